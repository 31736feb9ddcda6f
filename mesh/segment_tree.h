#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "mesh/four_boxes.h"

// Border segments near a place are found by a tree of boxes.

namespace burin {

/// A straight part of a segment, as the box around it.
struct SegmentPiece {
    glm::vec3 low{0.0f}, high{0.0f};
    std::uint32_t segment = 0;  ///< number of the segment that it is a part of
};

/// One whose box is around another box: numbers that single precision does not hold are rounded outwards.
SegmentPiece piece_around(const glm::dvec3& low, const glm::dvec3& high, std::uint32_t segment);

/// A tree of boxes around pieces of segments, to find those near a place.
class SegmentTree {
  public:
    /// Where boxes are cut in two: where the middles of pieces spread the most; or where they do so beside how wide
    /// pieces are on average, since pieces of a pile of sheets lie over each other along the sheets and not across
    /// them.
    enum class Cut { across_longest, across_thin_boxes };

    SegmentTree() = default;
    explicit SegmentTree(std::span<const SegmentPiece> pieces, Cut cut = Cut::across_longest);

    bool is_empty() const { return nodes_.empty(); }
    /// The segments of all pieces, those of pieces near each other mostly one after the other.
    std::span<const std::uint32_t> segments() const { return segments_; }

    /// Calls visit(segment) for all pieces in boxes of which may_be_near(boxes), an AreNear, says so, until it says
    /// false.
    template <typename MayBeNear, typename Visit>
    void visit_leaves(const MayBeNear& may_be_near, const Visit& visit) const {
        if (nodes_.empty()) return;
        std::uint32_t stack[kMostWaiting];
        int top = 0;
        stack[top++] = 0;
        while (top > 0) {
            const Node& node = nodes_[stack[--top]];
            const FourBoxes::AreNear near = may_be_near(node.boxes);
            for (std::size_t k = 0; k < FourBoxes::kCount; ++k) {
                if (!near[k]) continue;
                if (node.piece_count[k] == 0) {
                    if (node.first[k] == 0) continue;
                    stack[top++] = node.first[k];
                    __builtin_prefetch(&nodes_[node.first[k]]);
                    continue;
                }
                for (std::uint32_t i = node.first[k]; i < node.first[k] + node.piece_count[k]; ++i) {
                    if (!visit(segments_[i])) return;
                }
            }
        }
    }

    /// Calls visit(segment) for all pieces in boxes that may be as near to a point as `reach`, which visit() may lower
    /// meanwhile. Nearer boxes mostly come first.
    template <typename Visit>
    void visit_nearest(const glm::dvec3& at, const double& reach, const Visit& visit) const {
        visit_nearest(
            at, reach,
            [](const FourBoxes&) {
                return FourBoxes::AreNear{true, true, true, true};
            },
            visit);
    }
    /// Visits the nearest pieces in boxes of which may_be_near(boxes) says so.
    template <typename MayBeNear, typename Visit>
    void visit_nearest(const glm::dvec3& at, const double& reach, const MayBeNear& may_be_near,
                       const Visit& visit) const {
        if (nodes_.empty()) return;
        const DistanceToBoxes distance(at);
        struct Waiting {
            double square;  // of the distance to its box
            std::uint32_t first, piece_count;
        };
        Waiting stack[kMostWaiting];
        int top = 0;
        stack[top++] = {0, 0, 0};
        while (top > 0) {
            const Waiting next = stack[--top];
            if (!is_near(next.square, reach)) continue;
            if (next.piece_count > 0) {
                for (std::uint32_t i = next.first; i < next.first + next.piece_count; ++i) visit(segments_[i]);
                continue;
            }
            const Node& node = nodes_[next.first];
            const FourBoxes::AreNear near = may_be_near(node.boxes);
            const std::array<double, FourBoxes::kCount> squares = distance.squares(node.boxes);
            const int before = top;
            for (std::size_t k = 0; k < FourBoxes::kCount; ++k) {
                if (!near[k] || !is_near(squares[k], reach) || (node.piece_count[k] == 0 && node.first[k] == 0))
                    continue;
                int i = top++;  // the nearest comes last
                for (; i > before && stack[i - 1].square < squares[k]; --i) stack[i] = stack[i - 1];
                stack[i] = {squares[k], node.first[k], node.piece_count[k]};
            }
        }
    }

  private:
    /// Halving 2^32 pieces twice takes 16 levels, each of which leaves three boxes waiting.
    static constexpr int kMostWaiting = 64;
    /// Boxes around pieces: those at [first, first + piece_count) of segments_ (a leaf), or all of node `first` (count
    /// 0); none if both are 0.
    struct Node {
        FourBoxes boxes;
        std::array<std::uint32_t, FourBoxes::kCount> first{}, piece_count{};
    };
    struct Place {
        glm::vec3 middle;  // twice that
        std::uint32_t piece;
    };
    /// The margin keeps rounding from hiding an equally near one.
    static bool is_near(double square, double reach) { return square <= reach * reach * (1 + 1e-9); }

    /// Cuts pieces in two; returns how many are in the first half.
    static std::uint32_t cut(const glm::vec3& weight, std::span<Place> places);
    /// Makes a node of pieces, the first of which is the one at `first` of segments_. Returns the box around them.
    FourBoxes::Box build(std::span<const SegmentPiece> pieces, const glm::vec3& weight, std::uint32_t node,
                         std::uint32_t first, std::span<Place> places);
    FourBoxes::Box add_leaf(std::span<const SegmentPiece> pieces, std::uint32_t first, std::span<const Place> places);

    std::vector<std::uint32_t> segments_;  // of pieces
    std::vector<Node> nodes_;
};

}  // namespace burin
