#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kernels/screen_boxes.h"
#include "kernels/tile_kernels.h"

// Pairs of triangles that may meet are found by a tree of their boxes.

namespace burin {

/// BoxTree takes boxes in space, in an order that keeps neighbours together, eight to a leaf, eight leaves to a node
/// and so on, and finds all pairs that overlap. The third axis is ScreenBox's range of nearness.
class BoxTree {
  public:
    BoxTree(std::span<const ScreenBox> boxes, const TileKernels& kernels, int threads);

    /// Two nodes of one level, which overlap.
    struct NodePair {
        std::uint32_t a, b;  // a <= b
    };
    /// Pairs of large nodes that all pairs of boxes are in, each once. Nothing if these nodes overlap that many others
    /// that it is no use to have a tree.
    std::optional<std::vector<NodePair>> tasks() const;

    /// The numbers of the boxes, as given, in the tree's order.
    std::span<const std::uint32_t> order() const { return order_; }

    /// Calls visit(a, b, found) for pairs of leaves in a task, by the places of their first boxes in that order;
    /// `found` says which of their boxes overlap, see for_bits().
    template <typename Visit>
    void for_leaf_pairs(const NodePair& task, const Visit& visit) const {
        descend(task_level_, task, visit);
    }
    /// Calls visit(i, k) for the bits of TileKernels::Intersect::find_overlaps().
    template <typename Visit>
    static void for_bits(std::uint64_t found, const Visit& visit) {
        for (; found != 0; found &= found - 1) {
            const auto bit = static_cast<std::uint32_t>(std::countr_zero(found));
            visit(bit / kFan, bit % kFan);
        }
    }

  private:
    static constexpr std::uint32_t kFan = 8;

    /// Which parts overlap of two nodes of a level above the boxes.
    std::uint64_t overlaps(std::size_t level, const NodePair& nodes) const {
        const ScreenBoxes& parts = levels_[level - 1];
        const auto end = static_cast<std::uint32_t>(parts.size());
        const std::uint32_t a = nodes.a * kFan, b = nodes.b * kFan;
        const std::uint64_t found =
            kernels_.intersect.find_overlaps(parts.view(), a, std::min(kFan, end - a), b, std::min(kFan, end - b));
        // Bits of the pairs within one node: every pair once; a box overlaps itself, which says nothing.
        constexpr std::uint64_t kBehind = 0x0080C0E0F0F8FCFEu, kBehindOrSame = 0x80C0E0F0F8FCFEFFu;
        return a == b ? found & (level == 1 ? kBehind : kBehindOrSame) : found;
    }
    template <typename Visit>
    void for_parts(std::size_t level, const NodePair& nodes, const Visit& visit) const {
        for_bits(overlaps(level, nodes), [&](std::uint32_t i, std::uint32_t k) {
            visit(NodePair{nodes.a * kFan + i, nodes.b * kFan + k});
        });
    }
    template <typename Visit>
    void descend(std::size_t level, const NodePair& nodes, const Visit& visit) const {
        if (level == 1) return visit(nodes.a * kFan, nodes.b * kFan, overlaps(1, nodes));
        for_parts(level, nodes, [&](const NodePair& p) { descend(level - 1, p, visit); });
    }

    void sort(std::span<const ScreenBox> boxes, int threads);

    const TileKernels& kernels_;
    std::vector<std::uint32_t> order_;
    std::vector<ScreenBoxes> levels_;  // the boxes, leaves, nodes; of the last one there is one
    std::size_t task_level_ = 1;
};

}  // namespace burin
