"""The render engine that Blender calls: BURIN."""

import bpy

try:
    from . import viewport
except ImportError:
    viewport = None


class BurinEngine(bpy.types.RenderEngine):
    bl_idname = "BURIN"
    bl_label = "Burin"
    bl_use_preview = False
    bl_use_postprocess = True  # compositor and sequencer

    def view_update(self, context, depsgraph):
        """Something has changed that a viewport shows."""
        if viewport:
            viewport.view_update(self, context, depsgraph)

    def view_draw(self, context, depsgraph):
        """A viewport is drawn."""
        if viewport:
            viewport.view_draw(self, context, depsgraph)


def register():
    bpy.utils.register_class(BurinEngine)


def unregister():
    bpy.utils.unregister_class(BurinEngine)
