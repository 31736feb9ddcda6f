"""The package as users call it. Pictures are compared with those of the program, and of the same mesh in a file."""

import os
import subprocess
import types

import numpy as np
import pytest

import burin

POINTS = np.array(
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], np.float64
)
QUADS = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
SIZE = (160, 120)
PROGRAM = os.environ["BURIN"]


def cube_file(folder):
    path = folder / "cube.obj"
    lines = [f"v {x} {y} {z}" for x, y, z in POINTS] + ["f " + " ".join(str(i + 1) for i in quad) for quad in QUADS]
    path.write_text("\n".join(lines) + "\n")
    return path


def png_size(png):
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    return int.from_bytes(png[16:20], "big"), int.from_bytes(png[20:24], "big")


def test_a_mesh_gives_the_pixels_that_the_program_draws(tmp_path):
    picture = burin.draw((POINTS, QUADS), size=SIZE, width=2)
    subprocess.run(
        [PROGRAM, "render", cube_file(tmp_path), "-r", "160x120", "-w", "2", "-o", tmp_path / "a.png", "-q"], check=True
    )
    picture.save(tmp_path / "b.png")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    assert picture.png() == (tmp_path / "b.png").read_bytes()


def test_a_picture_has_layers_as_arrays():
    picture = burin.draw((POINTS, QUADS), size=SIZE, layers="beauty,lines,Z,N,ids")
    assert picture.layers == ["beauty", "lines", "Z", "N", "id"]
    assert picture["lines"].shape == (120, 160, 4) and picture["lines"].dtype == np.float16
    assert picture["Z"].shape == (120, 160) and picture["Z"].dtype == np.float32
    assert picture["id.object"].dtype == np.uint32 and set(np.unique(picture["id.object"])) == {0, 1}
    assert np.array_equal(picture["N"][..., 2], picture["N.Z"])
    assert np.asarray(picture).shape == (120, 160, 3)
    assert picture.pixels(1).shape == (120, 160) and picture.pixels(4).shape == (120, 160, 4)
    assert "Z" in picture and "lines" in picture and "nothing" not in picture
    assert picture.size == SIZE
    with pytest.raises(KeyError, match="no layer 'nothing'; there are beauty, lines"):
        picture["nothing"]
    with pytest.raises(ValueError):
        picture["Z"][0, 0] = 1  # the picture owns it
    depth = picture["Z"]
    del picture
    assert np.isfinite(depth[60, 80])  # and lives as long as its arrays


def test_a_picture_is_drawn_again_in_another_style():
    scene = burin.Scene((POINTS, QUADS))
    picture = scene.render(SIZE)
    styled = {style: picture.restyle(style).png() for style in ("technical", "blueprint")}
    assert len({picture.png(), *styled.values()}) == 3
    assert styled["technical"] == scene.find_lines(SIZE, find="all").draw("technical").png()
    again = picture.restyle("technical")
    assert again.restyle("blueprint").png() == styled["blueprint"]


def test_a_crop_is_a_part_of_the_picture():
    whole = burin.draw((POINTS, QUADS), size=SIZE)
    part = burin.draw((POINTS, QUADS), size=SIZE, crop=(20, 30, 100, 90))
    assert part["lines"].shape == (60, 80, 4)
    assert np.array_equal(part["lines"], whole["lines"][30:90, 20:100])
    assert png_size(part.png()) == SIZE


def trimesh():
    return types.SimpleNamespace(vertices=POINTS, faces=triangles())


def triangles():
    return np.concatenate([QUADS[:, [0, 1, 2]], QUADS[:, [0, 2, 3]]])


class Cells:
    def __init__(self, type, data):
        self.type, self.data = type, data


def polydata(faces):
    return types.SimpleNamespace(points=POINTS, faces=faces)


