#pragma once

#include <string>

#include "render/film.h"
#include "render/frame.h"

namespace burin {

enum class OutputFormat : std::uint8_t { exr, png, tiff };

struct OutputOptions {
    std::string path;
    OutputFormat format = OutputFormat::exr;
    int bits = 8;  ///< PNG and TIFF: 8 or 16
    int threads = 1;
};

/// Writes the film to its file (docs/conventions.md lists the layers). Throws InputError.
void write_output(const Frame& frame, const Film& film, const OutputOptions& options);

}  // namespace burin
