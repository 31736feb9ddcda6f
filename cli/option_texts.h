#pragma once

#include <string>
#include <vector>

#include "cli/exr_options.h"
#include "cli/farm_options.h"
#include "cli/frame_options.h"
#include "cli/page_options.h"
#include "cli/vector_options.h"

namespace burin {

/// Options of all commands as they were typed.
struct Texts {
    std::string input, output, size, eye, target, up, fov, ortho, camera, method, mask, samples, lines, operators,
        supersample;
    std::string width, color, frame, deep, save_lines, find, crease, hidden, style, layers, crop, threads, memory,
        model_memory, depth_complexity, stats, bits;
    PageTexts page;
    VectorTexts vector;
    FrameTexts frames;
    ExrTexts exr;
    FarmTexts farm;
    std::string repeat, progress, pixel, background, methods, compare_frames;
    std::string port;
    std::vector<std::string> sets, outputs;
    int verbose = 0;
    bool quiet = false, json = false, strict = false, save_surface = false, no_browser = false;
};

}  // namespace burin
