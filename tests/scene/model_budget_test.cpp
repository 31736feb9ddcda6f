// What a few words of a scene multiply is counted before it is made.

#include <gtest/gtest.h>

#include "tests/scene/scene_text.h"

namespace burin {
namespace {

using test::SceneText;

constexpr std::uint64_t kMega = std::uint64_t{1} << 20;

/// The message of the InputError that loading within a budget gives; empty if there is none.
std::string refusal(const SceneText& text, std::uint64_t limit_bytes = ModelBudget::kDefaultLimit) {
    try {
        load_scene(text.read(), {.budget = ModelBudget(limit_bytes)});
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(ModelBudgetOfScenes, LargeShapesAreRefusedBeforeTheyAreMade) {
    for (const auto& [keys, size] : std::vector<std::pair<std::string, std::string>>{
             {"shape='sphere'\nsegments=4096\nrings=4096",
              "16.8 million polygons (segments 4096, rings 4096) needs about 3.7 GB"},
             {"shape='plane'\ncolumns=4096\nrows=4095",
              "16.8 million polygons (columns 4096, rows 4095) needs about 3.7 GB"},
             {"shape='torus'\nsegments=4096\ntube_segments=4096", "16.8 million"},
             {"shape='teapot'\ntessellation=256\nsubdivide=2", "33.6 million polygons (tessellation 256, subdivide 2)"},
             {"shape='sphere'\nsegments=64\nrings=64\nsubdivide=8",
              "266.3 million polygons (segments 64, rings 64, subdivide 8)"},
             {"shape='box'\nsubdivide=8\n[[object]]\nshape='cone'\nsegments=4096\nsubdivide=7\n", "cone"}}) {
        const std::string message = refusal(SceneText("[[object]]\n" + keys + "\n"));
        EXPECT_TRUE(has(message, size)) << keys << ": " << message;
        EXPECT_TRUE(has(message, "that models may take")) << message;
        EXPECT_TRUE(has(message, "scene.toml:")) << message;
    }
}

TEST(ModelBudgetOfScenes, ShapesCountTogetherAndBeforeAnyFileIsRead) {
    std::string text = "[[object]]\nfile='missing.obj'\n";
    for (int i = 0; i < 40; ++i)
        text += "[[object]]\nshape='plane'\nname='p" + std::to_string(i) + "'\ncolumns=1024\nrows=1024\n";
    const std::string message = refusal(SceneText(text));
    EXPECT_TRUE(has(message, "object 'p8'")) << message;  // each takes 240 MB
    // What is named is enough: 40 times 240 MB, and 40 instances.
    EXPECT_TRUE(has(message, "needs about 240 MB, all of its kind together 9.4 GB, more than the 2.0 GB")) << message;
}

TEST(ModelBudgetOfScenes, WhatInstancesOfAllModelsNeedIsNamed) {
    std::string text;
    for (int i = 0; i < 3; ++i) {
        text += "[[object]]\nfile='" + std::to_string(i) + ".obj'\ninstance=[";
        for (int k = 0; k < 1000; ++k) text += "{},";
        text += "]\n";
    }
    const SceneText scene(text);
    for (int i = 0; i < 3; ++i)
        scene.folder().write(std::to_string(i) + ".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string message = refusal(scene, kMega);
    EXPECT_TRUE(has(message, "1.obj' of 1000 instances with 1 part each needs about 586 KB")) << message;
    EXPECT_TRUE(has(message, "all of its kind together 1.7 MB, more than the 1.0 MB")) << message;
    EXPECT_EQ(refusal(scene, 2 * kMega), "");
}

TEST(ModelBudgetOfScenes, TheSizeOfAShapeIsKnown) {
    for (const char* keys :
         {"shape='box'", "shape='plane'", "shape='plane'\ncolumns=3\nrows=5", "shape='sphere'",
          "shape='sphere'\nsegments=3\nrings=2", "shape='sphere'\nsegments=5\nrings=3", "shape='cylinder'",
          "shape='cylinder'\nsegments=3", "shape='cone'", "shape='cone'\nsegments=3", "shape='torus'",
          "shape='torus'\nsegments=4\ntube_segments=7", "shape='teapot'", "shape='teapot'\ntessellation=1"}) {
        SceneDescription scene = SceneText("[[object]]\n" + std::string(keys)).read();
        const Shape& shape = scene.objects[0].shape;
        const PolygonSoup soup = shape.make();
        EXPECT_EQ(shape.polygons, soup.polygon_count()) << keys;
        EXPECT_EQ(shape.corners, soup.corners.size()) << keys;
        EXPECT_EQ(shape.name, soup.object_names[0]) << keys;
        scene.objects[0].subdivide = 2;
        const PolygonCounts counts =
            count_subdivided({shape.polygons, shape.corners}, SubdivisionScheme::automatic, 2, "shape");
        if (shape.name == "teapot") continue;  // some of its polygons have no area
        EXPECT_EQ(load_scene(scene).meshes[0].polygon_count, counts.polygons) << keys;
    }
}

TEST(ModelBudgetOfScenes, SubdividedFilesAreRefusedBeforeTheWork) {
    const SceneText text("[[object]]\nfile='two.obj'\nsubdivide=8\n");
    text.folder().write("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
    EXPECT_EQ(refusal(text, 24 * kMega), "");  // 131,072 triangles: 22.5 MB
    const std::string message = refusal(text, 22 * kMega);
    EXPECT_TRUE(has(message, "131072 polygons (subdivide 8) needs about 22 MB")) << message;
}

/// All objects of a file together, and before the first of them.
TEST(ModelBudgetOfScenes, SubdividedObjectsCountTogether) {
    std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";
    for (int i = 0; i < 100; ++i) obj += "o part" + std::to_string(i) + (i % 2 == 0 ? "\nf 1 2 3\n" : "\nf 1 2 4 3\n");
    const SceneText text("[[object]]\nfile='parts.obj'\nsubdivide=3\n");
    text.folder().write("parts.obj", obj);
    const std::string message = refusal(text, kMega);  // 350 corners become 22,400
    EXPECT_TRUE(has(message, "the model of 5600 polygons (subdivide 3) needs about 1.3 MB")) << message;
    EXPECT_EQ(refusal(text, 2 * kMega), "");
}

/// A file may be large, if it spells out what it says.
TEST(ModelBudgetOfScenes, WhatAFileSpellsOutIsNotCounted) {
    std::string obj;
    for (int i = 0; i < 1000; ++i) {
        const std::string n =
            std::to_string(3 * i + 1) + " " + std::to_string(3 * i + 2) + " " + std::to_string(3 * i + 3);
        obj += "v 0 0 " + std::to_string(i) + "\nv 1 0 0\nv 0 1 0\no " + std::to_string(i) + "\nf " + n + "\n";
    }
    const SceneText text("[[object]]\nfile='many.obj'\n");
    text.folder().write("many.obj", obj);
    EXPECT_EQ(refusal(text, 1), "");
    const SceneText twice("[[object]]\nfile='many.obj'\n[[object]]\nfile='./many.obj'\n");
    twice.folder().write("many.obj", obj);
    EXPECT_EQ(refusal(twice, kMega), "");
    EXPECT_TRUE(has(refusal(twice, 500000), "of 1 instances with 1000 parts each needs about"));
}

TEST(ModelBudgetOfScenes, InstancesTimesPartsAreCounted) {
    std::string instances;
    for (int i = 0; i < 5000; ++i) instances += "{},";
    std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 1000; ++i) obj += "o " + std::to_string(i) + "\nf 1 2 3\n";
    const SceneText text("[[object]]\nfile='parts.obj'\nname='crowd'\ninstance=[" + instances + "]\n");
    text.folder().write("parts.obj", obj);
    const std::string message = refusal(text);
    EXPECT_TRUE(has(message, "object 'crowd' of 5000 instances with 1000 parts each needs about 2.8 GB")) << message;
}

TEST(ModelBudgetOfScenes, PolygonsOfAllInstancesAreCountedBeforeTheyArePlaced) {
    std::string instances;
    for (int i = 0; i < 3000; ++i) instances += "{},";
    const SceneText shapes("[[object]]\nshape='teapot'\ntessellation=256\ninstance=[" + instances + "]\n");
    EXPECT_TRUE(has(refusal(shapes), "more than 4 billion polygons"));
    const SceneText files(
        "[[object]]\nfile='two.obj'\nsubdivide=8\ninstance=[" + instances + instances + instances + instances + "]\n" +
        "[[object]]\nfile='two.obj'\nsubdivide=8\ninstance=[" + instances + instances + instances + instances + "]\n" +
        "[[object]]\nfile='two.obj'\nsubdivide=8\ninstance=[" + instances + instances + instances + "]\n");
    files.folder().write("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
    EXPECT_TRUE(has(refusal(files), "more than 4 billion polygons"));
}

/// Objects and instances of one model have one list of its materials.
TEST(ModelBudgetOfScenes, MaterialListsAreShared) {
    const SceneText text(
        "[[material]]\nname='clay'\n[[object]]\nfile='parts.obj'\ninstance=[{},{},{}]\n[[object]]"
        "\nfile='parts.obj'\n"
        "[[object]]\nfile='parts.obj'\nmaterial='clay'\n");
    text.folder().write("parts.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\no a\nusemtl x\nf 1 2 3\no b\nusemtl y\nf 1 2 3\n");
    const Scene scene = text.load();
    ASSERT_EQ(scene.objects.size(), 10u);
    for (std::size_t i = 1; i < 8; ++i)
        EXPECT_EQ(scene.objects[i].materials.address(), scene.objects[0].materials.address());
    EXPECT_EQ(scene.objects[0].materials, (std::vector<std::uint32_t>{1, 2, 3}));
    EXPECT_EQ(scene.objects[8].materials, (std::vector<std::uint32_t>{0, 0, 0}));
    int count = 0;
    scene.objects[8].materials.for_each([&](std::uint32_t) { ++count; });
    EXPECT_EQ(count, 1);
}

TEST(ModelBudgetOfScenes, AFileIsReadOnceHoweverItIsSpelled) {
    const SceneText text(
        "[[object]]\nfile='two.obj'\n[[object]]\nfile='./two.obj'\n[[object]]\nfile='a/../"
        "two.obj'\n"
        "[[object]]\nfile='two.obj'\nscheme='loop'\n");
    text.folder().write("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    text.folder().write("a/x", "");
    const Scene scene = text.load();
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.objects.size(), 4u);
}

TEST(Transparency, IsThatOfMaterialsInUse) {
    const auto is_transparent = [](const std::string& material) {
        return has_transparent_surfaces(
            SceneText("[[material]]\nname='glass'\nopacity=0.5\n[[material]]\nname='clay'\n[["
                      "object]]\nshape='box'\n"
                      "[[object]]\nshape='box'\nmaterial='" +
                      material + "'\n")
                .load());
    };
    EXPECT_TRUE(is_transparent("glass"));
    EXPECT_FALSE(is_transparent("clay"));
}

}  // namespace
}  // namespace burin
