"""Freestyle's line sets as Burin draws them: against lengths that are computed here, and against Freestyle itself."""

import math
import os
import sys

sys.path.insert(0, os.path.dirname(__file__))

import bpy
import numpy as np
from bpy_extras.object_utils import world_to_camera_view

from in_blender import FOLDER, add, gathered, main, new_scene, read, render

WIDTH, HEIGHT = 320, 240
TOLERANCE = 0.02  # of lengths and thicknesses
EDGE_TYPES = ("silhouette", "border", "crease", "edge_mark", "material_boundary", "contour", "external_contour")


def line_set(name, types, **settings):
    """Adds a line set of these edge types; settings are those of the set or of its line style."""
    found = bpy.context.view_layer.freestyle_settings.linesets.new(name)
    found.select_by_edge_types = types is not None
    for kind in EDGE_TYPES:
        setattr(found, "select_" + kind, kind in (types or ()))
    for key, value in settings.items():
        setattr(found.linestyle if hasattr(found.linestyle, key) else found, key, value)
    return found


def no_line_sets():
    sets = bpy.context.view_layer.freestyle_settings.linesets
    while len(sets):
        sets.remove(sets[0])


def scene_of_lines():
    """A scene without surfaces in the picture, drawn by line sets."""
    scene = new_scene(WIDTH, HEIGHT)
    scene.burin.use_line_sets = True
    scene.burin.shading = "NONE"
    no_line_sets()
    return scene


def alpha():
    """All that is drawn."""
    return next(values for name, values in render().items() if name.endswith("Combined.A"))


def color():
    pixels = render()
    return np.stack([next(v for n, v in pixels.items() if n.endswith("Combined." + c)) for c in "RGB"], -1)


def ink_of(types, **settings):
    no_line_sets()
    line_set("set", types, **settings)
    return float(alpha().sum())


def near(found, wanted, tolerance=TOLERANCE):
    assert abs(found - wanted) <= tolerance * wanted, (found, wanted)


def edge_lengths(thing):
    """Lengths on the screen of a convex mesh's edges: on the outline, before it, behind it."""
    scene = bpy.context.scene
    eye = scene.camera.matrix_world.translation
    mesh, to_world = thing.data, thing.matrix_world
    turned = {}  # edge: how many of its faces are turned to the eye
    for polygon in mesh.polygons:
        faces_eye = (to_world.to_3x3() @ polygon.normal).dot(eye - to_world @ polygon.center) > 0
        for key in polygon.edge_keys:
            turned.setdefault(key, []).append(faces_eye)

    def on_screen(number):
        place = world_to_camera_view(scene, scene.camera, to_world @ mesh.vertices[number].co)
        return np.array([place.x * WIDTH, place.y * HEIGHT])

    lengths = {1: 0.0, 2: 0.0, 0: 0.0}
    for (a, b), faces in turned.items():
        lengths[sum(faces)] += float(np.linalg.norm(on_screen(a) - on_screen(b)))
    return lengths[1], lengths[2], lengths[0]


def cube(**arguments):
    thing = add("cube", "cube", **{"size": 3, **arguments})
    bpy.context.view_layer.update()
    return thing


def types_of_a_cube():
    scene_of_lines()
    outline, front, _ = edge_lengths(cube())
    near(ink_of(["silhouette"], thickness=3), 3 * outline)
    near(ink_of(["contour"], thickness=3), 3 * outline)
    near(ink_of(["external_contour"], thickness=3), 3 * outline)
    # As in Freestyle an edge has several natures: those of the outline are creases, too.
    near(ink_of(["crease"], thickness=3), 3 * (outline + front))
    near(ink_of(None, thickness=3), 3 * (outline + front))
    assert ink_of(["border"]) == ink_of(["edge_mark"]) == ink_of(["material_boundary"]) == 0


def combined_and_negated_types():
    scene_of_lines()
    outline, front, _ = edge_lengths(cube())
    near(ink_of(["silhouette", "crease"], thickness=3, edge_type_combination="AND"), 3 * outline)
    near(ink_of(["silhouette"], thickness=3, edge_type_negation="EXCLUSIVE"), 3 * front, 0.03)
    near(ink_of(["silhouette", "crease"], thickness=3, edge_type_combination="AND", exclude_silhouette=True),
         3 * front, 0.03)
    assert ink_of(["silhouette", "border"], edge_type_combination="AND") == 0


