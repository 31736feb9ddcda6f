#include "mesh/spatial_order.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/huge_pages.h"
#include "base/interrupt.h"

namespace burin {
namespace {

constexpr std::int32_t kCellsAlong = 32;  // cells of some hundred triangles in a mesh of a million
constexpr std::size_t kCells = std::size_t{kCellsAlong} * kCellsAlong * kCellsAlong;

/// The cell of each position.
UnfilledVector<std::uint16_t> find_cells(std::span<const glm::vec3> positions) {
    glm::vec3 low = positions[0], high = low;
    for (const glm::vec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    // Halves, for the whole size may be too large for a number.
    const glm::vec3 half = 0.5f * high - 0.5f * low;
    const float largest = std::max({half.x, half.y, half.z});
    constexpr float kLeast = 1e-30f;  // the quotient is to be a number
    const float half_per_length = largest > kLeast ? 0.5f * kCellsAlong / largest : 0.0f;
    const auto along = [half_per_length](float p, float first) {
        return std::min(static_cast<std::int32_t>((0.5f * p - 0.5f * first) * half_per_length), kCellsAlong - 1);
    };
    UnfilledVector<std::uint16_t> cells;
    reserve_large(cells, positions.size());
    cells.resize(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::vec3& p = positions[i];
        const std::int32_t cell = (along(p.z, low.z) * kCellsAlong + along(p.y, low.y)) * kCellsAlong + along(p.x, low.x);
        cells[i] = static_cast<std::uint16_t>(cell);
    }
    return cells;
}

}  // namespace

UnfilledVector<std::uint32_t> spatial_order(std::span<const std::uint32_t> corners, std::span<const glm::vec3> positions) {
    static_assert(kCells <= std::size_t{1} << 16);
    UnfilledVector<std::uint32_t> order;
    if (corners.empty()) return order;
    const UnfilledVector<std::uint16_t> cells = find_cells(positions);
    const std::size_t count = corners.size() / 3;
    UnfilledVector<std::uint16_t> cell_of;  // triangles
    reserve_large(cell_of, count);
    cell_of.resize(count);
    std::vector<std::uint32_t> next(kCells + 1, 0);  // place in `order`, of each cell
    for (std::size_t t = 0; t < count; ++t) {
        const std::uint32_t* const c = &corners[3 * t];
        const std::uint16_t cell = std::min(std::min(cells[c[0]], cells[c[1]]), cells[c[2]]);
        cell_of[t] = cell;
        ++next[cell + 1u];
    }
    throw_if_interrupted();
    std::partial_sum(next.begin(), next.end(), next.begin());
    reserve_large(order, count);
    order.resize(count);
    for (std::size_t t = 0; t < count; ++t) order[next[cell_of[t]]++] = static_cast<std::uint32_t>(t);
    return order;
}

}  // namespace burin
