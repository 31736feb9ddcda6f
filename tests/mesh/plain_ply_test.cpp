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

constexpr int kVertices = 3000, kFaces = 6000;  // more than a piece, and more than a block
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
    testing::AssertionResult refuses(const std::vector<std::string>& rows,
                                     std::initializer_list<std::string_view> parts) {
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
                case 0:
                    row = "\t" + row.substr(0, blank) + "  \t" + row.substr(blank) + " \r";
                    break;
                case 1:
                    row = row[0] == '-' ? row : "+" + row;
                    break;
                case 2:
                    row = row.substr(0, blank) + "\n\n" + row.substr(blank + 1);
                    break;
                case 4:
                    row = row.find('.') < blank ? row.substr(0, blank) + "e0" + row.substr(blank) : row;
                    break;
                case 3:
                    row.insert(row[0] == '-' ? 1 : 0, "00000000000000000000");
                    break;
                default:
                    break;
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
        for (int i = 0; i < kFaces; ++i)
            ASSERT_EQ(soup.polygon(static_cast<std::size_t>(i)).size(), i == at ? 4u : 3u) << i;
    }
}

TEST_P(PlainPly, ErrorsNameTheLine) {
    const auto refused = [&](int row, const std::string& text, std::string_view what) {
        std::vector<std::string> rows = plain_rows();
        rows[static_cast<std::size_t>(row)] = text;
        const std::string place = ":" + std::to_string(kFirstVertexLine + row) + ":";
        return refuses(rows, {place, what});
    };
    for (const int row : {0, 1, 500, 1023, 1024, 1025, 2500, kVertices - 1}) {
        EXPECT_TRUE(refused(row, "0 x 255 0", "no number")) << row;
        EXPECT_TRUE(refused(row, "0 1e31 255 0", "beyond 1e30")) << row;
    }
    for (const int row : {0, 1, 1023, 1024, 1025, 5000, kFaces - 1}) {
        EXPECT_TRUE(refused(kVertices + row, "3 0 1.5 2", "no number")) << row;
        EXPECT_TRUE(refused(kVertices + row, "3 0 -1 2", "vertex -1 does not exist")) << row;
        EXPECT_TRUE(refused(kVertices + row, "3 0 3000 2", "vertex 3000 does not exist")) << row;
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

/// Values of a row are told by white space of any kind, also those that are skipped.
TEST_P(PlainPly, SkippedColumnsMayStandOnTheNextLine) {
    constexpr int kRows = 6000;
    Random random(2);
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex " + std::to_string(kRows) +
        "\nproperty float x\nproperty float y\nproperty float z\nproperty float quality\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n";
    std::vector<glm::dvec3> expected;
    for (int i = 0; i < kRows; ++i) {
        expected.emplace_back(0.5 * i, -0.25 * i, 0.125 * random.integer(0, 100));
        const glm::dvec3& p = expected.back();
        text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z);
        text += (i == 0 || i == 10 || random.integer(0, 999) == 0 ? "\n" : " ") + std::to_string(i % 9) + "\n";
    }
    const std::string path = folder_.write("split.ply", text + "3 0 1 " + std::to_string(kRows - 1) + "\n");
    const PolygonSoup soup = read_ply(path, GetParam());
    EXPECT_EQ(soup.positions, expected);
    EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 1, kRows - 1}));
}

LineCutter::Copy copy_of(const std::string& text) {
    return [&text](std::size_t place, std::span<char> to) { text.copy(to.data(), to.size(), place); };
}

/// No piece's rows are read a second time by one thread.
TEST(PlyPieces, AllAreUsed) {
    std::string text;
    std::vector<glm::dvec3> expected;
    for (int i = 0; i < kVertices; ++i) {
        expected.emplace_back(0.5 * i, -0.25 * i, 1e-3);
        text += std::to_string(0.5 * i) + " " + std::to_string(-0.25 * i) + (i % 7 == 0 ? " 1e-3\n" : " 0.001\n");
    }
    for (const int threads : {1, 4}) {
        AsciiValues values(text, 1);
        std::atomic<int> pieces = 0;
        std::vector<glm::dvec3> positions;
        const auto read_piece = [&](AsciiValues& piece, std::span<glm::dvec3> rows) {
            ++pieces;
            return read_position_rows(piece, std::array{0, 1, 2}, rows);
        };
        EXPECT_EQ(
            read_in_pieces(values, copy_of(text), text.size() / 10, threads, expected.size(), 1, positions, read_piece),
            expected.size());
        EXPECT_TRUE(values.at_end());
        EXPECT_EQ(positions, expected);
        EXPECT_GE(pieces, 10);
    }
}

