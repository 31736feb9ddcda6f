#pragma once

#include <cstdint>

#include "cli/farm/covered_blocks.h"
#include "image/image.h"
#include "output/output_format.h"
#include "render/film.h"

namespace burin {

/// What the memory of a picture depends on.
struct PictureLoad {
    std::uint64_t triangles = 0;         ///< of all meshes, each once
    std::uint64_t placed_triangles = 0;  ///< of all objects
    std::uint64_t objects = 0;
    PixelRect area;         ///< that is drawn
    CoveredBlocks covered;  ///< of it, by surfaces
    LayerSet layers;
    int classes = 0;                 ///< of lines, which the layer coverage has a channel for each
    bool is_in_bands = false;        ///< an EXR that is written while it is drawn
    bool finishes_in_bands = false;  ///< so are sub-frames
    bool keeps_all_lines = false;    ///< hidden lines, style sheets
    bool finds_all = false;          ///< lines of all classes, to be saved
    bool saves_surface = false;      ///< beside the lines that are saved
    bool has_regions = false;        ///< surfaces in a vector file
    OutputFormat format = OutputFormat::exr;
    int threads = 1;
    std::uint64_t cap_bytes = 0;        ///< --memory; 0: none
    int sub_frames = 1;                 ///< whose mean it is
    std::size_t pieces = 1;             ///< in which it is drawn one after the other, under a cap
    std::uint64_t least_cap_bytes = 0;  ///< that it can be drawn under; 0: there is no cap for it
    int frames_at_once = 1;             ///< 2 if one is written while the next one is drawn
    bool has_flat = true;               ///< a file that is not deep
};

/// What a process will take, in bytes; docs/performance/memory.md says how well that is met.
struct MemoryForecast {
    std::uint64_t program = 0;  ///< the program itself
    std::uint64_t model = 0;
    std::uint64_t film = 0;    ///< and what is made of it to be written
    std::uint64_t blur = 0;    ///< sums of sub-frames
    std::uint64_t method = 0;  ///< of finding and drawing
    std::uint64_t least = 0;   ///< of what the method takes: the least cap for memory; 0: there is none
    std::uint64_t total() const { return program + model + film + blur + method; }
};
MemoryForecast forecast_memory(const PictureLoad& load);

/// The bytes of a frame's channels, before they are compressed; of a vector file 0.
std::uint64_t uncompressed_bytes(const PictureLoad& load);
/// The same of a deep file's samples, if each pixel that has any has one; it may have more.
std::uint64_t deep_bytes(const PictureLoad& load);

}  // namespace burin
