"""Burin's library as objects of Python: a scene, and the pictures of it."""

import ctypes

import numpy as np

from . import interface
from .library import LibraryError, load_library

__all__ = ["BurinError", "LibraryError", "Picture", "Scene", "Stopped", "burin"]

NUMPY_TYPES = {interface.HALF: np.float16, interface.FLOAT: np.float32, interface.UINT32: np.uint32}

_preference = ""  # what the add-on's preferences say where the program or the library is
_library = None


class BurinError(Exception):
    """A call of the library failed; the text is that of burin_error()."""


class Stopped(BurinError):
    """The call was stopped by cancel() or its progress function."""


def set_preference(program):
    """Says where the program or the library is; counts for what is loaded later."""
    global _preference
    _preference = program


def preference():
    """What was said last where the program or the library is; "" if nothing was."""
    return _preference


def burin():
    """The library. Throws LibraryError."""
    global _library
    if _library is None:
        _library = interface.declare(load_library(_preference))
    return _library


def checked(result):
    """The result of a call that did not fail; else raises what the library says."""
    if result is None or (isinstance(result, int) and result < 0):
        text = (burin().burin_error() or b"").decode(errors="replace")
        text = text.replace("options.memory_bytes:", "Memory Cap:")  # as the panel calls it
        raise (Stopped if burin().burin_error_kind() == interface.STOPPED else BurinError)(text)
    return result


def address(array):
    return None if array is None else array.ctypes.data


class Scene:
    """A burin_scene: meshes, materials, objects and settings. Numbers count from 1."""

    def __init__(self):
        self.handle = checked(burin().burin_scene_new())

    def __del__(self):
        if getattr(self, "handle", None):
            burin().burin_scene_free(self.handle)
            self.handle = None

    def add_material(self, name, color, opacity):
        material = interface.Material(ctypes.sizeof(interface.Material), opacity, tuple(color), name.encode())
        return checked(burin().burin_add_material(self.handle, material))

    def add_mesh(self, name, points, corners, sizes=None, materials=None, marks=None):
        """`points`: float32 x y z; `corners`, `sizes` and `materials` (numbers, one for each polygon): int32; `marks`:
        int32 pairs of points. All lie without gaps. `sizes` None: triangles."""
        mesh = interface.Mesh(
            size=ctypes.sizeof(interface.Mesh), name=name.encode(), points=address(points),
            point_count=points.size // 3, corners=address(corners), corner_count=corners.size,
            polygon_sizes=address(sizes), polygon_count=0 if sizes is None else sizes.size,
            polygon_materials=address(materials), marked_edges=address(marks),
            marked_edge_count=0 if marks is None else marks.size // 2)
        return checked(burin().burin_add_mesh(self.handle, mesh))

    def remove_mesh(self, mesh):
        checked(burin().burin_remove_mesh(self.handle, mesh))

    def add_object(self, mesh, name, to_world, material=0):
        """`to_world`: a numpy array of 16 doubles, row by row."""
        entry = interface.Object(ctypes.sizeof(interface.Object), mesh, material, name.encode(),
                                 interface.MATRIX.from_buffer_copy(to_world))
        return checked(burin().burin_add_object(self.handle, entry))

    def move_object(self, number, to_world):
        checked(burin().burin_move_object(self.handle, number, interface.MATRIX.from_buffer_copy(to_world)))

    def clear_objects(self):
        checked(burin().burin_clear_objects(self.handle))

    def object_of_id(self, number):
        """Which object has a number in the channel id.object."""
        return checked(burin().burin_object_of_id(self.handle, number))

    def set(self, key_and_value):
        checked(burin().burin_set(self.handle, key_and_value.encode()))

    def set_style(self, text_or_name):
        """None or "" takes the style sheet away."""
        checked(burin().burin_set_style(self.handle, (text_or_name or "").encode()))

    def render(self, view, layers=None, threads=0, progress=None, memory_bytes=0):
        """Draws. `view`: a dict of fields of burin_view; `progress(done)` returns True to stop. Gives a Picture."""
        given = interface.View(size=ctypes.sizeof(interface.View))
        for name, value in view.items():
            kind = type(getattr(given, name))
            setattr(given, name, kind(*value) if issubclass(kind, ctypes.Array) else value)
        options = interface.Options(size=ctypes.sizeof(interface.Options), threads=threads, memory_bytes=memory_bytes,
                                    layers=None if layers is None else layers.encode())
        if progress is not None:
            options.progress = interface.PROGRESS(lambda done, user: 1 if progress(done) else 0)
        return Picture(checked(burin().burin_render(self.handle, given, options)))

    def cancel(self):
        """Stops what the scene is doing on another thread."""
        burin().burin_cancel(self.handle)


class Picture:
    """A burin_picture. Arrays of its channels are views of its memory and keep it alive."""

    def __init__(self, handle):
        self.handle = handle

    def __del__(self):
        if self.handle:
            burin().burin_picture_free(self.handle)
            self.handle = None

    def channel_names(self):
        return [name.decode() for name in texts(burin().burin_channel_name, self.handle)]

    def notes(self):
        return [note.decode(errors="replace") for note in texts(burin().burin_picture_note, self.handle)]

    def channel(self, name):
        """The values of a channel, rows from the top: (height, width), float16, float32 or uint32."""
        kind, size = ctypes.c_int32(), (ctypes.c_int32 * 2)()
        data = checked(burin().burin_channel(self.handle, name.encode(), kind, size))
        dtype = np.dtype(NUMPY_TYPES[kind.value])
        memory = (ctypes.c_char * (size[0] * size[1] * dtype.itemsize)).from_address(data)
        memory.picture = self  # lives as long as the array does
        return np.frombuffer(memory, dtype).reshape(size[1], size[0])

    def layer(self, name, out=None):
        """The four channels of a layer ("": the picture itself) as (height, width, 4) float32, in `out` if given."""
        prefix = name + "." if name else ""
        channels = [self.channel(prefix + letter) for letter in "RGBA"]
        if out is None:
            out = np.empty((*channels[0].shape, 4), np.float32)
        for i, channel in enumerate(channels):
            out[..., i] = channel
        return out


def texts(function, handle):
    """What a function that takes an index gives until it gives NULL."""
    index = 0
    while (text := function(handle, index)) is not None:
        yield text
        index += 1
