// OBJ files are parsed in pieces, on many threads. Where the text is cut must not show, neither in what is
// read nor in what errors say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "mesh/obj_pieces.h"
#include "mesh/readers.h"
#include "mesh/text_scan.h"
#include "tests/mesh/model_files.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin::obj_pieces_test {
namespace {

using test::Random;

constexpr std::size_t kOnePiece = std::string_view::npos;

template <typename T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}
bool same_material(const Material& a, const Material& b) {
    return a.name == b.name && a.color == b.color && a.opacity == b.opacity;
}

/// What differs, or nothing.
std::string difference(const PolygonSoup& a, const PolygonSoup& b) {
    if (!same_bytes(a.positions, b.positions)) return "positions";
    if (a.corners != b.corners) return "corners";
    if (a.polygon_ends != b.polygon_ends) return "ends of polygons";
    if (a.polygon_object != b.polygon_object) return "objects";
    if (a.polygon_material != b.polygon_material) return "materials";
    if (a.marked_edges != b.marked_edges) return "marked edges";
    if (a.marked_edge_object != b.marked_edge_object) return "objects of marked edges";
    if (a.object_names != b.object_names) return "names of objects";
    if (!std::equal(a.materials.begin(), a.materials.end(), b.materials.begin(), b.materials.end(), same_material)) {
        return "colours of materials";
    }
    return "";
}

class ObjPieces : public testing::Test {
  protected:
    ObjPieces() {
        folder_.write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n");
        folder_.write("b.mtl", "newmtl red\nKd 0.5 0 0\nnewmtl \nKd 0 0 1\n");
    }

    struct Outcome {
        PolygonSoup soup;
        std::string error;
    };
    Outcome read(std::string_view text, int threads, std::size_t piece_size) const {
        try {
            return {read_obj_text(path_, text, threads, piece_size), ""};
        } catch (const InputError& error) {
            return {{}, error.what()};
        }
    }

    /// Good files must be read from their pieces, not all over again.
    testing::AssertionResult is_same(std::string_view text, const Outcome& whole, std::size_t piece_size,
                                     int threads) const {
        const Outcome cut = read(text, threads, piece_size);
        const std::string what = whole.error == cut.error ? difference(whole.soup, cut.soup)
                                                          : "error '" + cut.error + "', not '" + whole.error + "'";
        const bool again =
            whole.error.empty() &&
            !parse_obj_pieces(path_, cut_between_statements(without_byte_order_mark(text), piece_size), threads);
        if (what.empty() && !again) return testing::AssertionSuccess();
        return testing::AssertionFailure() << "pieces of " << piece_size << " bytes on " << threads
                                           << " threads: " << (what.empty() ? "read again" : what) << "\n"
                                           << text;
    }
    /// Every line end is the first cut of one of these sizes, and with a size of 1 all are cuts.
    testing::AssertionResult same_in_all_pieces(std::string_view text) const {
        const Outcome whole = read(text, 1, kOnePiece);
        for (std::size_t size = 1; size <= text.size(); ++size) {
            const testing::AssertionResult same = is_same(text, whole, size, static_cast<int>(1 + size % 3));
            if (!same) return same;
        }
        return testing::AssertionSuccess();
    }
    testing::AssertionResult is_read(std::string_view text) const {
        const std::string error = read(text, 1, kOnePiece).error;
        if (!error.empty()) return testing::AssertionFailure() << error;
        return same_in_all_pieces(text);
    }
    testing::AssertionResult is_refused(std::string_view text, std::string_view what) const {
        const std::string error = read(text, 1, kOnePiece).error;
        if (error.find(what) == error.npos)
            return testing::AssertionFailure() << "'" << error << "', not '" << what << "'";
        return same_in_all_pieces(text);
    }

    test::TemporaryFolder folder_;
    std::string path_ = folder_.file("part.obj");
};

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 -0\n";