def test_meshes_are_known_by_what_they_have():
    flat = np.insert(QUADS, 0, 4, axis=1).ravel()
    mixed = np.concatenate([flat[5:], [3, 0, 3, 2, 3, 0, 2, 1]])  # one face as two triangles
    quads = burin.draw((POINTS, QUADS), size=SIZE).png()
    same = [
        polydata(flat),
        types.SimpleNamespace(points=POINTS, cells=[Cells("quad", QUADS), Cells("vertex", np.array([[0]]))]),
        burin.MeshArrays(POINTS, QUADS.ravel(), np.full(6, 4)),
        (POINTS.tolist(), QUADS.tolist()),
        (POINTS.astype(np.float32), QUADS.astype(np.uint16)),
        (np.asfortranarray(POINTS), np.asfortranarray(QUADS)),
    ]
    for mesh in same:
        assert burin.draw(mesh, size=SIZE).png() == quads
    # Triangles have diagonals, which are no creases; only class `polygon` shows them.
    of_triangles = [trimesh(), types.SimpleNamespace(vertices=POINTS, triangles=triangles()), (POINTS, triangles())]
    pictures = [burin.draw(mesh, size=SIZE, lines=["polygon"]).png() for mesh in of_triangles]
    assert len(set(pictures)) == 1 and pictures[0] != burin.draw((POINTS, QUADS), size=SIZE, lines="polygon").png()
    assert burin.draw(polydata(mixed), size=SIZE, lines="crease,silhouette").png()
    assert len(burin.mesh_arrays(polydata(mixed)).sizes) == 7


def test_meshes_of_real_packages():
    meshio = pytest.importorskip("meshio", reason="python3-meshio is not installed")
    mesh = meshio.Mesh(POINTS, [("quad", QUADS)], point_data={"heat": POINTS[:, 0]})
    assert burin.draw(mesh, size=SIZE).png() == burin.draw((POINTS, QUADS), size=SIZE).png()
    assert list(burin.mesh_arrays(mesh).attributes) == ["heat"]


def test_a_mesh_of_vtk():
    vtk = pytest.importorskip("vtkmodules.vtkCommonDataModel", reason="python3-vtk9 is not installed")
    from vtkmodules.vtkCommonCore import vtkPoints

    points, polygons, mesh = vtkPoints(), vtk.vtkCellArray(), vtk.vtkPolyData()
    points.SetDataTypeToDouble()
    for point in POINTS:
        points.InsertNextPoint(point)
    for quad in QUADS:
        polygons.InsertNextCell(4, quad.tolist())
    mesh.SetPoints(points)
    mesh.SetPolys(polygons)
    assert burin.draw(mesh, size=SIZE).png() == burin.draw((POINTS, QUADS), size=SIZE).png()


@pytest.mark.parametrize("package", ["trimesh", "pyvista", "open3d"])
def test_meshes_of_packages_that_are_there(package):
    module = pytest.importorskip(package, reason=f"{package} is not installed")
    faces = triangles()
    if package == "trimesh":
        mesh = module.Trimesh(POINTS, faces, process=False)
    elif package == "pyvista":
        mesh = module.PolyData(POINTS, np.insert(faces, 0, 3, axis=1).ravel())
    else:
        mesh = module.geometry.TriangleMesh(
            module.utility.Vector3dVector(POINTS), module.utility.Vector3iVector(faces.astype(np.int32))
        )
    assert burin.draw(mesh, size=SIZE).png() == burin.draw((POINTS, faces), size=SIZE).png()


def test_points_far_from_the_origin_keep_their_precision():
    near = burin.draw((POINTS, QUADS), size=SIZE)
    far = burin.draw((POINTS + np.array([1e7, -2e7, 3e7]), QUADS), size=SIZE)
    assert np.abs(near["lines"].astype(float) - far["lines"].astype(float)).max() <= 1 / 64


