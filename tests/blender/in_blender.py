"""What the checks that run inside Blender share: scenes made by Python, pictures as arrays."""

import math
import os
import pathlib

import bpy
import numpy as np
import OpenImageIO as oiio

FOLDER = pathlib.Path(os.environ["BURIN_TEST_FOLDER"])


def new_scene(width=160, height=90):
    """An empty scene with a camera, seen from the front right and above."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="burin_blender")  # factory settings have taken it away
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    camera.location = (5.5, -8, 5.5)
    camera.rotation_euler = (math.radians(62), 0, math.radians(34))
    camera.data.lens = 40
    scene.camera = camera
    render = scene.render
    render.engine = "BURIN"
    render.resolution_x, render.resolution_y = width, height
    render.film_transparent = True
    render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    render.image_settings.color_depth = "32"
    return scene


def add(kind, name, **arguments):
    """Adds a mesh by an operator of bpy.ops.mesh.primitive_KIND_add."""
    getattr(bpy.ops.mesh, f"primitive_{kind}_add")(**arguments)
    thing = bpy.context.view_layer.objects.active
    thing.name = thing.data.name = name
    return thing


def paint(thing, name, color):
    """Gives a mesh one more material."""
    material = bpy.data.materials.new(name)
    material.diffuse_color = color
    thing.data.materials.append(material)
    return material


def gathered():
    """What the add-on takes from the scene, as a viewport would."""
    from burin_blender.gather import gather
    return gather(bpy.context.evaluated_depsgraph_get())


def look_of(scene, view_layer):
    """Settings and style sheet, as the library gets them."""
    from burin_blender import line_sets, properties
    shown = gathered().shown
    return properties.settings_lines(scene, shown), line_sets.sheet_text(scene, view_layer, shown)


def read(path):
    """The channels of an EXR by name, (height, width), rows from the top. Files of one part only."""
    file = oiio.ImageInput.open(str(path))
    assert file, oiio.geterror()
    spec = file.spec()
    channels = {name: np.array(file.read_image(0, 0, i, i + 1, oiio.UNKNOWN)).reshape(spec.height, spec.width)
                for i, name in enumerate(spec.channelnames)}
    file.close()
    return channels


def render(name="picture", **arguments):
    """Renders the scene; gives the channels of its file."""
    path = FOLDER / f"{name}.exr"
    path.unlink(missing_ok=True)
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True, **arguments)
    return read(path)


def told(job):
    """Calls job(), and gives its result and what the engine has reported."""
    from burin_blender import engine
    said, original = [], engine.BurinEngine.tell

    def tell(self, kind, notes):
        said.extend(sorted(set(notes) - engine._told))
        original(self, kind, notes)

    engine.BurinEngine.tell = tell
    try:
        return job(), said
    finally:
        engine.BurinEngine.tell = original


def main(checks):
    """Runs checks, and ends Blender with status 1 at the first that fails."""
    for check in checks:
        try:
            check()
        except BaseException:
            import traceback
            traceback.print_exc()
            print(f"FAILED {check.__name__}", flush=True)
            os._exit(1)
        print(f"PASSED {check.__name__}", flush=True)
    os._exit(0)
