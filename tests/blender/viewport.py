"""The live viewport, in a window: what is on the screen is the library's picture of that view. Needs a display."""

import math
import os
import sys
import time
import traceback

sys.path.insert(0, os.path.dirname(__file__))

import bpy
import numpy as np
import OpenImageIO as oiio
from mathutils import Quaternion

from in_blender import FOLDER, add, look_of, new_scene, paint

from burin_blender import mesh_arrays, properties, view_fields, viewport
from burin_blender.export import Session
from burin_blender.look import Look

EDGE = 30  # of a region, where Blender draws rounded corners and arrows over the picture
FRAME = 3  # beside the frame of a camera or a border
SECONDS_TO_REST = 30  # far more than it takes
NEAREST_CODES = 2  # of 255: a texture of halves, and rounding of the display


class Fails(Exception):
    """A check failed."""


def window():
    return bpy.context.window_manager.windows[0]


def area():
    return next(a for a in window().screen.areas if a.type == "VIEW_3D")


def region():
    return next(r for r in area().regions if r.type == "WINDOW")


def space():
    return area().spaces.active


def view():
    return space().region_3d


def inside():
    """The context of the viewport."""
    return bpy.context.temp_override(window=window(), area=area(), region=region(), space_data=space(),
                                     region_data=view())


def live():
    found = [v for v in viewport.live_views]
    return found[0] if found else None


def screen():
    """What the viewport shows: (height, width, 3) bytes."""
    # A name of its own each time: OpenImageIO keeps a file that is written again within a second.
    path = str(FOLDER / f"screen_{time.monotonic_ns()}.png")
    with bpy.context.temp_override(window=window(), area=area()):
        bpy.ops.screen.screenshot(filepath=path)
    whole = oiio.ImageBuf(path).get_pixels(oiio.UINT8)[..., :3]
    r = region()
    height = whole.shape[0]
    return whole[height - r.y - r.height:height - r.y, r.x:r.x + r.width].astype(int)


def from_library(shown=lambda thing: True):
    """The same view by a scene of its own, as bytes on the display."""
    scene, view_layer = bpy.context.scene, bpy.context.view_layer
    depsgraph = bpy.context.evaluated_depsgraph_get()
    session = Session()
    session.update(depsgraph)
    Look().apply(session.scene, *look_of(scene, view_layer))
    with inside():
        fields = view_fields.fields_of(bpy.context, depsgraph)
    picture = session.scene.render({**fields, "samples": properties.samples_of(scene.burin.viewport_samples)}, "beauty")
    pixels = picture.layer("").astype(float)
    light = pixels[..., :3] + (1 - pixels[..., 3:]) * np.array(scene.burin.background)
    codes = np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.clip(light, 0, 1) ** (1 / 2.4) - 0.055)
    return np.clip(np.round(255 * codes), 0, 255).astype(int), fields


def keep(name, pixels):
    """Writes a picture for whoever looks why a check failed."""
    image = oiio.ImageBuf(oiio.ImageSpec(pixels.shape[1], pixels.shape[0], 3, oiio.UINT8))
    image.set_pixels(oiio.ROI(), pixels.astype(np.uint8))
    image.write(str(FOLDER / f"{name}.png"))


draws = 0  # how often Blender had a viewport drawn


def count_draws():
    original = viewport.view_draw

    def counting(*arguments):
        global draws
        original(*arguments)
        draws += 1

    viewport.view_draw = counting


def until(condition, what):
    """Waits for something that is to come by itself."""
    begin = time.monotonic()
    while not condition():
        if time.monotonic() - begin > SECONDS_TO_REST:
            raise Fails(what)
        yield 0.05


def drawn_again():
    before = draws
    area().tag_redraw()
    yield from until(lambda: draws > before, "the viewport is not drawn again")


def at_rest():
    """Waits until the full picture of what is there now is on the screen."""
    yield from drawn_again()
    yield from until(lambda: live() is not None and live().is_final, "the viewport does not come to rest")
    yield from drawn_again()
    yield 0.1


