#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "lines/mesh_curvature.h"
#include "shading/ink/line_sides.h"
#include "shading/sheet/surface_needs.h"

namespace burin {

/// SurfaceValues gives what smooth surfaces and files say at places on triangles: the columns of SurfaceNeeds. It may
/// be used by several threads.
class SurfaceValues {
  public:
    /// `curvatures`: of the mesh of each instance; needed for `kr` only. All must outlive this.
    SurfaceValues(const SurfaceSet& surfaces, const SurfaceNeeds& needs,
                  std::span<const MeshCurvature* const> curvatures);

    /// Writes the columns at both ends of a piece of a line, one after the other. `front`: where its front side is.
    void write(const LinePiece& piece, const FrontFace& front, std::span<float> to) const;
    /// Writes the columns at a place on a triangle. `weights`: of its corners, with the sum 1; `eye`: the unit vector
    /// from there to the eye, in view space.
    void write_at(SurfaceId surface, const std::array<double, 3>& weights, const glm::dvec3& eye,
                  std::span<float> to) const;
    /// The weights of a triangle's corners at the place on it that is nearest to one in view space.
    std::array<double, 3> weights_at(SurfaceId surface, const glm::dvec3& place) const;

  private:
    std::array<double, 3> weights_on_edge(const FrontFace& front, const glm::dvec3& place) const;

    const SurfaceSet& surfaces_;
    const SurfaceNeeds& needs_;
    std::span<const MeshCurvature* const> curvatures_;
    std::vector<glm::dmat3> from_view_;  // per instance, if there are curvatures
};

}  // namespace burin
