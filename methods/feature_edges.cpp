#include "methods/feature_edges.h"

#include <map>

#include "base/parallel.h"
#include "lines/surface_walk.h"

namespace burin {
namespace {

/// The edges of one instance.
class InstanceEdges {
  public:
    InstanceEdges(const Frame& frame, std::uint32_t instance, const PolygonOutlines& outlines)
        : frame_(frame),
          surfaces_(frame.surfaces),
          mesh_(*frame.surfaces.instances[instance].mesh),
          instance_(instance),
          outlines_(outlines),
          faces_(mesh_.polygon_count) {}

    void find_facing(std::uint32_t polygon) { faces_[polygon] = facing_of(polygon); }

    /// Facing of a polygon, or, for a sliver, of the neighbour that it belongs to.
    bool facing_of(std::uint32_t polygon) const {
        const auto triangles = outlines_.triangles(polygon);
        if (triangles.size() != 1) return faces_eye(polygon);
        const HalfEdge longest = longest_edge_of_sliver(triangles[0]);
        if (longest == kNoHalfEdge) return faces_eye(polygon);
        const HalfEdge other = mesh_.next_on_edge[longest];
        if (other == longest || longest_edge_of_sliver(other / 3) != kNoHalfEdge) {
            return faces_eye(polygon);
        }
        return faces_eye(mesh_.polygon_of(other / 3)) == runs_against(longest, other);
    }

    LineClassSet classes_of(HalfEdge h) const {
        if (PolygonOutlines::across_diagonal(mesh_, h) != kNoHalfEdge) return {};
        // The classes of all triangles that share the edge, so that they agree on it where they are more than two.
        LineClassSet classes = edge_classes(surfaces_, {{instance_, h / 3}, h}, frame_.criteria);
        for (HalfEdge g = mesh_.next_on_edge[h]; g != h; g = mesh_.next_on_edge[g]) {
            classes |= edge_classes(surfaces_, {{instance_, g / 3}, g}, frame_.criteria);
        }
        if (mesh_.next_on_edge[h] == h) {
            classes |= classes_of_border(h);
        } else if (is_contour(h)) {
            classes |= LineClass::silhouette;
        }
        return classes & frame_.criteria.classes;
    }

  private:
    std::uint32_t start_of(HalfEdge h) const { return mesh_.triangles[h / 3][h % 3]; }
    glm::dvec3 view(std::uint32_t vertex) const { return surfaces_.view_position(instance_, vertex); }

    /// Whether two half-edges of one edge run in opposite directions, as in consistent winding.
    bool runs_against(HalfEdge a, HalfEdge b) const { return start_of(a) != start_of(b); }

    /// Whether the polygon turns the side to the eye around which its outline runs counterclockwise.
    bool faces_eye(std::uint32_t polygon) const {
        double volume = 0;
        for (const std::uint32_t t : outlines_.triangles(polygon)) {
            glm::dvec3 c[3];
            surfaces_.view_corners({instance_, t}, c);
            const glm::dvec3 area = glm::cross(c[1] - c[0], c[2] - c[0]);
            volume += surfaces_.projection.orthographic ? area.z : -glm::dot(area, c[0]);
        }
        return volume > 0;
    }

    bool is_contour(HalfEdge h) const {
        for (HalfEdge g = mesh_.next_on_edge[h]; g != h; g = mesh_.next_on_edge[g]) {
            const bool a = faces_[mesh_.polygon_of(h / 3)];
            const bool b = faces_[mesh_.polygon_of(g / 3)];
            if ((a == b) != runs_against(h, g)) return true;
        }
        return false;
    }

    /// The longest edge of a triangle that is a sliver; kNoHalfEdge for others.
    HalfEdge longest_edge_of_sliver(std::uint32_t t) const {
        glm::dvec3 c[3];
        surfaces_.view_corners({instance_, t}, c);
        HalfEdge longest = 0;
        double length = 0;
        for (HalfEdge k = 0; k < 3; ++k) {
            const double l = glm::distance(c[k], c[(k + 1) % 3]);
            if (l > length) {
                length = l;
                longest = k;
            }
        }
        return is_sliver(surfaces_, {instance_, t}) ? 3 * t + longest : kNoHalfEdge;
    }

    /// The edge has one polygon: a border, or a seam that another patch continues.
    LineClassSet classes_of_border(HalfEdge h) const {
        const auto& t = mesh_.triangles[h / 3];
        const std::uint32_t a = t[h % 3], b = t[(h % 3 + 1) % 3];
        const glm::dvec3 middle = 0.5 * (mesh_.local_position(a) + mesh_.local_position(b));
        const auto partner = mesh_.borders.seam_partner(h, middle);
        if (!partner) return LineClass::border;
        const SurfaceId own{instance_, h / 3}, other{instance_, *partner / 3};
        const glm::dvec3 seen = 0.5 * (view(a) + view(b));
        LineClassSet classes;
        if (-seen.z > surfaces_.projection.near_distance) {
            classes = contact_classes(surfaces_, own, other, surfaces_.projection.to_pixel(seen), frame_.criteria);
        }
        // The patches need not agree in winding: they face apart if both lie on one side of the edge.
        if (same_side_of_edge(view(a), view(b), third_corner(h), third_corner(*partner))) {
            classes |= LineClass::silhouette;
        }
        return classes;
    }
    glm::dvec3 third_corner(HalfEdge h) const { return view(mesh_.triangles[h / 3][(h % 3 + 2) % 3]); }
    /// Whether two points are on one side of an edge, as the eye sees it.
    bool same_side_of_edge(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p, const glm::dvec3& q) const {
        const glm::dvec3 towards_eye = surfaces_.projection.orthographic ? glm::dvec3(0, 0, 1) : -a;
        const glm::dvec3 side = glm::cross(b - a, towards_eye);
        return glm::dot(side, p - a) * glm::dot(side, q - a) > 0;
    }

    const Frame& frame_;
    const SurfaceSet& surfaces_;
    const Mesh& mesh_;
    std::uint32_t instance_;
    const PolygonOutlines& outlines_;
    std::vector<std::uint8_t> faces_;  // per polygon; bytes, so that threads can write side by side
};

}  // namespace

FeatureEdges::FeatureEdges(const Frame& frame, int threads) {
    std::map<const Mesh*, std::size_t> known;
    std::vector<const Mesh*> meshes;
    for (const SurfaceInstance& instance : frame.surfaces.instances) {
        const auto [at, is_new] = known.emplace(instance.mesh, meshes.size());
        if (is_new) meshes.push_back(instance.mesh);
        outlines_of_instance_.push_back(at->second);
    }
    std::vector<std::optional<PolygonOutlines>> made(meshes.size());
    parallel_for(meshes.size(), threads, [&](std::size_t i, int) { made[i].emplace(*meshes[i]); });
    for (auto& outlines : made) outlines_.push_back(std::move(*outlines));

    classes_.resize(frame.surfaces.instances.size());
    for (std::uint32_t i = 0; i < classes_.size(); ++i) {
        const Mesh& mesh = *frame.surfaces.instances[i].mesh;
        InstanceEdges edges(frame, i, outlines(i));
        std::vector<LineClassSet>& classes = classes_[i];
        classes.resize(3 * mesh.triangles.size());
        parallel_for_each(mesh.polygon_count, threads,
                          [&](std::size_t p) { edges.find_facing(static_cast<std::uint32_t>(p)); });
        parallel_for_each(classes.size(), threads,
                          [&](std::size_t h) { classes[h] = edges.classes_of(static_cast<HalfEdge>(h)); });
    }
}

}  // namespace burin
