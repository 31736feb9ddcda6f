#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "kernels/tile_kernels.h"
#include "scene/scene.h"
#include "view/surface_set.h"

namespace burin {

/// Tells which triangles of a scene may pass through each other, whatever the view.
class IntersectionTest {
  public:
    using Triangle = std::array<glm::dvec3, 3>;

    explicit IntersectionTest(const Scene& scene);

    enum class Meeting : std::uint8_t {
        none,        ///< they are apart, or touch
        through,     ///< they pass through each other, by more than rounding, or almost
        along_edge,  ///< so they would, but an edge of one lies in the other's plane, to rounding, and the rest of it
                     ///< on one side
    };
    Meeting meeting(const Triangle& p, const Triangle& q) const;
    /// Whether two triangles pass through each other, or the surface of one does along its edge, which then stands for
    /// one of the two triangles there.
    bool may_intersect(SurfaceId a, SurfaceId b) const {
        const Meeting m = meeting(triangle(a), triangle(b));
        return m == Meeting::through || (m == Meeting::along_edge && goes_on_beyond(a, b) && goes_on_beyond(b, a));
    }

    /// A vertex of an object, from the scene's middle.
    glm::dvec3 position(std::uint32_t object, std::uint32_t vertex) const {
        const Place& p = places_[object];
        const glm::dvec3 at = p.mesh->local_position(vertex);
        return p.axes[0] * at.x + p.axes[1] * at.y + (p.axes[2] * at.z + p.origin);
    }
    /// The diagonal of the box of all vertices.
    double extent() const { return extent_; }
    /// The box around a triangle, in single precision and no smaller for it; nearness is the third axis.
    static ScreenBox box_of(const Triangle& t);

  private:
    struct Place {
        const Mesh* mesh;
        glm::dmat3 axes;
        glm::dvec3 origin;
    };
    Triangle triangle(SurfaceId s) const;
    bool goes_on_beyond(SurfaceId s, SurfaceId plane) const;

    std::vector<Place> places_;  // per object
    double extent_ = 0;
};

/// All pairs of triangles without a vertex in common that may intersect, in ascending order, the smaller one first.
/// Nothing if there are too many triangles or pairs to be worth their memory, if more boxes overlap than a view would
/// have to look at, or if the scene is too large to calculate with.
std::optional<std::vector<SurfacePair>> find_intersecting_pairs(const Scene& scene, const TileKernels& kernels,
                                                                int threads);

}  // namespace burin
