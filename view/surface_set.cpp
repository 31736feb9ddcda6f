#include "view/surface_set.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "view/rounded_copies.h"

namespace burin {
namespace {

/// The most pairs of triangles that two polygons are compared by. If there are more, only the two triangles are
/// compared: time would grow with the square of the corners.
constexpr std::uint64_t kMostComparisons = 16;

/// The triangles [first, second) of the polygon that a triangle belongs to, or some of them if there are many.
std::pair<std::uint32_t, std::uint32_t> triangles_of_polygon(const Mesh& mesh, std::uint32_t triangle) {
    std::uint32_t begin = triangle, end = triangle + 1;
    if (mesh.triangle_polygon.empty()) return {begin, end};
    const std::uint32_t polygon = mesh.polygon_of(triangle);
    while (begin > 0 && triangle - begin <= kMostComparisons && mesh.polygon_of(begin - 1) == polygon) --begin;
    while (end < mesh.triangles.size() && end - triangle <= kMostComparisons && mesh.polygon_of(end) == polygon) ++end;
    return {begin, end};
}

}  // namespace

SurfaceOrder SurfaceSet::order(SurfaceId a, SurfaceId b, OrderMemory* memory) const {
    SurfaceOrder order = order_of_polygons(a, b);
    const bool may_be_copies =
        order.have_common_place && !order.is_far && (order.has_nearer || order.has_farther) && !order.are_coincident();
    order.is_of_copies = may_be_copies && are_rounded_copies(*this, a, b, memory);
    return order;
}

SurfaceOrder SurfaceSet::order_of_polygons(SurfaceId a, SurfaceId b) const {
    if (are_of_one_polygon(a, b)) return {};
    // The triangles in question are compared first: they tell for most.
    SurfaceOrder order = compare(a, b, nullptr);
    const auto [begin_a, end_a] = triangles_of_polygon(mesh_of(a), a.triangle);
    const auto [begin_b, end_b] = triangles_of_polygon(mesh_of(b), b.triangle);
    if (std::uint64_t{end_a - begin_a} * (end_b - begin_b) > kMostComparisons) return order;
    for (std::uint32_t s = begin_a; s < end_a; ++s) {
        for (std::uint32_t t = begin_b; t < end_b; ++t) {
            if (order.is_apart) return order;
            if (s != a.triangle || t != b.triangle) order += compare({a.instance, s}, {b.instance, t}, nullptr);
        }
    }
    return order;
}

SurfaceOrder SurfaceSet::compare(SurfaceId s, SurfaceId t, const glm::dvec2* place) const {
    glm::dvec3 corners_s[3], corners_t[3];
    view_corners(s, corners_s);
    view_corners(t, corners_t);
    const CoordinateErrors errors(coordinate_error, rounding_error(s, corners_s), rounding_error(t, corners_t));
    const SurfaceOrders orders = place != nullptr ? compare_planes(projection, corners_s, corners_t, *place, errors)
                                                  : compare_surfaces(projection, corners_s, corners_t, errors);
    const SurfaceOrder &order = orders.of_one_plane, &exact = orders.of_two_planes;
    // Mostly there is no need to know where bodies are.
    if (s.instance != t.instance || order.is_far || !order.have_common_place || !exact.is_apart) return order;
    // A thin sheet has two sides. Bodies that are flush with each other may be wound either way.
    const bool s_faces_eye = faces_eye(projection, corners_s), t_faces_eye = faces_eye(projection, corners_t);
    const bool face_alike = s_faces_eye == t_faces_eye;
    const BodySides& sides = *instance_of(s).body_sides;
    if (sides.are_same(s.triangle, t.triangle)) return face_alike ? order : exact;
    const int of_s = sides.of(s.triangle), of_t = sides.of(t.triangle);
    const bool are_on_one_side =
        of_s == 0 || of_t == 0 ? face_alike : (s_faces_eye ? of_s : -of_s) == (t_faces_eye ? of_t : -of_t);
    return are_on_one_side ? order : exact;
}

double SurfaceSet::rounding_error(SurfaceId s, const glm::dvec3 (&corners)[3]) const {
    constexpr double kRounding = 0x1p-23;  // twice that of one number
    const Mesh& mesh = mesh_of(s);
    const auto& t = mesh.triangles[s.triangle];
    const glm::dvec3 p[3] = {glm::dvec3(mesh.positions[t[0]]), glm::dvec3(mesh.positions[t[1]]),
                             glm::dvec3(mesh.positions[t[2]])};
    const glm::dvec3 area = glm::cross(p[1] - p[0], p[2] - p[0]);
    const glm::dvec3 largest = glm::max(glm::abs(p[0]), glm::max(glm::abs(p[1]), glm::abs(p[2])));
    // Volumes grow by the determinant, and this area by that of the triangle: heights by what is left.
    const double volume =
        std::abs(glm::determinant(glm::dmat3(instance_of(s).to_view))) * glm::dot(glm::abs(area), largest);
    const double area_in_view = glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    return area_in_view > 0 ? kRounding * volume / area_in_view : coordinate_error;
}

}  // namespace burin
