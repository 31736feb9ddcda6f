// What stands behind the last element that a file counts is named, and refused where the reader is strict.

#include <gtest/gtest.h>

#include <string>

#include "mesh/readers.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::ByteWriter;
using Read = PolygonSoup (*)(const std::string& path, bool strict);

PolygonSoup read_ply_file(const std::string& path, bool strict) { return read_ply(path, 1, strict); }

class Surplus : public testing::Test {
  protected:
    /// The file with `behind` at its end has the polygons that it has without, and one note.
    void expect_noted(Read read, const std::string& name, const std::string& file, const std::string& behind,
                      const std::string& note, const std::string& place) {
        const PolygonSoup whole = read(folder_.write(name, file), true);
        EXPECT_TRUE(whole.notes.empty());
        const std::string path = folder_.write(name, file + behind);
        const PolygonSoup soup = read(path, false);
        EXPECT_EQ(soup.notes, std::vector<std::string>{note}) << behind;
        EXPECT_EQ(soup.positions, whole.positions) << behind;
        EXPECT_EQ(test::polygons_of(soup), test::polygons_of(whole)) << behind;
        EXPECT_TRUE(test::refuses([&](const std::string& p) { return read(p, true); }, path, {place + note})) << behind;
    }
    void expect_nothing(Read read, const std::string& name, const std::string& file) {
        EXPECT_TRUE(read(folder_.write(name, file), true).notes.empty()) << file;
    }
    test::TemporaryFolder folder_;
};

TEST_F(Surplus, OfOffIsNamed) {
    const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    expect_noted(read_off, "a.off", off, "3 2 1 0\n",
                 "lines behind the last polygon left out: 1; the first one is line 7", ":7: ");
    expect_noted(read_off, "a.off", off, "\n# more\r\nx\n\n0 0 0",
                 "lines behind the last polygon left out: 2; the first one is line 9", ":9: ");
    for (const char* nothing : {"\n\n", " \t\r\n", "# the end\n", "\n  # the end"})
        expect_nothing(read_off, "a.off", off + nothing);
}

TEST_F(Surplus, OfPlyIsNamed) {
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    expect_noted(read_ply_file, "a.ply", ply, "3 2 1 0\n",
                 "lines behind the last element left out: 1; the first one is line 14", ":14: ");
    expect_noted(read_ply_file, "a.ply", ply, "\n\nx\ny",
                 "lines behind the last element left out: 2; the first one is line 16", ":16: ");
    for (const char* nothing : {"\n\n", " \t\r\n", "# the end\n", "comment the end"})
        expect_nothing(read_ply_file, "a.ply", ply + nothing);
}

TEST_F(Surplus, OfPlyIsNamedBesideLongLines) {
    const std::string path =
        folder_.write("a.ply",
                      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 9\n1 0 0\n0 1 0\n3 0 "
                      "1 2\n3 0 1 2\n");
    EXPECT_EQ(
        read_ply(path).notes,
        (std::vector<std::string>{"line 10 has more values than the header declares; the rest of the line is left out",
                                  "lines behind the last element left out: 1; the first one is line 14"}));
}

TEST_F(Surplus, OfBinaryPlyIsNamed) {
    for (const bool big_endian : {false, true}) {
        ByteWriter w(big_endian);
        w.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}).add<std::uint8_t>({3}).add<std::int32_t>({0, 1, 2});
        const std::string ply = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                                "_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
                                w.bytes();
        expect_noted(read_ply_file, "a.ply", ply, "abc", "bytes behind the last element left out: 3", " ");
        expect_noted(read_ply_file, "a.ply", ply, std::string(13, '\0'), "bytes behind the last element left out: 13",
                     " ");
        expect_nothing(read_ply_file, "a.ply", ply + "\n");
    }
}

TEST_F(Surplus, OfBinaryStlIsNamed) {
    ByteWriter w;
    w.add<std::uint32_t>({1}).add<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}).add<std::uint16_t>({0});
    const std::string stl = std::string(80, ' ') + w.bytes();
    expect_noted(read_stl, "a.stl", stl, "abc", "bytes behind the last triangle left out: 3", " ");
    expect_noted(read_stl, "a.stl", stl, std::string(70, 'x'), "bytes behind the last triangle left out: 70", " ");
    expect_nothing(read_stl, "a.stl", stl + "\r\n");
}

}  // namespace
}  // namespace burin
