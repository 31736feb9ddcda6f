#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "mesh/readers.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::ByteWriter;
using test::Polygons;
using test::polygons_of;
using Edges = std::vector<std::array<std::uint32_t, 2>>;

const std::string kAscii = "ply\nformat ascii 1.0\n";
const std::string kVertices4 = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kPositions4 = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
const std::string kList = "property list uchar int vertex_indices\n";
const std::string kEnd = "end_header\n";

std::string binary_header(bool big_endian) {
    return std::string("ply\nformat binary_") + (big_endian ? "big" : "little") + "_endian 1.0\n";
}

class ReadPly : public testing::Test {
  protected:
    PolygonSoup read(std::string_view text) { return read_ply(folder_.write("part.ply", text)); }
    testing::AssertionResult refuses(std::string_view text, std::initializer_list<std::string_view> parts) {
        return test::refuses([](const std::string& path) { return read_ply(path); }, folder_.write("part.ply", text),
                             parts);
    }
    test::TemporaryFolder folder_;
};

TEST_F(ReadPly, ReadsAsciiPolygonsOfAnySize) {
    const PolygonSoup soup = read(kAscii + "comment made by hand\nobj_info x\n" + kVertices4 + "element face 3\n" +
                                  kList + kEnd + kPositions4 + "3 0 1 2\n4 0 1 2 3\n2 0 1");
    EXPECT_EQ(polygons_of(soup), (Polygons{{0, 1, 2}, {0, 1, 2, 3}, {0, 1}}));
    EXPECT_EQ(soup.positions[2], glm::dvec3(1, 1, 0));
    EXPECT_EQ(soup.object_names, std::vector<std::string>{"part"});
    EXPECT_EQ(soup.materials.size(), 1u);
    EXPECT_TRUE(read(kAscii + kVertices4 + "element face 2\n" + kList + kEnd + kPositions4 + "3 0 1 2\n3 0 2 3\n")
                    .polygon_ends.empty())
        << "triangles alone need no list of ends";
}

TEST_F(ReadPly, ReadsBothBinaryByteOrders) {
    for (const bool big_endian : {false, true}) {
        ByteWriter body(big_endian);
        body.add<float>({0, 0, 0, 1.5f, 0, 0, 1, -1, 0, 0, 1, 1e-3f});
        body.add<std::uint8_t>({3}).add<std::int32_t>({0, 1, 2});
        body.add<std::uint8_t>({4}).add<std::int32_t>({0, 1, 2, 3});
        const PolygonSoup soup =
            read(binary_header(big_endian) + kVertices4 + "element face 2\n" + kList + kEnd + body.bytes());
        EXPECT_EQ(polygons_of(soup), (Polygons{{0, 1, 2}, {0, 1, 2, 3}})) << big_endian;
        EXPECT_EQ(soup.positions[1], glm::dvec3(1.5, 0, 0));
        EXPECT_EQ(soup.positions[2], glm::dvec3(1, -1, 0));
        EXPECT_EQ(soup.positions[3].z, static_cast<double>(1e-3f));
    }
}

/// Adds `value` as the named type, so that one test can go through all of them.
void add_as(ByteWriter& body, const std::string& type, double value) {
    if (type == "char" || type == "int8") body.add({static_cast<std::int8_t>(value)});
    if (type == "uchar" || type == "uint8") body.add({static_cast<std::uint8_t>(value)});
    if (type == "short" || type == "int16") body.add({static_cast<std::int16_t>(value)});
    if (type == "ushort" || type == "uint16") body.add({static_cast<std::uint16_t>(value)});
    if (type == "int" || type == "int32") body.add({static_cast<std::int32_t>(value)});
    if (type == "uint" || type == "uint32") body.add({static_cast<std::uint32_t>(value)});
    if (type == "float" || type == "float32") body.add({static_cast<float>(value)});
    if (type == "double" || type == "float64") body.add({value});
}