def unmarked(fields, shape):
    """Where nothing of Blender's lies over the picture: its corners and arrows, frames of cameras and borders."""
    mask = np.ones(shape[:2], bool)
    mask[:EDGE] = mask[-EDGE:] = mask[:, :EDGE] = mask[:, -EDGE:] = False
    boxes = [fields["crop"]] if "crop" in fields else []
    if view().view_perspective == "CAMERA":
        with inside():
            left, bottom, right, top = view_fields.camera_frame(bpy.context, bpy.context.scene)
        boxes.append((left, shape[0] - top, right, shape[0] - bottom))
    for x0, y0, x1, y1 in boxes:
        for x in (x0, x1):
            mask[:, max(round(x) - FRAME, 0):max(round(x) + FRAME, 0)] = False
        for y in (y0, y1):
            mask[max(round(y) - FRAME, 0):max(round(y) + FRAME, 0)] = False
    return mask


def same_as_library():
    """Fails unless the screen shows the library's picture. Gives it."""
    yield from at_rest()
    wanted, fields = from_library()
    seen = screen()
    x0, y0, x1, y1 = fields.get("crop", (0, 0, fields["width"], fields["height"]))
    if seen.shape[:2] != (fields["height"], fields["width"]):
        raise Fails(f"{seen.shape} on the screen, {fields} wanted")
    mask = unmarked(fields, seen.shape)[y0:y1, x0:x1]
    differs = (np.abs(seen[y0:y1, x0:x1] - wanted).max(axis=2) > NEAREST_CODES) & mask
    if differs.any():
        keep("seen", seen[y0:y1, x0:x1])
        keep("wanted", wanted)
        rows, columns = np.nonzero(differs)
        raise Fails(f"differs at {differs.sum()} places, the first of them {columns[0] + x0},{rows[0] + y0}")
    if not (wanted[mask] < 100).any():
        raise Fails("no lines")
    return seen


def begin():
    """A viewport that shows nothing but the picture, with a scene to look at."""
    count_draws()
    scene = new_scene()
    yield 0.5  # the windows are new ones
    bpy.context.preferences.view.show_splash = False
    bpy.context.preferences.view.smooth_view = 0  # views change at once, so that a check does not see them on the way
    monkey = add("monkey", "monkey", size=2)
    modifier = monkey.modifiers.new("finer", "SUBSURF")
    modifier.levels = 2
    paint(add("cube", "cube", size=1.5, location=(2, 0, 0)), "blue", (0, 0, 1, 1))
    scene.camera.data.show_passepartout = False
    scene.view_settings.view_transform = "Standard"
    scene.render.film_transparent = False
    shown = space()
    shown.overlay.show_overlays = shown.show_gizmo = False
    with inside():
        shown.show_region_header = shown.show_region_toolbar = shown.show_region_tool_header = False
    shown.shading.type = "RENDERED"
    view().view_perspective = "PERSP"
    view().view_location, view().view_distance = (1, 0, 0), 9
    view().view_rotation = Quaternion((0, 0, 1), 0.4) @ Quaternion((1, 0, 0), 1.1)
    yield 0.5


def turns():
    before = yield from same_as_library()
    view().view_rotation = Quaternion((0, 0, 1), 0.3) @ view().view_rotation
    after = yield from same_as_library()
    if (before != after).sum() < 1000:
        raise Fails("a turn changes nothing")


def other_projections():
    view().view_perspective = "ORTHO"
    yield from same_as_library()
    with inside():
        bpy.ops.view3d.view_axis(type="FRONT")
    seen = yield from same_as_library()
    # The viewport's middle is within the head; what is before it is seen, too.
    eyes = (seen[250:285, 285:345].min(axis=2) < 100).sum()
    if eyes < 20:
        raise Fails(f"an orthographic view is cut: {eyes} dark pixels where eyes are")
    view().view_perspective = "CAMERA"
    view().view_camera_zoom, view().view_camera_offset = 10, (0.1, -0.05)
    yield from same_as_library()
    camera = bpy.context.scene.camera.data
    camera.shift_x, camera.sensor_fit = 0.2, "VERTICAL"
    yield from same_as_library()
    camera.type = "ORTHO"
    yield from same_as_library()
    camera.type = "PERSP"


def borders():
    render = bpy.context.scene.render
    render.use_border = True
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.2, 0.7, 0.3, 0.9
    seen = yield from same_as_library()
    if (seen > 250).all(axis=2).mean() > 0.8:
        raise Fails("the border is not kept")
    render.use_border = False
    view().view_perspective = "PERSP"
    space().use_render_border = True
    space().render_border_min_x, space().render_border_max_x = 0.4, 0.8
    space().render_border_min_y, space().render_border_max_y = 0.25, 0.75
    yield from same_as_library()
    space().use_render_border = False
    yield from same_as_library()


