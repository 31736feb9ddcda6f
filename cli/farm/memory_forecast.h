#pragma once

#include <cstdint>

#include "image/image.h"
#include "output/output_format.h"
#include "render/film.h"

namespace burin {

/// What the memory of a picture depends on.
struct PictureLoad {
    std::uint64_t triangles = 0;  ///< of all meshes, each once
    std::uint64_t objects = 0;
    PixelRect area;  ///< that is drawn
    LayerSet layers;
    int classes = 0;               ///< of lines, which the layer coverage has a channel for each
    bool is_in_bands = false;      ///< an EXR that is written while it is drawn
    bool keeps_all_lines = false;  ///< hidden lines, style sheets
    bool has_regions = false;      ///< surfaces in a vector file
    OutputFormat format = OutputFormat::exr;
    int threads = 1;
    std::uint64_t cap_bytes = 0;  ///< --memory; 0: none
    bool is_blurred = false;      ///< a mean of sub-frames
    int frames_at_once = 1;       ///< 2 if one is written while the next one is drawn
};

/// What a process will take, in bytes; docs/performance/memory.md says how well that is met.
struct MemoryForecast {
    std::uint64_t program = 0;  ///< the program itself
    std::uint64_t model = 0;
    std::uint64_t film = 0;    ///< and what is made of it to be written
    std::uint64_t method = 0;  ///< of finding and drawing
    std::uint64_t total() const { return program + model + film + method; }
};
MemoryForecast forecast_memory(const PictureLoad& load);

/// The bytes of a frame's channels, before they are compressed.
std::uint64_t uncompressed_bytes(const PictureLoad& load);

}  // namespace burin
