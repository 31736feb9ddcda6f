#include "cli/blur_options.h"

#include "cli/option_values.h"

namespace burin {

using namespace option_values;

std::array<BlurOption, 4> blur_options(BlurTexts& t) {
    return {{{"--shutter", &t.shutter,
              "motion blur: when the shutter opens and closes, in frames relative to the frame: -0.25,0.25"},
             {"--blur-samples", &t.samples,
              "sub-frames of a blurred picture: auto (default), as many as it needs, or 1 to 4096; 1: no blur"},
             {"--lens", &t.lens, "depth of field: radius of the lens, in world units"},
             {"--focus", &t.focus, "distance in focus, in world units (default: that of the target)"}}};
}

void fill_blur_options(const BlurTexts& t, Arguments& a) {
    if (!t.shutter.empty()) {
        const auto parts = split(t.shutter, ',');
        if (parts.size() != 2) {
            fail("--shutter", "must be OPEN,CLOSE in frames relative to the frame, such as -0.25,0.25, got '" +
                                  printable(t.shutter) + "'");
        }
        a.shutter = {number("--shutter", parts[0]), number("--shutter", parts[1])};
        for (const double time : *a.shutter) {
            if (!(time >= -1e6 && time <= 1e6)) fail("--shutter", "must be from -1000000 to 1000000 frames");
        }
        if (!((*a.shutter)[0] < (*a.shutter)[1])) fail("--shutter", "must open before it closes");
    }
    if (!t.samples.empty() && t.samples != "auto") {
        a.blur_samples = integer("--blur-samples", t.samples, 1, ShutterSettings::kMostSamples);
    }
    if (!t.lens.empty()) {
        a.lens_radius = number("--lens", t.lens);
        if (!(*a.lens_radius >= 0 && *a.lens_radius <= 1e30)) fail("--lens", "must be from 0 to 1e30");
        if (*a.lens_radius > 0 && a.ortho_height) fail("--lens", "an orthographic camera has no lens");
        if (*a.lens_radius > 0 && !a.views.empty())
            fail("--lens", "the views of a sheet (--views) have no blur; remove one");
    }
    if (!t.focus.empty()) {
        a.focus = number("--focus", t.focus);
        if (!(*a.focus > 0 && *a.focus <= 1e30)) fail("--focus", "must be greater than 0 and at most 1e30");
    }
    a.has_blur_samples = !t.samples.empty();
}

}  // namespace burin
