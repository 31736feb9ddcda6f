#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/byte_sink.h"
#include "render/film.h"
#include "shading/ink/found_lines.h"

// The lines of a picture in a file, so that they can be drawn in another style without a new render
// (docs/shading/lines-files.md). The layout is that of safetensors.

namespace burin {

/// What a picture is drawn over, as red, green, blue and opacity of each pixel, linear and premultiplied; empty: not
/// kept.
struct KeptSurface {
    int width = 0, height = 0;
    std::vector<std::array<float, 4>> pixels;
};

/// The surfaces on a whole film, before anything is drawn over them.
KeptSurface kept_surface(const Film& film);

/// What stands in a .lines file.
struct LinesFile {
    FoundLines lines;
    KeptSurface surface;
};

/// Writes lines. Throws what the sink throws. `fingerprint`: of what they were found in; empty: the file has none.
void write_lines_file(ByteSink& file, const FoundLines& lines, const KeptSurface& surface,
                      const std::string& fingerprint = {});

/// Reads a file from anywhere: whatever it holds, the lines are whole, or it throws InputError with the file's name and
/// the array that is wrong.
LinesFile read_lines_file(const std::string& path);

}  // namespace burin
