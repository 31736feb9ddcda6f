#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/output_files.h"
#include "methods/method_table.h"
#include "render/frame.h"
#include "scene/animation/fitted_camera.h"
#include "scene/animation/scene_animation.h"
#include "scene/scene_description.h"

namespace burin {

/// What an input says, and the command line about it, before models are read.
struct DescribedInput {
    SceneDescription description;
    std::vector<std::string> files;  ///< that it names, and that of its style sheet
};
/// Throws InputError and UsageError.
DescribedInput describe_input(const Arguments& arguments);

/// A scene with the command line's wishes worked in, at rest, and how it moves.
struct LoadedInput {
    Scene scene;
    SceneAnimation animation;
    std::vector<double> frame_range;     ///< for which cameras are fitted; empty: they are fitted at rest
    std::optional<Turntable> turntable;  ///< of the scene, or of the command line
    std::vector<std::string> files;      ///< all that were read but the input itself
    std::uint64_t hash = 0;              ///< of what the input says of all frames
};
/// Prints what the models' readers noted, but for `info`. Throws InputError and UsageError: the latter where one of the
/// outputs is a file that is read, before any model is read if the scene file names it.
LoadedInput load_input(DescribedInput input, const Arguments& arguments, const std::vector<OutputFile>& outputs);

/// The scene of one frame: that of --frame, or the first of its range, or at rest. `animations`: for `info`, gets those
/// of its files.
Scene load_scene_of(const Arguments& arguments, const std::vector<OutputFile>& outputs = {},
                    std::vector<AnimationsOfFile>* animations = nullptr);

/// The frame that a still shows.
double still_frame(const Arguments& arguments, const std::vector<double>& range,
                   const std::optional<Turntable>& turntable);

/// The camera that the arguments ask for, of each frame.
class JobCamera {
  public:
    /// `points`: all that the frames should see. `first`: the scene's cameras where it is fitted. Throws InputError and
    /// UsageError.
    JobCamera(const Scene& scene, const std::vector<CameraSettings>& first, const PointSource& points,
              const std::optional<Turntable>& turntable, const Arguments& arguments);
    /// `scene`: at that frame.
    Camera at(const Scene& scene) const { return at(scene.cameras, scene.picture, scene.frame.number); }
    /// `cameras`: of the scene at a frame.
    Camera at(const std::vector<CameraSettings>& cameras, const PictureSettings& picture, double frame) const;

  private:
    const Arguments& arguments_;
    FittedCamera fitted_;
};

/// The cameras of a scene at rest for which those of all frames are fitted: as they are in the first frame of the
/// range that can be read. `unreadable`: as for points_of_frames().
std::vector<CameraSettings> cameras_to_fit(const Scene& scene, const SceneAnimation& animation,
                                           const std::vector<double>& range, const UnreadableFrame& unreadable = {});

/// The scene of one frame, and the camera that render has for it.
struct Still {
    Scene scene;
    Camera camera;
};
Still load_still(const Arguments& arguments, const std::vector<OutputFile>& outputs = {});

/// The views on one sheet that the arguments ask for; none: one view, through a camera. Throws InputError and
/// UsageError.
std::vector<ViewOnSheet> views_of(const Scene& scene, const PointSource& points, const Arguments& arguments);

/// The part of the picture that the arguments ask for. Throws UsageError.
PixelRect crop_of(const Arguments& arguments, int width, int height);

/// The frame that the arguments ask for. The scene must outlive it. Throws InputError and UsageError.
Frame frame_of(const Scene& scene, const Camera& camera, const Arguments& arguments,
               const PreparedScene* prepared = nullptr);

}  // namespace burin