TEST_F(ReadPly, EveryTypeMayHoldCoordinatesAndIndices) {
    for (const std::string type : {"char", "int8", "uchar", "uint8", "short", "int16", "ushort", "uint16", "int",
                                   "int32", "uint", "uint32", "float", "float32", "double", "float64"}) {
        const bool is_real = type[0] == 'f' || type[0] == 'd';
        const std::string count_type = is_real ? "uchar" : type;
        const std::string header = "element vertex 3\nproperty " + type + " x\nproperty " + type + " y\nproperty " +
                                   type + " z\nelement face 1\nproperty list " + count_type + " " + type +
                                   " vertex_indices\n" + kEnd;
        for (const bool big_endian : {false, true}) {
            ByteWriter body(big_endian);
            for (const double v : {0, 0, 0, 100, 0, 0, 0, 101, 7}) add_as(body, type, v);
            add_as(body, count_type, 3);
            for (const double v : {2, 1, 0}) add_as(body, type, v);
            const PolygonSoup soup = read(binary_header(big_endian) + header + body.bytes());
            EXPECT_EQ(soup.positions[2], glm::dvec3(0, 101, 7)) << type;
            EXPECT_EQ(polygons_of(soup), (Polygons{{2, 1, 0}})) << type;
        }
        const PolygonSoup ascii = read(kAscii + header + "0 0 0\n100 0 0\n0 101 7\n3 2 1 0\n");
        EXPECT_EQ(ascii.positions[2], glm::dvec3(0, 101, 7)) << type;
        EXPECT_EQ(polygons_of(ascii), (Polygons{{2, 1, 0}})) << type;
    }
}

TEST_F(ReadPly, NegativeAndLargeValuesKeepTheirSign) {
    ByteWriter body;
    body.add<std::int8_t>({-100}).add<std::int16_t>({-30000}).add<std::int32_t>({-2000000000});
    body.add<std::uint8_t>({3}).add<std::int32_t>({0, 0, 0});
    const PolygonSoup soup = read(binary_header(false) +
                                  "element vertex 1\nproperty char x\nproperty short y\nproperty int z\n"
                                  "element face 1\n" +
                                  kList + kEnd + body.bytes());
    EXPECT_EQ(soup.positions[0], glm::dvec3(-100, -30000, -2000000000));
    ByteWriter unsigned_body;
    unsigned_body.add<std::uint8_t>({200}).add<std::uint16_t>({60000}).add<std::uint32_t>({4000000000u});
    unsigned_body.add<std::uint8_t>({3}).add<std::int32_t>({0, 0, 0});
    const PolygonSoup large = read(binary_header(false) +
                                   "element vertex 1\nproperty uchar x\nproperty ushort y\nproperty uint z\n"
                                   "element face 1\n" +
                                   kList + kEnd + unsigned_body.bytes());
    EXPECT_EQ(large.positions[0], glm::dvec3(200, 60000, 4000000000.0));
}

TEST_F(ReadPly, DoubleCoordinatesKeepAllTheirDigits) {
    const std::string header =
        "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
        "element face 1\n" +
        kList + kEnd;
    ByteWriter body;
    body.add<double>({5000000.001, 0, 0, 1, 0, 0, 0, 1, 0});
    body.add<std::uint8_t>({3}).add<std::int32_t>({0, 1, 2});
    EXPECT_EQ(read(binary_header(false) + header + body.bytes()).positions[0].x, 5000000.001);
    EXPECT_EQ(read(kAscii + header + "5000000.001 0 0 1 0 0 0 1 0 3 0 1 2").positions[0].x, 5000000.001);
}

