#pragma once

#include <optional>

#include "scene/animation/turntable.h"
#include "scene/camera.h"

namespace burin {

/// The camera of all frames of a job: what its settings leave open is fitted once, so that the picture does not
/// breathe.
class FittedCamera {
  public:
    /// `first`: the settings that are fitted; `points`: all that the frames should see. Throws as resolve_camera().
    FittedCamera(const CameraSettings& first, const PointSource& points, double aspect,
                 const std::optional<Turntable>& turntable);

    /// The camera at a frame, at which `settings` holds. Throws as resolve_camera().
    Camera at(const CameraSettings& settings, double frame) const;

  private:
    CameraSettings first_;
    double aspect_;
    std::optional<Turntable> turntable_;
    Camera camera_;        // of first_
    glm::dvec3 target_{};  // on its axis; where first_ says it, that
};

}  // namespace burin
