#pragma once

#include "lines/surface_walk.h"

namespace burin {

/// walk_surface() where only its end is wanted, which is found sooner: what it crosses is not looked at. `sharp`:
/// find_sharp_edges() of the mesh, which tells of most triangles that they are no slivers; or nullptr.
SurfaceWalk walk_to_end(const SurfaceSet& surfaces, SurfaceId start, glm::dvec2 from, glm::dvec2 to, const LineCriteria& criteria,
                        int most_triangles, const std::uint8_t* sharp);

}  // namespace burin
