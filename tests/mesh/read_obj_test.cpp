#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "mesh/readers.h"
#include "tests/mesh/model_files.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin::read_obj_test {
namespace {

using test::Polygons;
using test::polygons_of;

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

PolygonSoup read_file(const std::string& path) { return read_obj(path); }

class ReadObj : public testing::Test {
  protected:
    PolygonSoup read(std::string_view text) { return read_obj(folder_.write("part.obj", text)); }
    testing::AssertionResult refuses(std::string_view text, std::initializer_list<std::string_view> parts) {
        return test::refuses(read_file, folder_.write("part.obj", text), parts);
    }
    test::TemporaryFolder folder_;
};

TEST_F(ReadObj, PolygonsKeepAllTheirCorners) {
    const PolygonSoup soup = read(kSquare + "v 0.5 2 0\nf 1 2 3\nf 1 2 3 4\nf 1 2 3 5 4\n");
    EXPECT_EQ(polygons_of(soup), (Polygons{{0, 1, 2}, {0, 1, 2, 3}, {0, 1, 2, 4, 3}}));
    ASSERT_EQ(soup.positions.size(), 5u);
    EXPECT_EQ(soup.positions[4], glm::dvec3(0.5, 2, 0));
    EXPECT_EQ(soup.object_names, std::vector<std::string>{"part"});
    EXPECT_EQ(soup.materials.size(), 1u);
}

TEST_F(ReadObj, CornersMayNameTexturesAndNormals) {
    const std::string head = kSquare + "vt 0 0\nvt 1 0\nvn 0 0 1\n";
    for (const char* face : {"f 1 2 3", "f 1/1 2/2 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/1/1", "f 1/ 2/ 3/",
                             "f 1/9/9 2 3//7", "fo 1 2 3", "  f\t1  2\t 3 \t"}) {
        EXPECT_EQ(polygons_of(read(head + face + "\n")), (Polygons{{0, 1, 2}})) << face;
    }
}

TEST_F(ReadObj, NegativeIndicesCountFromTheEnd) {
    const PolygonSoup soup = read(kSquare + "f -4 -3 -2\nv 5 5 5\nf -1/-1 1 -2//-1\n");
    EXPECT_EQ(polygons_of(soup), (Polygons{{0, 1, 2}, {4, 0, 3}}));
}

TEST_F(ReadObj, VerticesMayFollowTheFacesThatUseThem) {
    EXPECT_EQ(polygons_of(read("f 1 2 3\n" + kSquare)), (Polygons{{0, 1, 2}}));
}

// Lines in the usual form are read in another way than others, if they are not close to an end of the file.
TEST_F(ReadObj, UnusualSpellingsMeanTheSame) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        test::Random random(seed);
        std::string plain = "# 16 characters and more\n", unusual = plain;
        int vertices = 0;
        for (int line = 0; line < 60; ++line) {
            std::string text;
            if (vertices < 3 || random.integer(0, 1) == 0) {
                ++vertices;
                text = "v";
                for (int k = 0; k < 3; ++k) text += " " + std::to_string(random.real(-50.0, 50.0));
            } else {
                text = "f";
                for (int k = 0; k < 3; ++k)
                    text += " " + std::to_string(random.integer(1, vertices + (line < 30 ? 2 : 0)));
            }
            plain += text + "\n";
            const std::string ends[] = {"\n", "\r\n", " \n", "\t\n", text[0] == 'f' ? " # a comment\n" : " 1.0\n"};
            std::replace(text.begin(), text.end(), ' ', random.integer(0, 1) == 0 ? ' ' : '\t');
            unusual += text + ends[random.integer(0, 4)];
        }
        for (std::string* text : {&plain, &unusual}) *text += "v 0 0 0\nv 1 0 0\n";
        const PolygonSoup expected = read(unusual), soup = read(plain);
        ASSERT_EQ(soup.positions, expected.positions) << "seed " << seed;
        ASSERT_EQ(polygons_of(soup), polygons_of(expected)) << "seed " << seed;
    }
}

TEST_F(ReadObj, ErrorsOfUsualLinesNameTheLine) {
    const std::string vertices = "v 0.0 0.0 0.0\nv 1.0 0.0 0.0\nv 0.0 1.0 0.0\n";
    const std::string behind = "f 1 2 3\n" + vertices + vertices + vertices;
    EXPECT_TRUE(refuses(vertices + "f 1 2 3\nf 1 2 400\n" + behind, {":5:", "vertex 400 does not exist"}));
    EXPECT_TRUE(refuses(vertices + "f 1 2 3\nf 1 0 3\n" + behind, {":5:", "vertex 0 does not exist"}));
}

