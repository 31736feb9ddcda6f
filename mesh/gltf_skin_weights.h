#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/gltf_buffers.h"
#include "mesh/gltf_json.h"
#include "mesh/gltf_vertices.h"

// How much each vertex of a skin depends on which joints is read from JOINTS_n and WEIGHTS_n.

namespace burin {

/// How much a vertex depends on a joint.
struct GltfInfluence {
    std::uint32_t joint = 0;
    double weight = 0;

    auto operator<=>(const GltfInfluence&) const = default;
};

/// The accessors JOINTS_n and WEIGHTS_n of some vertices.
class GltfSkinWeights {
  public:
    GltfSkinWeights(const GltfVertices& vertices, std::size_t joint_count, GltfBuffers& buffers);

    /// The influences on a vertex, by joint, each once: the order in the file must not matter. They sum to 1, or are
    /// empty if the vertex depends on none.
    const std::vector<GltfInfluence>& of(std::uint64_t element);

    /// Says that a vertex depends on no joint.
    [[noreturn]] void fail(std::uint64_t element) const;

  private:
    struct Set {
        std::string joints_name, weights_name;
        GltfAccessor joints, weights;
    };

    bool has(const char* prefix, int n) const;
    void add(const Set& set, std::uint64_t element, int component);

    JsonPlace attributes_;
    std::size_t joint_count_;
    std::vector<Set> sets_;
    std::vector<GltfInfluence> influences_;
};

}  // namespace burin
