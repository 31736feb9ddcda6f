#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "mesh/gltf_buffers.h"
#include "mesh/gltf_skin_weights.h"
#include "mesh/gltf_surface.h"

// How the vertices of a glTF mesh move with the weights of morph targets and with joints.

namespace burin {

/// What the accessors of a mesh say of the motion of its vertices, one after the other.
class GltfDeformation {
  public:
    /// `surface`: before anything has moved it. `target_count`: of morph targets that each primitive must have; 0: they
    /// do not count. `joint_count`: of the skin; 0: it has none.
    GltfDeformation(const GltfSurface& surface, std::size_t target_count, std::size_t joint_count,
                    GltfBuffers& buffers);

    /// An upper bound of the memory that one takes.
    static std::uint64_t most_bytes(std::uint64_t vertices, std::size_t target_count, bool has_skin);

    /// Where the vertices are: morph targets first, then joints, as pose_gltf_mesh() has it, to the bit.
    /// `weights`: of the targets; empty: all 0. `joint_matrices`: of the skin. Throws InputError if a vertex is then
    /// not finite or beyond 1e30.
    std::vector<glm::dvec3> positions(std::span<const double> weights,
                                      std::span<const glm::dmat4> joint_matrices) const;

    /// A number per vertex, equal where vertices depend on the same targets and joints by the same amounts: those that
    /// are in one place stay together whatever moves them.
    std::vector<std::uint32_t> kinds() const;

  private:
    struct Delta {
        std::uint32_t target = 0;
        glm::dvec3 by{0.0};
    };
    void add_targets_of(const GltfVertices& vertices, std::size_t target_count, GltfBuffers& buffers);
    void add_influences_of(const GltfVertices& vertices, std::size_t joint_count, const std::vector<bool>& is_used,
                           GltfBuffers& buffers);
    std::span<const Delta> deltas_of(std::size_t vertex) const;
    std::span<const GltfInfluence> influences_of(std::size_t vertex) const;
    int compare(std::size_t a, std::size_t b) const;

    std::string place_;  // of the mesh, for messages
    std::vector<glm::dvec3> base_;
    // Of vertex v: those in [ends[v - 1], ends[v]); no ends: nothing of the kind.
    std::vector<Delta> deltas_;
    std::vector<std::uint64_t> delta_ends_;
    std::vector<GltfInfluence> influences_;
    std::vector<std::uint64_t> influence_ends_;
};

}  // namespace burin
