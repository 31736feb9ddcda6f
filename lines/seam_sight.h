#pragma once

#include <optional>

#include "view/surface_set.h"

// Seams are looked for as the eye sees them: gaps wider than a pixel are none.

namespace burin {

/// Borders of two patches farther apart than this on the screen are no seam. Pixels.
constexpr double kWidestCrackPx = 1;

/// Finds the border of another patch that runs along a border at a place on it, in the mesh's coordinates. It is
/// BorderIndex::seam_partner() for callers that take no partner farther than kWidestCrackPx from the place on the
/// screen, and may find none of those that are farther.
std::optional<HalfEdge> seam_partner_seen(const SurfaceSet& surfaces, std::uint32_t instance, HalfEdge border,
                                          const glm::dvec3& at);

/// The line of sight through a place in a mesh's coordinates, with all around it that may be seen as near to the place.
/// Nothing where that is no narrow cone, as beside the eye.
std::optional<BorderIndex::Sight> sight_through(const SurfaceSet& surfaces, std::uint32_t instance,
                                                const glm::dvec3& at);

}  // namespace burin
