#include "mesh/delaunay_flips.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/interrupt.h"
#include "mesh/vectors.h"

namespace burin {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;
/// If there are more flips than this for each triangle, rounding is the cause.
constexpr std::size_t kMostFlips = 64;
/// Coordinates are exact to this, for a polygon of size 1.
constexpr double kFlatHeight = 1e-6;
/// Circles that a corner lies on within rounding leave the edge as it is.
constexpr double kRounding = 1e-12;

double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) { return cross(b - a, c - a); }

class Flipper {
  public:
    Flipper(std::span<const glm::dvec2> points, std::span<std::array<std::uint32_t, 3>> triangles)
        : points_(points), triangles_(triangles), twins_(3 * triangles.size(), kNone) {
        link();
    }

    void run() {
        std::vector<std::uint32_t> open;  // sides to look at
        for (std::uint32_t side = 0; side < twins_.size(); ++side) {
            if (twins_[side] != kNone && side < twins_[side]) open.push_back(side);
        }
        std::size_t flips = 0;
        while (!open.empty() && flips < kMostFlips * triangles_.size()) {
            const std::uint32_t side = open.back();
            open.pop_back();
            if (twins_[side] == kNone || !is_better_flipped(side)) continue;
            if ((++flips & 0xFFFF) == 0) throw_if_interrupted();
            for (const std::uint32_t around : flip(side)) open.push_back(around);
        }
    }

  private:
    // Side 3 t + k of triangle t runs from its corner k to the next one.
    static std::uint32_t next(std::uint32_t side) { return side % 3 == 2 ? side - 2 : side + 1; }
    std::uint32_t start(std::uint32_t side) const { return triangles_[side / 3][side % 3]; }
    std::uint32_t apex(std::uint32_t side) const { return start(next(next(side))); }

    /// Finds the two sides of each edge within the polygon.
    void link() {
        struct Directed {
            std::uint32_t from, to, side;
        };
        std::vector<Directed> sides;
        for (std::uint32_t side = 0; side < twins_.size(); ++side)
            sides.push_back({start(side), start(next(side)), side});
        const auto is_before = [](const Directed& a, const Directed& b) {
            return a.from != b.from ? a.from < b.from : a.to < b.to;
        };
        std::sort(sides.begin(), sides.end(), is_before);
        for (const Directed& s : sides) {
            const auto twin = std::lower_bound(sides.begin(), sides.end(), Directed{s.to, s.from, 0}, is_before);
            if (twin != sides.end() && twin->from == s.to && twin->to == s.from) twins_[s.side] = twin->side;
        }
    }

    /// Whether the angles opposite of an edge add up to more than two right ones, and both new triangles turn left.
    bool is_better_flipped(std::uint32_t side) const {
        const glm::dvec2 a = points_[start(side)], b = points_[start(next(side))];
        const glm::dvec2 c = points_[apex(side)], d = points_[apex(twins_[side])];
        if (!(turn(a, d, c) > 0) || !(turn(d, b, c) > 0)) return false;
        // A triangle that turns right by more than rounding is of a polygon that crosses itself.
        const double least = -kFlatHeight * glm::distance(a, b);
        if (turn(a, b, c) < least || turn(b, a, d) < least) return false;
        const double sine_c = cross(a - c, b - c), sine_d = cross(b - d, a - d);
        const double cosine_c = glm::dot(a - c, b - c), cosine_d = glm::dot(b - d, a - d);
        const double size = glm::length(a - c) * glm::length(b - c) * glm::length(a - d) * glm::length(b - d);
        return sine_c * cosine_d + cosine_c * sine_d < -kRounding * size;
    }

    /// Returns the four sides around it.
    std::array<std::uint32_t, 4> flip(std::uint32_t side) {
        const std::uint32_t twin = twins_[side], t = side / 3, u = twin / 3;
        const std::uint32_t a = start(side), b = start(twin), c = apex(side), d = apex(twin);
        const std::uint32_t bc = twins_[next(side)], ca = twins_[next(next(side))];
        const std::uint32_t ad = twins_[next(twin)], db = twins_[next(next(twin))];
        triangles_[t] = {a, d, c};
        triangles_[u] = {d, b, c};
        join(3 * t, ad);
        join(3 * t + 1, 3 * u + 2);
        join(3 * t + 2, ca);
        join(3 * u, db);
        join(3 * u + 1, bc);
        return {3 * t, 3 * t + 2, 3 * u, 3 * u + 1};
    }
    void join(std::uint32_t side, std::uint32_t twin) {
        twins_[side] = twin;
        if (twin != kNone) twins_[twin] = side;
    }

    std::span<const glm::dvec2> points_;
    std::span<std::array<std::uint32_t, 3>> triangles_;
    std::vector<std::uint32_t> twins_;  // the other side of an edge; kNone on the border of the polygon
};

}  // namespace

void flip_to_delaunay(std::span<const glm::dvec2> points, std::span<std::array<std::uint32_t, 3>> triangles) {
    Flipper(points, triangles).run();
}

}  // namespace burin
