"""What is to be drawn, copied from Blender's dependency graph into arrays: nothing here refers to Blender's memory."""

from typing import NamedTuple

import numpy as np

from .line_art import Usages
from .materials import look_of
from .mesh_arrays import MeshArrays

SURFACE_TYPES = {"MESH", "CURVE", "SURFACE", "FONT", "META"}
# What has no surface of its own and is no loss.
OTHER_TYPES = {"EMPTY", "CAMERA", "LIGHT", "LIGHT_PROBE", "LIGHTPROBE", "ARMATURE", "LATTICE", "SPEAKER"}


class Placed(NamedTuple):
    """A mesh at a place; which one is the row of `Gathered.matrices`."""
    mesh: int
    name: str
    looks: tuple  # of its material slots; None: no material
    pass_index: int


class Gathered:
    """All that one view layer shows."""

    def __init__(self):
        self.meshes = []  # MeshArrays
        self.objects = []  # Placed
        self.matrices = np.empty((0, 16))  # to the world, row by row
        self.notes = set()  # what was not understood
        self.holdouts = set()  # names of objects that cut a hole into the picture


class Gatherer:
    """Goes over a dependency graph once."""

    def __init__(self, depsgraph, with_marks=True):
        self.depsgraph = depsgraph
        self.with_marks = with_marks
        self.view_layer = depsgraph.view_layer_eval
        self.is_render = depsgraph.mode == "RENDER"
        self.result = Gathered()
        self.mesh_numbers = {}  # address of Blender's data: number in result.meshes, or None
        self.looks = {}  # address of a material: Look
        self.known = {}  # address of an object: what of Placed all its instances share, or None
        self.usages = Usages(depsgraph.scene)
        self.unknown = {}  # type: names

    def gather(self):
        rows = []
        for instance in self.depsgraph.object_instances:
            shown = instance.show_self if not instance.is_instance or instance.particle_system is None \
                else instance.show_particles
            if not shown:
                continue
            thing = instance.object
            base = instance.parent if instance.is_instance else thing
            key = (thing.as_pointer(), base.as_pointer())
            if key not in self.known:
                self.known[key] = self.placed(thing, base)
            placed = self.known[key]
            if placed is not None:
                self.result.objects.append(placed)
                rows.append(instance.matrix_world.copy())
        if rows:
            self.result.matrices = np.array([(*m[0], *m[1], *m[2], 0, 0, 0, 1) for m in rows], float)
        self.leave_out_flat()
        for kind, names in sorted(self.unknown.items()):
            more = f" and {len(names) - 3} more" if len(names) > 3 else ""
            self.result.notes.add(f"objects of type {kind} are not drawn: {', '.join(sorted(names)[:3])}{more}")
        return self.result

    def placed(self, thing, base):
        """What all instances of an object share; None: it is not drawn."""
        if thing.type not in SURFACE_TYPES:
            if thing.type not in OTHER_TYPES:
                self.unknown.setdefault(thing.type.replace("_", " ").title(), set()).add(thing.name)
            return None
        if not self.is_render and thing.display_type in {"WIRE", "BOUNDS"}:
            return None
        if base.indirect_only_get(view_layer=self.view_layer) or not getattr(base, "visible_camera", True):
            return None
        if self.usages.of(thing) == "EXCLUDE":
            return None
        mesh = self.mesh_of(thing)
        if mesh is None:
            return None
        if base.is_holdout or base.holdout_get(view_layer=self.view_layer):
            self.result.holdouts.add(thing.name)
        materials = [slot.material for slot in thing.material_slots] or [None]
        return Placed(mesh, thing.name, tuple(self.look(m) for m in materials), thing.pass_index)

    def mesh_of(self, thing):
        """The number of an object's mesh; None: it has no polygons. An evaluated mesh is that after all modifiers."""
        is_mesh = thing.type == "MESH"
        key = (thing.data if is_mesh else thing).as_pointer()
        if key not in self.mesh_numbers:
            mesh = thing.data if is_mesh else thing.to_mesh()
            arrays = None if mesh is None else MeshArrays(mesh, thing.name, self.with_marks)
            if not is_mesh:
                thing.to_mesh_clear()
            if arrays is None or arrays.is_empty():
                self.mesh_numbers[key] = None
            else:
                self.mesh_numbers[key] = len(self.result.meshes)
                self.result.meshes.append(arrays)
        return self.mesh_numbers[key]

    def look(self, material):
        if material is None:
            return None
        key = material.as_pointer()
        if key not in self.looks:
            self.looks[key] = look_of(material, self.result.notes)
        return self.looks[key]

    def leave_out_flat(self):
        """Objects that are scaled to nothing are not seen; those whose matrix is no number are named."""
        matrices = self.result.matrices
        if not len(matrices):
            return
        finite = np.isfinite(matrices).all(axis=1)
        kept = finite & (np.linalg.det(np.where(finite[:, None], matrices, 0).reshape(-1, 4, 4)[:, :3, :3]) != 0)
        if kept.all():
            return
        for number in np.flatnonzero(~finite):
            self.result.notes.add(f"object {self.result.objects[number].name}: its matrix has numbers that are not "
                                  "finite; it is not drawn")
        self.result.objects = [o for o, is_kept in zip(self.result.objects, kept) if is_kept]
        self.result.matrices = matrices[kept]


def gather(depsgraph, with_marks=True):
    """Copies what a view layer shows. `with_marks`: Freestyle's marked edges, too, which takes time."""
    return Gatherer(depsgraph, with_marks).gather()