def crease_angle_is_between_faces():
    scene_of_lines()
    cube()
    settings = bpy.context.view_layer.freestyle_settings
    settings.crease_angle = math.radians(91)
    assert ink_of(["crease"]) > 0
    settings.crease_angle = math.radians(89)
    assert ink_of(["crease"]) == 0


def hidden_lines_by_their_surfaces():
    scene_of_lines()
    outline, front, back = edge_lengths(cube())
    every = ["silhouette", "crease"]
    near(ink_of(every, thickness=2, visibility="HIDDEN"), 2 * back, 0.03)
    near(ink_of(every, thickness=2, visibility="RANGE", qi_start=1, qi_end=1), 2 * back, 0.03)
    near(ink_of(every, thickness=2, visibility="RANGE", qi_start=0, qi_end=9), 2 * (outline + front + back), 0.03)
    assert ink_of(every, visibility="RANGE", qi_start=2, qi_end=9) == 0
    near(ink_of(every, thickness=2, select_by_visibility=False), 2 * (outline + front + back), 0.03)


def open_and_marked_edges():
    scene_of_lines()
    plane = add("plane", "plane", size=4)
    bpy.context.view_layer.update()
    assert ink_of(["silhouette"]) == ink_of(["crease"]) == 0
    whole = ink_of(["border"], thickness=3)
    assert whole > 500
    near(ink_of(["contour"], thickness=3), whole)
    plane.data.edges[0].use_freestyle_mark = plane.data.edges[1].use_freestyle_mark = True
    marked = ink_of(["edge_mark"], thickness=3)
    assert 0.3 * whole < marked < 0.7 * whole
    near(ink_of(["border", "edge_mark"], thickness=3), whole)


def contours_are_outlines_of_objects():
    """A torus has silhouettes before itself; they are no contours."""
    scene = scene_of_lines()
    add("torus", "torus", major_radius=2, minor_radius=1.1, major_segments=64, minor_segments=32)
    silhouette, contour = ink_of(["silhouette"]), ink_of(["contour"])
    external = ink_of(["external_contour"])
    assert external == contour < 0.95 * silhouette, (external, contour, silhouette)
    add("plane", "wall", size=50, location=(-3, 8, 0), rotation=(math.radians(90), 0, math.radians(20)))
    assert ink_of(["external_contour"]) < 0.05 * contour < ink_of(["contour"])
    assert scene.burin.use_line_sets


def collections():
    scene_of_lines()
    first, second = cube(size=1.5, location=(-2, 0, 0)), cube(size=1.5, location=(2, 0, 0))
    second.name = 'other "*?"'  # what means something in patterns and texts
    lengths = [sum(edge_lengths(thing)[:2]) for thing in (first, second)]
    part = bpy.data.collections.new("part")
    bpy.context.scene.collection.children.link(part)
    part.objects.link(second)
    settings = {"thickness": 3, "select_by_collection": True, "collection": part}
    near(ink_of(["crease"], **settings), 3 * lengths[1], 0.04)
    near(ink_of(["crease"], collection_negation="EXCLUSIVE", **settings), 3 * lengths[0], 0.04)
    part.objects.unlink(second)
    assert ink_of(["crease"], **settings) == 0
    near(ink_of(["crease"], collection_negation="EXCLUSIVE", **settings), 3 * sum(lengths), 0.04)


def large_collections():
    """A collection may have thousands of objects."""
    scene_of_lines()
    body = cube(size=1.5)
    part = bpy.data.collections.new("part")
    bpy.context.scene.collection.children.link(part)
    for number in range(3000):
        copy = bpy.data.objects.new(f"a name as long as people give them {number}", body.data)
        copy.scale = (0.01, 0.01, 0.01)  # within the body, which hides it
        part.objects.link(copy)
    settings = {"thickness": 3, "select_by_collection": True, "collection": part}
    assert ink_of(["crease"], **settings) == 0
    lengths = sum(edge_lengths(body)[:2])
    near(ink_of(["crease"], collection_negation="EXCLUSIVE", **settings), 3 * lengths, 0.04)


