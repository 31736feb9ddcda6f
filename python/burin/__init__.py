"""Line drawings of 3D models.

    import burin
    burin.draw(mesh)                     # shows itself in a notebook
    burin.draw(mesh, style="pencil").save("mesh.png")

`mesh` is what trimesh, Open3D, pyvista, meshio or VTK call one, a pair of arrays (points, polygons), or a file's name.
"""

from ._core import Cancelled, InputError, UsageError
from ._drawing import Drawing, Picture
from ._mesh import MeshArrays, mesh_arrays
from ._scene import Scene, draw
from ._version import __version__

__all__ = [
    "Cancelled",
    "Drawing",
    "InputError",
    "MeshArrays",
    "Picture",
    "Scene",
    "UsageError",
    "__version__",
    "draw",
    "mesh_arrays",
]
