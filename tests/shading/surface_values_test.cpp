// Along lines, curvature and the values of files are those of the surface in front.

#include <gtest/gtest.h>

#include <cmath>

#include "shading/ink/found_needs.h"
#include "shading/sheet/sheet_attributes.h"
#include "tests/support/shaded_scene.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using namespace test;
using V = Variable;

std::string scene_with(const std::string& objects, const std::string& camera) {
    return "[camera]\n" + camera + "\n" + objects;
}

constexpr const char* kFromFront = "eye = [0, 0, 9]\ntarget = [0, 0, 0]\nprojection = \"orthographic\"\nheight = 3";

/// Of a ball of radius R px, N · V = e is (1 - sqrt(1 - e²)) R from the contour.
TEST(SurfaceValues, IsophoteOfABallIsAPartOfItsRadius) {
    for (const std::string contours : {"mesh", "smooth"}) {
        for (const std::string object : {"", "scale = [0.5, 0.5, 0.5]\nrotate = [20, 30, 40]\n"}) {
            const ShadedScene scene(
                scene_with("[[object]]\nshape = \"sphere\"\nradius = 1\nsegments = 128\nrings = 64\n" + object,
                           kFromFront),
                "contours = \"" + contours + "\"\n" + sheet_of(R"("silhouette")", "width = \"=isophote(0.3)\""), 600,
                600);
            const double radius_world = object.empty() ? 1 : 0.5, radius_px = radius_world * 200;
            const FoundLines lines = scene.found();
            const ColumnsOfLines columns(lines);
            std::size_t count = 0;
            columns.each([&](const LineSample& sample, const LineRun&, const LinePiece&) {
                ++count;
                EXPECT_NEAR(static_cast<double>(columns.at(V::kr, sample)) * radius_world, 1, 0.01);
            });
            EXPECT_GT(count, 100u);
            const InkedLines inked = scene.inked();
            EXPECT_GT(inked.points.size(), 100u);
            for (const InkPoint& point : inked.points)
                EXPECT_NEAR(static_cast<double>(point.width_px) / (0.0460608 * radius_px), 1, 0.01);
        }
    }
}

/// A cylinder bends around its axis only; a box does not bend.
TEST(SurfaceValues, CurvatureTowardsTheEye) {
    const std::string sheet = sheet_of(R"("silhouette", "crease", "polygon")", "width = \"=1 + 0 * kr\"");
    const ShadedScene scene(scene_with("[[object]]\nshape = \"cylinder\"\nradius = 0.5\nheight = 2\nsegments = 96\n"
                                       "[[object]]\nshape = \"box\"\nsize = [0.2, 0.2, 0.2]\ntranslate = [1, 0, 0]\n",
                                       kFromFront),
                            sheet);
    const FoundLines lines = scene.found();
    const ColumnsOfLines columns(lines);
    std::size_t walls = 0;
    columns.each([&](const LineSample& sample, const LineRun&, const LinePiece& piece) {
        const double kr = static_cast<double>(columns.at(V::kr, sample));
        const glm::dvec3 p = columns.triple(V::P, sample);
        const bool is_wall = p.x < 0.6 && std::abs(p.y) < 0.99 && std::abs(piece.from.x - piece.to.x) < 0.01;
        walls += is_wall ? 1 : 0;
        EXPECT_NEAR(kr, is_wall ? 2 : 0, p.x < 0.6 && !is_wall ? 2.1 : 0.03) << p.x << ' ' << p.y;
    });
    EXPECT_GT(walls, 50u);
}

/// A floor that runs away from the eye: its u is its x, its v its z, whatever the perspective does.
constexpr const char* kFloor =
    "v -1 0 2 1 0 0\nv 1 0 2 0 1 0\nv 1 0 -20 0 1 0\nv -1 0 -20 1 0 0\nvt -1 2\nvt 1 2\nvt 1 -20\nvt -1 -20\n"
    "f 1/1 2/2 3/3 4/4\n";
constexpr const char* kLow = "eye = [0.3, 0.4, 3.5]\ntarget = [0, 0, 0]\nfov = 50";

TEST(SurfaceValues, TextureCoordinatesFollowThePerspective) {
    const TemporaryFolder folder;
    const std::string model = folder.write("floor.obj", kFloor);
    for (const std::string camera : {kLow, kFromFront}) {
        const ShadedScene scene(scene_with("[[object]]\nfile = \"" + model + "\"\nrotate = [10, 0, 0]\n", camera),
                                sheet_of(R"("border")", "width = \"=1 + u + Cv.r + attr(\\\"none\\\")\""));
        const FoundLines lines = scene.found();
        const ColumnsOfLines columns(lines);
        std::size_t count = 0;
        columns.each([&](const LineSample& sample, const LineRun&, const LinePiece&) {
            ++count;
            const glm::dvec3 p = columns.triple(V::PO, sample);
            EXPECT_NEAR(static_cast<double>(columns.at(V::u, sample)), p.x, 0.05);
            EXPECT_NEAR(static_cast<double>(columns.at(V::v, sample)), p.z, 0.1);
            EXPECT_NEAR(static_cast<double>(columns.at(V::Cv, sample, 0)), 0.5 - 0.5 * p.x, 0.03);
            EXPECT_EQ(columns.at(V::Cv, sample, 2), 0);
        });
        EXPECT_GT(count, 8u);
    }
}

