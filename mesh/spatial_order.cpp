#include "mesh/spatial_order.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/huge_pages.h"
#include "base/interrupt.h"

namespace burin {
namespace {

constexpr std::int32_t kCellsAlong =
    16;  // cells of some hundred triangles in a mesh of a million; 32 are as good, and take longer
constexpr std::size_t kCells = std::size_t{kCellsAlong} * kCellsAlong * kCellsAlong;

/// Sorts the numbers below `count` by their cells, and in a cell in ascending order. Both halves of them are counted
/// and put to their places at the same time: many that follow each other are in one cell, and each has to wait for the
/// one before.
template <typename CellOf>
UnfilledVector<std::uint32_t> order_by_cell(std::size_t count, const CellOf& cell_of) {
    UnfilledVector<std::uint16_t> cells;
    reserve_large(cells, count);
    cells.resize(count);
    std::vector<std::array<std::uint32_t, 2>> next(
        kCells);  // place of each cell's first one in the first half, and in the second
    const std::size_t half = count / 2;
    const auto for_all = [half, count](const auto& work) {
        for (std::size_t i = 0; i < half; ++i) {
            work(i, 0);
            work(half + i, 1);
        }
        if (2 * half < count) work(count - 1, 1);
    };
    for_all([&](std::size_t i, std::size_t of_half) {
        cells[i] = cell_of(i);
        ++next[cells[i]][of_half];
    });
    throw_if_interrupted();
    std::uint32_t before = 0;
    for (auto& places : next) {
        for (std::uint32_t& place : places) before += std::exchange(place, before);
    }
    UnfilledVector<std::uint32_t> order;
    reserve_large(order, count);
    order.resize(count);
    for_all(
        [&](std::size_t i, std::size_t of_half) { order[next[cells[i]][of_half]++] = static_cast<std::uint32_t>(i); });
    return order;
}

}  // namespace

SpatialOrder::SpatialOrder(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners) {
    static_assert(kCells <= std::size_t{1} << 16);
    if (corners.empty()) return;
    // Some of the corners tell how large the model is; vertices that are none may lie anywhere.
    glm::vec3 low = positions[corners[0]], high = low;
    const std::size_t step = corners.size() / 4096 + 1;
    for (std::size_t i = 0; i < corners.size(); i += step) {
        low = glm::min(low, positions[corners[i]]);
        high = glm::max(high, positions[corners[i]]);
    }
    // Halves are taken, for the whole size may be too large for a number.
    const glm::vec3 half = 0.5f * high - 0.5f * low;
    const float largest = std::max({half.x, half.y, half.z});
    constexpr float kLeast = 1e-30f;  // the quotient is to be a number
    const float per_half = largest > kLeast ? kCellsAlong / largest : 0.0f;
    reserve_large(cells_, positions.size());
    cells_.resize(positions.size());
    constexpr std::size_t kBlock = 64;
    std::array<float, 3 * kBlock> half_low;
    for (std::size_t i = 0; i < half_low.size(); ++i) half_low[i] = 0.5f * low[static_cast<int>(i % 3)];
    for (std::size_t first = 0; first < positions.size(); first += kBlock) {
        const std::size_t count = std::min(kBlock, positions.size() - first);
        const float* const p = &positions[first].x;
        std::array<std::int32_t, 3 * kBlock> along;
        for (std::size_t i = 0; i < 3 * count; ++i) {
            const float cell = (0.5f * p[i] - half_low[i]) * per_half;
            constexpr float kLast = kCellsAlong - 1;
            along[i] = static_cast<std::int32_t>(cell > 0 ? (cell < kLast ? cell : kLast) : 0.0f);
        }
        for (std::size_t i = 0; i < count; ++i) {
            cells_[first + i] = static_cast<std::uint16_t>(
                (along[3 * i + 2] * kCellsAlong + along[3 * i + 1]) * kCellsAlong + along[3 * i]);
        }
    }
}

UnfilledVector<std::uint32_t> SpatialOrder::of_triangles(std::span<const std::uint32_t> corners) const {
    return order_by_cell(corners.size() / 3, [cells = cells_.data(), corners = corners.data()](std::size_t t) {
        const std::uint32_t* const c = corners + 3 * t;
        return std::min(std::min(cells[c[0]], cells[c[1]]), cells[c[2]]);
    });
}

UnfilledVector<std::uint32_t> SpatialOrder::of_polygons(const PolygonSoup& soup,
                                                        std::span<const std::uint32_t> polygons) const {
    return order_by_cell(polygons.size(), [&](std::size_t i) {
        std::uint16_t first = kCells - 1;
        for (const std::uint32_t v : soup.polygon(polygons[i])) first = std::min(first, cells_[v]);
        return first;
    });
}

}  // namespace burin
