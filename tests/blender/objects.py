"""What objects of Blender become: kinds, instances, visibility, materials, marks; and Burin's own render of them."""

import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(__file__))

import bpy
import numpy as np

from in_blender import FOLDER, add, gathered, main, new_scene, paint, read, render


def names(result):
    return sorted(thing.name for thing in result.objects)


def link(thing):
    bpy.context.scene.collection.objects.link(thing)
    return thing


def all_kinds_have_polygons():
    new_scene()
    bpy.ops.object.text_add()
    bpy.context.object.data.extrude = .1
    bpy.ops.curve.primitive_bezier_circle_add()
    bpy.context.object.data.bevel_depth = .1
    bpy.ops.surface.primitive_nurbs_surface_sphere_add()
    bpy.ops.object.metaball_add()
    add("cube", "cube")
    bpy.ops.curve.primitive_bezier_curve_add()  # a wire without polygons
    bpy.ops.object.empty_add()
    bpy.ops.object.light_add()
    bpy.ops.object.armature_add()
    bpy.ops.object.volume_add()
    result = gathered()
    assert names(result) == ["BezierCircle", "Mball", "SurfSphere", "Text", "cube"], names(result)
    assert len(result.meshes) == 5 and all(len(mesh.corners) > 20 for mesh in result.meshes)
    assert result.notes == {"objects of type Volume are not drawn: Volume"}, result.notes
    assert render()["ViewLayer.Combined.A"].max() == 1


def polygons_stay_what_they_are():
    """Also large meshes, whose numbers are read from structs."""
    new_scene()
    add("cylinder", "cylinder", vertices=7)
    mesh = gathered().meshes[0]
    assert sorted(mesh.sizes) == [4] * 7 + [7, 7] and mesh.points.size == 42
    bpy.ops.object.delete()
    big = add("grid", "grid", x_subdivisions=70, y_subdivisions=50)
    paint(big, "a", (1, 0, 0, 1)), paint(big, "b", (0, 1, 0, 1))
    for i in range(0, len(big.data.polygons), 3):
        big.data.polygons[i].material_index = 1
    mesh = gathered().meshes[0]
    assert mesh.corners.tolist() == [loop.vertex_index for loop in big.data.loops]
    assert mesh.sizes.tolist() == [polygon.loop_total for polygon in big.data.polygons]
    assert mesh.slots.tolist() == [polygon.material_index for polygon in big.data.polygons]
    assert mesh.points.tolist() == [c for vertex in big.data.vertices for c in vertex.co]
    key = mesh.key()
    assert gathered().meshes[0].key() == key
    big.data.vertices[100].co.x += 1e-4
    big.data.update()
    assert gathered().meshes[0].key() != key


def instances_share_a_mesh():
    new_scene()
    cube = add("cube", "cube", size=.3)
    for i in range(3):
        copy = link(cube.copy())
        copy.location = (i, 0, 0)
    ball = add("ico_sphere", "ball", radius=.1)
    grid = add("grid", "grid", x_subdivisions=2, y_subdivisions=2)
    ball.parent, grid.instance_type = grid, "VERTS"
    result = gathered()
    kinds = {name: names(result).count(name) for name in names(result)}
    # Blender shows what is instanced where it stands, too.
    assert kinds == {"cube": 1, "cube.001": 1, "cube.002": 1, "cube.003": 1, "ball": 10, "grid": 1}, kinds
    assert len(result.meshes) == 3, len(result.meshes)
    assert sorted(result.matrices[[t.name.startswith("cube") for t in result.objects], 3]) == [0, 0, 1, 2]
    grid.show_instancer_for_render = grid.show_instancer_for_viewport = False
    assert names(gathered()).count("grid") == 0
    assert render()["ViewLayer.Combined.A"].max() == 1