@pytest.mark.parametrize(
    "mesh, error, message",
    [
        ((POINTS, QUADS + 100), burin.InputError, "corner 0 is 100"),
        ((POINTS, QUADS - 1), burin.InputError, "-1"),
        ((POINTS * np.nan, QUADS), burin.InputError, "not finite"),
        ((POINTS * 1e300, QUADS), burin.InputError, "not finite or beyond"),
        ((POINTS[:, :2], QUADS), burin.UsageError, r"points: must have the shape \(N, 3\), not \(8, 2\)"),
        ((POINTS, QUADS[:, :2]), burin.UsageError, "polygons: must have the shape"),
        ((POINTS, QUADS.astype(float)), burin.UsageError, "polygons: must be integers, not float64"),
        ((POINTS, QUADS + 2**40), burin.UsageError, "does not fit into 32 bits"),
        ((POINTS.astype(complex), QUADS), burin.UsageError, "points: must be real numbers"),
        ((POINTS.astype(str), QUADS), burin.UsageError, "points: must be real numbers"),
        ((POINTS, [[0, 1, 2], [0, 1, 2, 3]]), burin.UsageError, "different numbers of corners"),
        (burin.MeshArrays(POINTS, QUADS.ravel(), np.full(5, 4)), burin.InputError, "have 20 corners, but there are 24"),
        (burin.MeshArrays(POINTS, QUADS, uv=np.zeros((3, 2))), burin.UsageError, r"uv: must have the shape \(24, 2\)"),
        (burin.MeshArrays(POINTS, QUADS, colors=np.zeros(8)), burin.UsageError, "colors: must have the shape"),
        (burin.MeshArrays(POINTS, QUADS, attributes={"a": np.zeros(7)}), burin.UsageError, "a: must have the shape"),
        (burin.MeshArrays(POINTS, QUADS, materials=[0, 0, 0, 0, 0, 9]), burin.InputError, "material"),
        (types.SimpleNamespace(points=POINTS, cells=[Cells("tetra", QUADS)]), burin.UsageError, "it has tetra"),
        (polydata(np.array([4, 0, 1, 2])), burin.UsageError, "ends within the polygon"),
        (3, TypeError, "cannot read a mesh from int"),
    ],
)
def test_bad_meshes_are_named(mesh, error, message):
    with pytest.raises(error, match=message):
        burin.draw(mesh, size=SIZE)
    assert issubclass(error, (ValueError, TypeError))


def test_pictures_save_paths_as_their_drawing_does(tmp_path):
    picture = burin.draw((POINTS, QUADS), size=SIZE)
    for format in "svg", "pdf", "dxf":
        picture.save(tmp_path / f"a.{format}")
        picture.drawing.save(tmp_path / f"b.{format}")
        saved = (tmp_path / f"a.{format}").read_bytes()
        assert saved == (tmp_path / f"b.{format}").read_bytes()
        assert format == "pdf" or saved == picture.encode(format)


def test_width_beside_a_style_is_its_parameter():
    scene = burin.Scene((POINTS, QUADS))
    scene.set_style("pencil")
    scene.set("style.width=7")
    wide = burin.draw((POINTS, QUADS), size=SIZE, style="pencil", width=7)
    assert wide.png() == scene.render(SIZE).png() != burin.draw((POINTS, QUADS), size=SIZE, style="pencil").png()


def test_lines_are_arrays():
    scene = burin.Scene((POINTS, QUADS))
    lines = scene.find_lines(SIZE, eye=(3, 4, 5), ortho=3)
    columns = lines.columns
    assert len(columns) == 11 and len(columns["x0"]) == len(lines) > 9
    # A cube has nine visible edges.
    assert len(np.unique(columns["line"])) == 9
    assert np.all(columns["invisibility"] == 0)
    length = np.hypot(columns["x1"] - columns["x0"], columns["y1"] - columns["y0"]).sum()
    assert 9 * 120 / 3 * 0.5 < length < 9 * 120 / 3
    scene.set("lines.hidden.style=solid")
    hidden = scene.find_lines(SIZE, eye=(3, 4, 5), ortho=3).columns
    assert len(np.unique(hidden["line"])) == 12 and set(np.unique(hidden["invisibility"])) == {0, 1}
    with pytest.raises(KeyError, match="no column 'length'"):
        columns["length"]


def test_a_drawing_is_drawn_again():
    scene = burin.Scene((POINTS, QUADS))
    lines = scene.find_lines(SIZE, style="technical")
    assert lines.draw().png() == scene.render(SIZE).png()
    assert lines.draw("[style.thick]\nwidth = 5\n[[set]]\nname = 's'\nclasses = ['crease']\nstyle = 'thick'\n").png()
    assert lines.draw().drawing is lines


