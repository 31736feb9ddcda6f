"""What Blender shows as a scene of Burin's library."""

import numpy as np

from . import core
from .gather import gather


class Session:
    """A scene of the library that follows what Blender shows. Meshes that have not changed are kept.

    Settings and style sheet are the caller's: session.scene.set(), session.scene.set_style()."""

    def __init__(self):
        self.scene = core.Scene()
        self.materials = {}  # Look: number
        self.meshes = {}  # key of a mesh with its materials: number
        self.used = set()  # keys of self.meshes, of the update before
        self.placed = []  # what the objects are, but for their places
        self.numbers = []  # of the objects
        self.matrices = np.empty((0, 16))

    def update(self, depsgraph, with_marks=True):
        """Brings meshes, materials and objects up to date. Gives sentences that say what was not understood."""
        gathered = gather(depsgraph, with_marks)
        self.apply(gathered)
        return sorted(gathered.notes)

    def apply(self, gathered):
        """The same for what was gathered before."""
        used = set()
        placed = []
        # All materials before the first mesh: those of the library's own for meshes without any come behind them.
        numbers_of = [self.material_numbers(thing, gathered.meshes[thing.mesh]) for thing in gathered.objects]
        for thing, numbers in zip(gathered.objects, numbers_of):
            arrays = gathered.meshes[thing.mesh]
            # Polygons of one material leave it to the object, so that meshes need not be made anew for another one.
            key = (arrays.key(), numbers if len(numbers) > 1 else None)
            used.add(key)
            if key not in self.meshes:
                self.meshes[key] = self.add_mesh(arrays, numbers)
            placed.append((self.meshes[key], thing.name, numbers[0] if len(numbers) == 1 else 0))
        self.place(placed, gathered.matrices)
        for key in [key for key in self.meshes if key not in used and key not in self.used]:
            self.scene.remove_mesh(self.meshes.pop(key))
        self.used = used

    def material_numbers(self, thing, arrays):
        """Those of an object's slots, or one if all polygons have the same. As in Blender, a slot that is not there is
        the last one."""
        looks = thing.looks
        if arrays.slots is None or len(looks) == 1:
            looks = (looks[min(max(arrays.slot, 0), len(looks) - 1)],)
        for look in looks:
            if look is not None and look not in self.materials:
                self.materials[look] = self.scene.add_material(look.name, look.color, look.opacity)
        return tuple(0 if look is None else self.materials[look] for look in looks)

    def add_mesh(self, arrays, numbers):
        materials = None
        if len(numbers) > 1:
            materials = np.array(numbers, np.int32)[np.clip(arrays.slots, 0, len(numbers) - 1)]
        try:
            return self.scene.add_mesh(arrays.name, arrays.points, arrays.corners, arrays.sizes, materials,
                                       arrays.marks)
        except core.BurinError as error:
            raise core.BurinError(f"object {arrays.name}: {error}") from None

    def place(self, placed, matrices):
        """Puts objects where they are: moves them, or makes them anew if they are others."""
        if placed == self.placed:
            for number in np.flatnonzero((matrices != self.matrices).any(axis=1)):
                self.scene.move_object(self.numbers[number], matrices[number])
        else:
            self.placed = []
            self.scene.clear_objects()
            self.numbers = [self.scene.add_object(mesh, name, matrix, material)
                            for (mesh, name, material), matrix in zip(placed, matrices)]
        self.placed, self.matrices = placed, matrices