// The text ends behind blanks, at the end of a page of memory: what is behind it must not be looked at.
TEST_F(ReadObj, AFileMayEndInBlanks) {
    for (const std::string last : {"v 1.0 2.0 3.0", "f 1 2 3"}) {
        const std::string head = "v 0.0 0.0 0.0\nv 1.0 0.0 0.0\nv 0.0 1.0 0.0\nf 1 2 3\n#";
        const std::string tail = "\n" + last + std::string(100, ' ');
        const std::string text = head + std::string(4096 * 513 - head.size() - tail.size(), 'x') + tail;
        EXPECT_EQ(read(text).polygon_count(), last[0] == 'f' ? 2u : 1u);
    }
}

TEST_F(ReadObj, CoordinatesAreReadInDoublePrecision) {
    const PolygonSoup soup = read("v 5000000.001 -1e-3 +.5 0.25 0.5 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(soup.positions[0], glm::dvec3(5000000.001, -1e-3, 0.5));
}

TEST_F(ReadObj, ObjectsHaveTheNamesOfTheirOLines) {
    const PolygonSoup soup = read(kSquare +
                                  "f 1 2 3\no left\nf 1 2 4\ng group\nf 2 3 4\no my right\nf 1 3 4\n"
                                  "o left\nf 3 2 1\n");
    EXPECT_EQ(soup.object_names, (std::vector<std::string>{"part", "left", "my right"}));
    EXPECT_EQ(soup.polygon_object, (std::vector<std::uint32_t>{0, 1, 1, 2, 1}));
}

TEST_F(ReadObj, GroupsAreObjectsOnlyInAFileWithoutObjects) {
    const PolygonSoup soup = read(kSquare + "f 1 2 3\ng a b\nf 1 2 4\ng c\nf 1 2 3\ng a b\nf 1 3 4\n");
    EXPECT_EQ(soup.object_names, (std::vector<std::string>{"part", "a b", "c"}));
    EXPECT_EQ(soup.polygon_object, (std::vector<std::uint32_t>{0, 1, 2, 1}));
    // One 'o' anywhere is enough, also behind the faces.
    const PolygonSoup with_object = read(kSquare + "g a\nf 1 2 3\ng b\nf 1 2 4\no last\n");
    EXPECT_EQ(with_object.object_names, (std::vector<std::string>{"part", "last"}));
    EXPECT_EQ(with_object.polygon_object, (std::vector<std::uint32_t>{0, 0}));
}

TEST_F(ReadObj, LinesMarkEdges) {
    const PolygonSoup soup = read(kSquare + "f 1 2 3 4\nl 1 2\nl 1/1 3/2 -1 # diagonal\n");
    using Edge = std::array<std::uint32_t, 2>;
    EXPECT_EQ(soup.marked_edges, (std::vector<Edge>{{0, 1}, {0, 2}, {2, 3}}));
    EXPECT_EQ(soup.polygon_count(), 1u);
}

TEST_F(ReadObj, BackslashesContinueLines) {
    const Polygons expected{{0, 1, 2, 3}};
    EXPECT_EQ(polygons_of(read(kSquare + "f 1 2 \\\n3 4\n")), expected);
    EXPECT_EQ(polygons_of(read(kSquare + "f 1 \\\n2 \\\n\\\n  3\\\n4\n")), expected) << "several in a row";
    EXPECT_EQ(polygons_of(read(kSquare + "f 1 2 \\\r\n3 4\r\n")), expected) << "CRLF";
    EXPECT_EQ(polygons_of(read(kSquare + "f 1 2 3 4 \\")), expected) << "at the end of the file";
    EXPECT_EQ(read("v 0 \\\n0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").positions.size(), 3u);
}

TEST_F(ReadObj, ABackslashAtTheEndOfACommentContinuesNothing) {
    // "# written to C:\models\" must not swallow the vertex behind it.
    EXPECT_EQ(read("# saved in C:\\models\\\n" + kSquare + "f 1 2 3\n").positions.size(), 4u);
    EXPECT_EQ(read("  #\\\r\n" + kSquare + "f 1 2 3\n").positions.size(), 4u);
}

TEST_F(ReadObj, LineEndsCommentsAndUnknownWordsDoNotMatter) {
    std::string text =
        "# a comment\n\n" + kSquare + "s off\nvp 1 2\ncurv 0 1 1 2\n   # another\nf 1 2 3 # rest\nf 1 3 4 #5 6 7";
    const Polygons expected{{0, 1, 2}, {0, 2, 3}};
    EXPECT_EQ(polygons_of(read(text)), expected);
    std::string crlf;
    for (const char c : text) crlf += c == '\n' ? "\r\n" : std::string(1, c);
    EXPECT_EQ(polygons_of(read(crlf)), expected);
}

TEST_F(ReadObj, KeywordsMayBeInCapitals) {
    folder_.write("Colours.mtl", "newmtl Red\nKd 1 0 0\n");
    const PolygonSoup soup = read(
        "MTLLIB Colours.mtl\nV 0 0 0\nV 1 0 0\nV 0 1 0\nVT 0 0\nVN 0 0 1\nO Left\nUSEMTL Red\nF "
        "1/1/1 2/1/1 3/1/1\nL 1 2\nG x\nUseMtl Red\nFo 3 2 1\n");
    EXPECT_EQ(polygons_of(soup), (Polygons{{0, 1, 2}, {2, 1, 0}}));
    EXPECT_EQ(soup.object_names, (std::vector<std::string>{"part", "Left"}));
    EXPECT_EQ(soup.materials[soup.polygon_material[1]].color, glm::vec3(1, 0, 0));
    EXPECT_EQ(soup.marked_edges.size(), 1u);
}

TEST_F(ReadObj, AByteOrderMarkIsNoPartOfTheFirstWord) {
    EXPECT_EQ(read("\xEF\xBB\xBF" + kSquare + "f 1 2 3\n").positions.size(), 4u);
}

TEST_F(ReadObj, MaterialsComeFromTheMtlFile) {
    folder_.write("sub/a.mtl",
                  "# colours\nKd 1 1 1\nnewmtl red wax\nKd 1 0.25 0 # rest\nd 0.5\r\nnewmtl glass\nKd 0 0 2\n"
                  "Tr 0.75\nnewmtl strange\nKd spectral x.rfl\nd -halo 0.1\nnewmtl broken\nKd nan 0 inf\nd nan\n");
    const PolygonSoup soup = read("mtllib sub/a.mtl\n" + kSquare +
                                  "f 1 2 3\nusemtl red wax\nf 1 2 4\nusemtl glass\nf 1 3 4\nusemtl strange\nf 1 2 3\n"
                                  "usemtl unknown\nf 2 3 4\nusemtl broken\nf 2 3 4\nusemtl red wax\nf 2 3 4\n");
    EXPECT_EQ(soup.polygon_material, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 1}));
    ASSERT_EQ(soup.materials.size(), 6u);
    const auto expect_material = [&](std::size_t i, const char* name, glm::vec3 color, float opacity) {
        EXPECT_EQ(soup.materials[i].name, name);
        EXPECT_EQ(soup.materials[i].color, color) << name;
        EXPECT_EQ(soup.materials[i].opacity, opacity) << name;
    };
    const glm::vec3 standard = Material{}.color;
    expect_material(0, "", standard, 1);
    expect_material(1, "red wax", {1, 0.25, 0}, 0.5f);
    expect_material(2, "glass", {0, 0, 1}, 0.25f);
    expect_material(3, "strange", standard, 1);
    expect_material(4, "unknown", standard, 1);
    expect_material(5, "broken", standard, 1);
}

