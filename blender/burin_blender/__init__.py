"""Burin as a render engine of Blender: 3D models as lines. See docs/blender.md."""

import importlib
import importlib.util

bl_info = {
    "name": "Burin",
    "description": "Renders lines: silhouettes, creases, intersections, with hidden lines removed or dashed",
    "author": "The Burin developers",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Render > Render Engine",
    "category": "Render",
}

# Each has register() and unregister(); in this order, for panels need properties and the engine needs none of them.
MODULES = ("preferences", "properties", "line_sets", "panels", "viewport", "engine")


def modules():
    for name in MODULES:
        if importlib.util.find_spec("." + name, __name__):
            yield importlib.import_module("." + name, __name__)


def register():
    for module in modules():
        if hasattr(module, "register"):
            module.register()


def unregister():
    for module in reversed(list(modules())):
        if hasattr(module, "unregister"):
            module.unregister()
