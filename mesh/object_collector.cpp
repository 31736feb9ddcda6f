#include "mesh/object_collector.h"

#include <algorithm>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/interrupt.h"
#include "mesh/repeated_edges.h"

namespace burin {
namespace {

/// Triangulating and comparing longer ones takes minutes.
constexpr std::size_t kMaxPolygonCorners = 100000;

}  // namespace

PolygonsByObject group_by_object(const PolygonSoup& soup) {
    PolygonsByObject groups;
    const std::size_t objects = std::max<std::size_t>(1, soup.object_names.size());
    groups.end.assign(objects, 0);
    if (soup.polygon_object.empty()) {
        groups.end[0] = soup.polygon_count();
        return groups;
    }
    for (const std::uint32_t object : soup.polygon_object) ++groups.end[object];
    std::size_t sum = 0;
    for (std::size_t& end : groups.end) end = std::exchange(sum, sum + end);
    groups.order.resize(soup.polygon_count());
    for (std::uint32_t i = 0; i < groups.order.size(); ++i) {
        groups.order[groups.end[soup.polygon_object[i]]++] = i;
    }
    return groups;
}

glm::dvec3 normal_of_any_corners(std::span<const glm::dvec3> corners) {
    glm::dvec3 along(0.0);
    for (const glm::dvec3& corner : corners.subspan(1)) {
        const glm::dvec3 d = corner - corners[0];
        if (along == glm::dvec3(0.0)) {
            along = d;
        } else if (const glm::dvec3 normal = glm::cross(along, d); normal != glm::dvec3(0.0)) {
            return normal;
        }
    }
    return glm::dvec3(0.0);
}

ObjectCollector::ObjectCollector(const PolygonSoup& soup, const std::vector<glm::vec3>& positions,
                                 const std::vector<glm::vec3>& residuals, const std::vector<std::uint32_t>& welded,
                                 const MarkedEdges& marks, const MovingVertices* moving)
    : soup_(soup),
      positions_(positions),
      residuals_(residuals),
      welded_(welded),
      local_(positions.size(), kUnused),
      is_corner_(positions.size(), false),
      is_welded_corner_(positions.size(), false),
      marks_(marks),
      moving_(moving) {}

PolygonMesh ObjectCollector::collect(const PolygonsByObject& groups, std::size_t begin, std::size_t end,
                                     MeshRepairs& repairs, std::vector<std::uint32_t>& dropped) {
    PolygonMesh mesh;
    mesh.corners.reserve(3 * (end - begin));
    for (std::size_t i = begin; i < end; ++i) {
        if ((i & 0xFFFF) == 0) throw_if_interrupted();
        const std::size_t polygon = groups.order.empty() ? i : groups.order[i];
        if (soup_.polygon(polygon).size() > kMaxPolygonCorners) {
            throw InputError("a polygon has " + std::to_string(soup_.polygon(polygon).size()) +
                             " corners, more than 100000; split it");
        }
        collapse(soup_.polygon(polygon), repairs);
        if (corners_.size() < 3 || (has_no_area() && !may_get_area())) {
            ++repairs.degenerate_polygons;
            dropped.push_back(static_cast<std::uint32_t>(i - begin));
            continue;
        }
        for (std::uint32_t& v : corners_) v = local_number(v, mesh);
        mesh.add_polygon(corners_);
        if (!soup_.polygon_material.empty()) {
            mesh.polygon_material.push_back(soup_.material_of(polygon));
        }
        if (knows_sources()) mesh.sources.push_back(static_cast<std::uint32_t>(polygon));
    }
    if (knows_sources()) mesh.source_vertices = used_;
    if (!residuals_.empty()) {
        for (const std::uint32_t v : used_) mesh.residuals.push_back(residuals_[v]);
    }
    add_marks(mesh);
    repairs.welded_vertices = corners_seen_ - welded_corners_seen_;
    forget(groups, begin, end);
    return mesh;
}

/// The polygon's welded corners, without repetitions in a row and spikes, into corners_.
void ObjectCollector::collapse(std::span<const std::uint32_t> corners, MeshRepairs& repairs) {
    ++repairs.input_polygons;
    if (corners.size() > 2) repairs.input_triangles += corners.size() - 2;
    corners_.clear();
    for (const std::uint32_t corner : corners) {
        const std::uint32_t v = welded_[corner];
        if (!is_corner_[corner]) {
            is_corner_[corner] = true;
            ++corners_seen_;
            welded_corners_seen_ += !is_welded_corner_[v];
            is_welded_corner_[v] = true;
        }
        corners_.push_back(v);
    }
    remove_spikes(corners_);
}

/// The marks between vertices of the object.
void ObjectCollector::add_marks(PolygonMesh& mesh) {
    collected_marks_.clear();
    if (marks_.empty()) return;
    for (const std::uint32_t u : used_) {
        marks_.for_marks_from(u, [&](std::size_t mark, std::uint32_t other) {
            const std::uint32_t v = local_[other];
            if (v == kUnused) return;
            mesh.marked_edges.push_back({local_[u], v});
            collected_marks_.push_back(mark);
        });
    }
}

/// Makes ready for the next object.
void ObjectCollector::forget(const PolygonsByObject& groups, std::size_t begin, std::size_t end) {
    for (const std::uint32_t v : used_) local_[v] = kUnused;
    used_.clear();
    corners_seen_ = welded_corners_seen_ = 0;
    if (groups.order.empty()) return;  // there is no other object
    for (std::size_t i = begin; i < end; ++i) {
        for (const std::uint32_t corner : soup_.polygon(groups.order[i])) {
            is_corner_[corner] = false;
            is_welded_corner_[welded_[corner]] = false;
        }
    }
}

bool ObjectCollector::has_no_area() {
    places_.clear();
    for (const std::uint32_t v : corners_) places_.emplace_back(positions_[v]);
    if (!residuals_.empty()) {
        for (std::size_t i = 0; i < corners_.size(); ++i) places_[i] += glm::dvec3(residuals_[corners_[i]]);
    }
    return normal_of_any_corners(places_) == glm::dvec3(0.0);
}

/// Whether some corners move otherwise than others.
bool ObjectCollector::may_get_area() const {
    return moving_ != nullptr && std::any_of(corners_.begin(), corners_.end(), [&](std::uint32_t v) {
               return moving_->kinds[v] != moving_->kinds[corners_[0]];
           });
}

std::uint32_t ObjectCollector::local_number(std::uint32_t v, PolygonMesh& mesh) {
    if (local_[v] == kUnused) {
        local_[v] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(positions_[v]);
        used_.push_back(v);
    }
    return local_[v];
}

}  // namespace burin
