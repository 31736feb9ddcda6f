"""Who draws lines, who only hides: what Line Art's settings of objects and collections say."""


class Usages:
    """Line Art's usage of objects: their own, or that of a collection which they are in."""

    def __init__(self, scene):
        self.of_collections = {}
        self.walk(scene.collection, "INCLUDE")

    def walk(self, collection, inherited):
        own = getattr(collection, "lineart_usage", "INCLUDE")
        usage = inherited if own == "INCLUDE" else own
        if usage != "INCLUDE":
            for thing in collection.objects:
                self.of_collections.setdefault(thing.name, usage)
        for child in collection.children:
            self.walk(child, usage)

    def of(self, thing):
        """INCLUDE, EXCLUDE, OCCLUSION_ONLY, INTERSECTION_ONLY, NO_INTERSECTION, FORCE_INTERSECTION."""
        settings = getattr(thing, "lineart", None)
        own = "INHERIT" if settings is None else settings.usage
        return self.of_collections.get(thing.name, "INCLUDE") if own == "INHERIT" else own
