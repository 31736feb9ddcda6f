#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "mesh/animation_choice.h"
#include "mesh/mesh.h"
#include "scene/animation/keys.h"
#include "scene/scene.h"

namespace burin {

/// What is wrong with one frame: "frame 12: walk.0012.obj:3: ...".
class FrameError : public InputError {
  public:
    FrameError(double frame, const std::string& what);
    double frame() const { return frame_; }

  private:
    double frame_;
};

/// What of a scene changes from one frame to another: made beside the drawing of another frame, then applied.
struct SceneChange {
    double frame = 0;
    std::vector<glm::dmat4> to_world;                    ///< per object of the scene; empty: none moves
    std::vector<CameraSettings> cameras;                 ///< empty: none moves
    std::vector<std::pair<std::uint32_t, Mesh>> meshes;  ///< those that deform or are another file's, by number
    std::vector<std::string> notes;
};

/// What moves within a model file. It is made when the model is loaded.
class ModelMotion {
  public:
    /// The model at one time. What is empty is as at rest.
    struct Pose {
        std::vector<glm::dmat4> parts;                       ///< to the model's space, per object of the model
        std::vector<glm::dmat4> cameras;                     ///< likewise, per camera of the model
        std::vector<std::pair<std::uint32_t, Mesh>> meshes;  ///< by number within the model
        std::vector<std::string> notes;
    };

    virtual ~ModelMotion() = default;
    /// Any threads may call it at once. Throws InputError.
    virtual Pose at(double frame) const = 0;
    /// Files that are read for this frame alone.
    virtual std::vector<std::string> files_at(double /*frame*/) const { return {}; }
};

/// The animations that a model file has.
struct AnimationsOfFile {
    std::string file;
    std::vector<AnimationSummary> animations;
};

/// How the things of a scene move. It borrows nothing of the Scene: at() may run while a frame of that is drawn.
class SceneAnimation {
  public:
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

    /// Something that stands where keys, an instance and a model say. Numbers are of the lists below; kNone: nothing
    /// moves it there.
    struct Place {
        std::size_t keys = kNone;
        glm::dmat4 object{1.0};    ///< without keys: where the object of the scene file is
        glm::dmat4 instance{1.0};  ///< within that
        std::size_t model = kNone;
        std::size_t part = 0;   ///< of the model: an object, or a camera
        glm::dmat4 own{1.0};    ///< at rest, within the instance
        std::string name = {};  ///< for messages
    };
    struct MovingModel {
        std::shared_ptr<const ModelMotion> motion;
        std::uint32_t first_mesh = 0;
    };
    /// A camera of the scene: with keys of its own, or one of a model that stands somewhere.
    struct MovingCamera {
        CameraSettings rest;
        CameraKeys keys = {};
        Place place = {};  ///< if `rest.to_world` is set
    };

    // All that is loaded is told in the scene's order; then at() may be called.
    std::vector<ObjectKeys> keys;
    std::vector<MovingModel> models;
    std::vector<Place> objects;  ///< one per object of the scene
    std::vector<MovingCamera> cameras;
    double fps = 24;
    std::vector<AnimationsOfFile> file_animations;  ///< if they were asked for, those that have animations

    /// Whether there is anything that at() would change: of objects and meshes, or at all.
    bool moves_objects() const { return !models.empty() || has_moving_objects(); }
    bool moves() const { return moves_objects() || has_moving_cameras(); }
    /// The scene at a frame, which may be any number. Any threads may call it at once. Throws InputError.
    SceneChange at(double frame) const;
    /// The same without asking models: what moves within them is as at rest. It costs little.
    SceneChange places_at(double frame) const;
    /// Files that are read for this frame alone.
    std::vector<std::string> files_at(double frame) const;

  private:
    SceneChange change_at(double frame, bool asks_models) const;
    bool has_moving_objects() const;
    bool has_moving_cameras() const;
};

/// Is told of a frame that cannot be read, and may throw.
using UnreadableFrame = std::function<void(const FrameError&)>;

/// The points of a scene, which is as it was loaded, at all these frames; at rest, if there are none. It borrows both.
/// Frames that cannot be read are left out, once `unreadable` was told of them; without it, their FrameError is thrown.
PointSource points_of_frames(const Scene& scene, const SceneAnimation& animation, std::vector<double> frames,
                             UnreadableFrame unreadable = {});

/// Puts a frame into the scene that the animation was loaded with.
void apply(SceneChange&& change, Scene& scene);

}  // namespace burin