def collections_are_instances():
    """Of several objects, twice, and one within the other."""
    scene = new_scene()
    part, whole = bpy.data.collections.new("part"), bpy.data.collections.new("whole")
    for kind, name in (("cube", "cube"), ("ico_sphere", "ball"), ("cone", "cone")):
        thing = add(kind, name)
        paint(thing, "material of " + name, (.5, .5, .5, 1))
        scene.collection.objects.unlink(thing)
        part.objects.link(thing)
    for i in range(2):
        empty = bpy.data.objects.new(f"part {i}", None)
        empty.instance_type, empty.instance_collection = "COLLECTION", part
        empty.location = (10 * i, 0, 0)
        whole.objects.link(empty)
    for i in range(3):
        empty = link(bpy.data.objects.new(f"whole {i}", None))
        empty.instance_type, empty.instance_collection = "COLLECTION", whole
        empty.location = (0, 10 * i, 0)
    result = gathered()
    assert names(result) == ["ball"] * 6 + ["cone"] * 6 + ["cube"] * 6, names(result)
    assert len(result.meshes) == 3
    for thing in result.objects:
        assert result.meshes[thing.mesh].name == thing.name and thing.looks[0].name == "material of " + thing.name
    places = {tuple(matrix[[3, 7]]) for matrix in result.matrices}
    assert places == {(x, y) for x in (0, 10) for y in (0, 10, 20)}, places


def geometry_nodes_are_instances():
    """Two meshes of one object, which differ by nothing but their data, with a material that nodes set."""
    new_scene()
    thing = add("grid", "grid", x_subdivisions=1, y_subdivisions=1)
    red = bpy.data.materials.new("red")
    modifier = thing.modifiers.new("nodes", "NODES")
    group = bpy.data.node_groups.new("nodes", "GeometryNodeTree")
    modifier.node_group = group
    group.inputs.new("NodeSocketGeometry", "in"), group.outputs.new("NodeSocketGeometry", "out")
    nodes, links = group.nodes, group.links
    begin, end, join = (nodes.new(kind) for kind in ("NodeGroupInput", "NodeGroupOutput", "GeometryNodeJoinGeometry"))
    for kind in ("GeometryNodeMeshCube", "GeometryNodeMeshIcoSphere"):
        instance, shape = nodes.new("GeometryNodeInstanceOnPoints"), nodes.new(kind)
        paint_node = nodes.new("GeometryNodeSetMaterial")
        paint_node.inputs["Material"].default_value = red
        links.new(shape.outputs["Mesh"], paint_node.inputs["Geometry"])
        links.new(begin.outputs[0], instance.inputs["Points"])
        links.new(paint_node.outputs["Geometry"], instance.inputs["Instance"])
        links.new(instance.outputs[0], join.inputs[0])
    links.new(join.outputs[0], end.inputs[0])
    result = gathered()
    sizes = sorted(len(result.meshes[t.mesh].corners) for t in result.objects)
    assert sizes == [24] * 4 + [60] * 4, sizes
    for thing in result.objects:
        assert thing.looks[result.meshes[thing.mesh].slot].name == "red", thing


def particles_are_instances():
    new_scene()
    ball = add("ico_sphere", "ball", radius=.1, location=(0, 0, -50))
    plane = add("plane", "plane", size=4)
    plane.modifiers.new("p", "PARTICLE_SYSTEM")
    settings = plane.particle_systems[0].settings
    settings.type, settings.count, settings.render_type, settings.instance_object = "HAIR", 30, "OBJECT", ball
    settings.particle_size, settings.hair_length = 1, 1
    found = names(gathered())
    assert found.count("ball") == 31 and found.count("plane") == 1, found
    settings.render_type = "PATH"
    assert gathered().notes == {"object plane: hair is not drawn"}, gathered().notes