def thickness():
    scene = scene_of_lines()
    outline, _, _ = edge_lengths(cube())
    for pixels in (0.5, 1, 2.5, 8):
        near(ink_of(["silhouette"], thickness=pixels), pixels * outline, 0.03 if pixels == 8 else TOLERANCE)
    scene.render.line_thickness = 2
    near(ink_of(["silhouette"], thickness=1.5), 3 * outline)
    scene.render.line_thickness_mode = "RELATIVE"
    near(ink_of(["silhouette"], thickness=6), 6 * HEIGHT / 480 * outline)
    scene.render.line_thickness_mode = "ABSOLUTE"
    scene.render.resolution_percentage = 200
    near(ink_of(["silhouette"], thickness=1), 4 * 2 * outline)


def thickness_position():
    """What lies on the surface and what beside it."""
    scene = scene_of_lines()
    cube()
    no_line_sets()
    scene.burin.shading = "LAMBERT"
    surface = alpha() > 0.5
    scene.burin.shading = "NONE"
    whole = ink_of(["silhouette"], thickness=6)
    shares = {}
    for position in ("CENTER", "INSIDE", "OUTSIDE", "RELATIVE"):
        near(ink_of(["silhouette"], thickness=6, thickness_position=position, thickness_ratio=0.25), whole, 0.06)
        ink = alpha()
        shares[position] = float(ink[surface].sum() / ink.sum())
    assert abs(shares["CENTER"] - 0.5) < 0.05, shares  # a round corner has more outside
    assert shares["INSIDE"] > 0.95 and shares["OUTSIDE"] < 0.03, shares
    assert abs(shares["RELATIVE"] - 0.75) < 0.05, shares
    # Creases have no sides.
    near(ink_of(["silhouette"], thickness=6, thickness_position="INSIDE", edge_type_negation="EXCLUSIVE"),
         ink_of(["silhouette"], thickness=6, edge_type_negation="EXCLUSIVE"), 0.001)


def color_and_alpha():
    scene_of_lines()
    outline, _, _ = edge_lengths(cube())
    line_set("set", ["silhouette"], thickness=6, color=(0.5, 0.25, 0.125), alpha=0.5)
    pixels = color()
    strength = ((0.5 + 0.055) / 1.055) ** 2.4  # Freestyle's strokes have their alpha in sRGB
    middle = pixels.reshape(-1, 3)[pixels[..., 0].argmax()]
    assert np.abs(middle - strength * np.array([0.5, 0.25, 0.125])).max() < 2e-3, middle
    near(float(alpha().sum()), 6 * strength * outline)


def earlier_sets_lie_above():
    scene_of_lines()
    cube()
    line_set("above", ["silhouette"], thickness=4, color=(1, 0, 0))
    line_set("below", ["silhouette"], thickness=8, color=(0, 0, 1))
    red, _, blue = (float(color()[..., i].sum()) for i in range(3))
    assert 0.9 < red / blue < 1.1, (red, blue)


def dashes():
    scene_of_lines()
    cube()
    whole = ink_of(["silhouette", "crease"], thickness=2)
    near(ink_of(["silhouette", "crease"], thickness=2, use_dashed_line=True, dash1=9, gap1=3), 0.75 * whole, 0.05)
    near(ink_of(["silhouette", "crease"], thickness=2, use_dashed_line=True, dash1=8, gap1=4, dash2=2, gap2=2),
         0.625 * whole, 0.05)


def layers_without_line_sets():
    scene_of_lines()
    cube()
    assert float(alpha().sum()) == 0
    line_set("hidden", ["silhouette"], show_render=False)
    assert float(alpha().sum()) == 0
    line_set("shown", ["silhouette"])
    assert float(alpha().sum()) > 0
    bpy.context.view_layer.use_freestyle = False
    assert float(alpha().sum()) == 0


def modifier(kind, name, **settings):
    """The only line set's line style gets one more modifier."""
    style = bpy.context.view_layer.freestyle_settings.linesets[0].linestyle
    found = getattr(style, kind + "_modifiers").new("modifier", name)
    for key, value in settings.items():
        setattr(found, key, value)
    return found


def upright_square():
    """A square that faces an orthographic camera, 200 pixels wide."""
    scene = scene_of_lines()
    camera = scene.camera
    camera.location, camera.rotation_euler = (0, -10, 0), (math.radians(90), 0, 0)
    camera.data.type, camera.data.ortho_scale = "ORTHO", 3.2
    return add("plane", "square", size=2, rotation=(math.radians(90), 0, 0))