def sizes():
    before = region().width
    space().show_region_ui = True
    bpy.context.preferences.system.use_region_overlap = False
    yield from until(lambda: region().width != before, "the region has the same size")
    yield from same_as_library()
    space().show_region_ui = False
    bpy.context.preferences.system.use_region_overlap = True
    yield from until(lambda: region().width == before, "the region keeps its size")
    yield from same_as_library()


def what_is_shown():
    """Hidden objects, and local view."""
    whole = yield from same_as_library()
    cube, monkey = bpy.data.objects["cube"], bpy.data.objects["monkey"]
    cube.hide_set(True)
    hidden = yield from same_as_library()
    cube.hide_set(False)
    again = yield from same_as_library()
    if (whole != again).any() or (whole == hidden).all():
        raise Fails("hiding an object")
    for thing in (cube, monkey):
        thing.select_set(thing is monkey)
    bpy.context.view_layer.objects.active = monkey
    with inside():
        bpy.ops.view3d.localview(frame_selected=False)
    yield from at_rest()
    if (screen() != hidden).any():
        raise Fails("local view is not the picture without the other object")
    with inside():
        bpy.ops.view3d.localview(frame_selected=False)
    yield from at_rest()
    if (screen() != whole).any():
        raise Fails("something is left of local view")
    space().show_object_viewport_mesh = False
    yield from at_rest()
    if (screen()[EDGE:-EDGE, EDGE:-EDGE] < 250).any():
        raise Fails("meshes are seen though the viewport shows none")
    space().show_object_viewport_mesh = True
    yield from same_as_library()


def only_what_changes_is_read():
    read = []
    original = mesh_arrays.MeshArrays.__init__

    def counting(self, mesh, name, *arguments):
        read.append(name)
        original(self, mesh, name, *arguments)

    mesh_arrays.MeshArrays.__init__ = counting
    try:
        cube = bpy.data.objects["cube"]
        cube.location.x += 0.3
        yield from at_rest()
        if read:
            raise Fails(f"{read} read for a move")
        cube.data.vertices[0].co.z += 0.4
        cube.data.update()
        yield from at_rest()
        if read != ["cube"]:
            raise Fails(f"{read} read for a change of the cube")
        bpy.data.objects["monkey"].modifiers["finer"].levels = 1
        yield from at_rest()
        if read != ["cube", "monkey"]:
            raise Fails(f"{read} read for a change of the monkey's modifier")
    finally:
        mesh_arrays.MeshArrays.__init__ = original
    yield from same_as_library()


def frames_and_undo():
    """Another frame, and back in time: addresses of Blender's data may be others, or the same of other data."""
    scene, cube = bpy.context.scene, bpy.data.objects["cube"]
    cube.keyframe_insert("location", frame=1)
    cube.location.z += 1
    cube.keyframe_insert("location", frame=10)
    scene.frame_set(10)
    late = yield from same_as_library()
    scene.frame_set(1)
    early = yield from same_as_library()
    if (early == late).all():
        raise Fails("an animation changes nothing")
    with inside():
        bpy.ops.ed.undo_push(message="before")
    cube.data.vertices[1].co.x -= 0.7
    cube.data.update()
    add("torus", "torus", location=(0, -2, 0))
    with inside():
        bpy.ops.ed.undo_push(message="after")
    yield from same_as_library()
    with inside():
        bpy.ops.ed.undo()
    undone = yield from same_as_library()
    if (undone != early).any():
        raise Fails("undo leaves something")
    bpy.data.objects.remove(bpy.data.objects["monkey"])
    add("uv_sphere", "monkey", segments=16, ring_count=8).modifiers.new("finer", "SUBSURF")
    yield from same_as_library()


