// Lines end in LF, CRLF or CR alone, and in one file each may end as it likes.

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>

#include "mesh/line_ends.h"
#include "mesh/readers.h"
#include "mesh/text_scan.h"
#include "tests/mesh/model_files.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::Polygons;
using test::polygons_of;
using test::Random;

/// The text with each of its line feeds as one of the ends that `ends` names: n for LF, r for CR, b
/// for both.
std::string with_line_ends(std::string_view text, Random& random, std::string_view ends) {
    std::string result;
    for (const char c : text) {
        const char end = ends[static_cast<std::size_t>(random.integer(0, static_cast<int>(ends.size()) - 1))];
        if (c != '\n') {
            result += c;
        } else if (result.ends_with('\r') && end == 'n') {
            result += '\r';  // an empty line; CR and LF would be one end
        } else {
            result += end == 'n' ? "\n" : end == 'r' ? "\r" : "\r\n";
        }
    }
    return result;
}

TEST(LineEnds, AreFoundWhereverTheyStand) {
    for (std::size_t size = 0; size < 70; ++size) {
        for (std::size_t place = 0; place <= size; ++place) {
            for (const char end : {'\n', '\r'}) {
                std::string text(size, 'x');
                if (place < size) text[place] = end;
                const char* const begin = text.data();
                ASSERT_EQ(find_line_end(begin, begin + size) - begin, static_cast<std::ptrdiff_t>(place));
            }
        }
    }
}

TEST(LineEnds, EachEndsOneLine) {
    LineReader lines("a\rb\r\nc\n\rd\r\r\n\ne\r");
    std::string_view line;
    std::string all;
    while (lines.next(line)) all += std::to_string(lines.line_number()) + std::string(line) + " ";
    EXPECT_EQ(all, "1a 2b 3c 4 5d 6 7 8e ");
}

class LineEndsOfModels : public testing::Test {
  protected:
    /// Reads the text with line ends of all kinds, and expects the soup that LF gives.
    template <typename Read>
    void expect_same(const std::string& name, const std::string& text, const Read& read) {
        const PolygonSoup expected = read(folder_.write(name, text));
        ASSERT_GT(expected.polygon_count(), 0u);
        for (std::uint64_t seed = 0; seed < 60; ++seed) {
            Random random(seed);
            const std::string_view ends = std::array{"r", "b", "rn", "rb", "nb", "rnb", "nnnnnnnnnnnr"}[seed % 7];
            const PolygonSoup soup = read(folder_.write(name, with_line_ends(text, random, ends)));
            ASSERT_EQ(soup.positions, expected.positions) << name << ", seed " << seed;
            ASSERT_EQ(polygons_of(soup), polygons_of(expected)) << name << ", seed " << seed;
            ASSERT_EQ(soup.object_names, expected.object_names) << name << ", seed " << seed;
            ASSERT_EQ(soup.polygon_material, expected.polygon_material) << name << ", seed " << seed;
            ASSERT_EQ(soup.marked_edges, expected.marked_edges) << name << ", seed " << seed;
            ASSERT_TRUE(soup.notes.empty()) << name << ", seed " << seed << ": " << soup.notes.front();
        }
    }
    /// Expects the error that LF gives: on the same line.
    template <typename Read>
    void expect_same_error(const std::string& name, const std::string& text,
                           std::initializer_list<std::string_view> parts, const Read& read) {
        for (const std::string_view ends : {"n", "r", "b", "rnb"}) {
            Random random(7);
            EXPECT_TRUE(test::refuses(read, folder_.write(name, with_line_ends(text, random, ends)), parts))
                << name << ' ' << ends;
        }
    }
    test::TemporaryFolder folder_;
};

std::string rows(int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += std::to_string(i) + ".5 " + std::to_string(i % 7) + ".25 -1.0\n";
    return text;
}
std::string triangles(const std::string& head, int count, int first, int vertices) {
    std::string text;
    for (int i = 0; i < count; ++i) {
        text += head;
        for (int k = 0; k < 3; ++k) text += " " + std::to_string(first + (i + k) % vertices);
        text += "\n";
    }
    return text;
}

