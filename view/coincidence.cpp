#include "view/coincidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "mesh/vectors.h"
#include "view/depth_plane.h"
#include "view/screen_polygon.h"

namespace burin {
namespace {

/// Planes that meet at an angle drift apart by more than kCoincidentPx within this many pixels, or are taken for one.
constexpr double kAroundPx = 2;
/// Programs round coordinates on the way to a file. Nothing is in front for certain by less than this, in pixels,
/// unless that is more than single precision loses anywhere in the scene.
constexpr double kLeastCertainPx = 1.0 / 2048;

/// A convex polygon on the screen, in pixels, clockwise as seen.
class Region {
  public:
    explicit Region(const ScreenPolygon& polygon) {
        for (int i = 0; i < polygon.count; ++i) {
            const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
            corners_[count_++] = to_pixels(glm::dvec2(p.x, p.y));
        }
        double area = 0;
        for (std::size_t i = 2; i < count_; ++i)
            area += cross(corners_[i - 1] - corners_[0], corners_[i] - corners_[0]);
        if (area < 0) std::reverse(corners_.begin(), corners_.begin() + count_);
    }

    /// Whether the region is no wider than what snapping does to edges.
    bool is_sliver() const {
        constexpr double kSnappedPx = 1.0 / 128;
        double area = 0, around = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const glm::dvec2 p = corners_[i] - corners_[0], q = corners_[i + 1 == count_ ? 0 : i + 1] - corners_[0];
            area += 0.5 * cross(p, q);
            around += glm::distance(p, q);
        }
        return !(area > 0.5 * kSnappedPx * around);
    }
    std::span<const glm::dvec2> corners() const { return {corners_.data(), count_}; }

    /// Keeps what lies to the right of the way from one point to another.
    void clip(glm::dvec2 from, glm::dvec2 to) {
        std::array<double, kMost> side;
        bool is_all = true;
        for (std::size_t i = 0; i < count_; ++i) {
            side[i] = cross(to - from, corners_[i] - from);
            is_all = is_all && side[i] >= 0;
        }
        if (is_all) return;
        std::array<glm::dvec2, kMost> kept;
        std::size_t kept_count = 0;
        for (std::size_t i = 0; i < count_ && kept_count + 2 <= kMost; ++i) {
            const std::size_t next = i + 1 == count_ ? 0 : i + 1;
            if (side[i] >= 0) kept[kept_count++] = corners_[i];
            if ((side[i] < 0) != (side[next] < 0))
                kept[kept_count++] = glm::mix(corners_[i], corners_[next], side[i] / (side[i] - side[next]));
        }
        std::copy_n(kept.begin(), kept_count, corners_.begin());
        count_ = kept_count;
    }
    void clip(const Region& other) {
        const auto c = other.corners();
        for (std::size_t i = 0; i < c.size(); ++i) clip(c[i], c[i + 1 == c.size() ? 0 : i + 1]);
    }

  private:
    static constexpr std::size_t kMost = 2 * ScreenPolygon::kMaxCorners + 8;  // each side of another one adds a corner

    std::array<glm::dvec2, kMost> corners_;
    std::size_t count_ = 0;
};

/// Whether there is a row or a column between two polygons. Polygons that are a point, or nothing, are not asked about.
bool are_beside(const ScreenPolygon& a, const ScreenPolygon& b) {
    struct Box {
        std::int32_t x0 = std::numeric_limits<std::int32_t>::max(), y0 = x0, x1 = -x0, y1 = -x0;
        explicit Box(const ScreenPolygon& polygon) {
            for (int i = 0; i < polygon.count; ++i) {
                const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
                x0 = std::min(x0, p.x);
                y0 = std::min(y0, p.y);
                x1 = std::max(x1, p.x);
                y1 = std::max(y1, p.y);
            }
        }
        bool is_wide() const { return x0 < x1 || y0 < y1; }
    };
    const Box p(a), q(b);
    return p.is_wide() && q.is_wide() && (p.x1 < q.x0 || q.x1 < p.x0 || p.y1 < q.y0 || q.y1 < p.y0);
}

/// The region where both are in the picture, or anywhere if they are not.
Region common_region(const Projection& projection, const ScreenPolygon& a, const ScreenPolygon& b) {
    Region common(a);
    common.clip(Region(b));
    const glm::dvec2 size = 2.0 * (projection.center_px - projection.shift_px), right(size.x, 0), below(0, size.y);
    Region seen = common;
    for (const auto& [from, to] :
         {std::pair{glm::dvec2(0.0), right}, {right, size}, {size, below}, {below, glm::dvec2(0.0)}})
        seen.clip(from, to);
    return seen.is_sliver() ? common : seen;
}

/// How much nearness changes when a plane moves by `error` along its normal: by error / normal.z (orthographic), or by
/// a factor of error / distance of the plane from the eye.
class Sensitivity {
  public:
    Sensitivity(const Projection& projection, const glm::dvec3 (&corners)[3]) : projection_(projection) {
        const glm::dvec3 area = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const glm::dvec3 normal = area / std::max(glm::length(area), 1e-300);
        divisor_ = projection.orthographic ? normal.z : glm::dot(normal, corners[0]);
    }
    bool has_plane() const { return divisor_ != 0; }  // else it is seen edge-on, or has no area
    bool is_front() const { return projection_.orthographic ? divisor_ > 0 : divisor_ < 0; }
    double change(double nearness, double error) const {
        return (projection_.orthographic ? error : std::abs(nearness) * error) / std::abs(divisor_);
    }

