"""What a viewport shows, gathered again and again: only meshes that have changed are read."""

from .gather import Gatherer


def visibility_of(space):
    """What a viewport says about which objects it shows. Blender redraws when it changes, and tells nothing else."""
    types = tuple(getattr(space, name) for name in dir(space) if name.startswith("show_object_viewport_"))
    return types, space.local_view is not None, space.use_local_collections


MOST_SAMPLES = 16


def traits_of(mesh):
    """By these a mesh is told from another one that Blender has put into the same place: its sizes and some points."""
    points = mesh.vertices
    step = max(len(points) // MOST_SAMPLES, 1)
    return (len(points), len(mesh.loops), len(mesh.polygons),
            tuple(tuple(points[i].co) for i in range(0, len(points), step)))


class KeptMeshes:
    """Meshes that were read, by the address of Blender's data, each with its traits and the names of all objects that
    showed it."""

    def __init__(self):
        self.arrays = {}  # None: a mesh without polygons
        self.owners = {}
        self.traits = {}

    def forget_changed(self, depsgraph):
        """Takes away the meshes of all objects that Blender names as changed. Addresses alone would not do: a new mesh
        may lie where an old one did."""
        changed = {update.id.name for update in depsgraph.updates if update.is_updated_geometry}
        for address in [a for a, names in self.owners.items() if names & changed]:
            del self.arrays[address], self.owners[address], self.traits[address]


class LiveGatherer(Gatherer):
    """Leaves out what the viewport does not show (local view, hidden types and collections), and takes meshes that
    have not changed from `kept`, which it fills."""

    def __init__(self, depsgraph, space, kept):
        super().__init__(depsgraph, with_marks=True)
        self.space = space
        self.kept = kept
        self.owners = {}
        self.names = set()  # of the object that is looked at

    def gather(self):
        result = super().gather()
        kept = self.kept
        kept.arrays = {address: kept.arrays[address] for address in self.owners}
        kept.owners = self.owners
        kept.traits = {address: kept.traits[address] for address in self.owners}
        return result

    def placed(self, thing, base):
        if not base.visible_in_viewport_get(self.space):
            return None
        self.names = {thing.name, base.name}
        if thing.data is not None:
            self.names.add(thing.data.name)
        return super().placed(thing, base)

    def mesh_of(self, thing):
        address = thing.data.as_pointer()
        self.owners.setdefault(address, set()).update(self.names)
        if address not in self.mesh_numbers:
            traits = traits_of(thing.data)
            if self.kept.traits.get(address) != traits:
                self.kept.arrays.pop(address, None)
            self.kept.traits[address] = traits
        if address not in self.mesh_numbers and address in self.kept.arrays:
            arrays = self.kept.arrays[address]
            self.mesh_numbers[address] = None if arrays is None else len(self.result.meshes)
            if arrays is not None:
                self.result.meshes.append(arrays)
        number = super().mesh_of(thing)
        self.kept.arrays[address] = None if number is None else self.result.meshes[number]
        return number