def visibility_is_blenders():
    scene = new_scene()
    shown = {}
    for name in ("plain", "hidden", "indirect", "no camera", "excluded", "flat", "hidden collection"):
        shown[name] = add("cube", name)
    shown["hidden"].hide_render = shown["hidden"].hide_viewport = True
    shown["no camera"].visible_camera = False
    shown["excluded"].lineart.usage = "EXCLUDE"
    shown["flat"].scale = (1, 1, 0)
    for name, attribute in (("indirect", "indirect_only"), ("hidden collection", "exclude")):
        collection = bpy.data.collections.new(name)
        scene.collection.children.link(collection)
        scene.collection.objects.unlink(shown[name])
        collection.objects.link(shown[name])
        setattr(bpy.context.view_layer.layer_collection.children[name], attribute, True)
    quiet = bpy.data.collections.new("quiet")
    scene.collection.children.link(quiet)
    quiet.lineart_usage = "EXCLUDE"
    quiet.objects.link(add("cube", "of a collection"))
    result = gathered()
    assert names(result) == ["plain"], names(result)
    assert not result.notes, result.notes


def occlusion_only_hides_and_has_no_lines():
    new_scene()
    front = add("cube", "front", size=1, location=(1.5, -2.4, 2))
    add("cube", "back", size=3)
    full = render()["ViewLayer.Lines.A"]
    front.lineart.usage = "OCCLUSION_ONLY"
    quiet = render()["ViewLayer.Lines.A"]
    front.hide_render = True
    alone = render()["ViewLayer.Lines.A"]
    assert (quiet <= full + 1e-3).all() and (quiet <= alone + 1e-3).all()
    assert full.sum() > quiet.sum() + 10 and alone.sum() > quiet.sum() + 10, (full.sum(), quiet.sum(), alone.sum())


def holdouts_cut_a_hole():
    scene = new_scene()
    front = add("cube", "front", size=1, location=(1.5, -2.4, 2))
    add("cube", "back", size=3)
    full = render()["ViewLayer.Combined.A"]
    front.is_holdout = True
    held = render()["ViewLayer.Combined.A"]
    front.is_holdout = False
    bpy.data.objects["back"].hide_render = True
    alone = render()["ViewLayer.Combined.A"]
    assert alone.max() == 1 and held[alone == 1].max() < 1e-3
    assert (held[alone == 0] == full[alone == 0]).all() and held.max() == 1
    scene.render.film_transparent = False
    front.is_holdout = True
    assert (render()["ViewLayer.Combined.A"][alone == 1] < 1e-3).all()


def materials_have_one_color():
    from burin_blender.materials import look_of
    new_scene()
    notes = set()
    plain = bpy.data.materials.new("plain")
    plain.diffuse_color = (.1, .2, .3, .4)
    assert np.allclose(look_of(plain, notes)[1:3][0] + (look_of(plain, notes).opacity,), (.1, .2, .3, .4))
    plain.use_nodes = True
    principled = plain.node_tree.nodes["Principled BSDF"]
    principled.inputs["Base Color"].default_value = (.5, .6, .7, 1)
    principled.inputs["Alpha"].default_value = .25
    look = look_of(plain, notes)
    assert np.allclose(look.color, (.5, .6, .7)) and look.opacity == .25 and not notes
    texture = plain.node_tree.nodes.new("ShaderNodeTexChecker")
    plain.node_tree.links.new(texture.outputs[0], principled.inputs["Base Color"])
    look = look_of(plain, notes)
    assert np.allclose(look.color, (.1, .2, .3)) and len(notes) == 1 and "plain" in min(notes), notes
    bare = bpy.data.materials.new("bare")
    bare.use_nodes = True
    bare.node_tree.nodes.clear()
    look_of(bare, notes)
    assert len(notes) == 2, notes
    glow = bpy.data.materials.new("glow")
    glow.diffuse_color = (9, -1, .5, 1)  # Blender limits it, and so do we
    assert look_of(glow, notes).color == (1, 0, .5)

    # What else a material has at its output is named, and its surface is drawn.
    foggy, notes = bpy.data.materials.new("foggy"), set()
    foggy.use_nodes = True
    nodes, output = foggy.node_tree.nodes, foggy.node_tree.get_output_node("ALL")
    for kind, socket in ("ShaderNodeVolumePrincipled", "Volume"), ("ShaderNodeDisplacement", "Displacement"):
        foggy.node_tree.links.new(nodes.new(kind).outputs[0], output.inputs[socket])
    look_of(foggy, notes)
    assert notes == {f"material foggy: Burin leaves its {what} out" for what in ("volume", "displacement")}, notes


