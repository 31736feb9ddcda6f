"""A scene with Freestyle line sets for docs/blender/freestyle.md, made anew; drawn by Burin:

    blender -b --addons burin_blender -P docs/blender/examples/line_sets.py -E BURIN -o //line_sets_# -F PNG -f 1

and by Freestyle itself, over white:

    blender -b -P docs/blender/examples/line_sets.py -E CYCLES -o //freestyle_# -F PNG -f 1
"""

import math
import sys

import bpy

for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
scene = bpy.context.scene
render = scene.render


def line_set(name, types, color, thickness, **settings):
    """A line set of these edge types; settings are those of the set or of its line style."""
    found = bpy.context.view_layer.freestyle_settings.linesets.new(name)
    for kind in ("silhouette", "border", "crease", "contour"):
        setattr(found, "select_" + kind, kind in types)
    found.linestyle.color, found.linestyle.thickness = color, thickness
    for key, value in settings.items():
        setattr(found.linestyle if hasattr(found.linestyle, key) else found, key, value)


bpy.ops.mesh.primitive_monkey_add(size=2, location=(0, 0, 1), rotation=(-.5, 0, .3))
bpy.context.object.modifiers.new("smooth", "SUBSURF").render_levels = 2
bpy.ops.object.shade_smooth()
bpy.ops.mesh.primitive_cube_add(size=1.4, location=(2.3, .4, .7), rotation=(0, 0, .5))
bpy.ops.mesh.primitive_cylinder_add(vertices=7, radius=.6, depth=1.6, location=(-2.1, .5, .8))
bpy.ops.mesh.primitive_plane_add(size=9)

white = bpy.data.materials.new("white")
white.use_nodes = True
nodes = white.node_tree.nodes
nodes.clear()
output, emission = nodes.new("ShaderNodeOutputMaterial"), nodes.new("ShaderNodeEmission")
emission.inputs["Color"].default_value = (1, 1, 1, 1)
white.node_tree.links.new(emission.outputs[0], output.inputs["Surface"])
for thing in bpy.data.objects:
    thing.data.materials.append(white)
scene.world = bpy.data.worlds.new("white")
scene.world.color = (1, 1, 1)

sets = bpy.context.view_layer.freestyle_settings.linesets
while len(sets):
    sets.remove(sets[0])
line_set("outlines", {"contour"}, (.02, .03, .1), 5)
line_set("edges", {"silhouette", "border", "crease"}, (.1, .1, .1), 1.5)
line_set("hidden", {"silhouette", "crease"}, (.4, .1, .05), 1.5, visibility="HIDDEN",
         use_dashed_line=True, dash1=7, gap1=5)

camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(camera)
camera.location, camera.rotation_euler = (4.2, -8.4, 4.4), (math.radians(67), 0, math.radians(26))
camera.data.lens = 46
scene.camera = camera
render.resolution_x, render.resolution_y = 450, 300
scene.view_settings.view_transform = "Standard"

# -E comes behind this script.
if "BURIN" in sys.argv:
    render.engine = "BURIN"
    scene.burin.use_line_sets = True
else:
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.max_bounces = 16, False, 0
    render.use_freestyle = True
