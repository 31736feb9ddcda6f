#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "image/exr_io.h"
#include "image/image_io.h"
#include "output/output_format.h"
#include "render/film.h"
#include "render/frame.h"

namespace burin {

struct OutputOptions {
    std::string path;
    OutputFormat format = OutputFormat::exr;
    int bits = 8;  ///< PNG and TIFF: 8 or 16
    int threads = 1;
    std::string fingerprint = {};  ///< of what the picture is made from; empty: the file has none
    FrameSettings frame = {};      ///< which frame it is
};

/// Writes the film to its file (docs/conventions.md lists the layers). Throws InputError.
void write_output(const Frame& frame, const Film& film, const OutputOptions& options);
/// Writes a whole film's image into a file that is open; `options.path` is its name. `picture`: its paper.
void write_output(ByteSink& file, const PictureSettings& picture, const Image& image, const OutputOptions& options);
/// What a display shows of it: over its paper, or with an alpha channel if it is transparent.
DisplayImage displayed(const PictureSettings& picture, const Image& image);

/// BandWriter writes a film in bands to an EXR while it is rendered. The file appears under its name only when finish()
/// has been called. Everything throws InputError.
class BandWriter {
  public:
    BandWriter(Film& film, const OutputOptions& options);
    ~BandWriter();
    /// Writes a band and closes it. It is called once for each band, in any order, by any threads at once.
    void write(std::size_t band);
    /// Puts the file under its name, after all bands are written.
    void finish();
    /// Whether anything that it was called for has failed.
    bool has_failed() const { return has_failed_; }

  private:
    Film& film_;
    std::unique_ptr<ExrWriter> exr_;
    std::atomic<bool> has_failed_ = false;
};

}  // namespace burin
