"""blender -b --python blender_positions.py -- FILE.gltf OUT.txt FRAME...: where the vertices of a glTF are at frames.

Imports the file, and writes a line "FRAME X Y Z" per vertex and frame, in the file's axes.
"""
import sys

import bpy
import numpy

numpy.bool = bool  # the importer of Blender 3.4 uses this name, which newer versions of NumPy have no longer
path, out, *frames = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.fps = 24
bpy.ops.import_scene.gltf(filepath=path)
with open(out, "w") as lines:
    for frame in map(float, frames):
        scene.frame_set(int(frame // 1), subframe=frame % 1)
        graph = bpy.context.evaluated_depsgraph_get()
        for thing in scene.objects:
            # The importer adds a ball as the shape of bones.
            if thing.type != "MESH" or thing.name.startswith("Icosphere"):
                continue
            seen = thing.evaluated_get(graph)
            for vertex in seen.to_mesh().vertices:
                x, y, z = seen.matrix_world @ vertex.co
                lines.write(f"{frame} {x} {z} {-y}\n")
