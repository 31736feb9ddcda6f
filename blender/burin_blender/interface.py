"""The structs and functions of burin/burin.h for ctypes."""

import ctypes
from ctypes import POINTER, c_char_p, c_double, c_float, c_int, c_int32, c_uint32, c_uint64, c_void_p

HALF, FLOAT, UINT32 = 1, 2, 3  # burin_type
STOPPED = -3  # burin_result

PROGRESS = ctypes.CFUNCTYPE(c_int, c_double, c_void_p)
MATRIX = c_double * 16


class Material(ctypes.Structure):
    _fields_ = [("size", c_uint32), ("opacity", c_float), ("color", c_float * 3), ("name", c_char_p)]


class Mesh(ctypes.Structure):
    _fields_ = [
        ("size", c_uint32), ("name", c_char_p), ("points", c_void_p), ("point_count", c_uint64), ("corners", c_void_p),
        ("corner_count", c_uint64), ("polygon_sizes", c_void_p), ("polygon_count", c_uint64),
        ("polygon_materials", c_void_p), ("polygon_objects", c_void_p), ("object_count", c_uint64),
        ("object_names", c_void_p), ("marked_edges", c_void_p), ("marked_edge_count", c_uint64),
        ("corner_uv", c_void_p), ("point_colors", c_void_p), ("attribute_names", c_void_p),
        ("point_attributes", c_void_p), ("attribute_count", c_uint64),
    ]


class Object(ctypes.Structure):
    _fields_ = [("size", c_uint32), ("mesh", c_int32), ("material", c_int32), ("name", c_char_p), ("to_world", MATRIX)]


class View(ctypes.Structure):
    _fields_ = [
        ("size", c_uint32), ("width", c_int32), ("height", c_int32), ("crop", c_int32 * 4), ("samples", c_int32),
        ("frame", c_int32), ("camera", c_char_p), ("camera_to_world", MATRIX), ("fov_deg", c_double),
        ("ortho_height", c_double), ("shift", c_double * 2), ("pixel_aspect", c_double),
    ]


class Options(ctypes.Structure):
    _fields_ = [
        ("size", c_uint32), ("threads", c_int32), ("memory_bytes", c_uint64), ("layers", c_char_p),
        ("progress", PROGRESS), ("user", c_void_p), ("for_paths", c_int32), ("find_all", c_int32),
    ]


FUNCTIONS = {
    "burin_error": (c_char_p,),
    "burin_error_kind": (c_int,),
    "burin_scene_new": (c_void_p,),
    "burin_scene_free": (None, c_void_p),
    "burin_add_material": (c_int, c_void_p, POINTER(Material)),
    "burin_add_mesh": (c_int, c_void_p, POINTER(Mesh)),
    "burin_remove_mesh": (c_int, c_void_p, c_int),
    "burin_add_object": (c_int, c_void_p, POINTER(Object)),
    "burin_move_object": (c_int, c_void_p, c_int, POINTER(c_double)),
    "burin_object_of_id": (c_int, c_void_p, c_uint32),
    "burin_clear_objects": (c_int, c_void_p),
    "burin_set": (c_int, c_void_p, c_char_p),
    "burin_set_style": (c_int, c_void_p, c_char_p),
    "burin_render": (c_void_p, c_void_p, POINTER(View), POINTER(Options)),
    "burin_cancel": (None, c_void_p),
    "burin_picture_free": (None, c_void_p),
    "burin_picture_note": (c_char_p, c_void_p, c_int),
    "burin_channel": (c_void_p, c_void_p, c_char_p, POINTER(c_int32), POINTER(c_int32)),
    "burin_channel_name": (c_char_p, c_void_p, c_int),
    "burin_pixels": (c_int, c_void_p, c_void_p, c_int),
}


def declare(library):
    """Tells ctypes what the functions take and return."""
    for name, (result, *arguments) in FUNCTIONS.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = arguments
    return library
