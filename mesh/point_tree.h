#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/interrupt.h"

// Points of several coordinates, as a place and a direction together, are found by a tree of boxes.

namespace burin {

/// A tree of boxes around points of `kCoordinates` numbers each, held as `Number`. It is cut where points spread the
/// most, so numbers of different kinds must come in units that compare.
template <std::size_t kCoordinates, typename Number = double>
class PointTree {
  public:
    using Coordinates = std::array<Number, kCoordinates>;
    struct Point {
        Coordinates at;
        std::uint32_t number;
    };

    PointTree() = default;
    explicit PointTree(std::vector<Point> points) : points_(std::move(points)) {
        if (points_.empty()) return;
        nodes_.reserve(points_.size());
        nodes_.emplace_back();
        build(0, 0, points_);
    }

    bool is_empty() const { return nodes_.empty(); }

    /// Calls visit(number) for all points in boxes that may_be_near(low, high), and for some beside them, until it says
    /// false.
    template <typename MayBeNear, typename Visit>
    void visit(const MayBeNear& may_be_near, const Visit& visit) const {
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
                if (!visit(points_[i].number)) return;
            }
        }
    }

  private:
    static constexpr std::uint32_t kLeafSize = 4;
    static constexpr int kMostLevels = 64;  // halving 2^32 points takes 32 levels
    /// A box around the points [first, first + count) (a leaf), or around those of nodes `first` and `first + 1`
    /// (count 0).
    struct Node {
        Coordinates low, high;
        std::uint32_t first = 0, count = 0;
    };

    void build(std::uint32_t node, std::uint32_t first, std::span<Point> points) {
        const auto count = static_cast<std::uint32_t>(points.size());
        if (count > 0xFFFF) throw_if_interrupted();
        Node box{points.front().at, points.front().at, first, count};
        for (const Point& p : points) {
            for (std::size_t k = 0; k < kCoordinates; ++k) {
                box.low[k] = std::min(box.low[k], p.at[k]);
                box.high[k] = std::max(box.high[k], p.at[k]);
            }
        }
        if (count > kLeafSize) {
            std::size_t axis = 0;
            for (std::size_t k = 1; k < kCoordinates; ++k) {
                if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) axis = k;
            }
            const std::uint32_t half = count / 2;
            std::nth_element(points.begin(), points.begin() + half, points.end(),
                             [&](const Point& p, const Point& q) { return p.at[axis] < q.at[axis]; });
            box.first = static_cast<std::uint32_t>(nodes_.size());
            box.count = 0;
            nodes_.resize(nodes_.size() + 2);
            build(box.first, first, points.first(half));
            build(box.first + 1, first + half, points.subspan(half));
        }
        nodes_[node] = box;
    }

    std::vector<Point> points_;
    std::vector<Node> nodes_;
};

}  // namespace burin
