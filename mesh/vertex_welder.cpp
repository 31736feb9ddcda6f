#include "mesh/vertex_welder.h"

#include <algorithm>
#include <array>
#include <bit>

#include "base/huge_pages.h"

namespace burin {
namespace {

constexpr std::uint32_t kEmpty = 0xFFFFFFFFu;

std::size_t hash(const glm::vec3& p) {
    const std::uint64_t xy =
        std::uint64_t{std::bit_cast<std::uint32_t>(p.x)} << 32 | std::bit_cast<std::uint32_t>(p.y);
    std::uint64_t h = xy * 0x9E3779B97F4A7C15u;
    h = (h ^ h >> 32 ^ std::bit_cast<std::uint32_t>(p.z)) * 0xD6E8FEB86659FD93u;
    return static_cast<std::size_t>(h ^ h >> 32);
}

}  // namespace

std::vector<std::uint32_t> weld_vertices(std::span<const glm::vec3> positions) {
    const std::size_t mask = std::bit_ceil(std::max<std::size_t>(16, 2 * positions.size())) - 1;
    std::vector<std::uint32_t> table = large_vector(mask + 1, kEmpty);
    std::vector<std::uint32_t> first;
    reserve_large(first, positions.size());
    // The table is far larger than the nearest caches: ask for the places of a batch before the
    // first is looked at.
    constexpr std::size_t kBatch = 32;
    std::array<std::size_t, kBatch> slots;
    for (std::size_t begin = 0; begin < positions.size(); begin += kBatch) {
        const std::size_t count = std::min(kBatch, positions.size() - begin);
        for (std::size_t i = 0; i < count; ++i) {
            slots[i] = hash(positions[begin + i]) & mask;
            __builtin_prefetch(&table[slots[i]], 1);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const auto v = static_cast<std::uint32_t>(begin + i);
            std::size_t slot = slots[i];
            while (table[slot] != kEmpty && positions[table[slot]] != positions[v]) {
                slot = (slot + 1) & mask;
            }
            if (table[slot] == kEmpty) table[slot] = v;
            first.push_back(table[slot]);
        }
    }
    return first;
}

}  // namespace burin