TEST_F(ReadPly, OtherPropertiesAndElementsAreSkipped) {
    const std::string header =
        "element material 2\nproperty uchar red\nproperty list ushort double weights\n"
        "element vertex 3\nproperty list uchar short ids\nproperty double time\nproperty float z\n"
        "property uchar red\nproperty float x\nproperty float y\nproperty int last\n"
        "element face 2\nproperty uchar flags\nproperty list uchar float texcoord\n" +
        kList + "property list uchar uchar rest\nelement tail 1\nproperty int n\n" + kEnd;
    const Polygons expected{{0, 1, 2}, {2, 1, 0}};
    const std::string text =
        "255 2 0.5 0.25\n0 0\n"
        "1 7 0.1 30 255 10 20 -1\n0 0.2 31 0 11 21 -2\n2 8 9 0.3 32 1 12 22 -3\n"
        "1 6 0 0 1 0 0 1 3 0 1 2 0\n0 0 3 2 1 0 2 5 5\n42\n";
    const PolygonSoup ascii = read(kAscii + header + text);
    EXPECT_EQ(ascii.positions[1], glm::dvec3(11, 21, 31));
    EXPECT_EQ(polygons_of(ascii), expected);
    for (const bool big_endian : {false, true}) {
        ByteWriter b(big_endian);
        b.add<std::uint8_t>({255}).add<std::uint16_t>({2}).add<double>({0.5, 0.25});
        b.add<std::uint8_t>({0}).add<std::uint16_t>({0});
        const auto vertex = [&](std::initializer_list<std::int16_t> ids, float x, float y, float z) {
            b.add<std::uint8_t>({static_cast<std::uint8_t>(ids.size())}).add(ids).add<double>({0.1});
            b.add<float>({z}).add<std::uint8_t>({9}).add<float>({x, y}).add<std::int32_t>({-1});
        };
        vertex({7}, 10, 20, 30);
        vertex({}, 11, 21, 31);
        vertex({8, 9}, 12, 22, 32);
        b.add<std::uint8_t>({1, 6}).add<float>({0, 0, 1, 0, 0, 1});
        b.add<std::uint8_t>({3}).add<std::int32_t>({0, 1, 2}).add<std::uint8_t>({0});
        b.add<std::uint8_t>({0, 0, 3}).add<std::int32_t>({2, 1, 0}).add<std::uint8_t>({2, 5, 5});
        b.add<std::int32_t>({42});
        const PolygonSoup binary = read(binary_header(big_endian) + header + b.bytes());
        EXPECT_EQ(binary.positions, ascii.positions) << big_endian;
        EXPECT_EQ(polygons_of(binary), expected) << big_endian;
    }
}

TEST_F(ReadPly, FacesMayStandBeforeTheVertices) {
    const PolygonSoup soup =
        read(kAscii + "element face 1\n" + kList + kVertices4 + kEnd + "4 3 2 1 0\n" + kPositions4);
    EXPECT_EQ(polygons_of(soup), (Polygons{{3, 2, 1, 0}}));
}

TEST_F(ReadPly, TheListMayBeCalledVertexIndex) {
    EXPECT_EQ(polygons_of(read(kAscii + kVertices4 + "element face 1\nproperty list uchar uint vertex_index\n" + kEnd +
                               kPositions4 + "3 0 1 2")),
              (Polygons{{0, 1, 2}}));
}

TEST_F(ReadPly, StripsAreCutIntoTrianglesOfOneWinding) {
    const std::string header =
        "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
        "element tristrips 2\nproperty list int int vertex_indices\n" +
        kEnd;
    const std::string positions = "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n";
    // A restart begins anew: the first triangle behind it is not turned.
    const PolygonSoup soup = read(kAscii + header + positions + "9 0 1 2 3 4 -1 4 3 2\n5 -1 0 1 -1 2\n");
    EXPECT_EQ(polygons_of(soup), (Polygons{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 2}}));
    for (std::size_t i = 0; i < 3; ++i) {
        const auto t = soup.polygon(i);
        const glm::dvec3 normal =
            glm::cross(soup.positions[t[1]] - soup.positions[t[0]], soup.positions[t[2]] - soup.positions[t[0]]);
        EXPECT_LT(normal.z, 0) << i;
    }
}

TEST_F(ReadPly, StripsMayFollowPolygons) {
    const std::string header = kVertices4 + "element face 1\n" + kList +
                               "element tristrips 1\nproperty list int int vertex_indices\n" + kEnd + kPositions4;
    EXPECT_EQ(polygons_of(read(kAscii + header + "4 0 1 2 3\n4 0 1 2 3\n")),
              (Polygons{{0, 1, 2, 3}, {0, 1, 2}, {2, 1, 3}}));
    EXPECT_EQ(polygons_of(read(kAscii + header + "3 0 1 2\n4 0 1 2 3\n")), (Polygons{{0, 1, 2}, {0, 1, 2}, {2, 1, 3}}));
}