def modifiers_of_thickness():
    upright_square()
    line_set("set", ["border"], thickness=2)
    near(float(alpha().sum()), 2 * 800)
    # Level lines are thick, upright ones thin: the pen lies along the vertical.
    modifier("thickness", "CALLIGRAPHY", orientation=math.radians(90), thickness_min=1, thickness_max=5)
    ink = alpha()
    near(float(ink[:, 100:220].sum()), 2 * 5 * 120)
    near(float(ink[60:180].sum()), 2 * 1 * 120)
    for blend, influence, wanted in (("MULTIPLY", 1, 6), ("ADD", 0.5, 3.5), ("SUBTRACT", 0.5, 0.5),
                                     ("DIFFERENCE", 1, 1), ("MAXIMUM", 1, 3), ("MINIMUM", 0.5, 1.5),
                                     ("DIVIDE", 1, 2 / 3), ("MIX", 0.25, 2.25)):
        style = bpy.context.view_layer.freestyle_settings.linesets[0].linestyle
        style.thickness_modifiers.remove(style.thickness_modifiers[0])
        modifier("thickness", "CALLIGRAPHY", orientation=0, thickness_min=3, thickness_max=3, blend=blend,
                 influence=influence)
        near(float(alpha().sum()), wanted * 800)


def modifiers_of_distance():
    square = upright_square()
    bpy.context.scene.camera.data.type = "PERSP"
    line_set("set", ["border"], thickness=4, color=(1, 1, 1))
    ramp = modifier("color", "DISTANCE_FROM_OBJECT", range_min=0, range_max=4, target=square).color_ramp
    ramp.elements[0].color, ramp.elements[1].color = (1, 0, 0, 1), (0, 1, 0, 1)
    pixels = color()
    row, column = divmod(int(pixels[..., 0].argmax()), WIDTH)  # the reddest place is nearest to the middle
    assert min(abs(row - HEIGHT / 2), abs(column - WIDTH / 2)) < 3, (row, column)
    near(float(pixels[row, column, 0]), 0.75, 0.02)  # 1 from the middle, of 4
    style = bpy.context.view_layer.freestyle_settings.linesets[0].linestyle
    style.color_modifiers.remove(style.color_modifiers[0])
    modifier("alpha", "DISTANCE_FROM_CAMERA", range_min=8, range_max=12, mapping="LINEAR", invert=True)
    nearest = 1 - (math.hypot(10, 1) - 8) / 4  # alpha in the middle of an edge
    near(float(alpha().max()), ((nearest + 0.055) / 1.055) ** 2.4, 0.01)


def modifiers_of_material():
    square = upright_square()
    material = bpy.data.materials.new('blue "pen"')
    material.line_color = (0, 0, 1, 0.5)
    square.data.materials.append(material)
    line_set("set", ["border"], thickness=4)
    modifier("color", "MATERIAL", material_attribute="LINE")
    pixels = color()
    assert pixels[..., 2].max() > 0.99 and pixels[..., :2].max() == 0
    modifier("alpha", "MATERIAL", material_attribute="LINE_A")
    near(float(alpha().max()), ((0.5 + 0.055) / 1.055) ** 2.4, 0.01)


def modifiers_along_strokes():
    """Which end is the beginning is not said; both ends together are."""
    upright_square()
    line_set("set", ["border"], thickness=2)
    modifier("thickness", "ALONG_STROKE", value_min=0, value_max=8)
    near(float(alpha().sum()), 4 * 800, 0.03)
    curve = modifier("thickness", "ALONG_STROKE", value_min=2, value_max=6, mapping="CURVE").curve
    curve.curves[0].points[0].location = (0, 1)  # from 1 down to 0 and up again
    curve.curves[0].points.new(0.5, 0)
    for point in curve.curves[0].points:
        point.handle_type = "VECTOR"
    curve.update()
    near(float(alpha().sum()), 4 * 800, 0.03)


