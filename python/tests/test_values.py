"""Values of parameters that are wrong: errors name the parameter, what it must be and what was given."""

import numpy as np
import pytest

import burin

POINTS = np.array(
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], np.float64
)
QUADS = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
SIZE = (160, 120)


@pytest.mark.parametrize(
    "options, message",
    [
        ({"size": (0, 3)}, "width and view.height"),
        ({"size": 3}, "size: must be two whole numbers, width and height, not 3"),
        ({"size": ("a", 3)}, "size: must be two whole numbers"),
        ({"size": (64.5, 48)}, r"size: must be two whole numbers, width and height, not \(64.5, 48\)"),
        ({"size": (99999, 3)}, "65535"),
        ({"eye": (0, 0, 0), "target": (0, 0, 0)}, "are one place"),
        ({"eye": (0, 5, 0), "up": (0, 1, 0), "target": (0, 0, 0)}, "up: is zero, or along"),
        ({"eye": (0, float("nan"), 0)}, "eye: must be three finite numbers"),
        ({"target": (0, 0, 0)}, "target: needs eye"),
        ({"fov": 30}, "need eye or matrix"),
        ({"pixel_aspect": 0.01}, "pixel_aspect"),
        ({"pixel_aspect": float("nan")}, "pixel_aspect"),
        ({"shift": (1, 2, 3)}, "shift: must be two finite numbers"),
        ({"shift": (1, 0)}, "shift"),
        ({"eye": (3, 3, 3), "fov": float("nan")}, "fov"),
        ({"eye": (3, 3, 3), "fov": 30, "ortho": 3}, "fov and ortho: give one of them"),
        ({"style": "pencil", "lines": "crease"}, "lines: a style sheet says itself"),
        ({"style": "pencil", "hidden": "solid"}, "hidden: a style sheet says itself"),
        ({"matrix": np.eye(3)}, "matrix: must be a matrix"),
        ({"matrix": 2 * np.eye(4)}, "camera_to_world"),
        ({"camera": "main", "matrix": np.eye(4)}, "give one of them"),
        ({"width": float("nan")}, "width"),
        ({"lines": "crinkle"}, "crinkle"),
        ({"style": "pncil"}, "did you mean 'pencil'"),
        ({"layers": "everything"}, "layers"),
        ({"crop": (0, 0, 500, 500)}, "crop"),
        ({"threads": -1}, "threads"),
        ({"threads": 1e9}, "threads: must be from 0 to 1024"),
        ({"threads": 1e10}, "threads: must be a whole number from -2147483648 to 2147483647, not 10000000000.0"),
        ({"samples": "a"}, "samples: must be a whole number, not 'a'"),
        ({"frame": float("nan")}, "frame: must be a whole number, not nan"),
        ({"fov": "x"}, "fov: must be a finite number, not 'x'"),
        ({"ortho": [3]}, r"ortho: must be a finite number, not \[3\]"),
        ({"pixel_aspect": "wide"}, "pixel_aspect: must be a finite number"),
        ({"crop": (1, 2)}, r"crop: must be four whole numbers, x0, y0, x1, y1, not \(1, 2\)"),
        ({"crop": "all"}, "crop: must be four"),
        ({"memory": -1}, "memory: must be a whole number from 0"),
        ({"memory": None}, "memory: must be a whole number, not None"),
        ({"style": 3}, r"style: must be a text \(str\), not 3"),
        ({"style": "a\0b"}, "style: must be a text of UTF-8 without NUL"),
        ({"style": "\ud800"}, "style: must be a text of UTF-8"),
        ({"camera": 3}, "camera: must be a text"),
        ({"layers": [1]}, "layers: must be a text"),
        ({"layers": 1}, "layers: must be a list of texts"),
        ({"progress": 3}, "progress: must be a function, not 3"),
        ({"up": "y", "eye": (3, 3, 3)}, "up: must be three finite numbers, not 'y'"),
        ({"target": [[1], [2, 3]], "eye": (3, 3, 3)}, "target: must be three finite numbers"),
    ],
)
def test_bad_options_are_named(options, message):
    with pytest.raises(ValueError, match=message):
        burin.draw((POINTS, QUADS), **{"size": SIZE, **options})


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda s: s.add((POINTS, QUADS), name=3), "name: must be a text"),
        (lambda s: s.add((POINTS, QUADS), material="steel"), "material: must be a whole number, not 'steel'"),
        (lambda s: s.add_file(3), "path: must be a file's name .*, not 3"),
        (lambda s: s.add_text(b"", ""), "toml: must be a text"),
        (lambda s: s.add_text("", 3), "base_folder: must be a file's name"),
        (lambda s: s.add_material("a", "red"), "color: must be three finite numbers, not 'red'"),
        (lambda s: s.add_material("a", opacity="x"), "opacity: must be a finite number"),
        (lambda s: s.move("a", None), "object: must be a whole number"),
        (lambda s: s.remove(2**31), "object: must be a whole number from"),
        (lambda s: s.object_name(1.5), "object: must be a whole number, not 1.5"),
        (lambda s: s.object_of_id(None), "id: must be a whole number"),
        (lambda s: s.set(3), "settings: must be a text"),
        (lambda s: s.set_toml(None), "toml: must be a text"),
        (lambda s: s.add_line_shader("a", ["s"], 3), "function: must be a function"),
        (lambda s: s.add_line_shader("a", "s", print), "variables: must be a list of texts"),
        (lambda s: s.add_line_test(3, ["s"], print), "name: must be a text"),
        (lambda s: s.explain("x", 0, SIZE), "x: must be a whole number"),
        (lambda s: s.render(SIZE).pixels("all"), "channels: must be a whole number"),
        (lambda s: s.render(SIZE).encode(3), "format: must be a text"),
        (lambda s: s.render(SIZE).save(3), "path: must be a file's name"),
        (lambda s: s.render(SIZE).restyle(3), "style: must be a text"),
        (lambda s: s.find_lines(SIZE).draw(3), "style: must be a text"),
        (lambda s: s.find_lines(SIZE).draw(threads="all"), "threads: must be a whole number"),
        (lambda s: s.find_lines(SIZE).svg(3), "style: must be a text"),
        (lambda s: s.find_lines(SIZE).save(3), "path: must be a file's name"),
    ],
)
def test_bad_values_are_named(call, message):
    with pytest.raises(burin.UsageError, match=f"^{message}"):
        call(burin.Scene((POINTS, QUADS)))


def test_numbers_of_all_kinds_are_numbers():
    plain = burin.draw((POINTS, QUADS), size=SIZE, eye=(3, 2, 5), samples=4).png()
    for of in (np.int64, np.float32, float):
        size, eye = np.array(SIZE, of), np.array((3, 2, 5), of)
        assert burin.draw((POINTS, QUADS), size=size, eye=eye, samples=of(4), fov=of(0)).png() == plain


def test_a_parameter_that_there_is_not_is_named():
    scene = burin.Scene()
    scene.add((POINTS, QUADS))
    for call in (scene.render, scene.find_lines):
        with pytest.raises(TypeError, match="^sampels: no such parameter; a view has size, camera, "):
            call((8, 8), sampels=2)