def test_pictures_know_their_lines_while_the_scene_is_what_it_was():
    scene = burin.Scene((POINTS, QUADS))
    picture = scene.render(SIZE)
    assert len(picture.drawing) > 9 and picture.drawing is picture.drawing
    late = scene.render(SIZE)
    scene.set("lines.width=3")
    with pytest.raises(burin.UsageError, match="has changed since"):
        late.drawing


def test_svg_of_a_plain_scene_and_of_a_style():
    scene = burin.Scene((POINTS, QUADS))
    plain = scene.find_lines(SIZE)
    svg = plain.svg()
    assert svg.startswith("<?xml") and svg == plain._repr_svg_()
    assert scene.find_lines(SIZE, style="technical").svg() != svg
    assert plain.encode("pdf").startswith(b"%PDF")


def test_pixels_may_be_wide_and_lenses_shifted():
    scene = burin.Scene((POINTS, QUADS))
    view = {"eye": (3, 2, 5), "fov": 30}
    plain = scene.render(SIZE, **view)
    wide = scene.render((80, 120), pixel_aspect=2, **view)
    assert abs(wide["id.object"].astype(bool).mean() - plain["id.object"].astype(bool).mean()) < 0.005
    shifted = scene.render(SIZE, shift=(0.25, 0), **view)
    assert np.abs(shifted["lines.A"][:, :90].astype(float) - plain["lines.A"][:, 30:120].astype(float)).max() < 0.02
    with pytest.raises(burin.UsageError, match="pixel_aspect"):
        scene.find_lines((80, 120), pixel_aspect=2, **view).svg()


def test_files_have_notes():
    sheet = "[style.a]\ncolor = '=mix(#ff0000, #0000ff, x / 160)'\n[[set]]\nname = 's'\nclasses = ['crease']\nstyle = 'a'\n"
    lines = burin.Scene((POINTS, QUADS)).find_lines(SIZE, style=sheet)
    assert lines.notes == []
    assert lines.svg() and "one colour" in lines.notes[0]


def test_what_moves_is_shown_at_rest():
    scene = burin.Scene()
    scene.add_text("[[object]]\nshape = 'box'\n[[object.key]]\nframe = 1\ntranslate = [1, 0, 0]\n")
    assert "at rest" in scene.notes[0]
    with pytest.raises(burin.UsageError, match="burin render -f 3"):
        scene.render(SIZE, frame=3)


def test_notebooks_show_pictures():
    assert png_size(burin.draw((POINTS, QUADS), size=SIZE)._repr_png_()) == SIZE


def test_objects_move_and_go():
    scene = burin.Scene()
    number = scene.add((POINTS, QUADS), name="cube")
    assert scene.object_name(number) == "cube"
    view = {"eye": (6, 4, 5), "target": (0, 0, 0)}
    here = scene.render(SIZE, **view).png()
    shift = np.eye(4)
    shift[0, 3] = 1
    scene.move(number, shift)
    there = scene.render(SIZE, **view).png()
    assert there != here
    moved = burin.Scene()
    moved.add((POINTS, QUADS), matrix=shift)
    assert moved.render(SIZE, **view).png() == there
    scene.remove(number)
    with pytest.raises(burin.UsageError):
        scene.move(number, shift)


def test_materials_and_attributes_reach_style_sheets():
    heat = POINTS[:, 0]
    mesh = burin.MeshArrays(POINTS, QUADS, attributes={"heat": heat}, colors=np.ones((8, 3)) * (1, 0, 0))
    scene = burin.Scene(mesh)
    sheet = "[style.a]\n{}\n[[set]]\nname = 's'\nclasses = ['crease', 'silhouette']\nstyle = 'a'\n"
    scene.set_style(sheet.format('color = "=Cv"'))
    red = scene.render(SIZE)["lines"]
    assert red[..., 0].max() > 0.9 and red[..., 1].max() == 0
    scene.set_style(sheet.format("width = \"=1 + 4 * attr(\\\"heat\\\")\""))
    assert scene.render(SIZE).png()