TEST_F(ReadPly, TrianglesFirstAndOtherPolygonsLater) {
    const std::string two_elements = kVertices4 + "element face 2\n" + kList + "element face 2\n" + kList + kEnd;
    EXPECT_EQ(polygons_of(read(kAscii + two_elements + kPositions4 + "3 0 1 2\n3 1 2 3\n3 0 2 3\n4 0 1 2 3\n")),
              (Polygons{{0, 1, 2}, {1, 2, 3}, {0, 2, 3}, {0, 1, 2, 3}}));
    const std::string one_element = kVertices4 + "element face 5\n" + kList + kEnd + kPositions4;
    EXPECT_EQ(polygons_of(read(kAscii + one_element + "3 0 1 2\n3 1 2 3\n4 0 1 2 3\n0\n3 0 2 3\n")),
              (Polygons{{0, 1, 2}, {1, 2, 3}, {0, 1, 2, 3}, {}, {0, 2, 3}}));
}

TEST_F(ReadPly, EdgesAreMarks) {
    const std::string header = kVertices4 + "element face 1\n" + kList +
                               "element edge 2\nproperty uchar red\nproperty int vertex1\nproperty int vertex2\n" +
                               kEnd;
    EXPECT_EQ(read(kAscii + header + kPositions4 + "3 0 1 2\n255 0 1\n255 2 3\n").marked_edges,
              (Edges{{0, 1}, {2, 3}}));
    EXPECT_TRUE(
        refuses(kAscii + header + kPositions4 + "3 0 1 2\n255 0 1\n255 2 4\n", {":20: vertex 4 does not exist"}));
    EXPECT_TRUE(
        refuses(kAscii + header + kPositions4 + "3 0 1 2\n255 0 1\n255 -1 0\n", {":20: vertex -1 does not exist"}));
}

TEST_F(ReadPly, HeadersMayHaveCrLf) {
    const std::string header =
        "ply\r\nformat binary_little_endian 1.0\r\nelement vertex 3\r\nproperty float x\r\n"
        "property float y\r\nproperty float z\r\nelement face 1\r\n"
        "property list uchar int vertex_indices\r\nend_header\r\n";
    ByteWriter body;
    body.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}).add<std::uint8_t>({3}).add<std::int32_t>({0, 1, 2});
    EXPECT_EQ(polygons_of(read(header + body.bytes())), (Polygons{{0, 1, 2}}));
    EXPECT_EQ(polygons_of(read("ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\nproperty float y\r\n"
                               "property float z\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\n"
                               "end_header\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n")),
              (Polygons{{0, 1, 2}}));
}

TEST_F(ReadPly, CountsThatTheFileHasNoRoomForAreRefused) {
    const std::string vertex = "property float x\nproperty float y\nproperty float z\n";
    for (const char* count : {"4000000000", "400000000", "9223372036854775807"}) {
        for (const std::string& start : {kAscii, binary_header(false), binary_header(true)}) {
            EXPECT_TRUE(refuses(start + "element vertex " + count + "\n" + vertex + "element face 1\n" + kList + kEnd +
                                    std::string(100, '0'),
                                {"the header promises ", count, "'vertex'"}));
            EXPECT_TRUE(
                refuses(start + "element face " + count + "\n" + kList + kVertices4 + kEnd + std::string(100, '0'),
                        {"the header promises ", count, "'face'"}));
            EXPECT_TRUE(refuses(
                start + "element other " + count + "\nproperty int a\n" + kVertices4 + kEnd + std::string(100, '0'),
                {"the header promises ", count, "'other'"}));
        }
    }
    EXPECT_TRUE(
        refuses(kAscii + "element other 4000000000\n" + kVertices4 + kEnd, {"'other' has a count but no properties"}));
    for (const char* count : {"-1", "x", "", "99999999999999999999", "1.5"}) {
        EXPECT_TRUE(refuses(kAscii + "element vertex " + count + "\n" + vertex + kEnd,
                            {":3: an element needs a name and a count"}));
    }
}

