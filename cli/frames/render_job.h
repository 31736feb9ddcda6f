#pragma once

#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/frames/frame_plan.h"
#include "cli/frames/frame_renderer.h"
#include "output/film_files.h"

namespace burin {

/// The frames that a command line asks for, and what draws them: all is checked and loaded, and nothing is drawn.
class RenderJob {
  public:
    /// Throws InputError, UsageError and Interrupted.
    explicit RenderJob(const Arguments& arguments);
    RenderJob(const RenderJob&) = delete;
    RenderJob& operator=(const RenderJob&) = delete;

    const Method& method() const { return method_; }
    const FramePlan& plan() const { return plan_; }
    const std::vector<OutputOptions>& outputs() const { return outputs_; }  ///< of the first frame
    FrameRenderer& renderer() { return renderer_; }

    /// Those of the frames that are not there, whole and made from the same input; all of them without --skip-existing.
    std::vector<double> missing_frames() const;

  private:
    FrameRenderer load(DescribedInput described);

    const Arguments& arguments_;
    const Method& method_;
    std::vector<OutputOptions> outputs_;
    DescribedInput described_;
    FramePlan plan_;
    FrameRenderer renderer_;
};

}  // namespace burin
