#include "render/frame_reach.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>

#include "view/screen_polygon.h"

namespace burin {
namespace {

/// Single-precision coordinates are exact to 2^-24 of their size; transforms of files and the
/// planes of small triangles lose some more. With residuals they are exact to 2^-46. What
/// transforms lose of a place in double precision comes on top.
constexpr double kError = 0x1p-21, kErrorWithResiduals = 0x1p-44, kErrorOfPlaces = 0x1p-49;
/// A scene is uneven if it is at least this many times as large as one of its objects.
constexpr double kUneven = 64;
/// The near plane, as a part of how far the scene reaches: usually, and where a surface comes as
/// near to the eye as that.
constexpr double kUsualNear = 0x1p-20, kNearest = 0x1p-40;
/// Single precision tells places apart in depth that are 1/64 pixel's width apart if the scene is
/// no deeper than this.
constexpr double kDeepestPx = 0x1p18;

double half_diagonal(const Box& box) { return box.is_empty() ? 0 : 0.5 * glm::distance(box.low, box.high); }

Box around(std::span<const Box> boxes) {
    Box all;
    for (const Box& box : boxes) {
        if (box.is_empty()) continue;
        all.add(box.low);
        all.add(box.high);
    }
    return all;
}

bool is_uneven(const SurfaceSet& surfaces, std::span<const Box> view_boxes, double size) {
    for (std::size_t i = 0; i < view_boxes.size(); ++i) {
        const Mesh& mesh = *surfaces.instances[i].mesh;
        if (mesh.triangles.empty()) continue;
        if (mesh.has_residuals() || kUneven * half_diagonal(view_boxes[i]) < size) return true;
    }
    return false;
}

/// How far off a mesh's coordinates may be, along its axes, and how much its surface turns to
/// these.
struct MeshError {
    glm::dvec3 of_coordinates{0.0}, largest_normal{0.0};

    explicit MeshError(const Mesh& mesh) {
        const double part = mesh.has_residuals() ? kErrorWithResiduals : kError;
        // Whole numbers and the like, which end in zeros, were not rounded.
        constexpr std::uint32_t kLowBits = 63;
        for (const glm::vec3& p : mesh.positions) {
            for (int k = 0; k < 3; ++k) {
                if (!mesh.has_residuals() && (std::bit_cast<std::uint32_t>(p[k]) & kLowBits) == 0) continue;
                of_coordinates[k] = std::max(of_coordinates[k], part * static_cast<double>(std::abs(p[k])));
            }
        }
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const glm::dvec3 area = mesh.polygon_area_vector(t);
            largest_normal = glm::max(largest_normal, glm::abs(area) / std::max(glm::length(area), 1e-300));
        }
    }

