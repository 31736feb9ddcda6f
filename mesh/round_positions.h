#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "mesh/polygon_soup.h"

// Coordinates in double precision become positions in single precision, relative to an origin that fits the file.

namespace burin {

/// The places of a soup's vertices as meshes keep them: origin + position + residual.
struct RoundedPositions {
    glm::dvec3 origin{0.0};
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> residuals;  ///< empty where single precision resolves the model
};

/// Rounds the places of all vertices, seen from an origin for all objects of the soup. No
/// coordinate becomes -0.
///
/// The origin is 0, or the model's centre if the model lies more than 16 times its half size away
/// from 0. Where single precision would blur what the model is made of even so, as with parts far
/// from a marker at 0, or a small part on a huge ground, it is the median of the corners, and
/// residuals keep what is lost. Vertices that no polygon and no
/// marked edge uses do not count.
RoundedPositions round_positions(const PolygonSoup& soup);

/// For every vertex the number of the first one in the same place.
std::vector<std::uint32_t> weld_vertices(const RoundedPositions& rounded);

}  // namespace burin
