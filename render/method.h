#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

#include "base/progress.h"
#include "render/depth_limit.h"
#include "render/film.h"
#include "render/frame.h"
#include "render/stats.h"

namespace burin {

struct FoundLines;

/// How to run a method, as far as it does not change the picture.
struct RunOptions {
    int threads = 0;  ///< 0 = all cores
    Progress* progress = nullptr;
    /// Method abuffer: cap for what it takes beyond the scene and the film; 0 = none.
    std::uint64_t memory_bytes = 0;
    /// Method abuffer: samples along a tile's side, a power of two from 8 pixels to 128 samples; 0 = the best.
    int tile_samples = 0;
    /// Method abuffer: what is deeper is refused, before anything is drawn.
    DepthLimit depth_limit = {};
    /// Method abuffer: called once for each band of a film in bands, when its pixels will not change any more, by any
    /// thread. It may close the band.
    std::function<void(std::size_t band)> finished_band = nullptr;
    /// Method abuffer, pictures with a style sheet: gets all that is known of their lines, when the film has the
    /// surfaces and no line is drawn.
    std::function<void(const FoundLines& lines, const Film& film)> found_lines = nullptr;
};

/// A way to draw the lines of a frame.
struct Method {
    std::string_view name;    ///< as on the command line
    std::string_view source;  ///< author, title, year
    LineClassSet draws;       ///< the classes that it can draw at all
    RenderStats (*render)(const Frame&, const RunOptions&, Film&);
    /// Classes whose boundaries it also finds when asked for some of those that it draws, and calls
    /// by their names: images know no classes. nullptr: none.
    LineClassSet (*also_finds)(LineClassSet asked) = nullptr;
    /// Says whether it finishes bands of a frame one after the other, and calls RunOptions::finished_band. nullptr:
    /// never.
    bool (*finishes_in_bands)(const Frame&) = nullptr;
    bool draws_loose_edges = false;  ///< lines of class mark that no polygon has
};

}  // namespace burin