def looks():
    """Settings, presets, line sets: those of which Blender tells nothing are seen as well."""
    settings = bpy.context.scene.burin
    settings.width, settings.shading, settings.paper = 4, "PAPER", (1, 0.8, 0.6)
    yield from same_as_library()
    settings.shading, settings.background = "TOON", (0.9, 1, 0.9)
    settings.use_shadows = True
    yield from same_as_library()
    settings.shading = "PAPER"  # needs a scene of the library that knows no shadows
    yield from same_as_library()
    pen = bpy.data.objects["cube"].active_material.burin
    plain = yield from same_as_library()
    pen.use_line_color, pen.line_color = True, (1, 0, 0)
    colored = yield from same_as_library()
    bpy.data.objects["cube"].lineart.usage = "OCCLUSION_ONLY"
    silent = yield from same_as_library()
    bpy.data.objects["cube"].lineart.usage, pen.use_line_color = "INHERIT", False
    if not (plain != colored).any() or not (colored != silent).any():
        raise Fails("a line colour or a usage is not seen")
    settings.sheet.source, settings.sheet.name_of_sheet = "NAME", "pencil"
    yield from same_as_library()
    settings.use_line_sets = True
    found = bpy.context.view_layer.freestyle_settings.linesets.new("set")
    found.linestyle.thickness = 2
    thin = yield from same_as_library()
    found.linestyle.thickness = 9
    before = live().version  # nobody asks for a redraw
    yield from until(lambda: live().version > before, "another thickness of a line style is not seen")
    thick = yield from same_as_library()
    if (thin == thick).all():
        raise Fails("a thicker line style changes nothing")
    settings.use_line_sets = False
    settings.sheet.source = "NONE"
    settings.background, settings.paper = (1, 1, 1), (1, 1, 1)
    yield from same_as_library()


def errors_are_texts():
    """A sheet that is wrong shows no picture; when it is right again, there is one."""
    sheet = bpy.context.scene.burin.sheet
    text = bpy.data.texts.new("mine")
    text.write('[[set]]\nname = "a"\nclasses = ["creese"]\nstyle = "b"\n[style.b]\nwidth = 3\n')
    sheet.source, sheet.text = "TEXT", text
    yield from until(lambda: "did you mean 'crease'" in live().look_error, "no error")
    yield from drawn_again()
    yield 0.1
    seen = screen()
    if (seen > 250).all(axis=2).mean() > 0.5:
        raise Fails("a picture is shown beside the error")
    reddish = (seen[..., 0] > seen[..., 1] + 60).sum()
    if reddish < 100:
        raise Fails("the error cannot be seen")
    text.from_string(text.as_string().replace("creese", "crease"))
    yield from until(lambda: not live().look_error, "the sheet is right, but an error is left")
    yield from same_as_library()
    sheet.source = "NONE"


def changes_while_it_works():
    """Turns while full pictures are made: none is kept for another view."""
    settings = bpy.context.scene.burin
    settings.viewport_samples = "8"
    bpy.data.objects["monkey"].modifiers["finer"].levels = 3
    for step in range(12):
        view().view_rotation = Quaternion((0, 0, 1), 0.05) @ view().view_rotation
        area().tag_redraw()
        yield 0.05 + 0.03 * (step % 5)
    yield from same_as_library()
    for _ in range(3):  # an object goes while its picture is made
        view().view_rotation = Quaternion((0, 0, 1), 0.05) @ view().view_rotation
        area().tag_redraw()
        yield 0.25
        thing = bpy.data.objects["cube"]
        thing.hide_set(not thing.hide_get())
    bpy.data.objects["cube"].hide_set(False)
    settings.viewport_samples = "AUTO"
    yield from same_as_library()


def viewport_goes():
    """Another kind of shading, and back: nothing of the old one works on."""
    space().shading.type = "SOLID"
    yield from until(lambda: live() is None, "a live view is left")
    space().shading.type = "RENDERED"
    yield from same_as_library()


def all_panels_are_drawn():
    """By Blender itself, in the properties editor: their errors are printed, for which run.sh looks."""
    bpy.context.scene.burin.use_line_sets = True
    editor = next(a for a in window().screen.areas if a.type == "PROPERTIES")
    for name in ("RENDER", "OUTPUT", "VIEW_LAYER", "SCENE", "WORLD", "OBJECT", "DATA", "MATERIAL"):
        editor.spaces.active.context = name
        editor.tag_redraw()
        yield 0.2


CHECKS = (turns, other_projections, borders, sizes, what_is_shown, only_what_changes_is_read, frames_and_undo, looks,
          errors_are_texts, changes_while_it_works, viewport_goes, all_panels_are_drawn)


def run():
    yield from begin()
    for check in CHECKS:
        yield from check()
        print(f"PASSED {check.__name__}", flush=True)


progress = run()


def step():
    try:
        return next(progress)
    except StopIteration:
        os._exit(0)
    except BaseException:
        traceback.print_exc()
        print("FAILED", flush=True)
        os._exit(1)


# Blender's window has to be there first.
bpy.app.timers.register(step, first_interval=1, persistent=True)
