"""Blender shows a deep file as the beauty that was rendered beside it.

    blender_deep_test.py BURIN SCENES

Without Blender the test fails: scripts/install-dependencies installs it.
"""
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import OpenImageIO as oiio

BURIN, SCENES = sys.argv[1], pathlib.Path(sys.argv[2])

BLENDER = '''
import bpy, sys
path, output = sys.argv[sys.argv.index("--") + 1:]
image = bpy.data.images.load(path)
image.colorspace_settings.name = "Raw"
width, height = image.size
with open(output, "wb") as file:
    import array
    file.write(array.array("i", [width, height]).tobytes())
    file.write(array.array("f", image.pixels[:]).tobytes())
'''


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    assert done.returncode == 0, (command, done.stdout[-2000:], done.stderr[-2000:])
    return done.stdout


def main():
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "script.py").write_text(BLENDER)
        for more in ([], ["--hidden", "solid"], ["--set", 'surfaces.shading="lambert"', "--style", "technical"]):
            flat, deep = folder / "flat.exr", folder / "deep.exr"
            run(BURIN, "render", SCENES / "still_life.toml", "--deep", deep, "-q", "-r", "160x120", *more)
            plain = [] if more == ["--hidden", "solid"] else more
            hidden = [] if "--style" in more else ["--hidden", "none"]
            run(BURIN, "render", SCENES / "still_life.toml", "-o", flat, "-q", "-r", "160x120", *plain, *hidden)
            run("blender", "-b", "--factory-startup", "--python-exit-code", "9", "-P", folder / "script.py", "--", deep,
                folder / "pixels")
            data = (folder / "pixels").read_bytes()
            width, height = np.frombuffer(data, np.int32, 2)
            seen = np.frombuffer(data, np.float32, offset=8).reshape(height, width, 4)[::-1]
            file = oiio.ImageInput.open(str(flat))
            names = file.spec().channelnames
            pixels = file.read_image("float")
            file.close()
            beauty = np.stack([pixels[..., names.index(c)] for c in "RGBA"], axis=-1)
            assert seen.shape == beauty.shape, (seen.shape, beauty.shape)
            difference = np.abs(seen - beauty).max()
            print("off by", difference, *more)
            assert difference <= 2**-11, (more, difference)
    print("OK")


main()