TEST_F(ReadPly, BrokenHeadersAreRefused) {
    const std::string face = "element face 1\n" + kList;
    EXPECT_TRUE(refuses("plx\n", {":1: this is no PLY file"}));
    EXPECT_TRUE(refuses("ply", {":1: the header has no 'end_header'"}));
    EXPECT_TRUE(refuses(kAscii + kVertices4 + face, {"the header has no 'end_header'"}));
    EXPECT_TRUE(refuses("ply\n" + std::string(20000, '\n') + kEnd, {"the header has no 'end_header'"}));
    EXPECT_TRUE(
        refuses("ply\nformat binary_middle_endian 1.0\n" + kVertices4, {":2: unknown format 'binary_middle_endian'"}));
    EXPECT_TRUE(refuses("ply\n" + kVertices4 + face + kEnd + kPositions4 + "3 0 1 2\n", {"no 'format' line"}));
    EXPECT_TRUE(refuses(kAscii + "property float x\n", {":3: a property stands before any element"}));
    EXPECT_TRUE(refuses(kAscii + "element vertex 3\nproperty half x\n", {":4: unknown property type 'half'"}));
    EXPECT_TRUE(refuses(kAscii + "element vertex 3\nproperty float\n", {":4: a property needs a name"}));
    EXPECT_TRUE(refuses(kAscii + "element face 3\nproperty list float int vertex_indices\n",
                        {":4: 'float' cannot count a list"}));
    EXPECT_TRUE(
        refuses(kAscii + "element vertex 1\nproperty float x\nproperty float z\n" + face + kEnd + "0 0\n3 0 0 0\n",
                {"element 'vertex' has no property 'y'"}));
    EXPECT_TRUE(refuses(kAscii + "element vertex 1\nproperty list int float x\nproperty float y\nproperty float z\n" +
                            face + kEnd + "1 0 0 0\n3 0 0 0\n",
                        {"element 'vertex' has no property 'x'"}));
    EXPECT_TRUE(
        refuses(kAscii + kVertices4 + "element face 1\nproperty int vertex_indices\n" + kEnd + kPositions4 + "1\n",
                {"element 'face' has no list 'vertex_indices'"}));
    EXPECT_TRUE(refuses(kAscii + kVertices4 + "element tristrips 1\nproperty int a\n" + kEnd + kPositions4 + "1\n",
                        {"element 'tristrips' has no list"}));
    EXPECT_TRUE(refuses(kAscii + kVertices4 + kEnd + kPositions4, {"no polygons"}));
    EXPECT_TRUE(refuses(kAscii + face + kEnd + "3 0 1 2", {"no vertices"}));
}

TEST_F(ReadPly, BodiesThatBreakOffAreRefused) {
    const std::string elements = kVertices4 + "element face 2\n" + kList + kEnd;
    const std::string text = kPositions4 + "3 0 1 2\n4 0 1 2 3";
    for (std::size_t size = 0; size < text.size(); ++size) {
        EXPECT_TRUE(refuses(kAscii + elements + text.substr(0, size), {})) << "after " << size;
    }
    for (const bool big_endian : {false, true}) {
        ByteWriter body(big_endian);
        body.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
        body.add<std::uint8_t>({3}).add<std::int32_t>({0, 1, 2});
        body.add<std::uint8_t>({4}).add<std::int32_t>({0, 1, 2, 3});
        const std::string bytes = body.bytes();
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            EXPECT_TRUE(refuses(binary_header(big_endian) + elements + bytes.substr(0, size), {})) << "after " << size;
        }
        EXPECT_EQ(read(binary_header(big_endian) + elements + bytes).polygon_count(), 2u);
    }
}

