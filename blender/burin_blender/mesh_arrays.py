"""The polygons of a mesh of Blender as arrays, copied as fast as its versions allow."""

import ctypes
import zlib

import bpy
import numpy as np

# Before 3.6, corners and polygons lie in structs, which foreach_get() reads at 60 ns each: bytes, place of the number.
HAS_STRUCTS = bpy.app.version < (3, 6, 0)
CORNER_STRUCT = (8, 0)
POLYGON_STRUCT = (12, 4)


class MeshArrays:
    """The polygons of an evaluated mesh, as they are. Marked edges only `with_marks`."""

    def __init__(self, mesh, name, with_marks=True):
        self.name = name
        polygon_count = len(mesh.polygons)
        self.points = taken(mesh.vertices, "co", 3 * len(mesh.vertices), np.float32)
        self.corners = corners_of(mesh)
        self.sizes = numbers_of(mesh.polygons, "loop_total", POLYGON_STRUCT)
        if len(self.corners) == 3 * polygon_count and (self.sizes == 3).all():
            self.sizes = None
        self.slots = material_slots(mesh)
        self.slot = 0  # of all polygons, where they have the same one
        if self.slots is not None and (self.slots == self.slots[0]).all():
            self.slot, self.slots = int(self.slots[0]), None
        self.marks = marked_edges(mesh) if with_marks else None
        self._key = self._box = None

    def is_empty(self):
        return len(self.corners) == 0 and self.marks is None

    def box(self):
        """The middle and the half size of the box around all points, and whether it is finite."""
        if self._box is None:
            axes = [self.points[axis::3] for axis in range(3)]  # by which NumPy is 20 times as fast as along rows
            low, high = (np.array([limit(values) for values in axes], float) for limit in (np.min, np.max))
            self._box = ((low + high) / 2, (high - low) / 2, bool(np.isfinite([low, high]).all()))
        return self._box

    def key(self):
        """Equal for equal meshes: their sizes and a checksum of all numbers."""
        if self._key is None:
            arrays = (self.points, self.corners, self.sizes, self.slots, self.marks)
            checksum = 0
            for array in arrays:
                if array is not None:
                    checksum = zlib.crc32(array, checksum)
            self._key = (checksum, self.slot, *(None if array is None else array.size for array in arrays))
        return self._key


def taken(collection, attribute, count, kind):
    array = np.empty(count, kind)
    collection.foreach_get(attribute, array)
    return array


def numbers_of(collection, attribute, struct):
    """An integer of each element: from the structs where Blender has them in a row, which is found out, else by
    foreach_get()."""
    count = len(collection)
    stride, offset = struct
    if HAS_STRUCTS and count > 1000:
        begin = collection[0].as_pointer()
        if all(collection[i].as_pointer() == begin + i * stride for i in (1, count // 2, count - 1)):
            memory = (ctypes.c_char * (count * stride)).from_address(begin)
            numbers = np.ndarray(count, np.int32, memory, offset, (stride,))
            if all(numbers[i] == getattr(collection[i], attribute) for i in (0, 1, count // 2, count - 1)):
                return numbers.copy()
    return taken(collection, attribute, count, np.int32)


def corners_of(mesh):
    """The point of each corner."""
    attribute = mesh.attributes.get(".corner_vert")
    if attribute is not None:
        return taken(attribute.data, "value", len(mesh.loops), np.int32)
    return numbers_of(mesh.loops, "vertex_index", CORNER_STRUCT)


def material_slots(mesh):
    """The material slot of each polygon; None: all have the first one."""
    attribute = mesh.attributes.get("material_index")
    if attribute is None or attribute.domain != "FACE" or attribute.data_type != "INT":
        return None
    slots = taken(attribute.data, "value", len(mesh.polygons), np.int32)
    return slots if slots.size > 0 else None


def marked_edges(mesh):
    """The pairs of points of Freestyle's marked edges; None: there are none."""
    try:
        marked = taken(mesh.edges, "use_freestyle_mark", len(mesh.edges), bool)
    except AttributeError:  # a Blender that was built without Freestyle
        return None
    if not marked.any():
        return None
    return np.ascontiguousarray(taken(mesh.edges, "vertices", 2 * len(mesh.edges), np.int32).reshape(-1, 2)[marked])
