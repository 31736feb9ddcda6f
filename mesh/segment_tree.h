#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

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

    /// Calls visit(segment) for all pieces in boxes that may_be_near(low, high), until it says false.
    template <typename MayBeNear, typename Visit>
    void visit_leaves(const MayBeNear& may_be_near, const Visit& visit) const {
        if (nodes_.empty()) return;
        std::uint32_t stack[kMostLevels];
        int top = 0;
        stack[top++] = 0;
        while (top > 0) {
            const Node& node = nodes_[stack[--top]];
            if (!may_be_near(node.low, node.high)) continue;
            if (node.count == 0) {
                stack[top++] = node.first;
                stack[top++] = node.first + 1;
                continue;
            }
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                if (!visit(segments_[i])) return;
            }
        }
    }

    /// Calls visit(segment) for all pieces in boxes that may be as near to a point as `reach`, which visit() may lower
    /// meanwhile. Nearer boxes mostly come first.
    template <typename Visit>
    void visit_nearest(const glm::dvec3& at, const double& reach, const Visit& visit) const {
        visit_nearest(
            at, reach, [](const glm::vec3&, const glm::vec3&) { return true; }, visit);
    }
    /// Visits the nearest pieces in boxes for which may_be_near(low, high) says yes.
    template <typename MayBeNear, typename Visit>
    void visit_nearest(const glm::dvec3& at, const double& reach, const MayBeNear& may_be_near,
                       const Visit& visit) const {
        if (nodes_.empty()) return;
        struct Waiting {
            std::uint32_t node;
            double square;  // of the distance to its box
        };
        Waiting stack[kMostLevels];
        int top = 0;
        const auto put = [&](const Waiting& waiting) {
            if (is_near(waiting.square, reach)) stack[top++] = waiting;
        };
        put({0, square_of_distance(at, nodes_[0])});
        while (top > 0) {
            const Waiting next = stack[--top];
            if (!is_near(next.square, reach)) continue;
            const Node& node = nodes_[next.node];
            if (!may_be_near(node.low, node.high)) continue;
            if (node.count == 0) {
                Waiting nearer{node.first, square_of_distance(at, nodes_[node.first])};
                Waiting farther{node.first + 1, square_of_distance(at, nodes_[node.first + 1])};
                if (farther.square < nearer.square) std::swap(nearer, farther);
                put(farther);
                put(nearer);
                continue;
            }
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) visit(segments_[i]);
        }
    }

  private:
    static constexpr int kMostLevels = 64;  // halving 2^32 pieces takes 32 levels
    /// A box around pieces: those at [first, first + count) of segments_ (a leaf), or all of its
    /// children's, which are nodes `first` and `first + 1` (count 0).
    struct Node {
        glm::vec3 low{0.0f}, high{0.0f};
        std::uint32_t first = 0, count = 0;
    };
    struct Place {
        glm::vec3 middle;  // twice that
        std::uint32_t piece;
    };
    /// The margin keeps rounding from hiding an equally near one.
    static bool is_near(double square, double reach) { return square <= reach * reach * (1 + 1e-9); }
    static double square_of_distance(const glm::dvec3& p, const Node& box) {
        const glm::dvec3 outside =
            glm::max(glm::max(glm::dvec3(box.low) - p, p - glm::dvec3(box.high)), glm::dvec3(0.0));
        return glm::dot(outside, outside);
    }
    void build(std::span<const SegmentPiece> pieces, const glm::vec3& weight, std::uint32_t node, std::uint32_t first,
               std::span<Place> places);

    std::vector<std::uint32_t> segments_;  // of pieces
    std::vector<Node> nodes_;
};

}  // namespace burin
