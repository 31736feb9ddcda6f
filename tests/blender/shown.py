"""What is seen of scenes with instances, animated looks, things of one name, and a camera with a clip range."""

import os
import sys

sys.path.insert(0, os.path.dirname(__file__))

import bpy
import numpy as np

from in_blender import FOLDER, add, look_of, main, new_scene, paint, read, render, told


def lines(pixels, letter="A"):
    return next(values for name, values in pixels.items() if name.endswith(f"Lines.{letter}"))


def share(pixels, letter):
    """How much of the ink has a colour: 1 where all lines are of this one."""
    return float(lines(pixels, letter).sum() / lines(pixels).sum())


def line_color(material, color):
    material.burin.use_line_color, material.burin.line_color = True, color
    return material


def at_two_frames():
    """The pictures of an animation's first and last frame, 1 and 10."""
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, scene.frame_step = 1, 10, 9
    scene.frame_set(5)
    scene.render.filepath = str(FOLDER / "frame_####")
    bpy.ops.render.render(animation=True)
    return [read(FOLDER / f"frame_{frame:04}.exr") for frame in (1, 10)]


def keyed(owner, path, first, last):
    """Two keys of a property, at frames 1 and 10."""
    name = path.rpartition(".")[2]
    place = owner.path_resolve(path.rpartition(".")[0]) if "." in path else owner
    for frame, value in ((1, first), (10, last)):
        setattr(place, name, value)
        owner.keyframe_insert(path, frame=frame)


def line_colors_are_animated():
    new_scene()
    material = line_color(paint(add("cube", "cube", size=3), "pen", (1, 1, 1, 1)), (1, 0, 0))
    keyed(material, "burin.line_color", (1, 0, 0), (0, 1, 0))
    first, last = at_two_frames()
    assert share(first, "R") > 0.99 and share(first, "G") < 0.01, (share(first, "R"), share(first, "G"))
    assert share(last, "R") < 0.01 and share(last, "G") > 0.99, (share(last, "R"), share(last, "G"))


def line_styles_are_animated():
    scene = new_scene()
    scene.burin.use_line_sets, scene.burin.shading = True, "NONE"
    cube = add("cube", "cube", size=3)
    pen = paint(cube, "pen", (1, 1, 1, 1))
    sets = bpy.context.view_layer.freestyle_settings.linesets
    while len(sets):
        sets.remove(sets[0])
    style = sets.new("set").linestyle
    keyed(style, "thickness", 2.0, 4.0)
    keyed(style, "color", (1, 0, 0), (0, 0, 1))
    first, last = at_two_frames()
    assert 1.9 < lines(last).sum() / lines(first).sum() < 2.1
    assert share(first, "R") > 0.99 and share(last, "B") > 0.99
    style.animation_data_clear()
    style.thickness = 3
    modifier = style.color_modifiers.new("material", "MATERIAL")
    modifier.material_attribute = "LINE"
    keyed(pen, "line_color", (1, 0, 0, 1), (0, 1, 0, 1))
    first, last = at_two_frames()
    assert share(first, "R") > 0.99 and share(last, "G") > 0.99


def targets_of_modifiers_are_animated():
    scene = new_scene()
    scene.burin.use_line_sets, scene.burin.shading = True, "NONE"
    add("cube", "cube", size=2)
    target = bpy.data.objects.new("target", None)
    scene.collection.objects.link(target)
    sets = bpy.context.view_layer.freestyle_settings.linesets
    while len(sets):
        sets.remove(sets[0])
    modifier = sets.new("set").linestyle.color_modifiers.new("distance", "DISTANCE_FROM_OBJECT")
    modifier.target, modifier.range_min, modifier.range_max = target, 5, 20
    modifier.color_ramp.elements[0].color, modifier.color_ramp.elements[1].color = (1, 0, 0, 1), (0, 1, 0, 1)
    keyed(target, "location", (0, 0, 0), (0, 0, 50))
    first, last = at_two_frames()
    assert share(first, "R") > 0.99 and share(last, "G") > 0.99, (share(first, "R"), share(last, "R"))


