"""Scenes: meshes in, pictures and lines out."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _arrays, _core, _values
from ._core import UsageError
from ._drawing import Drawing, PathLike, Picture
from ._mesh import MeshArrays, mesh_arrays

Vector = Union[Sequence[float], npt.NDArray[Any]]
Progress = Callable[[float], Any]

VIEW_PARAMETERS = (
    "size camera matrix eye target up fov ortho shift pixel_aspect crop samples frame layers threads memory progress"
).split()


class Scene:
    """Objects, materials, cameras and settings.

    What is not said here of settings is as in scene files: set("lines.width=2"). One scene is used by one thread at a
    time; cancel() may be called by any.
    """

    def __init__(self, *meshes: Any) -> None:
        self._core = _core.Scene()
        self._version = 0  # counts changes
        self._has_sheet = False
        for mesh in meshes:
            self.add(mesh)

    @classmethod
    def load(cls, path: PathLike) -> "Scene":
        """The scene of a scene file (.toml) or a model."""
        scene = cls()
        scene.add_file(path)
        return scene

    # ---- what is drawn ----

    def add(
        self,
        mesh: Any,
        *,
        name: str = "",
        matrix: Optional[npt.ArrayLike] = None,
        material: int = 0,
        marked_edges: Optional[npt.ArrayLike] = None,
    ) -> int:
        """Adds a mesh (see burin.mesh_arrays) and an object that shows it. Returns the object's number.

        matrix: object to world, (4, 4) or (3, 4). Points in double precision far from the origin keep it.
        """
        name, material = _values.text("name", name), _values.whole("material", material)
        arrays = mesh_arrays(mesh)
        points = np.asarray(arrays.points)
        middle = _arrays.middle_of(points)
        to_world = _arrays.matrix("matrix", matrix)
        if middle is not None:
            points = points - middle
            to_world = _moved(to_world, middle)
        number = self._add_mesh(arrays, points, name, marked_edges)
        try:
            result = self._core.add_object(number, name, to_world, material)
        finally:
            self._core.remove_mesh(number)  # the object goes on showing it
        self._version += 1
        return result

    def _add_mesh(self, arrays: MeshArrays, points: Any, name: str, marked_edges: Any) -> int:
        vertices = _arrays.floats("points", points, 3)
        polygons = np.asarray(arrays.polygons)
        corners = _arrays.integers("polygons", polygons)
        sizes = None if arrays.sizes is None else _arrays.integers("sizes", arrays.sizes).ravel()
        if sizes is None:
            if corners.ndim != 2 or (corners.size and corners.shape[1] < 3):
                raise UsageError(f"polygons: must have the shape (M, 3), (M, 4) ..., not {polygons.shape}; or give sizes")
            if corners.shape[1] > 3:
                sizes = np.full(len(corners), corners.shape[1], np.int32)
        elif sizes.size == 0:
            sizes = None
        marks = arrays.marked_edges if marked_edges is None else marked_edges
        edges = None if marks is None else _arrays.integers("marked_edges", marks)
        if edges is not None and (edges.ndim != 2 or edges.shape[1] != 2):
            raise UsageError(f"marked_edges: must have the shape (K, 2), not {edges.shape}")
        count = len(vertices)
        return self._core.add_mesh(
            name,
            vertices,
            corners.ravel(),
            sizes,
            None if arrays.materials is None else _arrays.integers("materials", arrays.materials).ravel(),
            None if arrays.objects is None else _arrays.integers("objects", arrays.objects).ravel(),
            list(arrays.object_names),
            edges,
            None if arrays.uv is None else _arrays.floats("uv", arrays.uv, 2, corners.size),
            None if arrays.colors is None else _arrays.floats("colors", arrays.colors, 3, count),
            {name: _arrays.floats(name, values, 1, count) for name, values in arrays.attributes.items()},
        )

    def add_file(self, path: PathLike) -> int:
        """Adds what a scene file or a model holds. Returns the number of its first object."""
        first = self._core.add_file(_values.path("path", path))
        self._version += 1
        return first

    def add_text(self, toml: str, base_folder: PathLike = "") -> int:
        """The same of the text of a scene file; paths in it are relative to `base_folder`."""
        first = self._core.add_text(_values.text("toml", toml), _values.path("base_folder", base_folder))
        self._version += 1
        return first

    def add_material(self, name: str = "", color: Vector = (0.8, 0.8, 0.8), opacity: float = 1.0) -> int:
        """Adds a material, of a linear colour. Returns its number."""
        rgb = _values.reals("color", color, 3, "three finite numbers")
        return self._core.add_material(_values.text("name", name), rgb, _values.real("opacity", opacity))

    def move(self, object: int, matrix: Optional[npt.ArrayLike]) -> None:
        """Puts an object somewhere else."""
        self._core.move(_values.whole("object", object), _arrays.matrix("matrix", matrix))
        self._version += 1

    def remove(self, object: int) -> None:
        self._core.remove(_values.whole("object", object))
        self._version += 1

    def clear(self) -> None:
        """Removes all objects."""
        self._core.clear()
        self._version += 1

    def object_of_id(self, id: int) -> int:
        """The object that has a number in the layer "id.object"."""
        return self._core.object_of_id(_values.whole("id", id))

    def object_name(self, object: int) -> str:
        return self._core.object_name(_values.whole("object", object))

    @property
    def notes(self) -> list[str]:
        """What readers left out of files or did not take as it stands."""
        return self._core.notes()

    # ---- how it looks ----

    def set(self, *settings: str, **values: Any) -> None:
        """Changes settings: set("lines.width=2"), or set(lines={"width": 2, "draw": ["crease"]})."""
        for setting in settings:
            self._core.set(_values.text("settings", setting))
            self._version += 1
        for table, keys in values.items():
            if not isinstance(keys, Mapping):
                raise UsageError(f"{table}: must be a dict of settings, as in set({table}={{'key': value}})")
            for key, value in keys.items():
                self._core.set(_values.text(table, f"{table}.{key}={_text(value)}"))
                self._version += 1

    def set_toml(self, toml: str) -> None:
        """Changes all settings that a text names, as a scene file does."""
        self._core.set_toml(_values.text("toml", toml))
        self._version += 1

    def set_style(self, style: Optional[str]) -> None:
        """Has lines look as a style sheet says: its name, file or text. None: takes it away."""
        self._core.set_style(_values.text_or_none("style", style) or "")
        self._has_sheet = bool(style)
        self._version += 1

    def add_line_shader(self, name: str, variables: Iterable[str], function: Callable[..., Any]) -> None:
        """Lets a function change the ink of lines: style sheets have it by shader = "NAME".

        function(columns, ink) gets arrays by name: the variables, and "width", "offset", "opacity", "red", "green",
        "blue" of the style. It returns a dict of those that it changes (arrays, or numbers), or None if it changed
        them in place. The same place must get the same ink in whatever array it comes.
        """
        self._core.add_line_shader(*_line_function(name, variables, function))
        self._version += 1

    def add_line_test(self, name: str, variables: Iterable[str], function: Callable[..., Any]) -> None:
        """Lets function(columns) say how much of lines there is, 0 to 1: line sets have it by test = "NAME"."""
        self._core.add_line_test(*_line_function(name, variables, function))
        self._version += 1

    # ---- pictures and lines ----

    def render(self, size: Optional[Sequence[int]] = None, **view: Any) -> Picture:
        """Draws the scene.

        size: width and height in pixels. The view: camera (a name), or matrix (camera to world), or eye, target, up;
        fov (degrees, vertical) or ortho (visible height), shift of the lens (right, up; heights of the picture);
        pixel_aspect (a pixel's width / its height); crop (x0, y0, x1, y1), samples, frame. How to work: layers
        ("beauty,lines,Z"), threads, memory (bytes), progress (a function of the part that is done; it returns True to
        stop).
        """
        finder, find_all = self._finder(size, view), self._finder(size, view, find_all=True)
        return Picture(self._core.render(self._work(size, **view)), finder, find_all)

    def find_lines(
        self, size: Optional[Sequence[int]] = None, *, style: Optional[str] = None, find: str = "view", **view: Any
    ) -> Drawing:
        """Finds the lines that render() would draw.

        style: a sheet for the scene, as by set_style(). find: "view", those that the scene's look asks for; or "all",
        all that there are, so that any style sheet with the same crease_angle and contours can draw them. Vector files
        of a scene without a style sheet are made of lines that are found anew: write them before the scene changes.
        """
        if find not in ("view", "all"):
            raise UsageError("find: must be 'view' or 'all'")
        if style is not None:
            self.set_style(style)
        return self._finder(size, view, find == "all")()

    def explain(self, x: int, y: int, size: Optional[Sequence[int]] = None, *, json: bool = False, **view: Any) -> str:
        """Says why a pixel of a scene with a style sheet looks as it does."""
        place = _values.whole("x", x), _values.whole("y", y)
        return self._core.explain(*place, "json" if json else "text", self._work(size, **view))

    def cancel(self) -> None:
        """Stops what the scene is doing, which then raises burin.Cancelled. From any thread."""
        self._core.cancel()

    def _finder(
        self, size: Optional[Sequence[int]], view: Mapping[str, Any], find_all: bool = False
    ) -> Callable[[], Drawing]:
        """What finds the lines of a view as it is now, as long as the scene is what it was."""
        version = self._version
        works = {paths: self._work(size, for_paths=paths, find_all=find_all, **view) for paths in (False, True)}

        def find(for_paths: bool) -> _core.Drawing:
            if version != self._version:
                raise UsageError("the scene has changed since then; find its lines before, by find_lines()")
            return self._core.find_lines(works[for_paths])

        has_paths = self._has_sheet or find_all
        return lambda: Drawing(find(False), self, None if has_paths else lambda: find(True))

    def _work(
        self,
        size: Optional[Sequence[int]] = None,
        *,
        camera: str = "",
        matrix: Optional[npt.ArrayLike] = None,
        eye: Optional[Vector] = None,
        target: Optional[Vector] = None,
        up: Vector = (0, 1, 0),
        fov: float = 0,
        ortho: float = 0,
        shift: Sequence[float] = (0, 0),
        pixel_aspect: float = 0,
        crop: Sequence[int] = (0, 0, 0, 0),
        samples: int = 0,
        frame: int = 0,
        layers: Union[str, Sequence[str]] = "",
        threads: int = 0,
        memory: int = 0,
        progress: Optional[Progress] = None,
        for_paths: bool = False,
        find_all: bool = False,
        **unknown: Any,
    ) -> _core.Work:
        for name in unknown:
            raise TypeError(f"{name}: no such parameter; a view has {', '.join(VIEW_PARAMETERS)}")
        camera = _values.text("camera", camera)
        if bool(camera) + (matrix is not None) + (eye is not None) > 1:
            raise UsageError("camera, matrix and eye: give one of them")
        if eye is None and target is not None:
            raise UsageError("target: needs eye")
        fov, ortho = _values.real("fov", fov), _values.real("ortho", ortho)
        if (fov or ortho) and matrix is None and eye is None:
            raise UsageError("fov and ortho: need eye or matrix")
        if fov and ortho:
            raise UsageError("fov and ortho: give one of them")
        to_world = _arrays.matrix("matrix", matrix)
        if eye is not None:
            to_world = _looking(_vector("eye", eye), self._target(target), _vector("up", up))
        if not isinstance(layers, str):
            layers = ",".join("ids" if layer == "id" else layer for layer in _values.texts("layers", layers))
        return _core.Work(
            [0, 0] if size is None else _values.wholes("size", size, 2, "two whole numbers, width and height"),
            _values.wholes("crop", crop, 4, "four whole numbers, x0, y0, x1, y1"),
            _values.whole("samples", samples),
            camera,
            to_world,
            fov,
            ortho,
            _values.reals("shift", shift, 2, "two finite numbers, to the right and up"),
            _values.real("pixel_aspect", pixel_aspect),
            _values.whole("frame", frame),
            _values.whole("threads", threads),
            _values.whole("memory", memory, 64),
            _values.text("layers", layers),
            for_paths,
            find_all,
            None if progress is None else _values.function("progress", progress),
        )

    def _target(self, target: Optional[Vector]) -> npt.NDArray[np.float64]:
        if target is not None:
            return _vector("target", target)
        low, high = self._core.box()
        middle: npt.NDArray[np.float64] = (np.array(low) + np.array(high)) / 2
        return middle


def draw(
    mesh: Any,
    *,
    size: Sequence[int] = (1200, 900),
    lines: Union[str, Sequence[str], None] = None,
    width: Optional[float] = None,
    crease_angle: Optional[float] = None,
    hidden: Optional[str] = None,
    style: Optional[str] = None,
    background: Optional[str] = None,
    **view: Any,
) -> Picture:
    """Draws a mesh, a file or a Scene, whose settings it changes.

    lines: classes of lines; width: of strokes, in pixels; crease_angle: in degrees; hidden: "none", "solid" or
    "dashed"; style: a style sheet, which takes the place of lines and hidden, and whose parameter width then is;
    background: "#rrggbb" or "transparent". All else as for Scene.render().
    """
    if isinstance(mesh, Scene):
        scene = mesh
    elif isinstance(mesh, (str, os.PathLike)):
        scene = Scene.load(mesh)
    else:
        scene = Scene(mesh)
    if style is not None:
        for name, given in ("lines", lines), ("hidden", hidden):
            if given is not None:
                raise UsageError(f"{name}: a style sheet says itself which lines are drawn and how; give one of both")
        scene.set_style(style)
        if width is not None:
            scene.set(f"style.width={width}")
            width = None
    looks = {"draw": lines, "width": width, "crease_angle": crease_angle}
    for key, value in looks.items():
        if value is not None:
            scene.set(lines={key: value})
    if hidden is not None:
        scene.set(f"lines.hidden.style={hidden}")
    if background is not None:
        scene.set(f"picture.background={background}")
    return scene.render(size, **view)


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if isinstance(value, (list, tuple, np.ndarray)):
        return ",".join(_text(v) for v in value)
    return repr(float(value)) if isinstance(value, np.floating) else str(value)


def _vector(name: str, value: Vector) -> npt.NDArray[np.float64]:
    return np.array(_values.reals(name, value, 3, "three finite numbers"))


def _line_function(
    name: str, variables: Iterable[str], function: Callable[..., Any]
) -> tuple[str, list[str], Callable[..., Any]]:
    return _values.text("name", name), _values.texts("variables", variables), _values.function("function", function)


def _moved(to_world: list[float], by: npt.NDArray[np.float64]) -> list[float]:
    matrix = np.reshape(to_world, (4, 4)) if any(to_world) else np.eye(4)
    shift = np.eye(4)
    shift[:3, 3] = by
    return [float(x) for x in (matrix @ shift).ravel()]


def _looking(
    eye: npt.NDArray[np.float64], target: npt.NDArray[np.float64], up: npt.NDArray[np.float64]
) -> list[float]:
    """Camera to world: x to the right, y up, looking along -z."""
    back = eye - target
    if not np.linalg.norm(back) > 0:
        raise UsageError("eye and target: are one place")
    back /= np.linalg.norm(back)
    right = np.cross(up, back)
    if not np.linalg.norm(right) > 1e-12 * np.linalg.norm(up):
        raise UsageError("up: is zero, or along the line of sight; give another direction")
    right /= np.linalg.norm(right)
    matrix = np.eye(4)
    matrix[:3, 0], matrix[:3, 1], matrix[:3, 2], matrix[:3, 3] = right, np.cross(back, right), back, eye
    return [float(x) for x in matrix.ravel()]
