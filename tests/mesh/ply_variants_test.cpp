// PLY as programs in use write it: more values than declared, other types and spellings.

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>

#include "mesh/readers.h"
#include "tests/mesh/model_files.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin::ply_variants_test {
namespace {

using test::ByteWriter;
using test::Polygons;
using test::polygons_of;
using test::Random;

std::string header(int vertices, int faces, const std::string& more = "") {
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(faces) +
           "\nproperty list uchar int vertex_indices\n" + more + "end_header\n";
}

class PlyVariants : public testing::Test {
  protected:
    PolygonSoup read(std::string_view text, int threads = 1) {
        return read_ply(folder_.write("part.ply", text), threads);
    }
    testing::AssertionResult refuses(std::string_view text, std::initializer_list<std::string_view> parts,
                                     bool strict = false) {
        return test::refuses([strict](const std::string& path) { return read_ply(path, 1, strict); },
                             folder_.write("part.ply", text), parts);
    }
    test::TemporaryFolder folder_;
};

const std::string kPositions = "0 0 0\n1 0 0\n1 1 0\n0 1.5 0\n";

TEST_F(PlyVariants, FacesHaveMaterialsByTheirNumbers) {
    const std::string faces = "3 0 1 2 7\n3 0 2 3 2000000000\n4 0 1 2 3 7\n3 0 1 3 0\n";
    const PolygonSoup soup = read(header(4, 4, "property int material_index\n") + kPositions + faces);
    EXPECT_EQ(soup.polygon_material, (std::vector<std::uint32_t>{1, 2, 1, 0}));
    ASSERT_EQ(soup.materials.size(), 3u);
    EXPECT_EQ(soup.materials[0].name, "material_0");
    EXPECT_EQ(soup.materials[1].name, "material_7");
    EXPECT_EQ(soup.materials[2].name, "material_2000000000");
    EXPECT_TRUE(soup.notes.empty());

    const PolygonSoup one = read(header(4, 1, "property uchar material_index\n") + kPositions + "3 0 1 2 5\n");
    EXPECT_TRUE(one.polygon_material.empty());
    ASSERT_EQ(one.materials.size(), 1u);
    EXPECT_EQ(one.materials[0].name, "material_5");
    EXPECT_EQ(read(header(4, 1) + kPositions + "3 0 1 2\n").materials.size(), 1u);

    // Strips have none, before faces and behind them.
    const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\n";
    const std::string list = "element face 1\nproperty list uchar int vertex_indices\nproperty int material_index\n";
    const std::string vertices =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\n";
    const PolygonSoup behind = read(vertices + list + strips + "end_header\n" + kPositions + "3 0 1 2 4\n4 0 1 2 3\n");
    EXPECT_EQ(behind.polygon_material, (std::vector<std::uint32_t>{0, 1, 1}));
    const PolygonSoup before = read(vertices + strips + list + "end_header\n" + kPositions + "4 0 1 2 3\n3 0 1 2 4\n");
    EXPECT_EQ(before.polygon_material, (std::vector<std::uint32_t>{1, 1, 0}));
    EXPECT_EQ(before.materials[1].name, "");

    for (const char* const bad : {"-1", "0.5", "3000000000"}) {
        EXPECT_TRUE(refuses(header(4, 1, "property float material_index\n") + kPositions + "3 0 1 2 " + bad + "\n",
                            {":15: material_index must be a whole number"}))
            << bad;
    }
    ByteWriter body;
    body.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0});
    for (const std::uint16_t index : {std::uint16_t{3}, std::uint16_t{1}})
        body.add<std::uint16_t>({index}).add<std::uint8_t>({3}).add<std::int32_t>({0, 1, 2});
    const PolygonSoup binary = read(
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 2\nproperty ushort material_index\n"
        "property list uchar int vertex_index\nend_header\n" +
        body.bytes());
    EXPECT_EQ(binary.polygon_material, (std::vector<std::uint32_t>{1, 0}));
}

