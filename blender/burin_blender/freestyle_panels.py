"""Freestyle's panels of the view layer, shown while Burin draws its line sets.

Blender shows them only while Freestyle itself is on, which must stay off, so each has a twin with another poll()."""

import functools

import bpy

try:
    from bl_ui import properties_freestyle as freestyle
except ImportError:  # a Blender without Freestyle
    freestyle = None

PREFIX, OWN_PREFIX = "VIEWLAYER_PT_", "BURIN_PT_view_layer_"
# What Burin does not draw, and the panel above all, which has switches of Freestyle itself.
LEFT_OUT = {
    "VIEWLAYER_PT_freestyle", "VIEWLAYER_PT_freestyle_edge_detection", "VIEWLAYER_PT_freestyle_style_modules",
    "VIEWLAYER_PT_freestyle_lineset_facemarks", "VIEWLAYER_PT_freestyle_linestyle_geometry",
    "VIEWLAYER_PT_freestyle_linestyle_texture", "VIEWLAYER_PT_freestyle_linestyle_strokes_splitting",
    "VIEWLAYER_PT_freestyle_linestyle_strokes_splitting_pattern",
    "VIEWLAYER_PT_freestyle_linestyle_strokes_sorting",
}


def draws_line_sets(context):
    return context.engine == "BURIN" and context.scene.burin.use_line_sets


class BURIN_PT_view_layer_line_sets(bpy.types.Panel):
    bl_label = "Line Sets"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "view_layer"
    bl_order = 9
    COMPAT_ENGINES = {"BURIN"}

    @classmethod
    def poll(cls, context):
        return draws_line_sets(context)

    def draw_header(self, context):
        self.layout.prop(context.view_layer, "use_freestyle", text="")

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.active = context.view_layer.use_freestyle
        settings = context.view_layer.freestyle_settings
        layout.prop(settings, "crease_angle")
        layout.prop(settings, "use_smoothness")


def poll_of_set(cls, context):
    settings = context.view_layer.freestyle_settings
    return draws_line_sets(context) and context.view_layer.use_freestyle and settings.mode == "EDITOR"


def poll_of_style(cls, context):
    line_set = context.view_layer.freestyle_settings.linesets.active
    return poll_of_set(cls, context) and line_set is not None and line_set.linestyle is not None


def own_name(name):
    return OWN_PREFIX + name.removeprefix(PREFIX)


@functools.lru_cache(maxsize=None)
def twins():
    """A class for each panel, in Blender's order; made once, since Python keeps all classes that are derived."""
    return tuple(twins_of(freestyle.classes)) if freestyle is not None else ()


def twins_of(classes):
    for panel in classes:
        name = panel.__name__
        if not name.startswith(PREFIX) or name in LEFT_OUT or not issubclass(panel, bpy.types.Panel):
            continue
        is_of_style = issubclass(panel, freestyle.ViewLayerFreestyleLineStyle)
        members = {"bl_idname": own_name(name), "COMPAT_ENGINES": {"BURIN"},
                   "poll": classmethod(poll_of_style if is_of_style else poll_of_set)}
        parent = getattr(panel, "bl_parent_id", "")
        if parent:
            members["bl_parent_id"] = own_name(parent)
        # Blender allows no class that is derived from one that is registered.
        bases = tuple(base for base in panel.__bases__ if base is not bpy.types.Panel)
        members.update({key: value for key, value in vars(panel).items()
                        if key not in members and key not in {"__dict__", "__weakref__", "bl_rna", "is_registered"}})
        yield type(own_name(name), (*bases, bpy.types.Panel), members)


def register():
    bpy.utils.register_class(BURIN_PT_view_layer_line_sets)
    for cls in twins():
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(twins()):
        bpy.utils.unregister_class(cls)
    bpy.utils.unregister_class(BURIN_PT_view_layer_line_sets)
