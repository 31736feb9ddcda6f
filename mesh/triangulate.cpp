#include "mesh/triangulate.h"

#include <algorithm>
#include <cmath>

#include "base/interrupt.h"
#include "mesh/delaunay_flips.h"
#include "mesh/index_set.h"
#include "mesh/vectors.h"

namespace burin {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr std::uint32_t kNoCorner = 0xFFFFFFFFu;

/// Twice the signed area of a triangle; positive when it turns left.
double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) { return cross(b - a, c - a); }

/// The polygon in its own plane, turning left, scaled to about 1 so that products stay finite.
std::vector<glm::dvec2> flattened(std::span<const glm::dvec3> corners) {
    const glm::dvec3 normal = area_vector(corners);
    const glm::dvec3 size = glm::abs(normal);
    // Leaving out the axis closest to the normal keeps the coordinates exact.
    const int drop = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const int u = (drop + 1) % 3;
    const int v = (drop + 2) % 3;
    const double flip = normal[drop] < 0 ? -1.0 : 1.0;
    double extent = 0;
    for (const glm::dvec3& c : corners) {
        const glm::dvec3 d = glm::abs(c - corners[0]);
        extent = std::max({extent, d.x, d.y, d.z});
    }
    const double scale = extent > 0 ? std::ldexp(1.0, -std::max(std::ilogb(extent), -1000)) : 1;
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::dvec3& c : corners) {
        const glm::dvec3 d = (c - corners[0]) * scale;
        flat.emplace_back(d[u] * flip, d[v]);
    }
    return flat;
}

/// The corners where the polygon turns right, findable by place.
class ReflexGrid {
  public:
    /// Keeps a reference to the points.
    ReflexGrid(const std::vector<glm::dvec2>& points, const std::vector<bool>& is_reflex) : points_(points) {
        low_ = high_ = points[0];
        for (const glm::dvec2& p : points) {
            low_ = glm::min(low_, p);
            high_ = glm::max(high_, p);
        }
        const auto count = std::count(is_reflex.begin(), is_reflex.end(), true);
        side_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(count))));
        cells_.resize(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            if (is_reflex[i]) cells_[cell(column(points[i].x), row(points[i].y))].push_back(i);
        }
    }

    /// A reflex corner in the box for which test(i) holds, or kNoCorner.
    template <typename Test>
    std::uint32_t find_in_box(glm::dvec2 low, glm::dvec2 high, const Test& test) const {
        for (int y = row(low.y); y <= row(high.y); ++y) {
            for (int x = column(low.x); x <= column(high.x); ++x) {
                for (const std::uint32_t i : cells_[cell(x, y)]) {
                    if (test(i)) return i;
                }
            }
        }
        return kNoCorner;
    }

    void remove(std::uint32_t i) { std::erase(cells_[cell(column(points_[i].x), row(points_[i].y))], i); }

  private:
    int place(double value, double low, double high) const {
        if (!(high > low)) return 0;
        return std::clamp(static_cast<int>((value - low) / (high - low) * side_), 0, side_ - 1);
    }
    int column(double x) const { return place(x, low_.x, high_.x); }
    int row(double y) const { return place(y, low_.y, high_.y); }
    std::size_t cell(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(x);
    }

    const std::vector<glm::dvec2>& points_;
    glm::dvec2 low_, high_;
    int side_ = 1;
    std::vector<std::vector<std::uint32_t>> cells_;
};

class EarClipper {
  public:
    explicit EarClipper(std::span<const glm::dvec3> corners)
        : points_(flattened(corners)),
          next_(corners.size()),
          previous_(corners.size()),
          is_reflex_(find_reflex_corners()),
          open_(static_cast<std::uint32_t>(corners.size())),
          blocker_(corners.size(), kNoCorner),
          grid_(points_, is_reflex_) {
        open_all(0);
    }

    void clip(std::vector<Triangle>& triangles) {
        auto left = static_cast<std::uint32_t>(points_.size());
        std::uint32_t at = 0;
        int second_looks = 0;
        for (; left > 3; --left) {
            std::uint32_t ear = find_ear(at);
            // In a simple polygon, only its neighbours can make a corner an ear. Others get a few
            // second looks: more would take long where a large polygon crosses itself everywhere.
            if (ear == kNoCorner && second_looks < kMaxSecondLooks) {
                ++second_looks;
                open_all(at);
                ear = find_ear(at);
            }
            // A polygon that crosses itself may run out of ears: then any corner is cut off.
            if (ear == kNoCorner) ear = at;
            triangles.push_back({previous_[ear], ear, next_[ear]});
            at = cut_off(ear);
        }
        triangles.push_back({previous_[at], at, next_[at]});
    }
    /// The corners in the polygon's plane.
    std::span<const glm::dvec2> points() const { return points_; }

  private:
    static constexpr int kMaxSecondLooks = 64;

    std::vector<bool> find_reflex_corners() {
        const auto n = static_cast<std::uint32_t>(points_.size());
        std::vector<bool> reflex(n);
        for (std::uint32_t i = 0; i < n; ++i) {
            next_[i] = (i + 1) % n;
            previous_[i] = (i + n - 1) % n;
        }
        for (std::uint32_t i = 0; i < n; ++i) reflex[i] = turn_at(i) <= 0;
        return reflex;
    }