TEST_F(ReadObj, SeveralMtlFilesMayStandOnOneLine) {
    folder_.write("a.mtl", "newmtl a\nKd 1 0 0\n");
    folder_.write("b.mtl", "newmtl b\nKd 0 1 0\n");
    folder_.write("with blank.mtl", "newmtl c\nKd 0 0 1\n");
    const PolygonSoup soup = read("mtllib a.mtl  b.mtl\nmtllib with blank.mtl\n" + kSquare +
                                  "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 4\nusemtl c\nf 1 3 4\n");
    ASSERT_EQ(soup.materials.size(), 4u);
    EXPECT_EQ(soup.materials[1].color, glm::vec3(1, 0, 0));
    EXPECT_EQ(soup.materials[2].color, glm::vec3(0, 1, 0));
    EXPECT_EQ(soup.materials[3].color, glm::vec3(0, 0, 1));
}

TEST_F(ReadObj, AMissingMtlFileIsNoError) {
    for (const char* name : {"missing.mtl", "", ".", "no/such/folder.mtl"}) {
        const PolygonSoup soup = read("mtllib " + std::string(name) + "\n" + kSquare + "usemtl m\nf 1 2 3\n");
        EXPECT_EQ(soup.materials[1].name, "m");
        EXPECT_EQ(soup.materials[1].color, Material{}.color);
    }
}

