#include <gtest/gtest.h>

#include <limits>

#include "tests/burin/shapes.h"
#include "tests/cli/program.h"

namespace burin::test::mesh_test {
namespace {

/// The EXR that the program makes of an OBJ of these arrays.
std::string program_exr(const Arrays& arrays, const std::vector<std::string>& more = {}) {
    const TemporaryFolder folder;
    folder.write("colours.mtl", "newmtl m2\nKd 1 0 0\nnewmtl m3\nKd 0 0 1\nd 0.5\n");
    folder.write("model.obj", obj_text(arrays));
    std::vector<std::string> arguments = {"render", "model.obj", "-o", "model.exr", "--size", "200x150", "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run_burin(folder.path(), arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return read_file(folder.file("model.exr"));
}

TEST(LibraryMesh, TrianglesGiveThePictureOfTheFile) {
    const Arrays arrays = waves(40);
    Scene scene;
    scene.add(arrays.mesh("waves"));
    EXPECT_TRUE(exr_of(scene) == program_exr(arrays));
    scene.set("lines.hidden.style=dashed");
    EXPECT_TRUE(exr_of(scene) == program_exr(arrays, {"--hidden", "dashed"}));
}

TEST(LibraryMesh, ALargeMeshGivesThePictureOfTheFile) {
    const Arrays arrays = waves(200);  // in spatial order
    Scene scene;
    scene.add(arrays.mesh("waves"));
    EXPECT_TRUE(exr_of(scene) == program_exr(arrays));
}

TEST(LibraryMesh, PolygonsGiveThePictureOfTheFile) {
    Arrays arrays = cube();
    add_cube(arrays, 0.5f, 0.75f, 0.75f, 0.75f);  // runs into the first
    Scene scene;
    scene.add(arrays.mesh());
    EXPECT_TRUE(exr_of(scene) == program_exr(arrays));
}

TEST(LibraryMesh, MaterialsGiveThePictureOfTheFile) {
    Arrays arrays = cube();
    add_cube(arrays, 0.5f, 1.2f, 0, 0);
    arrays.materials = {2, 2, 3, 3, 2, 3, 2, 2, 2, 3, 3, 3};
    Scene scene;
    ASSERT_EQ(scene.add(Material{}), 1);  // an OBJ has one for polygons without
    ASSERT_EQ(scene.add(Material{.name = "m2", .color = {1, 0, 0}}), 2);
    ASSERT_EQ(scene.add(Material{.name = "m3", .color = {0, 0, 1}, .opacity = 0.5f}), 3);
    scene.add(arrays.mesh());
    scene.set("surfaces.shading=lambert");
    EXPECT_TRUE(exr_of(scene) == program_exr(arrays, {"--set", "surfaces.shading=lambert"}));
}

TEST(LibraryMesh, WhereMaterialsMeetIsNoContact) {
    Arrays arrays = cube();
    Scene scene;
    ASSERT_EQ(scene.add(Material{.name = "red"}), 1);
    ASSERT_EQ(scene.add(Material{.name = "blue"}), 2);
    arrays.materials = {1, 2, 1, 2, 0, 2};
    scene.add(arrays.mesh());
    const auto pieces_of = [&](const std::string& classes) {
        scene.set("lines.draw=" + classes);
        return scene.find_lines({.width = 90, .height = 60}).piece_count();
    };
    EXPECT_EQ(pieces_of("object,intersection,border"), 0u);
    EXPECT_GT(pieces_of("material"), 2u);
}

/// What a sheet reads of a mesh is what it would read of a file.
TEST(LibraryMesh, AttributesGiveThePictureOfTheFile) {
    const std::vector<float> points{0, 0, 0, 1, 0, 0, 2, 0, -1, 0, 1, 0, 1, 1, 0, 2, 1, -1};
    const std::vector<std::int32_t> corners{0, 1, 4, 3, 1, 2, 5, 4}, sizes{4, 4};
    const std::vector<float> uv{0, 0, 1, 0, 1, 1, 0, 1, 5, 0, 6, 0, 6, 1, 5, 1};
    const std::vector<float> colors{1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1}, heat{1, 2, 3, 4, 5, 6};
    const std::string by_uv =
        "style_version = 1\n[[set]]\nname = \"all\"\nclasses = [\"border\", \"crease\"]\nstyle = \"ink\"\n"
        "[style.ink]\ncolor = \"=Cv\"\nwidth = \"=1 + u + 2*v\"\n";
    std::string obj;
    for (std::size_t i = 0; i < 18; i += 3) {
        obj += "v";
        for (const std::vector<float>* const numbers : {&points, &colors}) {
            for (std::size_t k = i; k < i + 3; ++k) obj += ' ' + std::to_string((*numbers)[k]);
        }
        obj += '\n';
    }
    for (std::size_t i = 0; i < uv.size(); i += 2)
        obj += "vt " + std::to_string(uv[i]) + ' ' + std::to_string(uv[i + 1]) + '\n';
    obj += "f 1/1 2/2 5/3 4/4\nf 2/5 3/6 6/7 5/8\n";
    const TemporaryFolder folder;
    folder.write("model.obj", obj);
    folder.write("sheet.toml", by_uv);
    const ProgramResult result = run_burin(folder.path(), {"render", "model.obj", "-o", "model.exr", "--size",
                                                           "200x150", "-q", "--style", "./sheet.toml"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Mesh mesh{.name = "model",
                    .points = points,
                    .corners = corners,
                    .polygon_sizes = sizes,
                    .corner_uv = uv,
                    .point_colors = colors,
                    .attributes = {{"heat", heat}}};
    Scene scene;
    scene.add(mesh);
    scene.set_style(by_uv);
    const std::string with_values = exr_of(scene);
    EXPECT_TRUE(with_values == read_file(folder.file("model.exr")));
    // A file that is loaded before the sheet is known keeps its values, too.
    Scene loaded;
    loaded.add_file(folder.file("model.obj"));
    loaded.set_style(by_uv);
    EXPECT_TRUE(exr_of(loaded) == with_values);
    scene.set_style(by_uv + "opacity = \"=attr(\\\"heat\\\") > 3\"\n");
    EXPECT_FALSE(exr_of(scene) == with_values);
}

TEST(LibraryMesh, PartsGiveThePictureOfTheFile) {
    Arrays arrays = cube();
    add_cube(arrays, 0.5f, 0.25f, 1, 0.25f);  // stands on it: a line of class object
    arrays.objects = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
    arrays.object_names = {"table", "box"};
    Scene scene;
    const int object = scene.add(arrays.mesh());
    EXPECT_TRUE(exr_of(scene) == program_exr(arrays));
    EXPECT_EQ(scene.object_of_id(1), object);
    EXPECT_EQ(scene.object_of_id(2), object);
    EXPECT_EQ(failure_of([&] { scene.object_of_id(3); }), BURIN_BAD_ARGUMENT);
}

TEST(LibraryMesh, MarkedEdgesGiveThePictureOfTheFile) {
    Arrays arrays = cube();
    arrays.marks = {0, 1, 5, 6, 0, 6, 1, 7};  // two edges, two lines through the inside
    Scene scene;
    scene.add(arrays.mesh());
    scene.set("lines.draw=all");
    EXPECT_TRUE(exr_of(scene) == program_exr(arrays, {"--lines", "all"}));
    Arrays lines_only = cube();
    lines_only.corners.clear();
    lines_only.sizes.clear();
    lines_only.marks = {0, 6, 1, 7, 2, 4};
    Scene lines;  // marks are drawn where there is nothing else
    lines.add(lines_only.mesh());
    EXPECT_TRUE(exr_of(lines) == program_exr(lines_only));
}

TEST(LibraryMesh, NothingIsTakenAsItStandsIfItIsWrong) {
    Scene scene;
    std::string text;
    const auto expect_refused = [&](const auto& change, int kind, const char* message) {
        Arrays arrays = cube();
        burin_mesh mesh = {};
        mesh.size = sizeof mesh;
        mesh.points = arrays.points.data(), mesh.point_count = 8;
        mesh.corners = arrays.corners.data(), mesh.corner_count = 24;
        mesh.polygon_sizes = arrays.sizes.data(), mesh.polygon_count = 6;
        change(arrays, mesh);
        EXPECT_EQ(burin_add_mesh(scene.get(), &mesh), kind) << message;
        EXPECT_STREQ(burin_error(), message);
    };
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, infinity, -infinity, 2e30f}) {
        expect_refused([&](Arrays& a, burin_mesh&) { a.points[13] = bad; }, BURIN_BAD_INPUT,
                       "mesh: a coordinate of point 4 is not finite or beyond 1e30");
    }
    expect_refused([](Arrays& a, burin_mesh&) { a.corners[7] = 8; }, BURIN_BAD_INPUT,
                   "mesh: corner 7 is 8; the mesh has 8 points, counted from 0");
    expect_refused([](Arrays& a, burin_mesh&) { a.corners[7] = -1; }, BURIN_BAD_INPUT,
                   "mesh: corner 7 is -1; the mesh has 8 points, counted from 0");
    expect_refused([](Arrays& a, burin_mesh&) { a.sizes[5] = 5; }, BURIN_BAD_INPUT,
                   "mesh: polygon 5 has 5 corners; there are 24 of all polygons");
    expect_refused([](Arrays& a, burin_mesh&) { a.sizes[5] = -4; }, BURIN_BAD_INPUT,
                   "mesh: polygon 5 has -4 corners; there are 24 of all polygons");
    expect_refused([](Arrays& a, burin_mesh&) { a.sizes[5] = 3; }, BURIN_BAD_INPUT,
                   "mesh: its polygons have 23 corners, but there are 24");
    expect_refused([](Arrays&, burin_mesh& m) { m.points = nullptr; }, BURIN_BAD_ARGUMENT,
                   "mesh: 8 points, but the array is NULL");
    expect_refused([](Arrays&, burin_mesh& m) { m.corners = nullptr; }, BURIN_BAD_ARGUMENT,
                   "mesh: 24 corners, but the array is NULL");
    expect_refused([](Arrays&, burin_mesh& m) { m.point_count = std::uint64_t{1} << 40; }, BURIN_BAD_ARGUMENT,
                   "mesh: 1099511627776 points; there may be 2147483647 at most");
    expect_refused([](Arrays&, burin_mesh& m) { m.corner_count = std::numeric_limits<std::uint64_t>::max(); },
                   BURIN_BAD_ARGUMENT, "mesh: 18446744073709551615 corners; there may be 4294967295 at most");
    expect_refused([](Arrays&, burin_mesh& m) { m.polygon_count = std::uint64_t{1} << 63; }, BURIN_BAD_ARGUMENT,
                   "mesh: 9223372036854775808 polygons; there may be 4294967294 at most");
    expect_refused([](Arrays&, burin_mesh& m) { m.marked_edge_count = std::uint64_t{1} << 63; }, BURIN_BAD_ARGUMENT,
                   "mesh: 9223372036854775808 marked edges; there may be 2147483647 at most");
    expect_refused([](Arrays&, burin_mesh& m) { m.polygon_sizes = nullptr; }, BURIN_BAD_ARGUMENT,
                   "mesh: 24 corners are not those of 6 triangles; give polygon_sizes");
    expect_refused([](Arrays&, burin_mesh& m) { m.polygon_sizes = nullptr, m.polygon_count = 0, m.corner_count = 23; },
                   BURIN_BAD_ARGUMENT, "mesh: 23 corners are not those of 7 triangles; give polygon_sizes");
    expect_refused(
        [](Arrays& a, burin_mesh& m) {
            a.marks = {0, 8}, m.marked_edges = a.marks.data(), m.marked_edge_count = 1;
        },
        BURIN_BAD_INPUT, "mesh: marked_edges: number 1 is 8; the mesh has 8 points, counted from 0");
    expect_refused(
        [](Arrays& a, burin_mesh& m) { a.materials = {0, 0, 0, 0, 0, 1}, m.polygon_materials = a.materials.data(); },
        BURIN_BAD_INPUT,
        "mesh: the material of polygon 5 is 1; the scene has 0 materials, counted from 1, and 0 is none");
    expect_refused(
        [](Arrays& a, burin_mesh& m) {
            a.objects = {0, 0, 0, 0, 0, 2}, m.polygon_objects = a.objects.data(), m.object_count = 2;
        },
        BURIN_BAD_INPUT, "mesh: the object of polygon 5 is 2; the mesh has 2, counted from 0");
    expect_refused([](Arrays& a, burin_mesh& m) { a.objects.assign(6, 0), m.polygon_objects = a.objects.data(); },
                   BURIN_BAD_ARGUMENT, "mesh: object_count is 0; with polygon_objects it must be from 1 to 16777216");
    EXPECT_EQ(failure_of([&] { scene.add_object(1); }), BURIN_BAD_ARGUMENT);  // there is none
}

TEST(LibraryMesh, AnEmptyMeshIsAnObjectWithoutPixels) {
    Scene scene;
    scene.add(cube().mesh());
    const std::string alone = exr_of(scene);
    const int empty = scene.add(Mesh{.name = "nothing"});
    Arrays dropped;  // no area
    dropped.points.assign(9, 1);
    dropped.corners = {0, 1, 2};
    scene.add(dropped.mesh());
    EXPECT_TRUE(exr_of(scene) == alone);
    EXPECT_EQ(scene.object_name(empty), "nothing");
}

}  // namespace
}  // namespace burin::test::mesh_test
