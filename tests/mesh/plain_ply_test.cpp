// Rows of plain numbers in ASCII PLY files are read in blocks, everything else value by value. Where
// one way ends and the other goes on must not show, in what is read and in what errors say.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <span>
#include <string>
#include <vector>

#include "mesh/ply_pieces.h"
#include "mesh/readers.h"
#include "tests/mesh/model_files.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::Random;

constexpr int kVertices = 1500, kFaces = 2500;  // more than a block
constexpr int kFirstVertexLine = 11;

/// The lines of the body of a file: vertices with a colour between y and z, then triangles.
std::vector<std::string> plain_rows() {
    Random random(1);
    std::vector<std::string> rows;
    for (int i = 0; i < kVertices; ++i) {
        const auto decimal = [&] {
            std::string text = std::to_string(random.real(-2, 2));
            text.resize(text.size() - static_cast<std::size_t>(random.integer(0, 5)));
            return text;
        };
        rows.push_back(decimal() + " " + decimal() + " 255 " + decimal());
    }
    for (int i = 0; i < kFaces; ++i) {
        rows.push_back("3");
        for (int k = 0; k < 3; ++k) rows.back() += " " + std::to_string(random.integer(0, kVertices - 1));
    }
    return rows;
}

std::string file_of(const std::vector<std::string>& rows) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(kVertices) +
                       "\nproperty float x\nproperty float y\nproperty uchar red\nproperty float z\nelement face " +
                       std::to_string(kFaces) + "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const std::string& row : rows) text += row + "\n";
    return text;
}

/// On how many threads a file is read must not show either.
class PlainPly : public testing::TestWithParam<int> {
  protected:
    PolygonSoup read(const std::vector<std::string>& rows) {
        return read_ply(folder_.write("part.ply", file_of(rows)), GetParam());
    }
    testing::AssertionResult refuses(const std::vector<std::string>& rows, std::initializer_list<std::string_view> parts) {
        const auto read_it = [](const std::string& path) { return read_ply(path, GetParam()); };
        return test::refuses(read_it, folder_.write("part.ply", file_of(rows)), parts);
    }
    test::TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Threads, PlainPly, testing::Values(1, 2, 5));

TEST_P(PlainPly, UnusualSpellingsMeanTheSame) {
    const std::vector<std::string> plain = plain_rows();
    const PolygonSoup expected = read(plain);
    EXPECT_EQ(expected.positions, read_ply(folder_.file("part.ply")).positions);
    EXPECT_EQ(expected.corners, read_ply(folder_.file("part.ply")).corners);
    ASSERT_EQ(expected.positions.size(), static_cast<std::size_t>(kVertices));
    ASSERT_EQ(expected.corners.size(), static_cast<std::size_t>(3 * kFaces));
    EXPECT_TRUE(expected.polygon_ends.empty());
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Random random(seed);
        std::vector<std::string> rows = plain;
        const int rarity = seed % 2 == 0 ? 4 : 400;
        for (std::string& row : rows) {
            const std::size_t blank = row.find(' ');
            switch (random.integer(0, rarity)) {
                case 0: row = "\t" + row.substr(0, blank) + "  \t" + row.substr(blank) + " \r"; break;
                case 1: row = row[0] == '-' ? row : "+" + row; break;
                case 2: row = row.substr(0, blank) + "\n\n" + row.substr(blank + 1); break;
                case 4: row = row.find('.') < blank ? row.substr(0, blank) + "e0" + row.substr(blank) : row; break;
                case 3: row.insert(row[0] == '-' ? 1 : 0, "00000000000000000000"); break;
                default: break;
            }
        }
        const PolygonSoup soup = read(rows);
        ASSERT_EQ(soup.positions, expected.positions) << "seed " << seed;
        ASSERT_EQ(soup.corners, expected.corners) << "seed " << seed;
        ASSERT_TRUE(soup.polygon_ends.empty());
    }
}

TEST_P(PlainPly, OtherPolygonsMayFollowAnywhere) {
    for (const int at : {0, 1, 1023, 1024, 1025, 2048, kFaces - 1}) {
        std::vector<std::string> rows = plain_rows();
        rows[static_cast<std::size_t>(kVertices + at)] = "4 0 1 2 3";
        const PolygonSoup soup = read(rows);
        ASSERT_EQ(soup.polygon_count(), static_cast<std::size_t>(kFaces));
        for (int i = 0; i < kFaces; ++i) ASSERT_EQ(soup.polygon(static_cast<std::size_t>(i)).size(), i == at ? 4u : 3u) << i;
    }
}

