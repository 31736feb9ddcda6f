#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "image/exr_options.h"
#include "image/image.h"
#include "image/image_strip.h"

namespace burin {

/// Writes an EXR of scan lines whose rows come in pieces. The file appears under its name only when finish() has been
/// called. Everything throws InputError.
class ExrWriter {
  public:
    /// Rows that come together, whatever is compressed together.
    static constexpr int kChunkRows = 16;

    /// Channels without a name are left out.
    ExrWriter(const std::string& path, PixelRect display, PixelRect data, const std::vector<ChannelFormat>& channels,
              const ExrOptions& options);
    /// Into a file that is open, and stays so. `name`: for messages.
    ExrWriter(ByteSink& file, const std::string& name, PixelRect display, PixelRect data,
              const std::vector<ChannelFormat>& channels, const ExrOptions& options);
    ~ExrWriter();

    /// Compresses rows [y, y + kChunkRows), or what the data window has of them, of all parts, and writes them as soon
    /// as all above are. They are within `part`, which has those channels, in that order, and the data window's
    /// columns. Each chunk once, in any order, at once on as many threads as one likes.
    void write_chunk(const ImageStrip& part, int y);
    /// Finishes the file after all chunks, and gives it its name.
    void finish();

  private:
    class State;
    std::unique_ptr<AtomicFile> own_file_;
    std::unique_ptr<State> state_;
};

/// Writes all channels of an image, with its display and data windows. Throws InputError.
void write_exr(const std::string& path, const Image& image, const ExrOptions& options);
/// The same into a file that is open.
void write_exr(ByteSink& file, const std::string& name, const Image& image, const ExrOptions& options);

}  // namespace burin
