"""What drawing makes: pictures, and lines as data."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from typing import Any, Callable, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _core, _values

PathLike = Union[str, "os.PathLike[str]"]
Array = npt.NDArray[Any]

_ORDER = "RGBAXYZ"

VECTOR_FORMATS = ("svg", "pdf", "dxf")


def _suffix(path: str) -> str:
    return os.path.splitext(path)[1].lstrip(".").lower()


class Picture:
    """Pixels in layers. numpy.asarray(picture) is what a display shows: (height, width, 3) bytes, sRGB."""

    def __init__(
        self,
        core: _core.Picture,
        find_drawing: Callable[[], "Drawing"],
        find_all: Optional[Callable[[], "Drawing"]] = None,
    ) -> None:
        self._core = core
        self._find_drawing = find_drawing
        self._find_all = find_all or find_drawing
        self._drawing: Optional[Drawing] = None
        self._all: Optional[Drawing] = None

    @property
    def channels(self) -> list[str]:
        """Names of all channels: "R", "lines.A", "Z", "id.object" ..."""
        return self._core.channel_names()

    @property
    def layers(self) -> list[str]:
        """Names of all layers: "beauty", "lines", "Z" ..."""
        names = (name.rpartition(".")[0] or (name if name not in "RGBA" else "beauty") for name in self.channels)
        return list(dict.fromkeys(names))

    def __getitem__(self, name: str) -> Array:
        """A layer, (height, width, channels), or one channel of it, (height, width). It is of the crop."""
        names = self.channels
        if name in names:
            return self._core.channel(name)
        parts = [c for c in names if (c in "RGBA" if name == "beauty" else c.rpartition(".")[0] == name)]
        if not parts:
            raise KeyError(f"no layer '{name}'; there are {', '.join(self.layers)}")
        if all(part[-2:-1] in ("", ".") and part[-1] in _ORDER for part in parts):
            parts.sort(key=lambda part: _ORDER.index(part[-1]))
        layer: Array = np.stack([self._core.channel(part) for part in parts], axis=-1)
        layer.setflags(write=False)
        return layer

    def __contains__(self, name: object) -> bool:
        return name in self.channels or name in self.layers

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the channels, in pixels."""
        shape = self._core.channel(self.channels[0]).shape
        return shape[1], shape[0]

    def pixels(self, channels: int = 3) -> npt.NDArray[np.uint8]:
        """What a display shows: 1 grey, 3 red green blue, 4 with alpha. Needs the layer "beauty"."""
        return self._core.pixels(_values.whole("channels", channels))

    def __array__(self, dtype: Any = None) -> Array:
        pixels = self.pixels()
        return pixels if dtype is None else pixels.astype(dtype)

    @property
    def drawing(self) -> "Drawing":
        """The lines of the picture as data. They are found when they are first asked for."""
        if self._drawing is None:
            self._drawing = self._find_drawing()
        return self._drawing

    def restyle(self, style: str) -> "Picture":
        """The same view drawn by a style sheet: its name, file or text. Lines of all classes are found when this is
        first called; sheets with the same crease_angle and contours can draw them."""
        _values.text("style", style)
        if self._all is None:
            self._all = self._find_all()
        return self._all.draw(style)

    @property
    def notes(self) -> list[str]:
        """What drawing found that its user should know."""
        return self._core.notes()

    def encode(self, format: str) -> bytes:
        """The bytes of a file: "png", "png16", "exr", "tif", "tif16", and "svg", "pdf", "dxf", which its drawing
        makes."""
        _values.text("format", format)
        return self.drawing.encode(format) if format in VECTOR_FORMATS else self._core.encode(format)

    def png(self) -> bytes:
        return self.encode("png")

    def save(self, path: PathLike) -> None:
        """Into a file, whose suffix says the format; paths are made by its drawing."""
        path = _values.path("path", path)
        if _suffix(path) in VECTOR_FORMATS:
            self.drawing.save(path)
        else:
            self._core.write(path)

    def _repr_png_(self) -> bytes:
        return self.png()


class Columns(Mapping[str, Array]):
    """What is known of each straight piece of a drawing, by name; a column is made when it is first asked for."""

    _NAMES = (
        "x0", "y0", "x1", "y1", "nearness0", "nearness1", "line", "object", "material", "classes", "invisibility"
    )  # fmt: skip

    def __init__(self, core: _core.Drawing) -> None:
        self._core = core

    def __getitem__(self, name: str) -> Array:
        if name not in self._NAMES:
            raise KeyError(f"no column '{name}'; there are {', '.join(self._NAMES)}")
        return self._core.column(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._NAMES)

    def __len__(self) -> int:
        return len(self._NAMES)


class Drawing:
    """Lines, found once: to be read as arrays, and drawn as often as one likes."""

    def __init__(self, core: _core.Drawing, used: object, for_paths: Optional[Callable[[], _core.Drawing]]) -> None:
        self._core = core
        self._used = used  # what drawing it calls
        self._find_for_paths = for_paths  # None: it was found by a style sheet, which paths are made by
        self._for_paths: Optional[_core.Drawing] = None
        self._notes: list[str] = []

    def __len__(self) -> int:
        """How many straight pieces there are."""
        return self._core.piece_count()

    @property
    def columns(self) -> Mapping[str, Array]:
        """Arrays with a value for each piece: x0 y0 x1 y1 (pixels), nearness0 nearness1, line, object, material,
        classes (bits), invisibility (how many surfaces are in front). See burin_column() of the library."""
        return Columns(self._core)

    def draw(self, style: Optional[str] = None, *, threads: int = 0) -> Picture:
        """The picture that a style sheet makes of the lines: its name, file or text. None: the look of the scene."""
        style, threads = _values.text_or_none("style", style), _values.whole("threads", threads)
        return Picture(self._core.draw(style, threads), lambda: self)

    def encode(self, format: str, style: Optional[str] = None) -> bytes:
        """The bytes of a file: "svg", "pdf", "dxf", and those of pictures."""
        file = self._written(format, style).encode(format, style)
        self._notes = _core.file_notes()
        return file

    def svg(self, style: Optional[str] = None) -> str:
        return self.encode("svg", style).decode()

    def save(self, path: PathLike, style: Optional[str] = None) -> None:
        """Into a file, whose suffix says the format."""
        path = _values.path("path", path)
        self._written(_suffix(path), style).write(path, style)
        self._notes = _core.file_notes()

    @property
    def notes(self) -> list[str]:
        """What the file that was made last does not have as it stands, such as colours that vary along a path."""
        return list(self._notes)

    def _written(self, format: str, style: Optional[str]) -> _core.Drawing:
        """What a file is made of: paths need lines that a style sheet asked for, or the scene's look as one."""
        _values.text("format", format)
        _values.text_or_none("style", style)
        if format not in VECTOR_FORMATS or style is not None or self._find_for_paths is None:
            return self._core
        if self._for_paths is None:
            self._for_paths = self._find_for_paths()
        return self._for_paths

    def _repr_svg_(self) -> str:
        return self.svg()
