"""Meshes of other packages as arrays. They are known by what they have, so that none of them is imported."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Any, Mapping, Optional

import numpy as np
import numpy.typing as npt

from ._core import UsageError

Array = npt.NDArray[Any]


@dataclass
class MeshArrays:
    """Polygons as arrays: what burin.Scene.add() takes, and what it makes of all else."""

    points: Array
    """(N, 3) numbers."""
    polygons: Array
    """(M, k) points of polygons with k corners each; or, with `sizes`, those of all polygons one after the other."""
    sizes: Optional[Array] = None
    """(M,) corners of each polygon."""
    materials: Optional[Array] = None
    """(M,) numbers of materials of the scene, 0 for none."""
    objects: Optional[Array] = None
    """(M,) which part each polygon belongs to, from 0."""
    object_names: list[str] = field(default_factory=list)
    marked_edges: Optional[Array] = None
    """(K, 2) points: edges that are lines of class `mark`."""
    uv: Optional[Array] = None
    """(C, 2) texture coordinates of all corners."""
    colors: Optional[Array] = None
    """(N, 3) linear colours of points, 0 to 1."""
    attributes: Mapping[str, Array] = field(default_factory=dict)
    """(N,) further numbers of points, by name: attr("name") in style sheets."""


def mesh_arrays(mesh: Any) -> MeshArrays:
    """The arrays of a mesh of trimesh, Open3D, pyvista, meshio or VTK, or of a pair (points, polygons).

    Raises TypeError for what is none of these, and burin.UsageError for arrays that make no mesh.
    """
    if isinstance(mesh, MeshArrays):
        return mesh
    if isinstance(mesh, (str, os.PathLike)):
        raise TypeError("burin: a file is loaded by burin.Scene.load()")
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return MeshArrays(np.asarray(mesh[0]), _polygons(mesh[1]))
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return _of_trimesh(mesh)
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):
        return _of_open3d(mesh)
    if hasattr(mesh, "GetPolys") and hasattr(mesh, "GetPoints"):
        return _of_vtk(mesh)
    if hasattr(mesh, "points") and hasattr(mesh, "faces"):
        return _of_polydata(mesh)
    if hasattr(mesh, "points") and hasattr(mesh, "cells"):
        return _of_meshio(mesh)
    raise TypeError(
        f"burin: cannot read a mesh from {type(mesh).__name__}; give (points, polygons), or what has .vertices and "
        ".faces, or .points and .cells"
    )


def _polygons(polygons: Any) -> Array:
    """An array of them; lists of polygons of several sizes are told apart by UsageError."""
    try:
        return np.asarray(polygons)
    except ValueError:
        raise UsageError("polygons: they have different numbers of corners; give burin.MeshArrays with sizes") from None


def _of_trimesh(mesh: Any) -> MeshArrays:
    arrays = MeshArrays(np.asarray(mesh.vertices), np.asarray(mesh.faces))
    visual: Any = getattr(mesh, "visual", None)
    if getattr(visual, "kind", None) == "vertex":
        arrays.colors = _linear(np.asarray(visual.vertex_colors)[:, :3] / 255.0)
    return arrays


def _of_open3d(mesh: Any) -> MeshArrays:
    arrays = MeshArrays(np.asarray(mesh.vertices), np.asarray(mesh.triangles))
    colors = np.asarray(getattr(mesh, "vertex_colors", ()))
    if colors.shape == arrays.points.shape:
        arrays.colors = _linear(colors)
    return arrays


def _of_polydata(mesh: Any) -> MeshArrays:
    """pyvista: polygons as one list, each with its number of corners in front."""
    points = np.asarray(mesh.points)
    flat = np.asarray(mesh.faces)
    if flat.ndim != 1:
        return MeshArrays(points, flat)
    corners, sizes = _without_counts(flat)
    arrays = MeshArrays(points, corners, sizes)
    data = getattr(mesh, "point_data", None)
    if data is not None:
        arrays.attributes = _numbers_of_points({str(name): data[name] for name in data.keys()}, len(points))
    return arrays


def _of_vtk(mesh: Any) -> MeshArrays:
    from vtk.util.numpy_support import vtk_to_numpy  # type: ignore[import]

    polygons = mesh.GetPolys()
    if mesh.GetPoints() is None:
        raise UsageError("points: there are none")
    offsets = vtk_to_numpy(polygons.GetOffsetsArray())
    corners = vtk_to_numpy(polygons.GetConnectivityArray())
    return MeshArrays(vtk_to_numpy(mesh.GetPoints().GetData()), corners, np.diff(offsets))


def _of_meshio(mesh: Any) -> MeshArrays:
    """meshio: blocks of cells. Only polygons are drawn."""
    points = np.asarray(mesh.points)
    if points.ndim == 2 and points.shape[1] == 2:
        points = np.pad(points, ((0, 0), (0, 1)))
    corners: list[Array] = []
    sizes: list[Array] = []
    others: set[str] = set()
    for cells in mesh.cells:
        if cells.type in ("triangle", "quad", "polygon"):
            block = np.asarray(cells.data)
            corners.append(block.ravel())
            sizes.append(np.full(len(block), block.shape[1]))
        elif cells.type not in ("vertex", "line"):
            others.add(str(cells.type))
    if not corners:
        found = f"; it has {', '.join(sorted(others))}" if others else ""
        raise UsageError(f"polygons: the mesh has no triangles, quads or polygons{found}")
    arrays = MeshArrays(points, np.concatenate(corners), np.concatenate(sizes))
    arrays.attributes = _numbers_of_points(getattr(mesh, "point_data", {}), len(points))
    return arrays


def _without_counts(flat: Array) -> tuple[Array, Array]:
    """n i j k n i j k l ... as corners and sizes."""
    if flat.size == 0:
        return flat, flat
    if np.any(flat < 0):
        raise UsageError(f"polygons: the number {flat[flat < 0][0]} is negative")
    first = int(flat[0])
    if flat.size % (first + 1) == 0:
        grid = flat.reshape(-1, first + 1)
        if np.all(grid[:, 0] == first):
            return grid[:, 1:].ravel(), np.full(len(grid), first)
    places = []
    place = 0
    while place < flat.size:
        places.append(place)
        place += int(flat[place]) + 1
    if place != flat.size:
        raise UsageError(f"polygons: the list ends within the polygon that begins at {places[-1]}")
    is_corner = np.ones(flat.size, bool)
    is_corner[places] = False
    return flat[is_corner], flat[places]


def _numbers_of_points(data: Mapping[str, Any], count: int) -> dict[str, Array]:
    """Those of them that are one number for each point."""
    arrays = {str(name): np.asarray(values) for name, values in data.items()}
    return {name: a for name, a in arrays.items() if a.shape == (count,) and a.dtype.kind in "fiub"}


def _linear(srgb: Array) -> Array:
    """Colours as displays have them, linear."""
    c = np.clip(np.asarray(srgb, np.float64), 0, 1)
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