TEST_F(ReadPly, VertexNumbersMustExist) {
    const std::string ascii = kAscii + kVertices4 + "element face 2\n" + kList + kEnd + kPositions4 + "3 0 1 2\n";
    EXPECT_TRUE(refuses(ascii + "3 0 1 4\n", {":15: vertex 4 does not exist (the file has 4"}));
    EXPECT_TRUE(refuses(ascii + "3 0 1 -1\n", {":15: vertex -1 does not exist"}));
    EXPECT_TRUE(refuses(ascii + "3 0 1 4294967296\n", {":15: vertex 4294967296 does not exist"}));
    EXPECT_TRUE(refuses(ascii + "3 0 1 99999999999999999999\n", {":15: a value of element 'face' is no number"}));
    EXPECT_TRUE(refuses(ascii + "3 0 1 x\n", {":15: a value of element 'face' is no number"}));
    for (const std::int32_t bad : {4, -1, std::numeric_limits<std::int32_t>::min()}) {
        ByteWriter body(true);
        body.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
        body.add<std::uint8_t>({3}).add<std::int32_t>({0, 1, 2}).add<std::uint8_t>({3}).add<std::int32_t>({0, 1, bad});
        EXPECT_TRUE(refuses(binary_header(true) + kVertices4 + "element face 2\n" + kList + kEnd + body.bytes(),
                            {std::to_string(bad) + " does not exist"}));
    }
    const std::string strips =
        kAscii + kVertices4 + "element tristrips 1\nproperty list int int vertex_indices\n" + kEnd + kPositions4;
    EXPECT_TRUE(refuses(strips + "4 0 1 2 4\n", {":14: vertex 4 does not exist"}));
    EXPECT_TRUE(refuses(strips + "4 0 1 2 -2\n", {":14: vertex -2 does not exist"}));
}

TEST_F(ReadPly, ValuesThatAreNoNumbersAreRefused) {
    const std::string body = "element face 1\n" + kList + kEnd;
    for (const char* bad : {"nan", "-nan", "inf", "1e31", "1e400"}) {
        EXPECT_TRUE(refuses(kAscii + kVertices4 + body + "0 0 0\n1 0 0\n0 " + bad + " 0\n0 1 0\n3 0 1 2\n",
                            {":12: a coordinate is not finite or beyond 1e30"}))
            << bad;
    }
    EXPECT_TRUE(refuses(kAscii + kVertices4 + body + "0 0 0\n1 0 0\n0 x 0\n0 1 0\n3 0 1 2\n",
                        {":12: a value of element 'vertex'"}));
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity(), 1.1e30f}) {
        ByteWriter bytes;
        bytes.add<float>({0, 0, 0, 1, 0, bad, 1, 1, 0, 0, 1, 0}).add<std::uint8_t>({3}).add<std::int32_t>({0, 1, 2});
        EXPECT_TRUE(refuses(binary_header(false) + kVertices4 + body + bytes.bytes(),
                            {"vertex 1: a coordinate is not finite"}));
    }
    // Lists of reals may hold vertex numbers, but not these.
    const std::string real_list =
        kAscii + kVertices4 + "element face 1\nproperty list uchar float vertex_indices\n" + kEnd + kPositions4;
    EXPECT_EQ(polygons_of(read(real_list + "3 0 1.0 2e0\n")), (Polygons{{0, 1, 2}}));
    for (const char* bad : {"nan", "inf", "1e300", "0.5", "-0.5"}) {
        EXPECT_TRUE(refuses(real_list + "3 0 1 " + bad + "\n", {":14: "})) << bad;
    }
    ByteWriter bytes;
    bytes.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}).add<std::uint8_t>({3}).add<float>({0, 1, 1.5f});
    EXPECT_TRUE(refuses(binary_header(false) + kVertices4 +
                            "element face 1\nproperty list uchar float vertex_indices\n" + kEnd + bytes.bytes(),
                        {"face 0: a value"}));
}

TEST_F(ReadPly, ListsLongerThanTheFileAreRefused) {
    const std::string header = kVertices4 + "element face 1\nproperty list int int vertex_indices\n" + kEnd;
    for (const std::int32_t length :
         {-1, 4, 100, std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min()}) {
        EXPECT_TRUE(refuses(kAscii + header + kPositions4 + std::to_string(length) + " 0 1 2\n", {})) << length;
        ByteWriter body;
        body.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}).add<std::int32_t>({length, 0, 1, 2});
        EXPECT_TRUE(refuses(binary_header(false) + header + body.bytes(), {})) << length;
    }
    ByteWriter body;
    body.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}).add<std::uint32_t>({4294967295u, 0, 1, 2});
    EXPECT_TRUE(refuses(binary_header(false) + kVertices4 + "element face 1\nproperty list uint int vertex_indices\n" +
                            kEnd + body.bytes(),
                        {"face 0: a list of 4294967295 values does not fit the file"}));
}

}  // namespace
}  // namespace burin
