"""What is to be drawn, copied from Blender's dependency graph into arrays: nothing here refers to Blender's memory."""

from typing import NamedTuple

import numpy as np

from .line_art import Usages
from .materials import look_of
from .mesh_arrays import MeshArrays

# What has no polygons of its own. Those of curves, texts and metaballs come as instances of type MESH.
OTHER_TYPES = {"CURVE", "SURFACE", "FONT", "META", "EMPTY", "CAMERA", "LIGHT", "LIGHT_PROBE", "LIGHTPROBE", "ARMATURE",
               "LATTICE", "SPEAKER"}


def materials_of(thing):
    """The materials of an evaluated object's slots, None where there is none: of its mesh, which modifiers may have
    given others, unless a slot has one for the object alone."""
    materials = list(thing.data.materials)
    for i, slot in enumerate(thing.material_slots):
        if slot.link == "OBJECT" and i < len(materials):
            materials[i] = slot.material
    return materials or [None]


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
            if not instance.show_self:
                continue
            thing = instance.object
            base = instance.parent if instance.is_instance else thing
            # The object of an instance is a copy which lies where that of the one before did.
            itself = instance.instance_object if instance.is_instance else thing
            data = thing.data
            key = (itself.as_pointer(), base.as_pointer(), 0 if data is None else data.as_pointer())
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
        if thing.type != "MESH":
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
        self.note_hair(thing)
        if base.is_holdout or base.holdout_get(view_layer=self.view_layer):
            self.result.holdouts.add(thing.name)
        return Placed(mesh, thing.name, tuple(self.look(m) for m in materials_of(thing)), thing.pass_index)

    def note_hair(self, thing):
        for system in thing.particle_systems:
            if system.settings.type == "HAIR" and system.settings.render_type == "PATH":
                self.result.notes.add(f"object {thing.name}: hair is not drawn")

    def mesh_of(self, thing):
        """The number of an object's mesh, which is that after all modifiers; None: it has no polygons."""
        key = thing.data.as_pointer()
        if key not in self.mesh_numbers:
            arrays = MeshArrays(thing.data, thing.name, self.with_marks)
            if arrays.is_empty():
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