/// Wherever the text is cut, and whatever rows are where it is.
TEST(PlyPieces, CutsDoNotShow) {
    const std::array axis_of{0, 1, 2};
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        std::string text;
        std::size_t rows = 0;
        for (; rows < 60; ++rows) {
            static constexpr std::array<const char*, 8> kRows = {
                "1.5 2.5 -3.5\n",      "1.5 2.5 -3.5 \n",  "1.25 1e1 2\r\n", "\n4.0 5.0\n 6.0\n",
                "1.0 2.0 0.1234567\n", "-1.0 -2.0 -0.0\n", "7 8 9 ",         "1.0 x 2.0\n"};
            text +=
                kRows[static_cast<std::size_t>(random.integer(0, seed % 3 == 0 ? 7 : 1 + static_cast<int>(seed % 6)))];
        }
        if (random.integer(0, 1) == 0) text.pop_back();
        std::vector<glm::dvec3> expected(rows), positions;
        AsciiValues whole(text, 5);
        const std::size_t expected_count = read_position_rows(whole, axis_of, expected);
        AsciiValues values(text, 5);
        const auto read_piece = [&](AsciiValues& piece, std::span<glm::dvec3> place) {
            return read_position_rows(piece, axis_of, place);
        };
        const std::size_t size = static_cast<std::size_t>(random.integer(1, 300));
        std::size_t count =
            read_in_pieces(values, copy_of(text), size, random.integer(1, 3), rows, 1, positions, read_piece);
        EXPECT_LE(count, expected_count);
        ASSERT_EQ(count, positions.size());
        positions.resize(rows);
        count += read_position_rows(values, axis_of, std::span(positions).subspan(count));
        ASSERT_EQ(count, expected_count);
        EXPECT_EQ(values.at_end(), whole.at_end());
        EXPECT_EQ(values.line(), whole.line());
        EXPECT_EQ(values.rest().size(), whole.rest().size());
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(positions[i], expected[i]);
    }
}

TEST(LineCutter, PiecesAreWholeLinesAndKnowThem) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        std::string text;
        for (int i = random.integer(0, 400); i > 0; --i)
            text += random.integer(0, 1 + static_cast<int>(seed) % 9) == 0 ? '\n' : 'x';
        const std::size_t size = static_cast<std::size_t>(random.integer(1, 50));
        LineCutter cutter(text.size(), 7, size, copy_of(text));
        std::vector<char> buffer;
        std::size_t place = 0, line = 7;
        while (const std::optional<TextPiece> piece = cutter.take(buffer)) {
            EXPECT_EQ(piece->place, place);
            EXPECT_EQ(piece->line, line);
            ASSERT_FALSE(piece->text.empty());
            EXPECT_EQ(piece->text, std::string_view(text).substr(place, piece->text.size()));
            EXPECT_EQ(piece->feeds, static_cast<std::size_t>(std::count(piece->text.begin(), piece->text.end(), '\n')));
            const std::string margin(TextPiece::kMargin, '\n');
            EXPECT_EQ(std::string_view(piece->text.data() - margin.size(), margin.size()), margin);
            EXPECT_EQ(std::string_view(piece->text.data() + piece->text.size(), margin.size()), margin);
            place += piece->text.size();
            line += piece->feeds;
            EXPECT_TRUE(piece->text.back() == '\n' || place == text.size());
            EXPECT_EQ(cutter.at_end(), place == text.size());
        }
        EXPECT_EQ(place, text.size());
    }
}

}  // namespace
}  // namespace burin