TEST_F(ObjPieces, StatementsAreNotCut) {
    using Pieces = std::vector<std::string_view>;
    EXPECT_EQ(cut_between_statements("v 1\nv 2\n\nv 3", 1), (Pieces{"v 1\n", "v 2\n", "\n", "v 3"}));
    EXPECT_EQ(cut_between_statements("v 1\nv 2\n\nv 3\n", 5), (Pieces{"v 1\nv 2\n", "\nv 3\n"}));
    EXPECT_EQ(cut_between_statements("f 1\\\n2\\\r\n3\nf\\ \nf", 1), (Pieces{"f 1\\\n2\\\r\n3\n", "f\\ \n", "f"}));
    EXPECT_EQ(cut_between_statements("f \\\n\\\n", 1), (Pieces{"f \\\n\\\n"}));
    EXPECT_EQ(cut_between_statements("f 1 2 3", 1), (Pieces{"f 1 2 3"}));
    EXPECT_EQ(cut_between_statements("", 1), (Pieces{""}));
}

TEST_F(ObjPieces, VerticesCountedBackwards) {
    EXPECT_TRUE(is_read(kSquare + "f -4 -3 -2\nv 5 5 5\nf -1/-1 1 -2//-1\nv 6 6 6\nf -6 6 -1\n"));
    EXPECT_TRUE(is_read(kSquare + "f -4 2 -2\nl 1 -1 2 -4\nv 5 5 5\nl -5 5 -1 \\\n -2 1\nf 1 2 3 -1 -5\n"));
    EXPECT_TRUE(is_refused(kSquare + "f 1 2 3\nv 5 5 5\n\nf 1 2 -6\nv 6 6 6\n",
                           ":8: vertex -6 does not exist (there are 5 so far)"));
    EXPECT_TRUE(
        is_refused(kSquare + "f 1 2 3\nl 2 -5\nv 6 6 6\n", ":6: vertex -5 does not exist (there are 4 so far)"));
    EXPECT_TRUE(is_refused("f -1 2 3\n" + kSquare, ":1: vertex -1 does not exist (there are 0 so far)"));
    EXPECT_TRUE(is_refused(kSquare + "f 1 2 -9223372036854775808\n", "vertex -9223372036854775808 does not exist"));
    EXPECT_TRUE(is_refused(kSquare + "f 1 2 -3221225472\nf 1 2 -1073741824\n", "vertex -3221225472 does not exist"));
}

TEST_F(ObjPieces, VerticesBehindTheirFirstUse) {
    EXPECT_TRUE(is_read("f 1 2 3\nl 4 1\n" + kSquare + "f 5 1 2\nv 1 2 3\n"));
    EXPECT_TRUE(is_refused("f 1 2 3\nf 1 2 6\nf 6 2 1\n" + kSquare + "f 6 2 5\nf 5 1 2\n",
                           ":2: vertex 6 does not exist (the file has 4)"));
    EXPECT_TRUE(is_refused("f 1 2 5\nf 1 2 3\n" + kSquare + "f 6 2 5\nf 6 1 2\n",
                           ":7: vertex 6 does not exist (the file has 4)"));
    for (const char* number : {"2147483648", "2147483649", "3221225472", "3221225473", "4294967295"}) {
        EXPECT_TRUE(is_refused(kSquare + "f 1 2 3\nf 1 -1 " + number + "\n",
                               std::string(":6: vertex ") + number + " does not exist (the file has 4)"));
    }
    EXPECT_TRUE(is_refused(kSquare + "f 1 2 4294967296\n", "vertex 4294967296 does not exist (there are 4 so far)"));
}

TEST_F(ObjPieces, NamesStayInForce) {
    const std::string faces = "f 1 2 3\nf 1 2 3 4\n";
    EXPECT_TRUE(is_read(kSquare + faces + "usemtl green\n" + faces + "usemtl red\nusemtl blue\n" + faces +
                        "mtllib a.mtl\n" + faces + "usemtl\n" + faces + "mtllib b.mtl\nusemtl red\n" + faces));
    EXPECT_TRUE(is_read("mtllib b.mtl\nusemtl blue\n" + kSquare + "usemtl red\nmtllib a.mtl\n" + faces));
    EXPECT_TRUE(is_read(kSquare + "g z\n" + faces + "g a b\n" + faces + "g\n" + faces + "g a b\n" + faces + "g c\n"));
    EXPECT_TRUE(is_read("g d\n" + kSquare + faces + "o z\ng a b\n" + faces + faces + "o y\n\n" + faces + "o\n" + faces +
                        "o z\n" + faces + "o \\\nx\n" + faces));
    EXPECT_TRUE(is_read("g a\n" + kSquare + faces + "g b\n" + faces + "o last\n"));
    EXPECT_TRUE(is_read("g a\n" + kSquare + faces + "o\n" + faces + "g b\n" + faces));
}

