#include "mesh/round_positions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "base/huge_pages.h"
#include "mesh/residuals.h"
#include "mesh/vertex_welder.h"

namespace burin {
namespace {

/// A model this many times larger than its typical polygon and others of that size would be side by
/// side is blurred: of what fills 1000 pixels single precision then moves corners by 1/64 pixel.
constexpr double kLargestReach = 256;
constexpr std::size_t kMostSamples = 1024;
/// Bits that are kept of the largest coordinate. Programs leave noise in the last digits of double precision, which
/// must not keep vertices apart.
constexpr int kBitsWithResiduals = 46;

double largest_of(const glm::dvec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

struct Bounds {
    glm::dvec3 low, high;

    explicit Bounds(const glm::dvec3& p) : low(p), high(p) {}
    void add(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    glm::dvec3 center() const { return 0.5 * (low + high); }
    double half_size() const { return largest_of(0.5 * (high - low)); }
    /// How far a box reaches from a place along an axis.
    double reach_from(const glm::dvec3& p) const { return std::max(largest_of(low - p), largest_of(high - p)); }
};

/// The box around vertices that polygons or marked edges have.
Bounds bounds_of(const PolygonSoup& soup) {
    std::vector<std::uint8_t> is_used(soup.positions.size(), 0);
    for (const std::uint32_t v : soup.corners) is_used[v] = 1;
    for (const auto& [a, b] : soup.marked_edges) is_used[a] = is_used[b] = 1;
    Bounds bounds(soup.positions[soup.corners.empty() ? soup.marked_edges[0][0] : soup.corners[0]]);
    for (std::size_t v = 0; v < soup.positions.size(); ++v) {
        if (is_used[v] != 0) bounds.add(soup.positions[v]);
    }
    return bounds;
}

/// If no vertex is so far from 0, the model is large enough for an origin at 0: some corners alone
/// make it so.
double plainly_near(const PolygonSoup& soup) {
    if (soup.corners.empty()) return 0;
    Bounds bounds(soup.positions[soup.corners[0]]);
    const std::size_t step = soup.corners.size() / kMostSamples + 1;
    for (std::size_t i = 0; i < soup.corners.size(); i += step) bounds.add(soup.positions[soup.corners[i]]);
    return 16 * bounds.half_size();
}

double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The size of most polygons that have one; 0: none has.
double typical_polygon_size(const PolygonSoup& soup) {
    std::vector<double> sizes;
    const std::size_t step = soup.polygon_count() / kMostSamples + 1;
    for (std::size_t i = 0; i < soup.polygon_count(); i += step) {
        const auto polygon = soup.polygon(i);
        if (polygon.empty()) continue;
        Bounds bounds(soup.positions[polygon[0]]);
        for (const std::uint32_t v : polygon) bounds.add(soup.positions[v]);
        if (bounds.half_size() > 0) sizes.push_back(2 * bounds.half_size());
    }
    return sizes.empty() ? 0 : median(sizes);
}

bool is_blurred(const PolygonSoup& soup, double reach) {
    const double size = typical_polygon_size(soup);
    return size > 0 && reach > kLargestReach * size * std::sqrt(static_cast<double>(soup.polygon_count()));
}

/// The median of some corners, in each coordinate. Where most of the model is, it is there, too.
glm::dvec3 median_corner(const PolygonSoup& soup) {
    std::vector<double> values[3];
    const std::size_t step = soup.corners.size() / kMostSamples + 1;
    for (std::size_t i = 0; i < soup.corners.size(); i += step) {
        const glm::dvec3& p = soup.positions[soup.corners[i]];
        for (int k = 0; k < 3; ++k) values[k].push_back(p[k]);
    }
    return {median(values[0]), median(values[1]), median(values[2])};
}

}  // namespace

RoundedPositions round_positions(const PolygonSoup& soup) {
    RoundedPositions result;
    reserve_large(result.positions, soup.positions.size());
    glm::dvec3 largest(0.0);
    for (const glm::dvec3& p : soup.positions) {
        result.positions.push_back(glm::vec3(p) + 0.0f);  // + 0 turns -0 into 0
        largest = glm::max(largest, glm::abs(p));
    }
    if (soup.corners.empty() && soup.marked_edges.empty()) return result;
    const bool is_plainly_near = largest_of(largest) < plainly_near(soup);
    if (is_plainly_near && !is_blurred(soup, largest_of(largest))) return result;

    const Bounds bounds = bounds_of(soup);
    if (largest_of(bounds.center()) > 16 * bounds.half_size()) result.origin = bounds.center();
    const bool has_residuals = is_blurred(soup, bounds.reach_from(result.origin));
    if (has_residuals) result.origin = median_corner(soup);
    if (result.origin == glm::dvec3(0.0) && !has_residuals) return result;
    if (has_residuals) reserve_large(result.residuals, soup.positions.size());
    // Without residuals the model may be a single place, which reaches nowhere.
    const double step =
        has_residuals ? std::ldexp(1.0, std::ilogb(bounds.reach_from(result.origin)) + 1 - kBitsWithResiduals) : 0;
    for (std::size_t v = 0; v < soup.positions.size(); ++v) {
        glm::dvec3 place = soup.positions[v] - result.origin;
        if (has_residuals) place = glm::round(place / step) * step;
        result.positions[v] = glm::vec3(place) + 0.0f;
        if (has_residuals) result.residuals.push_back(residual_of(place, result.positions[v]));
    }
    return result;
}

std::vector<std::uint32_t> weld_vertices(const RoundedPositions& rounded) {
    std::vector<std::uint32_t> first = weld_vertices(rounded.positions);
    if (rounded.residuals.empty()) return first;
    // Vertices that are one in single precision are put in order, so that those that are one altogether stand together,
    // the first one in front.
    const auto key = [&](std::uint32_t v) {
        const glm::vec3& r = rounded.residuals[v];
        return std::tuple(first[v], r.x, r.y, r.z);
    };
    std::vector<std::uint32_t> order(first.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t u, std::uint32_t v) {
        const auto a = key(u), b = key(v);
        return a != b ? a < b : u < v;
    });
    std::vector<std::uint32_t> result(first.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        result[order[i]] = i > 0 && key(order[i - 1]) == key(order[i]) ? result[order[i - 1]] : order[i];
    }
    return result;
}

}  // namespace burin