def faces_have_the_material_of_their_slot():
    scene = new_scene()
    scene.burin.shading, scene.burin.line_types = "LAMBERT", set()
    cube = add("cube", "cube", size=3)
    paint(cube, "red", (1, 0, 0, 1)), paint(cube, "green", (0, 1, 0, 1))
    for polygon in cube.data.polygons:
        polygon.material_index = 1 if polygon.normal.z > .5 else 0
    pixels = render()
    inside = pixels["ViewLayer.Combined.A"] == 1
    colors = {tuple(c > .1) for c in np.stack([pixels[f"ViewLayer.Combined.{k}"] for k in "RGB"], -1)[inside]}
    assert {(True, False, False), (False, True, False)} <= colors, colors
    for polygon in cube.data.polygons:
        polygon.material_index = 7 if polygon.normal.z > .5 else 0  # a slot that is not there is the last one
    cube.data.update()
    again = render()
    assert (again["ViewLayer.Combined.G"] == pixels["ViewLayer.Combined.G"]).all()
    cube.material_slots[1].link = "OBJECT"
    cube.material_slots[1].material = bpy.data.materials.new("blue")
    cube.material_slots[1].material.diffuse_color = (0, 0, 1, 1)
    assert pixels["ViewLayer.Combined.B"].max() == 0 and render()["ViewLayer.Combined.B"].max() > .3


def marked_edges_are_lines():
    scene = new_scene()
    scene.burin.line_types = {"MARK"}
    sphere = add("uv_sphere", "sphere", radius=2)
    assert render()["ViewLayer.Lines.A"].max() == 0
    for edge in sphere.data.edges:
        edge.use_freestyle_mark = all(abs(sphere.data.vertices[v].co.z) < 1e-3 for v in edge.vertices)
    marks = gathered().meshes[0].marks
    assert marks.shape == (32, 2), marks.shape
    assert render()["ViewLayer.Lines.A"].max() > .5


def modifiers_count_as_for_a_render():
    new_scene()
    cube = add("cube", "cube")
    levels = cube.modifiers.new("s", "SUBSURF")
    levels.levels, levels.render_levels = 1, 3
    for edge in cube.data.edges:
        edge.crease = 1
    assert len(gathered().meshes[0].sizes) == 24  # the viewport's
    sharp = render()["ViewLayer.Combined.A"]
    for edge in cube.data.edges:
        edge.crease = 0
    cube.data.update()
    round_ = render()["ViewLayer.Combined.A"]
    assert sharp.sum() > 1.2 * round_.sum()


def what_is_not_finite_is_named():
    new_scene()
    add("cube", "cube")
    bad = add("monkey", "bad monkey")
    bad.data.vertices[5].co.x = float("nan")
    try:
        render()
    except RuntimeError as error:
        assert "bad monkey" in str(error) and "point 5" in str(error), error
    else:
        raise AssertionError("a point that is no number is drawn")


def what_cannot_be_drawn_is_an_error():
    def alter(scene, what):
        exec(what, {"scene": scene})

    for what, message in (("scene.camera = None", "no camera"),
                          ("scene.camera.data.type = 'PANO'", "panoramic"),
                          ("scene.render.use_multiview = True", "Stereoscopy"),
                          ("scene.camera.scale = (0, 1, 1)", "camera camera is skewed or flattened"),
                          ("scene.camera.scale = (-1, 1, 1)", "mirrored"),
                          ("scene.camera.location.x = float('nan')", "camera_to_world"),
                          ("scene.burin.memory_mb, scene.render.resolution_x = 1, 9000", "Memory Cap: this picture"),
                          ("scene.camera.parent, scene.objects['cube'].scale = scene.objects['cube'], (1, 1, 3)",
                           "camera camera is skewed or flattened")):
        scene = new_scene()
        add("cube", "cube")
        alter(scene, what)
        try:
            render("broken")
        except RuntimeError as error:
            assert message in str(error), (what, error)
        else:
            raise AssertionError(what)
        assert not (FOLDER / "broken.exr").exists(), what