def instanced(name, collection, **settings):
    """An empty that shows a collection."""
    empty = bpy.data.objects.new(name, None)
    empty.instance_type, empty.instance_collection = "COLLECTION", collection
    for key, value in settings.items():
        setattr(empty, key, value)
    bpy.context.scene.collection.objects.link(empty)
    return empty


def part_with_a_cube():
    """A collection that is not in the scene, and its cube with a material."""
    part = bpy.data.collections.new("part")
    cube = add("cube", "cube", size=2)
    bpy.context.scene.collection.objects.unlink(cube)
    part.objects.link(cube)
    return part, cube, paint(cube, "pen", (1, 1, 1, 1))


def instances_have_the_colors_of_their_materials():
    new_scene()
    part, _, pen = part_with_a_cube()
    line_color(pen, (1, 0, 0))
    instanced("instance", part)
    assert share(render(), "R") > 0.99


def instances_have_the_usage_of_line_art():
    """Their own, that of a collection, or that of the object which makes them."""
    scene = new_scene()
    part, cube, _ = part_with_a_cube()
    instance = instanced("instance", part)
    assert lines(render()).sum() > 10
    for owner, attribute, plain in ((cube.lineart, "usage", "INHERIT"), (part, "lineart_usage", "INCLUDE"),
                                    (instance.lineart, "usage", "INHERIT")):
        setattr(owner, attribute, "OCCLUSION_ONLY")
        pixels = render()
        assert lines(pixels).sum() == 0 and pixels["ViewLayer.Combined.A"].max() == 1, owner
        setattr(owner, attribute, plain)
    # One instance draws no lines, another one of the same object does.
    alone = lines(render())
    second = instanced("second", part, location=(3, 0, 0))
    second.lineart.usage = "OCCLUSION_ONLY"
    assert abs(lines(render()).sum() - alone.sum()) < 0.2 * alone.sum()
    cube.lineart.use_crease_override, cube.lineart.crease_threshold = True, 1.5
    assert lines(render()).sum() < 0.9 * alone.sum()
    assert scene.burin.sheet.source == "NONE"


def materials_of_geometry_nodes_have_their_colors():
    new_scene()
    thing = add("cube", "cube", size=3)
    pen = line_color(bpy.data.materials.new("pen"), (0, 1, 0))
    group = bpy.data.node_groups.new("nodes", "GeometryNodeTree")
    thing.modifiers.new("nodes", "NODES").node_group = group
    group.inputs.new("NodeSocketGeometry", "in"), group.outputs.new("NodeSocketGeometry", "out")
    begin, end, node = (group.nodes.new(kind) for kind in ("NodeGroupInput", "NodeGroupOutput",
                                                           "GeometryNodeSetMaterial"))
    node.inputs["Material"].default_value = pen
    group.links.new(begin.outputs[0], node.inputs["Geometry"])
    group.links.new(node.outputs[0], end.inputs[0])
    assert share(render(), "G") > 0.99


def two_of_one_name():
    """A cube of this file at the left, and one of a library at the right, with materials of one name."""
    new_scene()
    other = add("cube", "cube", size=2, location=(2, 2, 0))
    line_color(paint(other, "pen", (1, 1, 1, 1)), (0, 0, 1))
    other.lineart.usage = "INCLUDE"
    path = str(FOLDER / "library.blend")
    bpy.data.libraries.write(path, {other})
    scene = new_scene()
    own = add("cube", "cube", size=2, location=(-2, -2, 0))
    line_color(paint(own, "pen", (1, 1, 1, 1)), (1, 0, 0))
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.objects = ["cube"]
    linked = wanted.objects[0]
    scene.collection.objects.link(linked)
    assert own.name == linked.name and own.active_material.name == linked.active_material.name
    return own, linked


