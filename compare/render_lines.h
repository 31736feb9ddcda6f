#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "compare/plane.h"
#include "image/image.h"
#include "render/method.h"

// A method draws a frame, and its line coverage, time and memory are kept.

namespace burin {

/// What a method made of a frame.
struct LineRendering {
    Plane coverage;                      ///< of all lines; what every metric looks at, so that shading does not count
    Image image;                         ///< R G B A
    double time_s = 0;                   ///< wall seconds
    double cpu_time_s = 0;               ///< processor seconds of all threads
    std::optional<double> memory_bytes;  ///< at the peak, beyond the loaded scene and the finished film
};

/// How a frame is seen: what all methods have in common.
struct ComparedView {
    Camera camera;
    int width = 0;
    int height = 0;
    PixelRect crop;
};

/// Lets the method draw the scene as it is set up.
LineRendering render_lines(const Method& method, const Scene& scene, const ComparedView& view,
                           const RunOptions& options);

/// Black ink of this coverage on white paper, sRGB-encoded: what SSIM and FLIP look at.
Plane ink_on_paper(const Plane& coverage);

}  // namespace burin