def an_empty_scene_is_empty():
    scene = new_scene()
    assert render()["ViewLayer.Combined.A"].max() == 0
    scene.render.film_transparent = False
    assert render()["ViewLayer.Combined.R"].min() == 1


def write_model(thing, path):
    """An OBJ of the mesh, without its transform."""
    mesh = thing.data
    with open(path, "w") as file:
        for vertex in mesh.vertices:
            file.write("v %.9g %.9g %.9g\n" % tuple(vertex.co))
        for polygon in mesh.polygons:
            file.write("f " + " ".join(str(v + 1) for v in polygon.vertices) + "\n")


def numbers(values):
    return "[" + ", ".join(repr(float(v)) for v in values) + "]"


def pictures_are_those_of_the_program():
    """The same scene as files, drawn by the program: equal but for pixels where the last bit of the camera counts."""
    scene = new_scene(320, 180)
    scene.burin.hidden = "SOLID"
    monkey = add("monkey", "monkey", size=2.5, location=(.3, .2, 1), rotation=(.1, .2, .3))
    torus = add("torus", "torus", location=(1, -1, .5))
    bpy.context.view_layer.update()
    pixels = render()
    matrix = np.array(scene.camera.matrix_world)
    fov = 2 * np.degrees(np.arctan(1 / scene.camera.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=320,
                                                                       y=180)[1][1]))
    from burin_blender.properties import settings_lines
    text = ["[picture]", "size = [320, 180]", "[[camera]]", f"eye = {numbers(matrix[:3, 3])}",
            f"target = {numbers(matrix[:3, 3] - matrix[:3, 2])}", f"up = {numbers(matrix[:3, 1])}", f"fov = {fov!r}"]
    for thing in (monkey, torus):
        write_model(thing, FOLDER / f"{thing.name}.obj")
        text += ["[[object]]", f'file = "{thing.name}.obj"', f'name = "{thing.name}"',
                 f"matrix = {numbers(np.array(thing.matrix_world).ravel())}"]
    (FOLDER / "scene.toml").write_text("\n".join(text) + "\n")
    sets = [part for line in settings_lines(scene, gathered().shown) for part in ("--set", line)]
    subprocess.run([os.environ["BURIN_PROGRAM"], "render", FOLDER / "scene.toml", "-o", FOLDER / "own.exr", "-q",
                    *sets], check=True)
    own = read(FOLDER / "own.exr")
    for layer, prefix in (("Combined", ""), ("Lines", "lines.")):
        for letter in "RGBA":
            a, b = pixels[f"ViewLayer.{layer}.{letter}"], own[prefix + letter].astype(np.float32)
            differ = (a != b).sum()
            assert differ <= 8, (layer, letter, differ)
    assert pixels["ViewLayer.Lines.A"].max() > .9


def the_preference_is_told():
    from burin_blender import core
    new_scene()
    preferences = bpy.context.preferences.addons["burin_blender"].preferences
    preferences.program = "/somewhere/burin"
    assert core._preference == "/somewhere/burin"
    preferences.program = ""
    assert core._preference == ""


main([all_kinds_have_polygons, polygons_stay_what_they_are, instances_share_a_mesh, collections_are_instances,
      geometry_nodes_are_instances, particles_are_instances,
      visibility_is_blenders, occlusion_only_hides_and_has_no_lines, holdouts_cut_a_hole, materials_have_one_color,
      faces_have_the_material_of_their_slot, marked_edges_are_lines, modifiers_count_as_for_a_render,
      what_is_not_finite_is_named, what_cannot_be_drawn_is_an_error, an_empty_scene_is_empty,
      pictures_are_those_of_the_program, the_preference_is_told])
