"""What is to be drawn, copied from Blender's dependency graph into arrays: nothing here refers to Blender's memory."""

import contextlib
import gc
import itertools
from typing import NamedTuple

import numpy as np

from .line_art import Usages, crease_angle_of
from .materials import look_of
from .mesh_arrays import MeshArrays
from .shown import Shown

# What has no polygons of its own. Those of curves, texts and metaballs come as instances of type MESH.
OTHER_TYPES = {"CURVE", "SURFACE", "FONT", "META", "EMPTY", "CAMERA", "LIGHT", "LIGHT_PROBE", "LIGHTPROBE", "ARMATURE",
               "LATTICE", "SPEAKER"}
GREASE_PENCIL = {"GPENCIL", "GREASEPENCIL"}  # which Blender draws itself, over the picture of any engine

FARTHEST = 1e12  # from the middle of the world


def materials_of(thing):
    """The materials of an evaluated object's slots, None where there is none: of its mesh, which modifiers may have
    given others, unless a slot has one for the object alone."""
    materials = list(thing.data.materials)
    for i, slot in enumerate(thing.material_slots):
        if slot.link == "OBJECT" and i < len(materials):
            materials[i] = slot.material
    return materials or [None]


@contextlib.contextmanager
def without_garbage_collection():
    """Python looks for garbage when many objects were made, which takes a third of the time, and finds none here."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


class Placed(NamedTuple):
    """A mesh at a place; which one is the row of `Gathered.matrices`."""
    mesh: int
    name: str  # of Shown
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
        self.shown = Shown()  # gives the names

    def keep(self, kept):
        """Leaves out the objects for which an array says False."""
        if not kept.all():
            self.objects = [o for o, is_kept in zip(self.objects, kept) if is_kept]
            self.matrices = self.matrices[kept]
            self.shown.keep({thing.name for thing in self.objects})


class Gatherer:
    """Goes over a dependency graph once."""

    def __init__(self, depsgraph, with_marks=True):
        self.depsgraph = depsgraph
        self.with_marks = with_marks
        self.view_layer = depsgraph.view_layer_eval
        self.material_override = self.view_layer.material_override
        self.is_render = depsgraph.mode == "RENDER"
        self.result = Gathered()
        self.mesh_numbers = {}  # address of Blender's data: number in result.meshes, or None
        self.looks = {}  # address of a material: Look
        self.known = {}  # address of an object: what of Placed all its instances share, or None
        self.usages = Usages(depsgraph.scene_eval)
        self.unknown = {}  # type: names

    def gather(self):
        with without_garbage_collection():
            self.walk()
        self.leave_out_flat()
        for kind, names in sorted(self.unknown.items()):
            more = f" and {len(names) - 3} more" if len(names) > 3 else ""
            self.result.notes.add(f"objects of type {kind} are not drawn: {', '.join(sorted(names)[:3])}{more}")
        return self.result

    def walk(self):
        """Looks at all that is shown, once."""
        rows = []
        for instance in self.depsgraph.object_instances:
            if not instance.show_self:
                continue
            thing = instance.object
            if instance.is_instance:
                # Its object is a copy which lies where that of the one before did.
                itself, base, data = instance.instance_object, instance.parent, thing.data
                key = (itself.as_pointer(), base.as_pointer(), 0 if data is None else data.as_pointer())
                if key not in self.known:
                    self.known[key] = self.placed(thing, base)
                placed = self.known[key]
            else:
                placed = self.placed(thing, thing)
            if placed is not None:
                self.result.objects.append(placed)
                rows.append(instance.matrix_world.copy())
        if rows:
            chain = itertools.chain.from_iterable
            self.result.matrices = np.fromiter(chain(chain(rows)), float, 16 * len(rows)).reshape(-1, 16)
            self.result.matrices[:, 12:] = 0, 0, 0, 1

    def placed(self, thing, base):
        """What all instances of an object share; None: it is not drawn."""
        if thing.type in GREASE_PENCIL:
            if self.is_render and not self.view_layer.use_pass_z:
                self.result.notes.add("grease pencil lies over everything; surfaces hide it if the pass Z is on")
            return None
        if thing.type != "MESH":
            if thing.type not in OTHER_TYPES:
                self.unknown.setdefault(thing.type.replace("_", " ").title(), set()).add(thing.name)
            return None
        if not self.is_render and thing.display_type in {"WIRE", "BOUNDS"}:
            return None
        if base.indirect_only_get(view_layer=self.view_layer) or not getattr(base, "visible_camera", True):
            return None
        usage = self.usages.of(thing, base)
        if usage == "EXCLUDE":
            return None
        mesh = self.mesh_of(thing)
        if mesh is None:
            return None
        self.note_hair(thing)
        is_holdout = base.is_holdout or base.holdout_get(view_layer=self.view_layer)
        name = self.result.shown.add_object(thing, usage, is_holdout, crease_angle_of(thing))
        if is_holdout:
            self.result.holdouts.add(name)
        return Placed(mesh, name, tuple(self.look(m) for m in self.materials_of(thing)), thing.pass_index)

    def materials_of(self, thing):
        return materials_of(thing) if self.material_override is None else [self.material_override]

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
        evaluated = material.evaluated_get(self.depsgraph)
        key = evaluated.as_pointer()
        if key not in self.looks:
            name = self.result.shown.add_material(evaluated)
            self.looks[key] = look_of(evaluated, self.result.notes)._replace(name=name)
        return self.looks[key]

    def leave_out_flat(self):
        """Objects that are scaled to nothing are not seen; those are named whose matrix is no number, and those so far
        away that they would take the precision from all others."""
        result, matrices = self.result, self.result.matrices
        if not len(matrices):
            return
        finite = np.isfinite(matrices).all(axis=1)
        matrices = np.where(finite[:, None], matrices, 0).reshape(-1, 4, 4)
        is_far = self.reaches(matrices) > FARTHEST
        for is_left_out, why in ((~finite, "its matrix has numbers that are not finite; it is not drawn"),
                                 (is_far, f"it is farther than {FARTHEST:g} from the middle of the world; it is not "
                                          "drawn")):
            for number in np.flatnonzero(is_left_out):
                result.notes.add(f"object {result.shown.own_name(result.objects[number].name)}: {why}")
        result.keep(finite & ~is_far & (np.linalg.det(matrices[:, :3, :3]) != 0))

    def reaches(self, matrices):
        """How far the objects reach from the middle of the world, along an axis; no number where the library will
        tell which point is none."""
        boxes = [mesh.box() for mesh in self.result.meshes]
        sizes = np.array([(np.abs(middle) + half).max() if is_finite else np.nan for middle, half, is_finite in boxes])
        of_objects = sizes[[thing.mesh for thing in self.result.objects]]
        with np.errstate(invalid="ignore"):
            along_axes = np.abs(matrices[:, :3, :3]).sum(axis=2) * of_objects[:, None] + np.abs(matrices[:, :3, 3])
            return along_axes.max(axis=1)


def gather(depsgraph, with_marks=True):
    """Copies what a view layer shows. `with_marks`: Freestyle's marked edges, too, which takes time."""
    return Gatherer(depsgraph, with_marks).gather()
