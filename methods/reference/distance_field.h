#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/reference/boundary_curves.h"

// Coverage of a stroke follows from the distance to the nearest boundary segment.

namespace burin {

/// The point of a segment that is nearest to p.
struct NearestPoint {
    glm::dvec2 at{0.0};
    double distance = 0;
    double along = 0;  ///< 0 = a, 1 = b
};

inline NearestPoint nearest_point(const BoundarySegment& s, glm::dvec2 p) {
    const glm::dvec2 d = s.b - s.a;
    const double length2 = glm::dot(d, d);
    NearestPoint n;
    n.along = length2 > 0 ? std::clamp(glm::dot(p - s.a, d) / length2, 0.0, 1.0) : 0.0;
    n.at = s.a + d * n.along;
    n.distance = glm::distance(p, n.at);
    return n;
}

/// Share of a square cell of side `size` whose points q, relative to its middle, satisfy
/// dot(q, normal) <= offset. Exact: the projection of a square is a trapezoid, the convolution of
/// two boxes.
inline double half_plane_share(double offset, glm::dvec2 normal, double size) {
    const double u = offset / size;
    double a = 0.5 * std::abs(normal.x), b = 0.5 * std::abs(normal.y);
    if (a < b) std::swap(a, b);
    if (u <= -a - b) return 0;
    if (u >= a + b) return 1;
    if (b < 1e-4) return std::clamp((u + a) / (2 * a), 0.0, 1.0);
    const auto square = [](double x) { return x > 0 ? x * x : 0.0; };
    return (square(u + a + b) - square(u + a - b) - square(u - a + b) + square(u - a - b)) / (8 * a * b);
}

/// The part of a straight stroke between two signed distances from its line.
struct StrokeBand {
    double low_px = 0, high_px = 0;
};

/// Share of a square cell around p that a stroke along the line through `nearest` covers, where the
/// signed distance of p from the line is `signed_distance` and grows along `normal`.
inline double stroke_share(const StrokeBand& band, double signed_distance, glm::dvec2 normal, double size) {
    return half_plane_share(band.high_px - signed_distance, normal, size) -
           half_plane_share(band.low_px - signed_distance, normal, size);
}

/// Finds the segments near a position. Covers a rectangle with bins of one pixel.
class SegmentGrid {
  public:
    SegmentGrid(glm::ivec2 low, glm::ivec2 high, std::span<const BoundarySegment> segments)
        : low_(low), size_(high - low), segments_(segments) {
        const auto bins = static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y);
        std::vector<std::uint32_t> counts(bins, 0);
        for_each_bin([&](std::size_t bin, std::uint32_t) { ++counts[bin]; });
        first_.assign(bins + 1, 0);
        for (std::size_t i = 0; i < bins; ++i) first_[i + 1] = first_[i] + counts[i];
        numbers_.resize(first_.back());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for_each_bin([&](std::size_t bin, std::uint32_t s) { numbers_[next[bin]++] = s; });
    }

    /// Calls visit(number) once or more for each segment that may lie within `reach_px` of p.
    template <typename Visit>
    void near(glm::dvec2 p, double reach_px, const Visit& visit) const {
        const glm::ivec2 from = clamped(p - reach_px), to = clamped(p + reach_px);
        for (int y = from.y; y <= to.y; ++y) {
            const std::uint32_t begin = first_[index({from.x, y})], end = first_[index({to.x, y}) + 1];
            for (std::uint32_t i = begin; i < end; ++i) visit(numbers_[i]);
        }
    }

  private:
    glm::ivec2 clamped(glm::dvec2 p) const {
        const glm::dvec2 cell = glm::floor(p) - glm::dvec2(low_);
        return glm::ivec2(glm::clamp(cell, glm::dvec2(0.0), glm::dvec2(size_ - 1)));
    }
    std::size_t index(glm::ivec2 cell) const {
        return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(cell.x);
    }
    template <typename Visit>
    void for_each_bin(const Visit& visit) const {
        for (std::uint32_t s = 0; s < segments_.size(); ++s) {
            const BoundarySegment& segment = segments_[s];
            const glm::dvec2 d = segment.b - segment.a;
            const glm::ivec2 from = clamped(glm::min(segment.a, segment.b)),
                             to = clamped(glm::max(segment.a, segment.b));
            for (int y = from.y; y <= to.y; ++y) {
                for (int x = from.x; x <= to.x; ++x) {
                    // Skip bins of a long diagonal's box that it does not touch.
                    const glm::dvec2 middle = glm::dvec2(low_ + glm::ivec2(x, y)) + 0.5 - segment.a;
                    const double off = std::abs(d.x * middle.y - d.y * middle.x);
                    if (from != to && off > 0.5001 * (std::abs(d.x) + std::abs(d.y))) continue;
                    visit(index({x, y}), s);
                }
            }
        }
    }

    glm::ivec2 low_, size_;
    std::span<const BoundarySegment> segments_;
    std::vector<std::uint32_t> first_, numbers_;
};

}  // namespace burin