TEST_F(LineEndsOfModels, Obj) {
    std::string text = "# saved in C:\\\no left\n";
    for (const char c : rows(100)) text += text.back() == '\n' ? std::string("v ") + c : std::string(1, c);
    text += "usemtl red \nf 1 2 \\\n3 4\nl 1 2\n\no right\n" + triangles("f", 100, 1, 100) + "f 3/1 4/1 5/1\n# end";
    const auto read = [](const std::string& path) { return read_obj(path); };
    expect_same("a.obj", text, read);
    const auto in_pieces = [](const std::string& path) { return read_obj_text(path, test::read_file(path), 2, 200); };
    expect_same("a.obj", text, in_pieces);
    for (const auto& reader : {std::function<PolygonSoup(const std::string&)>(read),
                               std::function<PolygonSoup(const std::string&)>(in_pieces)}) {
        expect_same_error("a.obj", text + "\nf 1 2 x\n", {":211: 'x' is no vertex number"}, reader);
    }
    EXPECT_TRUE(test::refuses(read, folder_.write("cut.obj", "v 0 0 0\rv 1 0 0\rf 1 2"),
                              {":3: the file ends in the middle of a face"}));
    EXPECT_EQ(read(folder_.write("whole.obj", "v 0 0 0\rv 1 0 0\rf 1 2\r")).polygon_count(), 1u);
}

TEST_F(LineEndsOfModels, MaterialFile) {
    const std::string obj =
        folder_.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red wax\nf 1 2 3\n");
    for (const std::string_view ends : {"n", "r", "b", "rnb"}) {
        Random random(3);
        folder_.write("a.mtl", with_line_ends("# colours\nnewmtl red wax\nKd 1 0.25 0\nd 0.5\nnewmtl other\nKd 0 0 0\n",
                                              random, ends));
        const Material material = read_obj(obj).materials[1];
        EXPECT_EQ(material.color, glm::vec3(1, 0.25, 0)) << ends;
        EXPECT_EQ(material.opacity, 0.5f) << ends;
    }
}

TEST_F(LineEndsOfModels, Stl) {
    std::string text = "solid a name\n";
    for (int i = 0; i < 20; ++i) {
        text += "facet normal 0 0 1\nouter loop\nvertex " + std::to_string(i) +
                " 0 0\nvertex 1 0 5\nvertex 1 1 0\nendloop\nendfacet\n";
    }
    text += "endsolid a name\n";
    const auto read = [](const std::string& path) { return read_stl(path); };
    expect_same("a.stl", text, read);
    expect_same_error("a.stl", text + "rubbish\n", {":143: unknown word 'rubbish'"}, read);
}

TEST_F(LineEndsOfModels, Off) {
    const auto read_off_file = [](const std::string& path) { return read_off(path); };
    const std::string text = "# made by hand\nOFF\n100 50 0\n" + rows(100) + "\n" + triangles("3", 50, 0, 100);
    expect_same("a.off", text, read_off_file);
    expect_same_error("a.off", "OFF\n3 2 0\n" + rows(3) + "3 0 1 2\n\n3 0 1 9\n", {":8: vertex 9 does not exist"},
                      read_off_file);
}

std::string ply_header(int vertices, int faces) {
    return "ply\nformat ascii 1.0\ncomment x\nelement vertex " + std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(faces) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
}

TEST_F(LineEndsOfModels, AsciiPly) {
    for (const int count : {20, 3000}) {  // the larger one is read in pieces
        const std::string text = ply_header(count, count) + rows(count) + triangles("3", count, 0, count);
        for (const int threads : {1, 3}) {
            expect_same("a.ply", text, [threads](const std::string& path) { return read_ply(path, threads); });
        }
    }
    const auto read = [](const std::string& path) { return read_ply(path); };
    expect_same_error("a.ply", ply_header(20, 20) + rows(20) + triangles("3", 19, 0, 20) + "3 0 1 x\n",
                      {":50: a value of element 'face'"}, read);
    expect_same_error("a.ply", ply_header(20, 20) + rows(20) + triangles("3", 19, 0, 20) + "3 0 1 20\n",
                      {":50: vertex 20 does not exist"}, read);
    expect_same_error("a.ply", "ply\nformat ascii 1.0\n\nelement vertex x\n",
                      {":4: an element needs a name and a count"}, read);
}

TEST_F(LineEndsOfModels, BinaryPlyMayBeginWithALineFeed) {
    // The first byte of the body is 10, as an LF is: it is no part of the header's last line end.
    const std::string header =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar "
        "y\nproperty uchar z\n"
        "element face 1\nproperty list uchar uchar vertex_indices\nend_header\n";
    const std::string body{10, 13, 10, 1, 0, 0, 0, 1, 0, 3, 0, 1, 2};
    for (const std::string_view ends : {"n", "r", "b"}) {
        Random random(0);
        const PolygonSoup soup = read_ply(folder_.write("a.ply", with_line_ends(header, random, ends) + body));
        EXPECT_EQ(soup.positions[0], glm::dvec3(10, 13, 10)) << ends;
        EXPECT_EQ(polygons_of(soup), (Polygons{{0, 1, 2}})) << ends;
    }
}

}  // namespace
}  // namespace burin
