#pragma once

#include <optional>

namespace burin {

/// When light falls onto a picture: motion blur is what moves meanwhile.
struct ShutterSettings {
    double open = -0.25, close = 0.25;  ///< in frames relative to the frame; open < close
    /// The shutter opens over the first part of that time and closes over the last part, linearly; their sum is at most
    /// 1. Both 0: it is open or closed ("box"); both 1/2: "triangle".
    double rise = 0, fall = 0;
    std::optional<int> samples;  ///< sub-frames; none: as many as the picture needs

    static constexpr int kMostSamples = 4096;
};

}  // namespace burin
