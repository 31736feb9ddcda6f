"""Burin as a render engine of Blender: 3D models as lines. See docs/blender.md."""

import importlib

bl_info = {
    "name": "Burin",
    "description": "Renders lines: silhouettes, creases, intersections, with hidden lines removed or dashed",
    "author": "The Burin developers",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Render > Render Engine",
    "category": "Render",
}

# Each has register() and unregister(), in the order in which one needs another.
MODULES = ("preferences", "properties", "panels", "viewport", "engine")


def modules():
    return [importlib.import_module("." + name, __name__) for name in MODULES]


def register():
    for module in modules():
        module.register()


def unregister():
    for module in reversed(modules()):
        module.unregister()
