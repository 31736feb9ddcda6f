#pragma once

#include <memory>
#include <string>
#include <vector>

#include "burin/scene_state.h"
#include "burin/view_input.h"
#include "render/frame.h"
#include "render/replaced_meshes.h"

namespace burin {

/// A scene of the interface put together and made ready for one frame of the method abuffer. Its meshes are those of
/// the burin_scene, which must not be used until this is gone: then it has them again, as they were.
class SceneForFrame {
  public:
    /// Throws InputError, UsageError and Interrupted.
    SceneForFrame(burin_scene& state, const burin_view& view, const OptionsInput& options);
    ~SceneForFrame();
    SceneForFrame(const SceneForFrame&) = delete;
    SceneForFrame& operator=(const SceneForFrame&) = delete;

    const Scene& scene() const { return scene_; }
    const Frame& frame() const { return frame_; }
    /// What its user should know of the picture before it is drawn.
    std::vector<std::string> notes() const;

  private:
    void take_meshes();
    void give_meshes_back() noexcept;
    void prepare(const OptionsInput& options);
    void make_frame_of(const burin_view& view, const OptionsInput& options);

    burin_scene& state_;
    Scene scene_;
    std::vector<std::shared_ptr<MeshGroup>> groups_;  ///< whose meshes the scene has, one after the other
    ReplacedMeshes replaced_;
    PreparedScene prepared_;
    std::size_t own_mesh_count_ = 0;  ///< meshes that the burin_scene has, too
    bool closes_cracks_ = false;      ///< for this view
    bool keeps_preparation_ = false;  ///< what was prepared is for later views, too
    Frame frame_;
};

}  // namespace burin
