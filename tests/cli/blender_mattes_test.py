"""Blender's Cryptomatte node gives the mattes that Burin's files have, without any difference.

    blender_mattes_test.py BURIN SCENES

Without Blender the test fails: scripts/install-dependencies installs it.
"""
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import OpenImageIO as oiio

BURIN, SCENES = sys.argv[1], pathlib.Path(sys.argv[2])
WIDTH, HEIGHT = 160, 120

# Renders the matte of each name of each layer of one file. The image is loaded by a node of its own first: without, the
# first matte is empty.
BLENDER = '''
import bpy, sys
path, folder, wanted = sys.argv[sys.argv.index("--") + 1:]
scene = bpy.context.scene
scene.use_nodes = True
tree = scene.node_tree
tree.nodes.clear()
image = bpy.data.images.load(path)
reader = tree.nodes.new("CompositorNodeImage")
reader.image = image
node = tree.nodes.new("CompositorNodeCryptomatteV2")
node.source = "IMAGE"
node.image = image
composite = tree.nodes.new("CompositorNodeComposite")
tree.links.new(node.outputs["Matte"], composite.inputs["Image"])
scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
scene.render.resolution_percentage = 100
scene.render.engine = "BLENDER_WORKBENCH"
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.view_settings.view_transform = "Raw"
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(camera)
scene.camera = camera
for i, line in enumerate(open(wanted, encoding="utf-8").read().splitlines()):
    layer, name = line.split("\\t")
    node.layer_name = layer
    node.matte_id = name
    scene.render.filepath = f"{folder}/matte{i}.exr"
    bpy.ops.render.render(write_still=True)
'''.replace("WIDTH", str(WIDTH)).replace("HEIGHT", str(HEIGHT))


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    assert done.returncode == 0, (command, done.stdout[-2000:], done.stderr[-2000:])
    return done.stdout


def channels(path):
    """All channels by name, whatever their parts, and the manifests of the layers."""
    file = oiio.ImageInput.open(str(path))
    assert file, oiio.geterror()
    found, manifests, part = {}, {}, 0
    while file.seek_subimage(part, 0):
        spec = file.spec()
        for attribute in spec.extra_attribs:
            if attribute.name.startswith("cryptomatte/") and attribute.name.endswith("/manifest"):
                manifests[spec.getattribute(attribute.name[:-8] + "name")] = eval(attribute.value)
        for c, name in enumerate(spec.channelnames):
            found[name] = np.array(file.read_image(part, 0, c, c + 1, "float"))[..., 0]
        part += 1
    file.close()
    return found, manifests


def matte(pixels, layer, number):
    """What a layer has of a name."""
    total = np.zeros((HEIGHT, WIDTH), np.float32)
    for level in range(3):
        for names, shares in ("RG", "BA"):
            ids = pixels[f"{layer}{level:02}.{names}"].view(np.uint32)
            total += np.where(ids == number, pixels[f"{layer}{level:02}.{shares}"], 0)
    return total


def main():
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for more in ([], ["--parts"], ["--style", "technical"]):
            file = folder / "picture.exr"
            run(BURIN, "render", SCENES / "still_life.toml", "-o", file, "-q", "-r", f"{WIDTH}x{HEIGHT}", "--layers",
                "beauty,lines,crypto", *(more if "--style" in more else ["--hidden", "solid", *more]))
            pixels, manifests = channels(file)
            wanted = [(layer, name, int(number, 16)) for layer, names in manifests.items()
                      for name, number in names.items() if matte(pixels, layer, int(number, 16)).any()]
            wanted = wanted[:: 3 if more else 1]
            assert len(wanted) > 4, wanted
            (folder / "wanted").write_text("".join(f"{layer}\t{name}\n" for layer, name, _ in wanted), encoding="utf-8")
            (folder / "script.py").write_text(BLENDER)
            said = run("blender", "-b", "--factory-startup", "--python-exit-code", "9", "-P", folder / "script.py",
                       "--", file, folder, folder / "wanted")
            for i, (layer, name, number) in enumerate(wanted):
                seen, _ = channels(folder / f"matte{i}.exr")
                difference = np.abs(seen.get("R", seen.get("Y")) - matte(pixels, layer, number)).max()
                assert difference == 0, (more, layer, name, difference, said[-500:])
            print(len(wanted), "mattes are equal", *more)
    print("OK")


main()
