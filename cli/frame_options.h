#pragma once

#include <string>
#include <string_view>

#include "cli/arguments.h"
#include "cli/blur_options.h"

namespace burin {

/// Options of frames as they were typed.
struct FrameTexts {
    std::string frames, fps, turntable;
    bool skips_existing = false, keeps_going = false;
    BlurTexts blur;
};

/// Checks them. Throws UsageError. The other options have been checked.
void fill_frame_options(const FrameTexts& texts, Arguments& arguments);

/// Whether an option, by its name as CLI11 has it, leaves each pixel of each frame as it is.
bool changes_no_picture(std::string_view option);

}  // namespace burin
