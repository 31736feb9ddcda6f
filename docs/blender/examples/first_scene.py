"""A scene for docs/blender.md, made anew:

    blender -b --addons burin_blender -P docs/blender/examples/first_scene.py -E BURIN -o //first_# -F PNG -f 1
"""

import math

import bpy

for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
scene = bpy.context.scene

bpy.ops.mesh.primitive_monkey_add(size=2, location=(0, 0, 1), rotation=(-.5, 0, .3))
smooth = bpy.context.object.modifiers.new("smooth", "SUBSURF")
smooth.levels = smooth.render_levels = 3
bpy.ops.object.shade_smooth()

bpy.ops.mesh.primitive_cube_add(size=1.4, location=(2.3, .4, .7), rotation=(0, 0, .5))
bevel = bpy.context.object.modifiers.new("bevel", "BEVEL")
bevel.width, bevel.segments = .1, 1

bpy.ops.mesh.primitive_cylinder_add(vertices=7, radius=.5, depth=1.6, location=(-2.1, .5, .8))
glass = bpy.data.materials.new("glass")
glass.diffuse_color = (.7, .9, .9, .3)
bpy.context.object.data.materials.append(glass)

bpy.ops.object.text_add(location=(-1.2, -2, .1))
text = bpy.context.object.data
text.body, text.extrude, text.size = "Burin", .1, .9

bpy.ops.mesh.primitive_plane_add(size=9)

camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(camera)
camera.location, camera.rotation_euler = (4.2, -8.4, 4.4), (math.radians(67), 0, math.radians(26))
camera.data.lens = 42
scene.camera = camera

scene.render.engine = "BURIN"
scene.render.resolution_x, scene.render.resolution_y = 900, 500
scene.view_settings.view_transform = "Standard"
scene.burin.hidden = "DASHED"
scene.burin.hidden_color = (.6, .6, .6)