    /// By how much such an error moves surfaces along their normals, in view space.
    double in_view(const glm::dmat4& to_view) const {
        const glm::dvec3 scale(glm::length(glm::dvec3(to_view[0])), glm::length(glm::dvec3(to_view[1])),
                               glm::length(glm::dvec3(to_view[2])));
        return glm::dot(of_coordinates, glm::min(scale, glm::length(scale) * largest_normal));
    }
};

double coordinate_error(const SurfaceSet& surfaces, std::span<const Box> view_boxes, double size, double places) {
    if (!is_uneven(surfaces, view_boxes, size)) return kError * size;
    std::map<const Mesh*, MeshError> known;
    double error = 0;
    for (const SurfaceInstance& instance : surfaces.instances) {
        auto it = known.find(instance.mesh);
        if (it == known.end()) it = known.emplace(instance.mesh, *instance.mesh).first;
        error = std::max(error, it->second.in_view(instance.to_view));
    }
    return std::min(error + kErrorOfPlaces * places, kError * size);
}

double distance_from_eye(const Box& box) {
    return glm::length(glm::max(glm::max(box.low, -box.high), glm::dvec3(0.0)));
}

double distance_from_eye(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 way = b - a;
    const double square = glm::dot(way, way), share = square > 0 ? std::clamp(-glm::dot(a, way) / square, 0.0, 1.0) : 0;
    return glm::length(a + share * way);
}

double distance_from_eye(const glm::dvec3 (&c)[3]) {
    const double least =
        std::min({distance_from_eye(c[0], c[1]), distance_from_eye(c[1], c[2]), distance_from_eye(c[2], c[0])});
    const glm::dvec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
    const double length = glm::length(normal), height = glm::dot(normal, c[0]);
    // The foot of the perpendicular lies within the triangle if it is on one side of all edges.
    int left = 0, right = 0;
    for (int k = 0; k < 3; ++k) (glm::dot(glm::cross(c[k], c[(k + 1) % 3]), normal) < 0 ? right : left) += 1;
    return length > 0 && (left == 0 || right == 0) ? std::min(least, std::abs(height) / length) : least;
}

/// How near the surfaces come to the eye, or `most`.
double nearest_surface(const SurfaceSet& surfaces, std::span<const Box> view_boxes, double most) {
    for (std::uint32_t i = 0; i < view_boxes.size(); ++i) {
        if (view_boxes[i].is_empty() || !(distance_from_eye(view_boxes[i]) < most)) continue;
        const auto count = static_cast<std::uint32_t>(surfaces.instances[i].mesh->triangles.size());
        for (std::uint32_t t = 0; t < count; ++t) {
            glm::dvec3 c[3];
            surfaces.view_corners({i, t}, c);
            Box box;
            for (const glm::dvec3& corner : c) box.add(corner);
            if (distance_from_eye(box) < most) most = std::min(most, distance_from_eye(c));
        }
    }
    return most;
}

/// Nothing that is seen is cut away, unless it is nearer than kNearest.
double near_distance(const SurfaceSet& surfaces, std::span<const Box> view_boxes, double farthest,
                     glm::dvec2 picture_px) {
    const Projection& p = surfaces.projection;
    const double usual = kUsualNear * farthest;
    const glm::dvec2 corner_px = glm::max(p.center_px, picture_px - p.center_px);
    const double to_corner = glm::length(glm::dvec3(corner_px / p.focal_xy_px(), 1));  // of the picture, at depth 1
    const double nearest = nearest_surface(surfaces, view_boxes, usual * to_corner);
    return nearest < usual * to_corner ? std::max(0.5 * nearest / to_corner, kNearest * farthest) : usual;
}

/// The distance of the farthest vertex that is on the screen; nothing if none is.
double farthest_on_screen(const SurfaceSet& surfaces, double otherwise) {
    double farthest = -std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < surfaces.instances.size(); ++i) {
        const auto count = static_cast<std::uint32_t>(surfaces.instances[i].mesh->positions.size());
        for (std::uint32_t v = 0; v < count; ++v) {
            const glm::dvec3 view = surfaces.view_position(i, v);
            if (needs_no_clipping(surfaces.projection, view)) farthest = std::max(farthest, -view.z);
        }
    }
    return farthest > -std::numeric_limits<double>::infinity() ? farthest : otherwise;
}

}  // namespace

void set_reach(SurfaceSet& surfaces, std::span<const Box> view_boxes, double eye_distance, glm::dvec2 picture_px) {
    Projection& projection = surfaces.projection;
    const Box all = around(view_boxes);
    double farthest = 0, depth = 1;
    if (!all.is_empty()) {
        farthest = glm::length(glm::max(glm::abs(all.low), glm::abs(all.high)));
        surfaces.coordinate_error = coordinate_error(surfaces, view_boxes, half_diagonal(all), farthest + eye_distance);
        depth = -all.low.z;
    }
    if (!projection.orthographic) projection.near_distance = near_distance(surfaces, view_boxes, farthest, picture_px);
    const double depth_px =
        projection.orthographic ? (all.high.z - all.low.z) * projection.focal_px : projection.focal_px;
    if (!all.is_empty() && depth_px > kDeepestPx) depth = farthest_on_screen(surfaces, depth);
    if (!projection.orthographic) depth = std::max(depth, projection.near_distance);
    surfaces.farthest_nearness = projection.nearness({0, 0, -depth});
}

}  // namespace burin