  private:
    const Projection& projection_;
    double divisor_;
};

/// The planes of two triangles.
class PlanePair {
  public:
    PlanePair(const Projection& projection, const glm::dvec3 (&a)[3], const glm::dvec3 (&b)[3])
        : projection_(projection), of_a_(projection, a), of_b_(projection, b) {
        if (!has_both()) return;
        plane_a_ = exact_depth_plane(projection, a);
        plane_b_ = exact_depth_plane(projection, b);
        drift_ = std::abs(plane_a_.per_x - plane_b_.per_x) + std::abs(plane_a_.per_y - plane_b_.per_y);
        snapping_ = plane_a_.snapping_error() + plane_b_.snapping_error();
    }

    bool has_both() const { return of_a_.has_plane() && of_b_.has_plane(); }
    SurfaceOrders at(glm::dvec2 p, const CoordinateErrors& errors) const {
        const double nearness = plane_a_.extended_to(p), gap = nearness - plane_b_.extended_to(p);
        const auto change = [&](double of_a, double of_b) {
            return of_a_.change(nearness, of_a) + of_b_.change(nearness, of_b);
        };
        const double pixel = projection_.pixel_size(projection_.distance(nearness));
        const double error = change(errors.any, errors.any), per_pixel = change(0.5 * pixel, 0.5 * pixel);
        const double visible = change(0.5 * kCoincidentPx * pixel, 0.5 * kCoincidentPx * pixel);
        const double certain = error + snapping_;
        SurfaceOrder order;
        order.have_common_place = true;
        (gap > certain ? order.has_front : gap < -certain ? order.has_behind : order.has_level) = true;
        const double own_error =
            std::min(error, std::max(change(errors.of_a, errors.of_b), kLeastCertainPx * per_pixel));
        (gap > own_error ? order.has_nearer : gap < -own_error ? order.has_farther : order.has_equal) = true;
        order.least_gap_px = order.greatest_gap_px = gap / per_pixel;
        const auto with_limits = [&](double of_one_plane, double of_copies) {
            order.is_apart = !(std::abs(gap) + kAroundPx * drift_ <= of_one_plane);  // so is what is not a number
            order.is_far = !(std::abs(gap) <= of_copies);
            return order;
        };
        return {with_limits(std::max(error, visible), std::max(error, kCopiesApartPx * per_pixel)),
                with_limits(error, error)};
    }

  private:
    const Projection& projection_;
    Sensitivity of_a_, of_b_;
    DepthPlane plane_a_, plane_b_;
    double drift_ = 0, snapping_ = 0;
};

}  // namespace

void SurfaceOrder::operator+=(const SurfaceOrder& o) {
    if (!o.have_common_place) return;
    least_gap_px = have_common_place ? std::min(least_gap_px, o.least_gap_px) : o.least_gap_px;
    greatest_gap_px = have_common_place ? std::max(greatest_gap_px, o.greatest_gap_px) : o.greatest_gap_px;
    have_common_place = true;
    has_front = has_front || o.has_front;
    has_behind = has_behind || o.has_behind;
    has_level = has_level || o.has_level;
    is_apart = is_apart || o.is_apart;
    has_nearer = has_nearer || o.has_nearer;
    has_farther = has_farther || o.has_farther;
    has_equal = has_equal || o.has_equal;
    is_far = is_far || o.is_far;
}

bool faces_eye(const Projection& projection, const glm::dvec3 (&corners)[3]) {
    return Sensitivity(projection, corners).is_front();
}

SurfaceOrders compare_surfaces(const Projection& projection, const glm::dvec3 (&a)[3], const glm::dvec3 (&b)[3],
                               const CoordinateErrors& errors) {
    const ScreenPolygon on_screen_a = project_triangle(projection, a), on_screen_b = project_triangle(projection, b);
    if (are_beside(on_screen_a, on_screen_b)) return {};  // small ones mostly are, and this takes less time
    const PlanePair planes(projection, a, b);
    if (!planes.has_both()) return {};
    const Region region = common_region(projection, on_screen_a, on_screen_b);
    SurfaceOrders orders;
    if (region.is_sliver()) return orders;
    for (const glm::dvec2 p : region.corners()) {
        const SurfaceOrders there = planes.at(p, errors);
        orders.of_one_plane += there.of_one_plane;
        orders.of_two_planes += there.of_two_planes;
    }
    return orders;
}

SurfaceOrders compare_planes(const Projection& projection, const glm::dvec3 (&a)[3], const glm::dvec3 (&b)[3],
                             glm::dvec2 place, const CoordinateErrors& errors) {
    const PlanePair planes(projection, a, b);
    return planes.has_both() ? planes.at(place, errors) : SurfaceOrders{};
}

}  // namespace burin
