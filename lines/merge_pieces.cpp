#include "lines/merge_pieces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

namespace burin {
namespace {

constexpr double kStraightPx = 1.0 / 2048;

/// Turns a piece round so that it runs from left to right, or downwards. Which way it runs would be an unpredictable
/// branch, so there is none.
void put_in_order(LinePiece& s) {
    const bool turns = !((s.from.x < s.to.x) | ((s.from.x == s.to.x) & (s.from.y < s.to.y)));
    const glm::dvec2 ends[2] = {s.from, s.to};
    const float nearness[2] = {s.nearness_from, s.nearness_to};
    const std::size_t first = turns ? 1 : 0;
    s.from = ends[first];
    s.to = ends[1 - first];
    s.nearness_from = nearness[first];
    s.nearness_to = nearness[1 - first];
    s.front_on_left = s.front_on_left != turns;
}

/// Blocks are put in order by a few bits of their place first: of those of one tile, hardly two have the same.
constexpr std::size_t kBuckets = 256;
std::size_t bucket_of(std::uint32_t block) { return (block >> 16 & 15u) << 4 | (block & 15u); }

bool is_before(const LinePiece& a, const LinePiece& b) {
    if (a.block != b.block) return a.block < b.block;
    if (a.line != b.line) return a.line < b.line;
    if (a.from.x != b.from.x) return a.from.x < b.from.x;
    if (a.from.y != b.from.y) return a.from.y < b.from.y;
    if (a.to.x != b.to.x) return a.to.x < b.to.x;
    return a.to.y != b.to.y ? a.to.y < b.to.y : a.opacity < b.opacity;
}

bool continues(const LinePiece& a, const LinePiece& b) {
    const bool is_same_line = a.line == b.line && a.drawn_as == b.drawn_as && a.is_drawn == b.is_drawn &&
                              a.opacity == b.opacity && a.block == b.block;
    if (!is_same_line || a.to != b.from || a.front_on_left != b.front_on_left) return false;
    const glm::dvec2 along = b.to - a.from, bend = a.to - a.from;
    const double area = along.x * bend.y - along.y * bend.x;
    return area * area <= kStraightPx * kStraightPx * glm::dot(along, along) && glm::dot(along, bend) > 0;
}

}  // namespace

void PieceMerger::sort(std::span<std::uint32_t> order, std::span<const LinePiece> pieces) const {
    if (sort_few(order, pieces)) return;
    std::sort(order.begin(), order.end(),
              [pieces](std::uint32_t a, std::uint32_t b) { return is_before(pieces[a], pieces[b]); });
}

/// Sorts the pieces of one block of an ordinary picture by numbers that say nearly all, without branches: these would
/// be unpredictable. Returns false where the numbers cannot.
bool PieceMerger::sort_few(std::span<std::uint32_t> order, std::span<const LinePiece> pieces) const {
    // A number says the line, where on it, and which piece: in 32, 23 and 6 bits behind the exponent's first one.
    constexpr int kIndexBits = 6, kPlaceBits = 23;
    constexpr std::size_t kFew = std::size_t{1} << kIndexBits;
    constexpr std::uint64_t kExponent = std::uint64_t{1} << 62;
    constexpr double kPerPx = 1 << 19, kBeyondPx = 4;
    if (order.size() > kFew) return false;
    const LinePiece& first = pieces[order[0]];
    const double begin = kMergeBlockPx * static_cast<std::int16_t>(first.block & 0xFFFFu) - kBeyondPx;
    std::array<double, kFew + 4> keys, sorted;  // with what the kernel reads behind
    bool fits = true;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const LinePiece& s = pieces[order[i]];
        const double place = (s.from.x - begin) * kPerPx;
        const bool is_inside = (place >= 0) & (place < 1 << kPlaceBits);
        fits &= (s.block == first.block) & (s.line.group() == first.line.group()) & is_inside;
        const std::uint64_t key =
            std::uint64_t{s.line.member()} << kPlaceBits | static_cast<std::uint32_t>(is_inside ? place : 0.0);
        keys[i] = std::bit_cast<double>(kExponent | key << kIndexBits | i);
    }
    if (!fits) return false;
    std::fill_n(keys.begin() + static_cast<std::ptrdiff_t>(order.size()), 4, 0.0);
    kernels_.sort.few(keys.data(), order.size(), sorted.data());
    std::array<std::uint32_t, kFew> given;
    std::copy(order.begin(), order.end(), given.begin());
    std::uint64_t before = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto key = std::bit_cast<std::uint64_t>(sorted[i]);
        order[i] = given[key % kFew];
        if (__builtin_expect((key ^ before) < kFew, 0)) {  // at one place: what else they have says more
            for (std::size_t at = i; at > 0 && is_before(pieces[order[at]], pieces[order[at - 1]]); --at)
                std::swap(order[at], order[at - 1]);
        }
        before = key;
    }
    return true;
}