    double turn_at(std::uint32_t i) const { return turn(points_[previous_[i]], points_[i], points_[next_[i]]); }

    /// The next ear from a corner on, along the polygon; those that are none are looked at no more until a neighbour is
    /// cut off. kNoCorner: there is none.
    std::uint32_t find_ear(std::uint32_t from) {
        for (std::uint32_t i = open_.find_from(from);; i = open_.find_from(i)) {
            if (i == IndexSet::kNone) i = open_.find_from(0);
            if (i == IndexSet::kNone) return kNoCorner;
            if ((looks_++ & 0xFF) == 0) throw_if_interrupted();
            if (is_ear(i)) return i;
            open_.erase(i);
        }
    }
    void open_all(std::uint32_t any) {
        std::uint32_t i = any;
        do {
            open_.insert(i);
            i = next_[i];
        } while (i != any);
    }

    /// An ear is a corner whose triangle holds no other corner. Only reflex corners can be in it.
    bool is_ear(std::uint32_t i) {
        if (is_reflex_[i]) return false;
        const std::uint32_t before = previous_[i];
        const std::uint32_t after = next_[i];
        const glm::dvec2 a = points_[before], b = points_[i], c = points_[after];
        const glm::dvec2 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
        const auto blocks = [&](std::uint32_t k) {
            if (k == before || k == i || k == after) return false;
            const glm::dvec2 p = points_[k];
            // A repeated corner (the cut to a hole) does not block.
            if (p == a || p == b || p == c) return false;
            // The box matters where the three corners lie on one line.
            return glm::all(glm::lessThanEqual(low, p)) && glm::all(glm::lessThanEqual(p, high)) &&
                   turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
        };
        std::uint32_t& blocker = blocker_[i];
        if (blocker != kNoCorner && is_reflex_[blocker] && blocks(blocker)) return false;
        blocker = grid_.find_in_box(low, high, blocks);
        return blocker == kNoCorner;
    }

    /// Removes corner i and returns where to go on: two corners further, which avoids slivers.
    std::uint32_t cut_off(std::uint32_t i) {
        const std::uint32_t before = previous_[i];
        const std::uint32_t after = next_[i];
        if (is_reflex_[i]) {
            is_reflex_[i] = false;
            grid_.remove(i);
        }
        next_[before] = after;
        previous_[after] = before;
        open_.erase(i);
        for (const std::uint32_t k : {before, after}) {
            open_.insert(k);
            if (is_reflex_[k] && turn_at(k) > 0) {
                is_reflex_[k] = false;
                grid_.remove(k);
            }
        }
        return next_[after];
    }

    std::vector<glm::dvec2> points_;
    std::vector<std::uint32_t> next_, previous_;
    std::vector<bool> is_reflex_;
    IndexSet open_;  // corners that may be ears: all but those that were none, with the neighbours that they have now
    std::vector<std::uint32_t> blocker_;  // the corner that was in its triangle when last looked at, or kNoCorner
    ReflexGrid grid_;
    std::uint32_t looks_ = 0;
};

/// Brings one of the triangles of a polygon with n corners to the front that begins with a side of the polygon.
void begin_with_a_side(std::span<Triangle> triangles, std::uint32_t n) {
    for (Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            if ((t[k] + 1) % n != t[(k + 1) % 3]) continue;
            std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(k), t.end());
            std::swap(t, triangles.front());
            return;
        }
    }
}

/// Cuts a quadrilateral along its shorter diagonal, or the only one inside if a corner is reflex.
void triangulate_quad(std::span<const glm::dvec3> c, std::vector<Triangle>& triangles) {
    const glm::dvec3 normal = area_vector(c);
    const auto side = [&](int a, int b, int d) {
        const auto at = [&](int i) { return c[static_cast<std::size_t>(i)]; };
        return glm::dot(glm::cross(at(b) - at(a), at(d) - at(a)), normal);
    };
    const bool cut_02_fits = side(0, 1, 2) > 0 && side(0, 2, 3) > 0;
    const bool cut_13_fits = side(1, 2, 3) > 0 && side(1, 3, 0) > 0;
    const glm::dvec3 d02 = c[2] - c[0];
    const glm::dvec3 d13 = c[3] - c[1];
    const bool prefer_02 = glm::dot(d02, d02) <= glm::dot(d13, d13);
    const bool cut_02 = cut_02_fits == cut_13_fits ? prefer_02 : cut_02_fits;
    if (cut_02) {
        triangles.push_back({0, 1, 2});
        triangles.push_back({0, 2, 3});
    } else {
        triangles.push_back({1, 2, 3});
        triangles.push_back({1, 3, 0});
    }
}

}  // namespace

glm::dvec3 area_vector(std::span<const glm::dvec3> corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    }
    return sum;
}

void triangulate_polygon(std::span<const glm::dvec3> corners, std::vector<Triangle>& triangles) {
    if (corners.size() == 3) {
        triangles.push_back({0, 1, 2});
    } else if (corners.size() == 4) {
        triangulate_quad(corners, triangles);
    } else {
        const std::size_t before = triangles.size();
        EarClipper clipper(corners);
        clipper.clip(triangles);
        const auto of_polygon = std::span(triangles).subspan(before);
        flip_to_delaunay(clipper.points(), of_polygon);
        begin_with_a_side(of_polygon, static_cast<std::uint32_t>(corners.size()));
    }
}

}  // namespace burin
