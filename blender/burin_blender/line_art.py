"""Who draws lines, who only hides: what Line Art's settings of objects and collections say."""

import math

import bpy

from .shown import address


class Usages:
    """Line Art's usage of objects: their own, or that of a collection which they are in, or, of instances, that of the
    object which makes them."""

    def __init__(self, scene):
        # By the address of an object; the first collection that says something counts.
        self.of_collections = usages_below([scene.collection])
        children = {child for collection in bpy.data.collections for child in collection.children}
        children.update(scene.collection.children)
        elsewhere = usages_below(c for c in bpy.data.collections if c not in children)
        if elsewhere:  # objects that are in no collection of the scene come as instances
            of_scene = {address(thing) for thing in scene.collection.all_objects}
            self.of_collections.update((thing, usage) for thing, usage in elsewhere.items() if thing not in of_scene)

    def of(self, thing, maker):
        """INCLUDE, EXCLUDE, OCCLUSION_ONLY, INTERSECTION_ONLY, NO_INTERSECTION, FORCE_INTERSECTION. `maker`: the object
        that makes the instance, or `thing` itself."""
        own = own_usage(thing)
        if own == "INHERIT" and self.of_collections:
            own = self.of_collections.get(address(thing), "INHERIT")
        if own == "INHERIT" and maker is not thing:
            own = self.of(maker, maker)
        return "INCLUDE" if own == "INHERIT" else own


def usages_below(collections, inherited="INCLUDE"):
    """The usage of objects that are in some collections or below, where there is one, by their addresses."""
    found = {}
    for collection in collections:
        own = getattr(collection, "lineart_usage", "INCLUDE")
        usage = inherited if own == "INCLUDE" else own
        if usage != "INCLUDE":
            for thing in collection.objects:
                found.setdefault(address(thing), usage)
        for thing, of_child in usages_below(collection.children, usage).items():
            found.setdefault(thing, of_child)
    return found


def own_usage(thing):
    settings = getattr(thing, "lineart", None)
    return "INHERIT" if settings is None else settings.usage


def crease_angle_of(thing):
    """Where an object's creases begin, in degrees between normals, if that is said for it alone; else None."""
    settings = getattr(thing, "lineart", None)
    if settings is None or not settings.use_crease_override:
        return None
    return min(max(round(180 - math.degrees(settings.crease_threshold), 4), 0), 180)
