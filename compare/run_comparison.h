#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "compare/render_lines.h"

namespace burin {

struct ComparisonOptions {
    std::string folder;  ///< exists; pictures go there
    std::vector<const Method*> methods;
    int frames = 0;  ///< 2 or more: also measure what flickers while the camera moves
    int threads = 0;
    Progress* progress = nullptr;
};

/// Draws the scene and the test chart with every method, measures both, and writes the pictures
/// truth.png, NAME.png and NAME_diff.png. `done` is called after each method with all results so
/// far, so that an interrupt loses only the method that was running.
///
/// The scene is changed on the way and is as it was at the end.
Comparison run_comparison(Scene& scene, const std::string& input, const ComparedView& view,
                          const ComparisonOptions& options, const std::function<void(const Comparison&)>& done);

}  // namespace burin