def things_of_one_name_are_told_apart():
    own, linked = two_of_one_name()
    bpy.context.view_layer.use_pass_cryptomatte_object = True
    both = render()
    assert 0.4 < share(both, "R") < 0.6 and 0.4 < share(both, "B") < 0.6, (share(both, "R"), share(both, "B"))
    own.lineart.usage = "OCCLUSION_ONLY"
    pixels = render()
    assert share(pixels, "B") > 0.99, share(pixels, "B")
    # Cryptomatte has them by the name that both have.
    hashes = pixels["ViewLayer.CryptoObject00.R"].view(np.uint32)
    assert len(np.unique(hashes[pixels["ViewLayer.CryptoObject00.G"] > 0])) == 1
    own.is_holdout = True
    held = render()["ViewLayer.Combined.A"]
    own.hide_render = True
    alone = render()["ViewLayer.Combined.A"]
    assert np.abs(held - alone).max() < 0.05 and alone.max() == 1


def collections_of_line_sets_tell_them_apart():
    own, linked = two_of_one_name()
    scene = bpy.context.scene
    scene.burin.use_line_sets, scene.burin.shading = True, "NONE"
    part = bpy.data.collections.new("part")
    part.objects.link(own)
    sets = bpy.context.view_layer.freestyle_settings.linesets
    while len(sets):
        sets.remove(sets[0])
    line_set = sets.new("set")
    both = lines(render()).sum()
    line_set.select_by_collection, line_set.collection = True, part
    one = lines(render()).sum()
    assert 0.3 * both < one < 0.7 * both, (one, both)


def names_are_no_patterns():
    """What means something in patterns is a letter of a name, and a name fits nothing but itself."""
    new_scene()
    for name, other in (("a*", "abc"), ("a?", "ab"), ("!a", "b"), ('"a"', "b"), ("a\\", "b"), ("ä€😀", "b"),
                        ("a\tb", "b")):
        first = add("cube", name, size=2, location=(-2, -2, 0))
        second = add("cube", other, size=2, location=(2, 2, 0))
        assert first.name == name and second.name == other
        line_color(paint(first, name, (1, 1, 1, 1)), (1, 0, 0))
        line_color(paint(second, other, (1, 1, 1, 1)), (0, 0, 1))
        pixels = render()
        assert 0.4 < share(pixels, "R") < 0.6 and 0.4 < share(pixels, "B") < 0.6, (name, share(pixels, "R"))
        first.lineart.usage = "OCCLUSION_ONLY"
        assert share(render(), "B") > 0.99, name
        first.lineart.usage, second.lineart.usage = "INHERIT", "OCCLUSION_ONLY"
        assert share(render(), "R") > 0.99, name
        for thing in (first, second):
            for owner, kind in ((thing.active_material, bpy.data.materials), (thing, bpy.data.objects)):
                kind.remove(owner)


def material_override_counts():
    scene = new_scene()
    scene.burin.shading, scene.burin.line_types = "LAMBERT", set()
    bare, cube = add("monkey", "bare", location=(-2, -2, 0)), add("cube", "cube", location=(2, 2, 0))
    for name in ("red", "green"):
        paint(cube, name, (name == "red", name == "green", 0, 1))
    cube.data.polygons[0].material_index = 1
    blue = bpy.data.materials.new("blue")
    blue.diffuse_color = (0, 0, 1, 1)
    bpy.context.view_layer.material_override = blue
    pixels = render()
    assert pixels["ViewLayer.Combined.R"].max() == pixels["ViewLayer.Combined.G"].max() == 0
    assert pixels["ViewLayer.Combined.B"].max() > 0.3
    line_color(blue, (0, 1, 0))
    scene.burin.line_types = {"CREASE", "MATERIAL"}
    assert share(render(), "G") > 0.99 and bare.active_material is None


def looks_along_y():
    """A camera at the middle of the world that looks along y, with a range from 1 to 20."""
    scene = new_scene()
    camera = scene.camera
    camera.location, camera.rotation_euler = (0, 0, 0), (np.pi / 2, 0, 0)
    camera.data.clip_start, camera.data.clip_end = 1, 20
    return scene, camera


def cut_objects(said):
    return sorted(text.split("object ")[1].split(" reaches")[0] for text in said if "clip range" in text)


