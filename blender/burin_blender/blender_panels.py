"""Blender's own panels that mean something to Burin: those that its Workbench engine has, but its settings."""

import bpy

LEFT_OUT_PREFIXES = ("RENDER_PT_opengl", "RENDER_PT_eevee", "RENDER_PT_freestyle", "VIEWLAYER_PT_freestyle",
                     "MATERIAL_PT_freestyle")
FURTHER = ("EEVEE_MATERIAL_PT_viewport_settings", "OBJECT_PT_visibility")


def panels(cls=bpy.types.Panel):
    for panel in cls.__subclasses__():
        yield panel
        yield from panels(panel)


def is_for_burin(panel):
    engines = getattr(panel, "COMPAT_ENGINES", ())
    name = panel.__name__
    return name in FURTHER or "BLENDER_WORKBENCH" in engines and not name.startswith(LEFT_OUT_PREFIXES)


_joined = []


def register():
    for panel in panels():
        if is_for_burin(panel) and hasattr(panel, "COMPAT_ENGINES") and "BURIN" not in panel.COMPAT_ENGINES:
            panel.COMPAT_ENGINES.add("BURIN")
            _joined.append(panel)


def unregister():
    while _joined:
        _joined.pop().COMPAT_ENGINES.discard("BURIN")
