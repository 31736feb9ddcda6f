#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "image/exr_io.h"
#include "image/image_io.h"
#include "output/exr_layers.h"
#include "output/matte_channels.h"
#include "output/output_format.h"
#include "render/film.h"
#include "render/frame.h"

namespace burin {

struct OutputOptions {
    std::string path;
    OutputFormat format = OutputFormat::exr;
    bool is_deep = false;    ///< a deep EXR, which DeepWriter writes
    bool has_beauty = true;  ///< of an EXR: if the film has it for another file, it may be left out
    int bits = 8;            ///< PNG and TIFF: 8 or 16
    int threads = 1;
    ExrChoice exr = {};
    std::string fingerprint = {};  ///< of what the picture is made from; empty: the file has none
    FrameSettings frame = {};      ///< which frame it is
};

/// All channels that a file has of a film: those that it keeps, and those that are made of its mattes.
class FilmChannels {
  public:
    /// Both must outlive it.
    FilmChannels(const Frame& frame, const Film& film);

    /// Those of an EXR have no name where they are left out.
    std::vector<ChannelFormat> formats(const OutputOptions& options) const;
    /// The options of an EXR with these channels, named as was chosen.
    ExrOptions exr_options(const Frame& frame, const OutputOptions& options) const;
    /// Whether rows of the film lack channels.
    bool adds_any() const { return mattes_.has_value(); }
    /// The rows [y0, y1) with all channels; of `strip`, which has them. Rows are those of whole bands.
    Image rows(const ImageStrip& strip, int y0, int y1) const;
    /// How often a name had no room in a pixel of Cryptomatte, in all rows so far.
    std::uint64_t dropped() const { return mattes_ ? mattes_->dropped() : 0; }

  private:
    const Film& film_;
    std::optional<MatteChannels> mattes_;
};

/// What writing a film tells.
struct WrittenFilm {
    std::uint64_t crypto_dropped = 0;  ///< FilmChannels::dropped()
};

/// Writes the film to its file (docs/conventions.md lists the layers). Throws InputError.
WrittenFilm write_output(const Frame& frame, const Film& film, const OutputOptions& options);
/// The same with channels that are known: then nothing of the scene's objects is read any more.
WrittenFilm write_output(const Frame& frame, const Film& film, const FilmChannels& channels,
                         const OutputOptions& options);
/// Writes a whole film's image into a file that is open; `options.path` is its name. `picture`: its paper; `exr`: what
/// an EXR says, beside its channels.
void write_output(ByteSink& file, const PictureSettings& picture, const Image& image, const ExrOptions& exr,
                  const OutputOptions& options);
/// What a display shows of it: over its paper, or with an alpha channel if it is transparent.
DisplayImage displayed(const PictureSettings& picture, const Image& image);

/// BandWriter writes a film in bands to an EXR while it is rendered. The file appears under its name only when finish()
/// has been called. Everything throws InputError.
class BandWriter {
  public:
    BandWriter(const Frame& frame, const Film& film, const OutputOptions& options);
    ~BandWriter();
    /// Writes a band, which is to be closed then. It is called once for each band, in any order, by any threads at
    /// once.
    void write(std::size_t band);
    /// Puts the file under its name, after all bands are written.
    WrittenFilm finish();

  private:
    const Film& film_;
    FilmChannels channels_;
    std::unique_ptr<ExrWriter> exr_;
};

}  // namespace burin