def what_is_not_drawn_is_named_once():
    from burin_blender import line_sets
    scene = scene_of_lines()
    cube()
    view_layer = bpy.context.view_layer
    found = line_set("odd", ["silhouette"], use_sorting=True, chaining="SKETCHY", caps="SQUARE", use_split_pattern=True)
    assert found.linestyle is not None
    found.select_suggestive_contour = found.select_by_face_marks = True
    modifier("alpha", "NOISE")
    modifier("geometry", "SPATIAL_NOISE")
    modifier("geometry", "SAMPLING")
    notes = line_sets.not_drawn(scene, view_layer, gathered().shown)
    for words in ("suggestive", "face marks", "sketchy", "square caps", "split pattern", "sorting", "Noise",
                  "Spatial Noise"):
        assert sum(words in note for note in notes) >= 1, (words, notes)
    assert len(notes) == len(set(notes)) == 8 and all("odd" in note for note in notes), notes
    assert float(alpha().sum()) > 0
    scene.render.use_freestyle = True
    assert "Freestyle itself is on" in line_sets.not_drawn(scene, view_layer, gathered().shown)[0]
    scene.render.use_freestyle = False
    view_layer.freestyle_settings.mode = "SCRIPT"
    assert len(line_sets.not_drawn(scene, view_layer, gathered().shown)) == 1 and float(alpha().sum()) == 0


def white(thing):
    """A material that shines, so that only lines are dark."""
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    output, emission = nodes.new("ShaderNodeOutputMaterial"), nodes.new("ShaderNodeEmission")
    emission.inputs[0].default_value = (1, 1, 1, 1)
    material.node_tree.links.new(emission.outputs[0], output.inputs[0])
    thing.data.materials.append(material)


def freestyle_itself():
    """Ink of Freestyle's own strokes, drawn over white by Cycles."""
    scene = bpy.context.scene
    scene.render.engine, scene.render.use_freestyle = "CYCLES", True
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.max_bounces = 16, False, 0
    scene.cycles.pixel_filter_type = "BOX"
    scene.render.film_transparent = False
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.filepath = str(FOLDER / "freestyle.exr")
    bpy.ops.render.render(write_still=True)
    scene.render.engine, scene.render.use_freestyle, scene.render.film_transparent = "BURIN", False, True
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    return 1 - read(FOLDER / "freestyle.exr")["R"]


def as_freestyle_draws_it():
    scene = scene_of_lines()
    scene.world = bpy.data.worlds.new("white")
    scene.world.color = (1, 1, 1)
    things = [cube(size=2), add("uv_sphere", "ball", radius=0.8, location=(1.8, 1.5, 0.3), segments=32, ring_count=16),
              add("plane", "floor", size=7, location=(0, 0, -1.5))]
    for thing in things:
        white(thing)
    for edge in things[0].data.edges[:6]:
        edge.use_freestyle_mark = True
    part = bpy.data.collections.new("part")
    scene.collection.children.link(part)
    part.objects.link(things[0])
    every = ["silhouette", "border", "crease"]
    for types, settings in (
            (["silhouette"], {}), (["border"], {}), (["crease"], {}), (["edge_mark"], {}), (["contour"], {}),
            (["external_contour"], {}), (every, {"visibility": "HIDDEN"}),
            (every, {"visibility": "RANGE", "qi_start": 2, "qi_end": 4}),
            (["silhouette"], {"edge_type_negation": "EXCLUSIVE"}),
            (["silhouette", "crease"], {"edge_type_combination": "AND", "exclude_silhouette": True}),
            (every, {"select_by_collection": True, "collection": part, "collection_negation": "EXCLUSIVE"}),
            (every, {"thickness": 8, "thickness_position": "INSIDE"}), (every, {"alpha": 0.6, "thickness": 4})):
        ink = ink_of(types, **settings)
        own, theirs = alpha(), freestyle_itself()
        near(ink, float(theirs.sum()), 0.04)
        assert np.abs(own - theirs).sum() < 0.1 * ink, (types, settings)


CHECKS = (
    types_of_a_cube, combined_and_negated_types, crease_angle_is_between_faces, hidden_lines_by_their_surfaces,
    open_and_marked_edges, contours_are_outlines_of_objects, collections, large_collections, thickness,
    thickness_position, color_and_alpha, earlier_sets_lie_above, dashes, layers_without_line_sets, modifiers_of_thickness,
    modifiers_of_distance, modifiers_of_material, modifiers_along_strokes, what_is_not_drawn_is_named_once,
    as_freestyle_draws_it)

main(CHECKS)