TEST_F(ObjPieces, StatementsGoOnBehindBackslashes) {
    EXPECT_TRUE(is_read(kSquare + "f 1 \\\n2 \\\n\\\n 3 4\nf 1 2 \\\r\n3\r\nv 0 \\\n\\\r\n0 0\nf 1 2 -1\\\n"));
    EXPECT_TRUE(is_read("# C:\\\n" + kSquare + "  # D:\\\r\nf 1 2 3 \\\n# E:\\\nf 9 9 9\nf 2 3 4\n"));
    EXPECT_TRUE(is_read(kSquare + "usemtl a\\\nv 1 2 3\nf 1 2 3\ng \\\n\\\nf 1 2 3\nf 3 2 1\n"));
    EXPECT_TRUE(is_refused(kSquare + "f 1 2 3\nf 1 \\\n2 \\\n5\nf 4 5 1\n", ":8: vertex 5 does not exist"));
    EXPECT_TRUE(is_refused(kSquare + "f 1 2 3\nf 1 \\\n2 \\\n5\nv 0 \\\n x 0\n", ":10: a vertex needs three numbers"));
}

TEST_F(ObjPieces, TheFirstErrorIsTheOneReported) {
    EXPECT_TRUE(is_refused(kSquare + "f 1 2 3\nf 1 2 x\n\nv 1\nf 0 1 2\n", ":6: 'x' is no vertex number"));
    EXPECT_TRUE(is_refused(kSquare + "f 1 2 3\nv 1\nf 1 2 x\n", ":6: a vertex needs three numbers"));
    EXPECT_TRUE(is_refused(kSquare + "f 1 2 9\nf 1 2 3\nv 1 2 nan\n", ":7: a coordinate is not finite"));
    EXPECT_TRUE(is_refused(kSquare + "f 1 2 9\nf 1 2 3\nf 1 2 -5\nv x\n", ":7: vertex -5 does not exist"));
    EXPECT_TRUE(is_refused(kSquare + "f 1 2 0\n\nf 1 2 -5\n", ":5: vertex 0 does not exist (there are 4 so far)"));
    EXPECT_TRUE(
        is_refused(kSquare + "f 1 2 3\r\nf 1 \\\r\n2\r\nf 1 2 3\nf 1 2", ":9: the file ends in the middle of a face"));
    EXPECT_TRUE(is_refused(kSquare + "f 1 2 3\nf 1", ":6: the file ends in the middle of a face"));
    EXPECT_TRUE(is_read(kSquare + "f 1 2 3\nf 1\nf\nl 1\nf 1 2\n"));
    EXPECT_TRUE(is_refused(kSquare + "l 1\n\n", "no polygons and no lines found"));
    EXPECT_TRUE(is_refused("hello\nworld\n", "no vertices found"));
    EXPECT_TRUE(is_refused(std::string("\xFF\xFEv\0\n\0 \n", 8), "UTF-16"));
}

TEST_F(ObjPieces, AByteOrderMarkIsOneAtTheStartOnly) {
    EXPECT_TRUE(is_read("\xEF\xBB\xBF" + kSquare + "f 1 2 3\n\xEF\xBB\xBFv 1\n\xEF\xBB\xBF\nf 2 3 4\n"));
}

