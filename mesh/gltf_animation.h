#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesh/animation_choice.h"
#include "mesh/gltf_buffers.h"
#include "mesh/gltf_json.h"
#include "mesh/gltf_nodes.h"
#include "mesh/gltf_sampler.h"

// The animations of a glTF file: what moves which nodes, and how.

namespace burin {

/// What of a node an animation moves.
enum class GltfPath : std::uint8_t { translation, rotation, scale, weights };

/// The keys that move one property of a node.
struct GltfChannel {
    std::uint32_t node = 0;
    GltfPath path = GltfPath::translation;
    GltfSampler sampler;
};

struct GltfAnimation {
    std::vector<GltfChannel> channels;
    std::vector<std::string> notes;  ///< what is left out, a line each
};

/// The number of the animation that is chosen; none: the file has none, or it is to stand still. Throws InputError if
/// there is no such animation. `path`: of the file. `root`: its whole JSON.
std::optional<std::uint32_t> chosen_gltf_animation(const std::string& path, const JsonPlace& root,
                                                   const AnimationChoice& choice);

/// Reads an animation and checks all of it: numbers are finite, times ascend, there are as many values as keys need.
/// `nodes`: of the file. What the keys take is counted in `budget` first.
GltfAnimation read_gltf_animation(const JsonPlace& root, std::uint32_t number, const GltfNodes& nodes,
                                  GltfBuffers& buffers, ModelBudget& budget);

/// The names and lengths of all animations. `notes`: gets what is wrong with an animation whose length cannot be read,
/// which has 0 seconds then.
std::vector<AnimationSummary> list_gltf_animations(const JsonPlace& root, GltfBuffers& buffers,
                                                   std::vector<std::string>& notes);

}  // namespace burin
