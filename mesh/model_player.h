#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "mesh/deforming_mesh.h"
#include "mesh/gltf_motion.h"
#include "mesh/mesh.h"

// A model that moves: where its parts are at a time.

namespace burin {

/// A model at a time.
struct ModelMoment {
    std::vector<glm::dmat4> objects;                     ///< to the model's space, per object
    std::vector<glm::dmat4> cameras;                     ///< the same per camera
    std::vector<std::pair<std::uint32_t, Mesh>> meshes;  ///< those that deform, by number
};

/// How a model moves. It does not change once it is made, so several threads may ask at a time.
class ModelPlayer {
  public:
    /// A mesh of the model that deforms.
    struct Part {
        std::uint32_t mesh = 0;
        DeformingMesh surface;
        GltfMover mover;
    };

    /// `objects` and `cameras`: those of the model; of cameras the nodes.
    ModelPlayer(GltfRig rig, std::vector<RiggedObject> objects, std::vector<std::uint32_t> cameras,
                std::vector<Part> parts)
        : rig_(std::move(rig)), objects_(std::move(objects)), cameras_(std::move(cameras)), parts_(std::move(parts)) {}

    /// The model at a time, counted as its file does. Throws InputError, without the file's name, if something is then
    /// not finite or beyond 1e30.
    ModelMoment at(double time_s) const;

  private:
    GltfRig rig_;
    std::vector<RiggedObject> objects_;
    std::vector<std::uint32_t> cameras_;
    std::vector<Part> parts_;
};

}  // namespace burin
