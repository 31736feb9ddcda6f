#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "mesh/gltf_buffers.h"
#include "mesh/gltf_json.h"
#include "mesh/gltf_nodes.h"
#include "mesh/gltf_surface.h"

// Morph targets and skins move vertices to where they stand without animation.

namespace burin {

/// The joints of a skin, and where they take a vertex that depends on one of them alone.
struct GltfSkin {
    std::vector<std::uint32_t> joints;  ///< nodes
    std::vector<glm::dmat4> inverse_binds;
    std::vector<glm::dmat4> joint_matrices;  ///< joint's world matrix x inverse bind matrix
};
GltfSkin read_gltf_skin(const JsonPlace& skin, const GltfNodes& nodes, GltfBuffers& buffers);

/// How much of each morph target a node adds to its mesh while nothing moves: `node.weights`, else
/// `mesh.weights`. Empty if nothing is added.
std::vector<double> gltf_morph_weights(const JsonPlace& node, const JsonPlace& mesh);

/// Which vertices polygons or marked edges have.
std::vector<bool> used_vertices(const PolygonSoup& soup);

/// The displacements of a morph target's vertices: an accessor with as many elements as they have.
GltfAccessor gltf_target(const GltfVertices& vertices, const JsonPlace& reference, GltfBuffers& buffers);

/// Adds morph targets to the positions of a mesh, then puts them where the joints of `skin` are
/// (nullptr: it has none). Vertices that are equal in all that their accessors say end in the same
/// place, to the bit.
void pose_gltf_mesh(GltfSurface& surface, const std::vector<double>& weights, const GltfSkin* skin,
                    GltfBuffers& buffers);

}  // namespace burin
