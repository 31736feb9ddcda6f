#include "mesh/vertex_welder.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "base/huge_pages.h"
#include "base/unfilled_vector.h"

namespace burin {
namespace {

std::uint32_t hash(const glm::vec3& p) {
    const std::uint64_t xy = std::uint64_t{std::bit_cast<std::uint32_t>(p.x)} << 32 | std::bit_cast<std::uint32_t>(p.y);
    std::uint64_t h = xy * 0x9E3779B97F4A7C15u;
    h = (h ^ h >> 32 ^ std::bit_cast<std::uint32_t>(p.z)) * 0xD6E8FEB86659FD93u;
    return static_cast<std::uint32_t>(h >> 32);
}

/// A set of numbers, which are taken modulo a power of two: at least 16 for each of the `count` numbers that it will
/// have.
class SmallSet {
  public:
    explicit SmallSet(std::size_t count)
        : words_(large_vector<std::uint64_t>(std::bit_ceil(std::max<std::size_t>(4, count / 4)))) {}

    bool has(std::uint32_t number) const { return (words_[place(number)] >> number % 64 & 1) != 0; }
    void add(std::uint32_t number) { words_[place(number)] |= std::uint64_t{1} << number % 64; }

  private:
    std::size_t place(std::uint32_t number) const { return number / 64 & (words_.size() - 1); }
    std::vector<std::uint64_t> words_;
};

/// Whether vertices are mostly equal to others, as where each triangle has its own: as far as the first ones tell.
bool have_many_again(std::span<const std::uint32_t> hashes) {
    const std::span tried = hashes.first(std::min<std::size_t>(hashes.size(), 1 << 14));
    SmallSet met(tried.size());
    std::size_t again = 0;
    for (const std::uint32_t h : tried) {
        again += met.has(h) ? 1 : 0;
        met.add(h);
    }
    return 4 * again > tried.size();
}

/// first[v] for vertices in ascending order, as weld_vertices() has it: there are no equal ones but among these.
void weld(std::span<const glm::vec3> positions, std::span<const std::uint32_t> vertices,
          std::span<const std::uint32_t> hashes, std::vector<std::uint32_t>& first) {
    constexpr std::uint32_t kEmpty = 0xFFFFFFFFu;
    const std::size_t mask = std::bit_ceil(std::max<std::size_t>(16, 2 * vertices.size())) - 1;
    std::vector<std::uint32_t> table = large_vector(mask + 1, kEmpty);
    constexpr std::size_t kAhead = 32;  // the table may be far larger than the nearest caches
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        __builtin_prefetch(&table[hashes[vertices[std::min(i + kAhead, vertices.size() - 1)]] & mask], 1);
        const std::uint32_t v = vertices[i];
        std::size_t slot = hashes[v] & mask;
        while (table[slot] != kEmpty && positions[table[slot]] != positions[v]) slot = (slot + 1) & mask;
        if (table[slot] == kEmpty) table[slot] = v;
        first[v] = table[slot];
    }
}

}  // namespace

std::vector<std::uint32_t> weld_vertices(std::span<const glm::vec3> positions) {
    const std::size_t count = positions.size();
    std::vector<std::uint32_t> first, doubtful;
    reserve_large(first, count);
    first.resize(count);
    std::iota(first.begin(), first.end(), 0u);
    // Where most have a hash of their own, these need not be looked for. Which have not is told by sets that the caches
    // hold.
    UnfilledVector<std::uint32_t> hashes;
    reserve_large(hashes, count);
    hashes.resize(count);
    for (std::size_t v = 0; v < count; ++v) hashes[v] = hash(positions[v]);
    if (have_many_again(hashes)) {
        doubtful = first;
    } else {
        SmallSet met(count), met_again(count);
        for (const std::uint32_t h : hashes) {
            if (met.has(h)) met_again.add(h);
            met.add(h);
        }
        for (std::size_t v = 0; v < count; ++v) {
            if (met_again.has(hashes[v])) doubtful.push_back(static_cast<std::uint32_t>(v));
        }
    }
    weld(positions, doubtful, hashes, first);
    return first;
}

}  // namespace burin
