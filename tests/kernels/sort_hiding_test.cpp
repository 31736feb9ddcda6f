// Triangles that may hide lines, sorted to blocks.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "kernels/screen_triangles.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

using Entry = std::tuple<std::uint32_t, std::uint32_t, float, float, float, float, float, float, float>;

Entry entry(std::uint32_t block, const CrossedTriangle& t) {
    return {block, t.number, t.x[0], t.x[1], t.x[2], t.y[0], t.y[1], t.y[2], t.highest};
}

/// One triangle after the other, one block after the other, one cell after the other.
std::vector<Entry> sort_slowly(const ScreenMesh& mesh, const std::vector<std::uint32_t>& listed, const HidingGrid& grid,
                               const std::vector<float>& cells, std::vector<std::uint32_t>& others) {
    constexpr int kBlock = 1 << HidingGrid::kShift, kCell = 1 << HidingGrid::kCellShift;
    std::vector<Entry> found;
    for (const std::uint32_t t : listed) {
        const auto corner = [&](std::uint32_t k) { return mesh.vertices[mesh.corners[3 * t + k]]; };
        const ScreenVertex a = corner(0), b = corner(1), c = corner(2);
        const int x0 = std::min({a.x, b.x, c.x}) - grid.first_x, x1 = std::max({a.x, b.x, c.x}) - grid.first_x;
        const int y0 = std::min({a.y, b.y, c.y}) - grid.first_y, y1 = std::max({a.y, b.y, c.y}) - grid.first_y;
        const Facing facing = doubled_area(a, b, c) > 0 ? clockwise : counterclockwise;
        const CrossedTriangle flat = crossed_triangle(a, b, c, facing, mesh.first_number + t);
        std::vector<Entry> own;
        int first_column = 1 << 30, last_column = -1, first_row = 1 << 30, last_row = -1;
        for (int row = 0; row < grid.rows; ++row) {
            for (int column = 0; column < grid.columns; ++column) {
                const bool touches_x = x0 - grid.reach < (column + 1) * kBlock && x1 + grid.reach >= column * kBlock;
                const bool touches_y = y0 - grid.reach < (row + 1) * kBlock && y1 + grid.reach >= row * kBlock;
                if (!touches_x || !touches_y) continue;
                first_column = std::min(first_column, column);
                last_column = std::max(last_column, column);
                first_row = std::min(first_row, row);
                last_row = std::max(last_row, row);
                // What lies beside the block is in the cells at its end.
                bool is_nearer = false;
                for (int y = 0; y < 2; ++y) {
                    for (int x = 0; x < 2; ++x) {
                        const auto is_in = [&](int low, int high, int block, int cell) {
                            const bool begins = cell == 0 || high >= block * kBlock + kCell;
                            return begins && (cell == 1 || low < block * kBlock + kCell);
                        };
                        if (!is_in(x0, x1, column, x) || !is_in(y0, y1, row, y)) continue;
                        const int cell = (2 * row + y) * 2 * grid.columns + 2 * column + x;
                        is_nearer = is_nearer || flat.highest > cells[static_cast<std::size_t>(cell)];
                    }
                }
                if (is_nearer) own.push_back(entry(static_cast<std::uint32_t>(row * grid.columns + column), flat));
            }
        }
        if (last_column - first_column > 1 || last_row - first_row > 1) {
            others.push_back(t);
        } else {
            found.insert(found.end(), own.begin(), own.end());
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

TEST(SortHiding, TrianglesAreFoundInBlocksWhereTheyAreNearer) {
    std::size_t found_count = 0, other_count = 0, tried = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const auto integer = [&](int low, int high) { return random.integer(low, high); };
        HidingGrid grid{integer(-9000, 9000), integer(-9000, 9000), integer(1, 9),
                        integer(1, 9),        integer(0, 5),        nullptr};
        std::vector<float> cells(static_cast<std::size_t>(4 * grid.columns * grid.rows));
        for (float& nearness : cells) nearness = integer(0, 3) == 0 ? 1e30f : static_cast<float>(integer(0, 8));
        std::vector<float> farthest(HidingGrid::kPlaces * static_cast<std::size_t>(grid.columns * grid.rows));
        for (int i = 0; i < grid.columns * grid.rows; ++i) {
            const auto cell = [&](int x, int y) {
                return cells[static_cast<std::size_t>((2 * (i / grid.columns) + y) * 2 * grid.columns +
                                                      2 * (i % grid.columns) + x)];
            };
            for (const auto& [low_x, high_x] : {std::pair{0, 0}, {0, 1}, {1, 1}}) {
                for (const auto& [low_y, high_y] : {std::pair{0, 0}, {0, 1}, {1, 1}}) {
                    farthest[HidingGrid::kPlaces * static_cast<std::size_t>(i) +
                             HidingGrid::place(low_x, high_x, low_y, high_y)] =
                        std::min({cell(low_x, low_y), cell(high_x, low_y), cell(low_x, high_y), cell(high_x, high_y)});
                }
            }
        }
        grid.farthest = farthest.data();
        const int size = 1 << integer(3, 13);
        const std::uint32_t count = 40;
        std::vector<ScreenVertex> vertices;
        std::vector<std::uint32_t> corners;
        for (std::uint32_t t = 0; t < count; ++t) {
            const int x = grid.first_x + integer(-3000, 2048 * grid.columns + 3000);
            const int y = grid.first_y + integer(-3000, 2048 * grid.rows + 3000);
            for (int k = 0; k < 3; ++k) {
                corners.push_back(static_cast<std::uint32_t>(vertices.size()));
                vertices.push_back({x + integer(0, size), y + integer(0, size), static_cast<float>(integer(0, 8))});
            }
        }
        ScreenMesh mesh;
        mesh.vertices = vertices.data();
        mesh.corners = corners.data();
        mesh.first_number = static_cast<std::uint32_t>(integer(0, 1000));
        std::vector<std::uint32_t> listed;
        for (std::uint32_t t = 0; t < count; ++t) {
            if (integer(0, 2) != 0) listed.push_back(t);
        }
        std::vector<std::uint32_t> expected_others;
        const std::vector<Entry> expected = sort_slowly(mesh, listed, grid, cells, expected_others);
        for (const TileKernels* kernels : all_kernels()) {
            std::vector<HidingInBlock> found(4 * listed.size());
            std::vector<std::uint32_t> others(listed.size());
            std::size_t others_found = 0;
            found.resize(kernels->fine.sort_hiding(mesh, listed.data(), listed.size(), grid, found.data(),
                                                   others.data(), &others_found));
            others.resize(others_found);
            std::vector<Entry> entries;
            for (const HidingInBlock& f : found) entries.push_back(entry(f.block, f.triangle));
            std::sort(entries.begin(), entries.end());
            EXPECT_EQ(entries, expected) << kernels->name << " seed " << seed;
            EXPECT_EQ(others, expected_others) << kernels->name << " seed " << seed;
        }
        found_count += expected.size();
        other_count += expected_others.size();
        tried += listed.size();
    }
    EXPECT_GT(found_count, tried / 8);
    EXPECT_GT(other_count, 100u);
}

}  // namespace
}  // namespace burin