TEST_F(PlyVariants, WhatFollowsTheDeclaredValuesOfALineIsNothing) {
    const Polygons expected{{0, 1, 2}, {0, 1, 2, 3}, {3, 2, 1}};
    for (const std::string& faces :
         {std::string("3 0 1 2 9 1 1 1 1 1 1 1 1 1\n4 0 1 2 3 9 1 1 1 1 1 1 1 1 1\n3 3 2 1 9 1 1 1 "
                      "1 1 1 1 1 1\n"),
          std::string("3 0 1 2 0\n4 0 1 2 3 0\n3 3 2 1 0\n"),      // empty polygons, if taken for some
          std::string("3 0 1 2 3 0 1 2\n4 0 1 2 3 0\n3 3 2 1 0"),  // no line feed at the end
          std::string("3 0 1 2 # a comment\n4 0 1 2 3\n3 3 2 1\n"),
          std::string("3 0 1 2\n4 0\n1 2\n3 0.5 x\n\n3 3 2 1 \t\n"),  // values that go on behind a
                                                                      // line feed
          std::string("3 0 1 2\r\n4 0 1 2 3 7 7\r\n3 3 2 1\r\n")}) {
        const PolygonSoup soup = read(header(4, 3) + kPositions + faces);
        EXPECT_EQ(polygons_of(soup), expected) << faces;
        ASSERT_EQ(soup.notes.size(), 1u) << faces;
        EXPECT_NE(soup.notes[0].find(" more values than the header declares"), std::string::npos) << soup.notes[0];
        EXPECT_TRUE(
            refuses(header(4, 3) + kPositions + faces, {"the line has more values than the header declares"}, true))
            << faces;
    }
    const std::string two = header(4, 3) + kPositions + "3 0 1 2\n4 0 1 2 3 5\n3 3 2 1 6\n";
    EXPECT_EQ(read(two).notes[0],
              "2 lines, the first one is line 15, have more values than the header declares; the "
              "rest of the line is left out");
    EXPECT_TRUE(refuses(two, {":15: the line has more values"}, true));
}

TEST_F(PlyVariants, VerticesMayHaveMoreValuesToo) {
    // In the usual form but for that, and enough of them to be read in blocks and in pieces.
    for (const int count : {4, 3000, 9000}) {
        std::string positions, surplus, faces;
        for (int i = 0; i < count; ++i) {
            const std::string row = std::to_string(i) + ".5 0.25 " + std::to_string(i % 5) + ".0";
            positions += row + "\n";
            surplus += row + (i % 3 == 0 ? " 255 0 128\n" : " 17 3 4 5\n");
            faces += "3 0 " + std::to_string(i) + " 1\n";
        }
        for (const int threads : {1, 3}) {
            const PolygonSoup expected = read(header(count, count) + positions + faces, threads);
            const PolygonSoup soup = read(header(count, count) + surplus + faces, threads);
            EXPECT_TRUE(expected.notes.empty());
            ASSERT_EQ(soup.positions, expected.positions) << count;
            ASSERT_EQ(soup.corners, expected.corners) << count;
            ASSERT_EQ(soup.notes.size(), 1u);
            EXPECT_EQ(soup.notes[0].find(std::to_string(count) + " lines, the first one is line 10,"), 0u)
                << soup.notes[0];
        }
    }
}

TEST_F(PlyVariants, OtherElementsMayHaveMoreValuesToo) {
    const std::string text =
        "ply\nformat ascii 1.0\nelement material 2\nproperty int a\nelement vertex 4\nproperty "
        "float x\nproperty float y\nproperty float z\n"
        "element tristrips 1\nproperty list int int vertex_indices\nelement edge 1\nproperty int "
        "vertex1\nproperty int vertex2\nend_header\n"
        "5 6\n7\n" +
        kPositions + "4 0 1 2 3 9 9\n0 1 9 9\n";
    const PolygonSoup soup = read(text);
    EXPECT_EQ(polygons_of(soup), (Polygons{{0, 1, 2}, {2, 1, 3}}));
    EXPECT_EQ(soup.marked_edges, (std::vector<std::array<std::uint32_t, 2>>{{0, 1}}));
    EXPECT_EQ(soup.notes.size(), 1u);
}

/// Without more values than declared, all may stand on one line, or each on one of its own.
TEST_F(PlyVariants, ValuesMayStandOnAnyLines) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        const int vertices = random.integer(3, 20), faces = random.integer(1, 20);
        std::string lines = header(vertices, faces), any = lines;
        const auto add = [&](const std::string& value, bool ends_line) {
            lines += value + (ends_line ? "\n" : " ");
            any += value + (random.integer(0, static_cast<int>(seed % 7)) == 0 ? "\n" : " ");
        };
        for (int i = 0; i < vertices; ++i) {
            for (int k = 0; k < 3; ++k) add(std::to_string(random.real(-9.0, 9.0)), k == 2);
        }
        for (int i = 0; i < faces; ++i) {
            const int corners = random.integer(3, 5);
            add(std::to_string(corners), false);
            for (int k = 0; k < corners; ++k) add(std::to_string(random.integer(0, vertices - 1)), k == corners - 1);
        }
        const PolygonSoup expected = read(lines), soup = read(any);
        ASSERT_EQ(soup.positions, expected.positions) << "seed " << seed;
        ASSERT_EQ(polygons_of(soup), polygons_of(expected)) << "seed " << seed;
        ASSERT_TRUE(soup.notes.empty()) << "seed " << seed;
    }
}

