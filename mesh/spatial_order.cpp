#include "mesh/spatial_order.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/huge_pages.h"
#include "base/interrupt.h"

namespace burin {
namespace {

constexpr std::int32_t kCellsAlong = 16;  // cells of some hundred triangles in a mesh of a million; 32 are as good, and take longer
constexpr std::size_t kCells = std::size_t{kCellsAlong} * kCellsAlong * kCellsAlong;

/// Numbers below `count` by their cells, and in a cell in ascending order.
template <typename CellOf>
UnfilledVector<std::uint32_t> order_by_cell(std::size_t count, const CellOf& cell_of) {
    UnfilledVector<std::uint16_t> cells;
    reserve_large(cells, count);
    cells.resize(count);
    std::vector<std::uint32_t> next(kCells + 1, 0);  // place of each cell
    for (std::size_t i = 0; i < count; ++i) {
        cells[i] = cell_of(i);
        ++next[cells[i] + 1u];
    }
    throw_if_interrupted();
    std::partial_sum(next.begin(), next.end(), next.begin());
    UnfilledVector<std::uint32_t> order;
    reserve_large(order, count);
    order.resize(count);
    for (std::size_t i = 0; i < count; ++i) order[next[cells[i]]++] = static_cast<std::uint32_t>(i);
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
    // Halves, for the whole size may be too large for a number.
    const glm::vec3 half = 0.5f * high - 0.5f * low;
    const float largest = std::max({half.x, half.y, half.z});
    constexpr float kLeast = 1e-30f;  // the quotient is to be a number
    const float per_half = largest > kLeast ? kCellsAlong / largest : 0.0f;
    const auto along = [per_half](float p, float first) {
        const float cell = (0.5f * p - 0.5f * first) * per_half;
        constexpr float kLast = kCellsAlong - 1;
        return static_cast<std::int32_t>(cell > 0 ? (cell < kLast ? cell : kLast) : 0.0f);
    };
    reserve_large(cells_, positions.size());
    cells_.resize(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::vec3& p = positions[i];
        const std::int32_t cell = (along(p.z, low.z) * kCellsAlong + along(p.y, low.y)) * kCellsAlong + along(p.x, low.x);
        cells_[i] = static_cast<std::uint16_t>(cell);
    }
}

UnfilledVector<std::uint32_t> SpatialOrder::of_triangles(std::span<const std::uint32_t> corners) const {
    return order_by_cell(corners.size() / 3, [cells = cells_.data(), corners = corners.data()](std::size_t t) {
        const std::uint32_t* const c = corners + 3 * t;
        return std::min(std::min(cells[c[0]], cells[c[1]]), cells[c[2]]);
    });
}

UnfilledVector<std::uint32_t> SpatialOrder::of_polygons(const PolygonSoup& soup, std::span<const std::uint32_t> polygons) const {
    return order_by_cell(polygons.size(), [&](std::size_t i) {
        std::uint16_t first = kCells - 1;
        for (const std::uint32_t v : soup.polygon(polygons[i])) first = std::min(first, cells_[v]);
        return first;
    });
}

}  // namespace burin
