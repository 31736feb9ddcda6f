#pragma once

#include <vector>

#include "cli/job.h"

namespace burin {

/// Depth ranges that methods fit to a frame are fitted to all of these frames once, so that what their steps do does
/// not change from frame to frame. A range that the scene says stays. `scene`: at rest.
void fit_depth_ranges(const SceneAnimation& animation, const std::vector<double>& frames, const JobCamera& camera,
                      Scene& scene);

}  // namespace burin