def test_functions_shade_lines():
    scene = burin.Scene((POINTS, QUADS))
    sheet = "[style.a]\nwidth = 2\nshader = 's'\n[[set]]\nname = 's'\nclasses = ['crease', 'silhouette']\nstyle = 'a'\n"

    def shade(columns, ink):
        assert columns["N"].shape == (len(ink["width"]), 3) and np.all(columns["depth"] > 0)
        return {"red": 1.0, "width": ink["width"] * 2}

    scene.add_line_shader("s", ["N", "depth"], shade)
    scene.set_style(sheet)
    wide = scene.render(SIZE)["lines"]
    assert wide[..., 0].max() > 0.9 and wide[..., 1].max() == 0
    scene.set_style(sheet.replace("width = 2\nshader = 's'", "width = 4\ncolor = '#ff0000'"))
    assert np.abs(wide.astype(float) - scene.render(SIZE)["lines"].astype(float)).max() < 0.02

    def fail(columns, ink):
        raise ZeroDivisionError("on purpose")

    scene.add_line_shader("s", ["depth"], fail)
    scene.set_style(sheet)
    with pytest.raises(ZeroDivisionError, match="on purpose"):
        scene.render(SIZE)


def test_progress_tells_and_stops():
    told = []
    scene = burin.Scene((POINTS, QUADS))
    scene.render((2000, 2000), progress=told.append)
    assert all(0 <= done <= 1 for done in told) and told == sorted(told)
    with pytest.raises(burin.Cancelled):
        for _ in range(20):  # a call that is faster than a tenth of a second tells nothing
            scene.render((8000, 8000), progress=lambda done: True)

    class Mine(Exception):
        pass

    def fail(done):
        raise Mine

    with pytest.raises(Mine):
        for _ in range(20):
            scene.render((8000, 8000), progress=fail)


def test_lines_of_all_classes_take_any_style():
    lines = burin.Scene((POINTS, QUADS)).find_lines(SIZE, find="all")
    pictures = {style: lines.draw(style).png() for style in ("technical", "blueprint", "instructions", "strata")}
    assert len(set(pictures.values())) == 4
    assert lines.svg("technical").startswith("<?xml")
    with pytest.raises(burin.UsageError, match="another crease_angle"):
        lines.draw("pencil")


def test_the_middle_is_looked_at_wherever_things_are(tmp_path):
    loaded = burin.draw(cube_file(tmp_path), size=SIZE, eye=(3, 2, 5))
    assert loaded["id.object"].any()
    scene = burin.Scene()
    number = scene.add((POINTS, QUADS))
    near = scene.render(SIZE, eye=(3, 2, 5)).png()
    shift = np.eye(4)
    shift[0, 3] = 64
    scene.move(number, shift)
    assert scene.render(SIZE, eye=(67, 2, 5)).png() == near


def test_a_view_is_that_of_the_call():
    scene = burin.Scene((POINTS, QUADS))
    eye = np.array([3.0, 2, 5])
    picture = scene.render(SIZE, eye=eye)
    count = len(scene.find_lines(SIZE, eye=eye))
    eye[:] = (-9, 0, 0.5)
    assert len(picture.drawing) == count


def test_random_calls_never_crash():
    """What the library does not check, the package has to: shapes and types of all arrays."""
    for seed in range(300):
        random = np.random.default_rng(seed)
        kinds = [np.float32, np.float64, np.int8, np.int32, np.int64, np.uint64, bool, complex, object, "U3"]

        def array():
            shape = tuple(random.integers(0, 5, random.integers(0, 4)))
            return (random.random(shape) * 20 - 4).astype(kinds[random.integers(len(kinds))])

        names = ["sizes", "materials", "objects", "marked_edges", "uv", "colors"]
        given = {name: array() for name in names if random.random() < 0.3}
        points, polygons = (POINTS if random.random() < 0.6 else array()), (QUADS if random.random() < 0.6 else array())
        try:
            burin.draw(burin.MeshArrays(points, polygons, **given), size=(32, 24))
        except (ValueError, TypeError):
            pass
