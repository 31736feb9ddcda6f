"""What a viewport shows, gathered again and again: only meshes that have changed are read."""

from .gather import Gatherer


class LiveGatherer(Gatherer):
    """Leaves out what the viewport does not show (local view, hidden types and collections), and takes meshes that
    have not changed from `kept`, which it fills."""

    def __init__(self, depsgraph, space, kept):
        super().__init__(depsgraph)
        self.space = space
        self.kept = kept
        self.seen = set()

    def gather(self):
        result = super().gather()
        for key in self.kept.keys() - self.seen:
            del self.kept[key]
        return result

    def placed(self, thing, base):
        if not base.visible_in_viewport_get(self.space):
            return None
        return super().placed(thing, base)

    def mesh_of(self, thing):
        key = (thing.data if thing.type == "MESH" else thing).as_pointer()
        self.seen.add(key)
        if key in self.mesh_numbers:
            return self.mesh_numbers[key]
        if key in self.kept:
            number = None
            if self.kept[key] is not None:
                number = len(self.result.meshes)
                self.result.meshes.append(self.kept[key])
            self.mesh_numbers[key] = number
            return number
        number = super().mesh_of(thing)
        self.kept[key] = None if number is None else self.result.meshes[number]
        return number


def forget_changed(kept, depsgraph):
    """Takes away the meshes of all that Blender names as changed."""
    for update in depsgraph.updates:
        if not update.is_updated_geometry:
            continue
        thing = update.id
        kept.pop(thing.as_pointer(), None)
        if hasattr(thing, "data") and thing.data is not None:
            kept.pop(thing.data.as_pointer(), None)