/// Any statements, with a fault now and then.
std::string random_text(Random& random) {
    const auto one_in = [&](int n) { return random.integer(1, n) == 1; };
    const int later_vertices = one_in(3) ? 2 : 0;
    const int rarity = one_in(3) ? 40 : 1000000;  // of faults
    int vertices = 0;
    std::string text;
    const auto vertex = [&] {
        text += "v " + std::to_string(random.integer(-3, 3)) + (one_in(rarity) ? " x" : " .5e1") + " " +
                std::to_string(random.real(-1, 1));
        ++vertices;
    };
    const auto corner = [&] {
        const bool backwards = vertices > 0 && one_in(3);
        const int wrong = one_in(rarity) ? 2 : 0;
        if (backwards) return std::to_string(-random.integer(1, vertices + wrong));
        return std::to_string(random.integer(1, vertices + later_vertices + wrong)) + (one_in(4) ? "/1/2" : "");
    };
    const auto name = [&] {
        static constexpr const char* kNames[] = {"", " ", "red", "green", "a b", "c", "c ", "red"};
        return std::string(" ") + kNames[random.integer(0, 7)];
    };
    const char* const line_end = one_in(4) ? "\r\n" : "\n";
    for (int i = 0; i < 3; ++i) {
        vertex();
        text += line_end;
    }
    for (int lines = random.integer(1, 30); lines > 0; --lines) {
        if (one_in(8)) text += one_in(2) ? " " : "\t";
        switch (random.integer(0, 11)) {
            case 0:
            case 1:
            case 2:
                vertex();
                break;
            case 3:
                text += "l " + corner() + " " + corner() + (one_in(2) ? " " + corner() : "");
                break;
            case 4:
                text += "o" + name();
                break;
            case 5:
                text += "g" + name();
                break;
            case 6:
                text += "usemtl" + name();
                break;
            case 7:
                text += one_in(3) ? "mtllib a.mtl b.mtl" : one_in(2) ? "mtllib a.mtl" : "# \\";
                break;
            default:
                text += "f";
                for (int corners = random.integer(one_in(8) ? 0 : 3, 5); corners > 0; --corners)
                    text += (one_in(10) ? " \\\n" : " ") + corner();
        }
        if (one_in(80)) text += "\\";
        text += line_end;
    }
    for (int i = 0; i < later_vertices; ++i) {
        vertex();
        text += line_end;
    }
    if (one_in(4)) text.pop_back();
    return text;
}

TEST_F(ObjPieces, AnyTextIsTheSameInPieces) {
    constexpr int kTrials = 3000;
    int refused = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        std::string text = random_text(random);
        for (int damage = std::max(0, random.integer(-3, 2)); damage > 0; --damage) {
            const auto at = static_cast<std::size_t>(random.integer(0, static_cast<int>(text.size()) - 1));
            const char c = "\\\n\r vfl-/#0127"[random.integer(0, 13)];
            if (random.integer(0, 1) == 0)
                text[at] = c;
            else
                text.insert(at, 1, c);
        }
        const Outcome whole = read(text, 1, kOnePiece);
        refused += whole.error.empty() ? 0 : 1;
        for (const std::size_t size : {1, random.integer(2, 60), random.integer(60, 400)}) {
            ASSERT_TRUE(is_same(text, whole, size, random.integer(1, 3))) << "trial " << trial;
        }
    }
    EXPECT_GT(refused, kTrials / 10);
    EXPECT_LT(refused, kTrials / 2);
}

TEST_F(ObjPieces, LargeFilesAreReadTheSameOnAnyNumberOfThreads) {
    std::string text = "mtllib a.mtl\n";
    Random random(1);
    for (int i = 0; i < 30000; ++i) {
        text += "v " + std::to_string(random.real(-1, 1)) + " " + std::to_string(random.real(-1, 1)) + " 0\n";
        if (i >= 2) text += "f -1 -2 " + std::to_string(random.integer(1, 30000)) + "\n";
        if (i % 1000 == 0) text += "g " + std::to_string(i % 7) + "\nusemtl " + (i % 3 == 0 ? "red\n" : "green\n");
    }
    ASSERT_GT(text.size(), std::size_t{3} << 18) << "several pieces";
    const std::string path = folder_.write("large.obj", text);
    const PolygonSoup expected = read_obj(path);
    EXPECT_EQ(expected.polygon_count(), 29998u);
    for (const int threads : {0, 2, 3, 7}) EXPECT_EQ(difference(read_obj(path, threads), expected), "") << threads;
}

}  // namespace
}  // namespace burin::obj_pieces_test