TEST_P(PlainPly, ErrorsNameTheLine) {
    const auto refused = [&](int row, const std::string& text, std::string_view what) {
        std::vector<std::string> rows = plain_rows();
        rows[static_cast<std::size_t>(row)] = text;
        const std::string place = ":" + std::to_string(kFirstVertexLine + row) + ":";
        return refuses(rows, {place, what});
    };
    for (const int row : {0, 1, 500, 1023, 1024, 1025, kVertices - 1}) {
        EXPECT_TRUE(refused(row, "0 x 255 0", "no number")) << row;
        EXPECT_TRUE(refused(row, "0 1e31 255 0", "beyond 1e30")) << row;
    }
    for (const int row : {0, 1, 1023, 1024, 1025, kFaces - 1}) {
        EXPECT_TRUE(refused(kVertices + row, "3 0 1.5 2", "no number")) << row;
        EXPECT_TRUE(refused(kVertices + row, "3 0 -1 2", "vertex -1 does not exist")) << row;
        EXPECT_TRUE(refused(kVertices + row, "3 0 1500 2", "vertex 1500 does not exist")) << row;
        EXPECT_TRUE(refused(kVertices + row, "3 0 99999999 2", "vertex 99999999 does not exist")) << row;
    }
}

TEST_P(PlainPly, ARowWithANumberTooFewShiftsAllThatFollow) {
    for (const int row : {1, 300, kVertices - 1}) {
        std::vector<std::string> rows = plain_rows();
        std::string& text = rows[static_cast<std::size_t>(row)];
        text = "0.000001 " + text.substr(text.rfind(' ') + 1) + " 255";
        EXPECT_TRUE(refuses(rows, {"ends in the middle"})) << row;
    }
}

TEST_P(PlainPly, AFileThatEndsTooEarlyIsRefused) {
    std::vector<std::string> rows = plain_rows();
    rows.back() = "3 0 1";
    EXPECT_TRUE(refuses(rows, {"ends in the middle"}));
}

/// No piece's rows are read a second time by one thread.
TEST(PlyPieces, AllAreUsed) {
    std::string text;
    std::vector<glm::dvec3> expected;
    for (int i = 0; i < kVertices; ++i) {
        expected.emplace_back(0.5 * i, -0.25 * i, 1e-3);
        text += std::to_string(0.5 * i) + " " + std::to_string(-0.25 * i) + (i % 7 == 0 ? " 1e-3\n" : " 0.001\n");
    }
    AsciiValues values(text, 1);
    LineCutter cutter(values.rest(), values.line(), text.size() / 10);
    std::atomic<int> pieces = 0;
    std::vector<glm::dvec3> positions(expected.size());
    LargestIndex largest;
    const auto read_piece = [&](AsciiValues& piece, std::uint64_t first, std::uint64_t count, LargestIndex&) {
        ++pieces;
        return read_position_rows(piece, std::array{0, 1, 2}, std::span(positions).subspan(first, count));
    };
    EXPECT_EQ(read_in_pieces(values, cutter, expected.size(), 4, largest, read_piece), expected.size());
    EXPECT_TRUE(values.at_end());
    EXPECT_EQ(positions, expected);
    EXPECT_GE(pieces, 10);
}

TEST(LineCutter, PiecesBeginWithLinesAndKnowThem) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        std::string text;
        for (int i = random.integer(0, 400); i > 0; --i) text += random.integer(0, 1 + static_cast<int>(seed) % 9) == 0 ? '\n' : 'x';
        const std::size_t size = static_cast<std::size_t>(random.integer(1, 50));
        LineCutter cutter(text, 7, size);
        const std::size_t most = cutter.most_left();
        std::size_t count = 0;
        const char* behind = text.data();  // the piece before begins in front of it
        for (; cutter.next() != nullptr; cutter.take(), ++count) {
            const TextPiece piece = *cutter.next();
            const auto place = static_cast<std::size_t>(piece.begin - text.data());
            EXPECT_GE(piece.begin, behind);
            behind = piece.begin + 1;
            EXPECT_TRUE(place == 0 || text[place - 1] == '\n');
            EXPECT_EQ(piece.line, 7u + static_cast<std::size_t>(std::count(text.data(), text.data() + place, '\n')));
            EXPECT_TRUE(count > 0 || place == 0);
        }
        EXPECT_LE(count, most);
        EXPECT_GE(count, 1u);
    }
}

}  // namespace
}  // namespace burin
