#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "base/model_budget.h"
#include "mesh/box.h"
#include "scene/scene.h"
#include "web/viewed_tables.h"

namespace burin {

/// How a scene is viewed on this machine.
struct ViewedSceneOptions {
    int threads = 0;  ///< 0 = all cores
    ModelBudget budget{};
};

/// ViewedScene is the scene that all pages of a server look at: it is read once, and drawn for one of them at a time.
class ViewedScene {
  public:
    /// Loads it. Throws InputError, UsageError and Interrupted.
    ViewedScene(ViewedInput input, const ViewedSceneOptions& options);

    const ViewedTables& tables() const { return tables_; }
    const std::string& name() const { return name_; }  ///< of the file, without folders and suffix
    /// What its user should know.
    const std::vector<std::string>& notes() const { return notes_; }
    int threads() const { return threads_; }
    const Box& box() const { return box_; }
    /// What turning keeps upright: the camera's `up`, or Y where the camera comes from a model and may be rolled.
    glm::dvec3 axis() const;
    /// The scene's own view for a picture of this size. Throws InputError.
    View home(int width, int height) const;
    /// A view in the direction of another one that the scene fills. Throws InputError.
    View fitted(const View& view) const;
    /// What the lens of the scene's camera is shifted by.
    const glm::dvec2& shift() const { return shift_; }

    /// Whoever draws locks the scene, puts in what is his, and leaves meshes and objects as they were.
    std::mutex& mutex() { return mutex_; }
    Scene& scene() { return scene_; }

  private:
    View view_of(const CameraSettings& settings, int width, int height) const;

    ViewedTables tables_;
    std::string name_;
    int threads_;
    std::vector<std::string> notes_;
    CameraSettings first_camera_;
    glm::dvec2 shift_{0.0};
    Box box_;
    mutable std::mutex mutex_;
    Scene scene_;
};

}  // namespace burin
