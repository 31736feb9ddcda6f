#include "cli/blur.h"

#include <cstdio>

#include "base/error.h"
#include "render/picture_notes.h"

namespace burin {

void set_lens(const Arguments& a, CameraSettings& camera) {
    if (a.lens_radius) camera.lens_radius = *a.lens_radius;
    if (a.focus) camera.focus = *a.focus;
    if (camera.orthographic && camera.lens_radius > 0) {
        if (a.lens_radius) throw UsageError("--lens: an orthographic camera has no lens");
        camera.lens_radius = 0;  // the scene's camera is made orthographic by --ortho
    }
    if (a.focus && camera.lens_radius == 0) throw UsageError("--focus: the camera has no lens; give one with --lens");
}

Blur blur_of(const Scene& scene, const Camera& camera, const Arguments& a, bool moves, bool has_paths) {
    Blur blur;
    blur.shutter = scene.shutter;
    if (a.shutter) {
        if (!blur.shutter) blur.shutter.emplace();
        blur.shutter->open = (*a.shutter)[0];
        blur.shutter->close = (*a.shutter)[1];
    }
    blur.has_lens = camera.lens_radius > 0;
    if (blur.shutter) blur.samples = blur.shutter->samples;
    if (a.has_blur_samples) blur.samples = a.blur_samples;
    if (a.has_blur_samples && !blur.is_asked_for())
        throw UsageError("--blur-samples: nothing is blurred; give --shutter or --lens");
    if (blur.is_asked_for() && blur.samples != 1) {
        const char* const option = a.shutter       ? "--shutter"
                                   : a.lens_radius ? "--lens"
                                   : blur.has_lens ? "lens_radius"
                                                   : "[shutter]";
        const auto refuse = [&](bool is_given, const std::string& what) {
            if (is_given) throw UsageError(std::string(option) + ": " + what + "; --blur-samples 1 draws without blur");
        };
        refuse(has_paths, "a vector file has no blur");
        refuse(!a.save_lines.empty(), "saved lines (--save-lines) have no blur");
        refuse(!a.views.empty(), "the views of a sheet (--views) have no blur");
    }
    if (!moves) blur.shutter.reset();
    return blur;
}

void note_missing_blur(const Scene& scene, const Camera& camera, const Arguments& a, const char* command) {
    const std::string note = note_on_missing_blur(scene.shutter.has_value(), camera, command);
    if (!note.empty() && !a.quiet) std::fprintf(stderr, "burin: note: %s\n", note.c_str());
}

}  // namespace burin