def objects_out_of_the_clip_range_are_left_out():
    for kind in ("PERSP", "ORTHO"):
        scene, camera = looks_along_y()
        camera.data.type, camera.data.ortho_scale = kind, 10
        for name, y, size in (("before", .5, .2), ("within", 10, 2), ("behind", 30, 4), ("at the start", 1, .5),
                              ("at the end", 20, 3), ("beside", -4, 1)):
            add("cube", name, size=size, location=(0, y, 0))
        ball = add("ico_sphere", "ball", radius=5, subdivisions=3, location=(0, 25.1, 0))
        ball.rotation_euler = (0.2, 0.6, 0.4)  # only the box around it reaches into the range
        add("cube", "out of the view", size=10, location=(60, 20, 0))
        pixels, said = told(render)
        assert cut_objects(said) == ["at the end", "at the start"], (kind, said)
        for name in ("before", "behind", "ball", "beside", "out of the view"):
            bpy.data.objects[name].hide_render = True
        assert (lines(render()) == lines(pixels)).all() and lines(pixels).max() > 0.9, kind


def a_floor_below_the_camera_is_not_cut():
    """It reaches behind the camera and beside it, where nobody sees it."""
    scene, camera = looks_along_y()
    camera.data.clip_start, camera.data.clip_end = .1, 100
    add("plane", "floor", size=30, location=(0, 0, -1.6))
    wall = add("cube", "house", size=8)
    for polygon in wall.data.polygons:
        polygon.flip()
    pixels, said = told(render)
    assert cut_objects(said) == [] and pixels["ViewLayer.Combined.A"].max() == 1, said
    camera.data.clip_start = 7  # the floor is seen from 6.3 on
    assert "floor" in cut_objects(told(render)[1])


def far_things_are_named_and_others_drawn():
    new_scene()
    add("cube", "cube", size=3)
    bpy.context.scene.camera.data.clip_end = 1e30
    plain = lines(render())
    far = add("cube", "far")
    for place in ((1e20, 0, 0), (0, -1e37, 1e37)):
        far.location = place
        pixels, said = told(render)
        assert (lines(pixels) == plain).all() and plain.max() > 0.9
        assert any("object far" in text and "1e+12" in text for text in said), said
    far.location = (0, 0, 0)
    far.data.vertices[0].co.x = 1e20
    pixels, said = told(render)
    assert (lines(pixels) == plain).all() and any("object far" in text for text in said), said


def grease_pencil_is_blenders():
    """Blender draws it over the picture; the pass Z tells it what surfaces hide."""
    scene = new_scene()
    scene.burin.shading = "PAPER"
    bpy.ops.object.gpencil_add(type="MONKEY")
    bpy.context.object.location, bpy.context.object.scale = (0, 0, 1), (3, 3, 3)
    cube = add("cube", "cube", size=1.5, location=(1.2, -2, 2))
    for has_depth in (False, True):
        bpy.context.view_layer.use_pass_z = has_depth
        cube.hide_render = False
        pixels, said = told(render)
        assert sum("grease pencil" in text for text in said) == (0 if has_depth else 1) == len(said), said
        cube.hide_render = True
        alone = render()
        dark = [(p["ViewLayer.Combined.A"] > 0.9) & (p["ViewLayer.Combined.G"] < 0.1) for p in (pixels, alone)]
        assert dark[1].sum() > 500 and (dark[0].sum() < 0.9 * dark[1].sum()) == has_depth, [d.sum() for d in dark]


def what_is_left_out_is_not_in_the_sheet():
    scene = new_scene()
    add("cube", "within", size=2)
    far = add("cube", "far")
    far.location = (1e20, 0, 0)
    far.lineart.usage = "OCCLUSION_ONLY"
    assert look_of(scene, bpy.context.view_layer)[1] is None
    far.location = (0, 90, 0)
    assert "group_0" in look_of(scene, bpy.context.view_layer)[1]


main([line_colors_are_animated, line_styles_are_animated, targets_of_modifiers_are_animated,
      instances_have_the_colors_of_their_materials, instances_have_the_usage_of_line_art,
      materials_of_geometry_nodes_have_their_colors, things_of_one_name_are_told_apart,
      collections_of_line_sets_tell_them_apart, names_are_no_patterns, material_override_counts,
      objects_out_of_the_clip_range_are_left_out, a_floor_below_the_camera_is_not_cut,
      far_things_are_named_and_others_drawn, grease_pencil_is_blenders, what_is_left_out_is_not_in_the_sheet])