void PieceMerger::merge(std::span<LinePiece> pieces, std::vector<LinePiece>& merged) {
    std::array<std::uint32_t, kBuckets> next{};
    std::array<std::uint64_t, kBuckets / 64> used{};  // a bit per bucket: few have any
    for (LinePiece& s : pieces) {
        put_in_order(s);
        const std::size_t bucket = bucket_of(s.block);
        ++next[bucket];
        used[bucket / 64] |= std::uint64_t{1} << bucket % 64;
    }
    const auto for_used = [&used](const auto& visit) {
        for (std::size_t word = 0; word < used.size(); ++word) {
            for (std::uint64_t bits = used[word]; bits != 0; bits &= bits - 1) {
                visit(64 * word + static_cast<std::size_t>(std::countr_zero(bits)));
            }
        }
    };
    std::uint32_t sum = 0;
    for_used([&](std::size_t bucket) { sum += std::exchange(next[bucket], sum); });
    order_.resize(pieces.size());
    for (std::uint32_t i = 0; i < order_.size(); ++i) order_[next[bucket_of(pieces[i].block)]++] = i;
    std::size_t begin = 0;
    for_used([&](std::size_t bucket) {
        const std::span<std::uint32_t> order(order_.data() + begin, next[bucket] - begin);
        begin = next[bucket];
        sort(order, pieces);
        bool is_first = true;
        for (const std::uint32_t i : order) {
            const LinePiece& piece = pieces[i];
            if (!is_first && continues(merged.back(), piece)) {
                LinePiece& last = merged.back();
                extend(last, piece);
                last.occludes = last.occludes || piece.occludes;
                last.classes |= piece.classes;
            } else {
                merged.push_back(piece);
            }
            is_first = false;
        }
    });
}

void PieceIndex::set(std::span<const LinePiece> merged) {
    static_assert(kBuckets == burin::kBuckets);
    merged_ = merged;
    keys_.resize(merged.size());
    std::size_t bucket = 0;
    for (std::uint32_t i = 0; i < merged.size(); ++i) {
        keys_[i] = {merged[i].line, merged[i].block};
        for (const std::size_t own = bucket_of(merged[i].block); bucket <= own; ++bucket) begin_[bucket] = i;
    }
    for (; bucket <= kBuckets; ++bucket) begin_[bucket] = static_cast<std::uint32_t>(merged.size());
}

/// There are no branches on what keys are: they would be unpredictable.
std::size_t PieceIndex::first_not_before(std::uint32_t block, LineId line) const {
    const std::size_t bucket = bucket_of(block);
    std::size_t first = begin_[bucket];
    for (std::size_t count = begin_[bucket + 1] - first; count > 0;) {
        const std::size_t half = count / 2;
        const Key& k = keys_[first + half];
        const bool is_before = (k.block < block) | ((k.block == block) & (k.line < line));
        first += is_before ? count - half : 0;
        count = half;
    }
    return first;
}

std::span<const LinePiece> PieceIndex::in_block(std::uint32_t block) const {
    const std::size_t first = first_not_before(block, LineId{0});
    std::size_t last = first;
    while (last < keys_.size() && keys_[last].block == block) ++last;
    return merged_.subspan(first, last - first);
}

std::span<const LinePiece> PieceIndex::of_line(std::uint32_t block, LineId line) const {
    const std::size_t first = first_not_before(block, line);
    std::size_t last = first;
    while (last < keys_.size() && keys_[last].block == block && keys_[last].line == line) ++last;
    return merged_.subspan(first, last - first);
}

}  // namespace burin
