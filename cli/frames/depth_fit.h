#pragma once

#include <optional>
#include <vector>

#include "cli/job.h"
#include "scene/animation/scene_animation.h"

namespace burin {

/// Depth ranges that methods fit to a frame are fitted to all of these frames once, so that what their steps do does
/// not change from frame to frame. A range that the scene says stays. `scene`: at rest. `unreadable`: as for
/// points_of_frames().
void fit_depth_ranges(const SceneAnimation& animation, const std::vector<double>& frames, const JobCamera& camera,
                      const UnreadableFrame& unreadable, Scene& scene);

/// The frames that depth ranges are fitted to: the scene's, or those of one turn; of long turns so many that the margin
/// of the fit has room for what is between them.
std::vector<double> frames_to_fit(const std::vector<double>& range, const std::optional<Turntable>& turntable);

}  // namespace burin