TEST_F(ReadObj, MtlFilesOutsideTheFolderAreNotRead) {
    const std::string outside = folder_.write("secret.mtl", "newmtl m\nKd 1 0 0\n");
    const auto color_with = [&](const std::string& name) {
        const std::string path =
            folder_.write("inside/part.obj", "mtllib " + name + "\n" + kSquare + "usemtl m\nf 1 2 3\n");
        return read_obj(path).materials[1].color;
    };
    folder_.write("inside/good.mtl", "newmtl m\nKd 0 1 0\n");
    std::filesystem::create_symlink("../secret.mtl", folder_.file("inside/link.mtl"));
    std::filesystem::create_symlink("good.mtl", folder_.file("inside/inner_link.mtl"));
    EXPECT_EQ(color_with("../inside/good.mtl"), glm::vec3(0, 1, 0));
    EXPECT_EQ(color_with("inner_link.mtl"), glm::vec3(0, 1, 0));
    EXPECT_EQ(color_with("../secret.mtl"), Material{}.color);
    EXPECT_EQ(color_with(outside), Material{}.color);
    EXPECT_EQ(color_with("link.mtl"), Material{}.color);
}

TEST_F(ReadObj, CoordinatesMustBeFiniteNumbersWithinReason) {
    const std::string face = "f 1 2 3\n";
    for (const char* bad :
         {"nan", "NaN", "inf", "-inf", "1e31", "-1e31", "1e400", "x", "1..2", "0x10", "1,5", "+-1", "1e", "--1"}) {
        EXPECT_TRUE(refuses("v 0 0 0\nv 0 " + std::string(bad) + " 1\nv 0 1 0\n" + face, {":2: "})) << bad;
    }
    EXPECT_TRUE(refuses("v 0 0 0\nv 1 2\nv 0 1 0\n" + face, {":2: a vertex needs three numbers"}));
    EXPECT_TRUE(refuses("v 0 0 0\nv\nv 0 1 0\n" + face, {":2: a vertex needs three numbers"}));
    EXPECT_EQ(read("v 0 0 0\nv 1e30 -1e30 1e-400\nv 0 1 0\n" + face).positions[1], glm::dvec3(1e30, -1e30, 0));
}

TEST_F(ReadObj, VertexNumbersMustExist) {
    for (const char* bad :
         {"0", "5", "-5", "4294967296", "4294967297", "99999999999999999999", "-9223372036854775808", "-4294967296"}) {
        EXPECT_TRUE(refuses(kSquare + "f 1 2 3\nf 1 2 " + bad + "\n", {":6: ", bad})) << bad;
        EXPECT_TRUE(refuses(kSquare + "f 1 2 3\nl 1 " + bad + "\n", {":6: ", bad})) << bad;
    }
    for (const char* bad : {"x", "1.5", "/1", "1a", "+-1", "-", "1-2"}) {
        EXPECT_TRUE(refuses(kSquare + "f 1 2 " + bad + "\n", {":5: '", bad, "is no vertex number"})) << bad;
    }
    EXPECT_TRUE(refuses("f 1 2 3\n\nf 1 2 9\n" + kSquare + "f 1 2 8\n", {":3: vertex 9 does not exist"}))
        << "the line of the reference, not the end of the file";
}

TEST_F(ReadObj, TextThatIsNoObjIsRefused) {
    EXPECT_TRUE(refuses(std::string("\xFF\xFEv\0 \0", 6), {"UTF-16"}));
    EXPECT_TRUE(refuses(std::string("\xFE\xFF\0v\0 ", 6), {"UTF-16"}));
    EXPECT_TRUE(refuses("hello\nworld\n", {"no vertices"}));
    EXPECT_TRUE(refuses(kSquare, {"no polygons"}));
    EXPECT_TRUE(refuses(kSquare + "l 1\n", {"no polygons"}));
    EXPECT_TRUE(refuses("", {"empty"}));
    EXPECT_TRUE(test::refuses(read_file, folder_.file("none.obj"), {"cannot open"}));
    EXPECT_TRUE(test::refuses(read_file, folder_.path(), {"not a regular file"}));
}

TEST_F(ReadObj, AFaceCutOffAtTheEndIsAnError) {
    EXPECT_TRUE(refuses(kSquare + "f 1 2 3\nf 1 2", {":6: the file ends in the middle of a face"}));
    EXPECT_TRUE(refuses(kSquare + "f 1 2 3\nf", {":6: the file ends in the middle of a face"}));
    EXPECT_EQ(read(kSquare + "f 1 2 3\nf 1 2\n").polygon_count(), 2u) << "build_meshes drops and counts it";
}

TEST_F(ReadObj, MessagesShowControlCharactersAsQuestionMarks) {
    EXPECT_TRUE(refuses(kSquare + "f 1 2 \x01\x7F\n", {"'\?\?' is no vertex number"}));
    EXPECT_TRUE(refuses("v " + std::string(5000, 'x') + "\n", {"xxxx..."}));
}

}  // namespace
}  // namespace burin::read_obj_test