/// At a seam, the front polygon's own coordinates count.
TEST(SurfaceValues, AtASeamTheFrontPolygonCounts) {
    const TemporaryFolder folder;
    const std::string model = folder.write("roof.obj",
                                           "v 0 1 1\nv 0 1 -1\nv -2 0 -1\nv -2 0 1\nv 0.5 0 -1\nv 0.5 0 1\nvt 10 0\nvt "
                                           "20 0\nf 1/1 2/1 3/1 4/1\nf 1/2 6/2 5/2 2/2\n");
    const ShadedScene scene(
        scene_with("[[object]]\nfile = \"" + model + "\"\n",
                   "eye = [0, 9, 0.1]\ntarget = [0, 0, 0]\nprojection = \"orthographic\"\nheight = 5"),
        sheet_of(R"("crease")", "width = \"=1 + u\""));
    const FoundLines lines = scene.found();
    const ColumnsOfLines columns(lines);
    std::size_t count = 0;
    columns.each([&](const LineSample& sample, const LineRun&, const LinePiece&) {
        ++count;
        EXPECT_EQ(columns.at(V::u, sample), 10) << "the flatter side turns to the eye more";
    });
    EXPECT_GT(count, 2u);
}

TEST(SurfaceValues, WhatIsMissingIsNotedOnceWithItsObjects) {
    const TemporaryFolder folder;
    folder.write("floor.obj", kFloor);
    const std::string ply =
        folder.write("a.ply",
                     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                     "property float z\nproperty float heat\nelement face 1\n"
                     "property list uchar int vertex_indices\nend_header\n0 0 0 5\n1 0 0 6\n0 1 0 7\n"
                     "3 0 1 2\n");
    const std::string objects =
        "[[object]]\nname = \"ball\"\nshape = \"sphere\"\n[[object]]\nname = \"part\"\nfile = \"" + ply +
        "\"\n[[object]]\nname = \"floor\"\nfile = \"" + folder.file("floor.obj") + "\"\n";
    const auto notes = [&](const std::string& value) {
        return ShadedScene(scene_with(objects, kLow), sheet_of(R"("silhouette")", "width = \"=" + value + "\""))
            .scene()
            .notes;
    };
    EXPECT_TRUE(notes("1 + kr").empty());
    EXPECT_EQ(notes("u + v"),
              std::vector<std::string>{"the style sheet reads texture coordinates (u, v), which 'ball', "
                                       "'part/a' have not: 0 there"});
    EXPECT_EQ(notes("attr(\\\"heet\\\")"),
              std::vector<std::string>{"the style sheet reads the vertex attribute 'heet', which 'ball', 'part/a', "
                                       "'floor/floor' have not: 0 there; the models have 'heat'"});
    EXPECT_EQ(notes("attr(\\\"heat\\\") + Cv.r").size(), 2u);
}

TEST(SurfaceValues, OnlyWhatTheSheetReadsIsKnown) {
    const auto found = [](const std::string& value) {
        return ShadedScene(scene_with("[[object]]\nshape = \"sphere\"\n", kFromFront),
                           sheet_of(R"("silhouette")", "width = \"=" + value + "\""))
            .found();
    };
    EXPECT_TRUE(found("1 + facing").surface_values.empty());
    const FoundLines lines = found("1 + kr");
    EXPECT_EQ(lines.surface.column_count(), 1u);
    const ShadedScene other(scene_with("[[object]]\nshape = \"sphere\"\n", kFromFront),
                            sheet_of(R"("silhouette")", "width = \"=kr + u + Cv.g + attr(\\\"a\\\")\""));
    const Frame frame = other.frame(other.whole());
    EXPECT_EQ(missing_for(*frame.scene->sheet, frame.sheet->needs(), lines),
              "texture coordinates (u, v), colours of vertices (Cv), the attribute 'a'");
    EXPECT_EQ(missing_for(*frame.scene->sheet, frame.sheet->needs(), other.found()), "");
}

TEST(SheetAttributes, AreFoundInTexts) {
    const auto wish = [](const std::string& text) {
        AttributeWish found;
        add_attributes_named_in(text, found);
        return found;
    };
    EXPECT_TRUE(wish("kr + t * noise(s) + C.r + N.x").empty());
    EXPECT_TRUE(wish("u").uv);
    EXPECT_TRUE(wish("2*v > 1 ? 0 : 1").uv);
    EXPECT_TRUE(wish("object == \"u\" ? Cv.r : 0").color);
    EXPECT_FALSE(wish("object == \"u\" ? Cv.r : 0").uv);
    EXPECT_EQ(wish("attr(\"a\") + attr( \"b c\") + attr(\"a\")").named, (std::vector<std::string>{"a", "b c"}));
    EXPECT_TRUE(wish("u + $").uv) << "what is wrong is told later";
}

}  // namespace
}  // namespace burin
