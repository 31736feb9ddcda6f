#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "cli/arguments.h"
#include "cli/job.h"
#include "render/method.h"
#include "render/prepared.h"
#include "render/replaced_meshes.h"

namespace burin {

/// The scene of a job, made ready for one frame after the other. What does not move from one frame to the next is kept.
class PosedScene {
  public:
    /// `frames`: how many come; with one, nothing is kept for later ones.
    PosedScene(Scene scene, const Arguments& arguments, const Method& method, std::size_t frames);

    /// Puts the scene into a frame, as it is loaded: nothing that the last one was made ready with is left.
    void pose(SceneChange&& change);
    /// Puts back what it was made ready with, so that meshes have the vertices that they were loaded with.
    void put_back();
    /// Makes it ready to be seen by a camera.
    void make_ready(const Camera& camera);

    const Scene& scene() const { return scene_; }
    Scene& scene() { return scene_; }
    /// The mesh of an object, by its number as the scene was loaded.
    std::uint32_t mesh_as_loaded(std::size_t object) const { return meshes_of_objects_[object]; }
    const PreparedScene& prepared() const { return prepared_; }

  private:
    void prepare();

    Scene scene_;
    const Arguments& arguments_;
    const Method& method_;
    bool keeps_;
    std::vector<std::uint32_t> meshes_of_objects_;  // as loaded
    std::size_t mesh_count_;                        // as loaded
    ReplacedMeshes replaced_;
    std::set<std::size_t> changed_;  // meshes that are not those that were prepared
    bool is_prepared_ = false;       // once
    bool has_moved_ = true;          // objects or meshes, since it was prepared
    bool is_ready_ = false;          // for ready_for_, as it is posed
    Camera ready_for_;
    PreparedScene prepared_;
};

}  // namespace burin
