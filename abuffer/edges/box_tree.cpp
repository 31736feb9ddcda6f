#include "abuffer/edges/box_tree.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace burin {
namespace {

constexpr int kBitsPerAxis = 13, kDigitBits = 13;
constexpr std::size_t kTaskLevel = 3;
// Neighbours of a patch on a surface are about eight.
constexpr std::size_t kMostPartners = 256, kLeastTasks = 1 << 14;
constexpr float kLastPlace = (1 << kBitsPerAxis) - 1;

ScreenBox around(const ScreenBox& a, const ScreenBox& b) {
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0),   std::max(a.x1, b.x1),
            std::max(a.y1, b.y1), std::min(a.low, b.low), std::max(a.high, b.high)};
}

/// Two zeros in front of each of up to 16 bits.
std::uint64_t spread(std::uint64_t v) {
    v = (v | v << 16) & 0x0000FF0000FFu;
    v = (v | v << 8) & 0x00F00F00F00Fu;
    v = (v | v << 4) & 0x0C30C30C30C3u;
    return (v | v << 2) & 0x249249249249u;
}

struct Key {
    std::uint64_t place;  // along the curve of Morton (1966)
    std::uint32_t number;
};

void sort_by_place(std::vector<Key>& keys) {
    std::vector<Key> sorted(keys.size());
    for (int shift = 0; shift < 3 * kBitsPerAxis; shift += kDigitBits) {
        std::array<std::size_t, (std::size_t{1} << kDigitBits) + 1> first{};
        const auto digit = [shift](const Key& k) { return k.place >> shift & ((1u << kDigitBits) - 1u); };
        for (const Key& k : keys) ++first[digit(k) + 1];
        for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
        for (const Key& k : keys) sorted[first[digit(k)]++] = k;
        keys.swap(sorted);
    }
}

}  // namespace

BoxTree::BoxTree(std::span<const ScreenBox> boxes, const TileKernels& kernels, int threads) : kernels_(kernels) {
    sort(boxes, threads);
    levels_.emplace_back();
    levels_[0].resize(order_.size());
    parallel_for_each(order_.size(), threads, [&](std::size_t i) { levels_[0].set(i, boxes[order_[i]]); });
    do {
        const ScreenBoxes& below = levels_.back();
        ScreenBoxes level;
        level.resize((below.size() + kFan - 1) / kFan);
        parallel_for_each(level.size(), threads, [&](std::size_t i) {
            ScreenBox all = below[kFan * i];
            for (std::size_t k = kFan * i + 1; k < std::min(kFan * (i + 1), below.size()); ++k)
                all = around(all, below[k]);
            level.set(i, all);
        });
        levels_.push_back(std::move(level));
    } while (levels_.back().size() > 1);
    task_level_ = std::min(kTaskLevel, levels_.size() - 1);
}

std::optional<std::vector<BoxTree::NodePair>> BoxTree::tasks() const {
    std::vector<NodePair> pairs, next;
    if (order_.empty()) return pairs;
    pairs.push_back({0, 0});
    const std::size_t most = kLeastTasks + kMostPartners * levels_[task_level_].size();
    for (std::size_t level = levels_.size() - 1; level > task_level_; --level) {
        next.clear();
        for (const NodePair& p : pairs) {
            for_parts(level, p, [&](const NodePair& parts) { next.push_back(parts); });
            if (next.size() > most) return std::nullopt;
        }
        pairs.swap(next);
    }
    return pairs;
}

void BoxTree::sort(std::span<const ScreenBox> boxes, int threads) {
    order_.resize(boxes.size());
    if (boxes.empty()) return;
    ScreenBox all = boxes[0];
    for (const ScreenBox& b : boxes) all = around(all, b);
    const float most = std::max({all.x1 - all.x0, all.y1 - all.y0, all.high - all.low});
    const float scale = most > 0 ? kLastPlace / most : 0.0f;
    std::vector<Key> keys(boxes.size());
    const auto bits = [scale](float low, float high, float zero) {
        const float place = (0.5f * (low - zero) + 0.5f * (high - zero)) * scale;
        return spread(place > 0 ? static_cast<std::uint64_t>(std::min(place, kLastPlace)) : 0);
    };
    parallel_for_each(boxes.size(), threads, [&](std::size_t i) {
        const ScreenBox& b = boxes[i];
        keys[i] = {bits(b.x0, b.x1, all.x0) | bits(b.y0, b.y1, all.y0) << 1 | bits(b.low, b.high, all.low) << 2,
                   static_cast<std::uint32_t>(i)};
    });
    sort_by_place(keys);
    for (std::size_t i = 0; i < keys.size(); ++i) order_[i] = keys[i].number;
}

}  // namespace burin