TEST_F(PlyVariants, AnErrorIsToldWhereItIs) {
    const std::string surplus = "3 0 1 2 5 5\n";
    EXPECT_TRUE(refuses(header(4, 3) + kPositions + surplus + surplus + "3 0 1 x 5\n",
                        {":16: a value of element 'face' is no number of its type"}));
    EXPECT_TRUE(
        refuses(header(4, 3) + kPositions + surplus + surplus + "3 0 1 4 5\n", {":16: vertex 4 does not exist"}));
    EXPECT_TRUE(
        refuses(header(4, 3) + kPositions + surplus + surplus, {"the file ends in the middle of element 'face'"}));
    EXPECT_TRUE(refuses(header(4, 3) + kPositions + "3 0 1 2\n3 0 x 2\n3 0 1 2\n",
                        {":15: a value of element 'face' is no number of its type"}));
    EXPECT_TRUE(refuses(header(4, 1) + "0 0 0 1 0 0 1 1 0 0 y 0 3 0 1 2\n",
                        {":10: a value of element 'vertex' is no number of its type"}));
}

template <typename T>
std::string bytes_of(bool big_endian, std::initializer_list<T> values) {
    return ByteWriter(big_endian).add(values).bytes();
}

TEST_F(PlyVariants, IntegersMayHave64Bits) {
    for (const std::string name : {"int64", "uint64", "longlong", "ulonglong", "int64_t", "uint64_t", "INT64"}) {
        const std::string body = "element vertex 3\nproperty " + name + " x\nproperty " + name + " y\nproperty " +
                                 name + " z\nelement face 1\nproperty list " + name + " " + name +
                                 " vertex_indices\nend_header\n";
        const PolygonSoup ascii = read("ply\nformat ascii 1.0\n" + body + "0 0 0\n5000000000 0 0\n0 1 0\n3 2 1 0\n");
        EXPECT_EQ(ascii.positions[1], glm::dvec3(5e9, 0, 0)) << name;
        for (const bool big_endian : {false, true}) {
            const std::string start =
                std::string("ply\nformat binary_") + (big_endian ? "big" : "little") + "_endian 1.0\n" + body;
            const std::string positions = bytes_of<std::int64_t>(big_endian, {0, 0, 0, 5000000000, 0, 0, 0, 1, 0});
            const PolygonSoup soup = read(start + positions + bytes_of<std::int64_t>(big_endian, {3, 2, 1, 0}));
            EXPECT_EQ(soup.positions, ascii.positions) << name;
            EXPECT_EQ(polygons_of(soup), (Polygons{{2, 1, 0}})) << name;
            for (const std::int64_t bad : {std::int64_t{3}, std::int64_t{-1}, std::int64_t{1} << 32,
                                           std::numeric_limits<std::int64_t>::min(), (std::int64_t{1} << 53) + 1}) {
                EXPECT_TRUE(refuses(start + positions + bytes_of<std::int64_t>(big_endian, {3, 2, 1, bad}),
                                    {"vertex ", " does not exist"}))
                    << name << bad;
                EXPECT_TRUE(
                    refuses(start + positions + bytes_of<std::int64_t>(big_endian, {bad == 3 ? 4 : bad, 2, 1, 0}), {}))
                    << name << bad;
            }
        }
    }
}

TEST_F(PlyVariants, LongIsClearInTextOnly) {
    const std::string body =
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face "
        "1\nproperty list uchar long vertex_indices\nend_header\n";
    EXPECT_EQ(polygons_of(read("ply\nformat ascii 1.0\n" + body + "0 0 0\n1 0 0\n0 1 0\n3 2 1 0\n")),
              (Polygons{{2, 1, 0}}));
    EXPECT_TRUE(refuses("ply\nformat binary_little_endian 1.0\n" + body,
                        {":8: the type 'long' has 4 bytes on some machines and 8 on others"}));
}

TEST_F(PlyVariants, TheHeaderMayBeInCapitals) {
    const std::string text =
        "PLY\nFORMAT ASCII 1.0\nCOMMENT x\nELEMENT VERTEX 3\nPROPERTY FLOAT X\nPROPERTY Float32 "
        "Y\nPROPERTY DOUBLE Z\nELEMENT FACE 1\n"
        "PROPERTY LIST UCHAR INT VERTEX_INDICES\nEND_HEADER\n0 0 0\n1 0 0\n0 1 2\n3 2 1 0\n";
    const PolygonSoup soup = read(text);
    EXPECT_EQ(soup.positions[2], glm::dvec3(0, 1, 2));
    EXPECT_EQ(polygons_of(soup), (Polygons{{2, 1, 0}}));
    // Where both are there, the small letters count.
    EXPECT_EQ(read("ply\nformat ascii 1.0\nelement vertex 3\nproperty float X\nproperty float "
                   "x\nproperty float y\nproperty float z\nelement face 1\n"
                   "property list uchar int vertex_indices\nend_header\n9 0 0 0\n9 1 0 0\n9 0 1 "
                   "0\n3 0 1 2\n")
                  .positions[1],
              glm::dvec3(1, 0, 0));
}

}  // namespace
}  // namespace burin::ply_variants_test
