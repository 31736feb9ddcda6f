#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "image/exr_options.h"
#include "image/image.h"

namespace burin {

/// The samples of one row of a deep picture.
struct DeepRow {
    std::vector<std::uint32_t> counts;  ///< of each pixel
    std::vector<std::uint8_t> samples;  ///< channel by channel, in the order of their names
};

/// Writes a deep EXR of scan lines, one part, each row compressed by itself. The file appears under its name only when
/// finish() has been called. Everything throws InputError.
class ExrDeepWriter {
  public:
    /// `channels`: in the order of their names. `options`: of compressions, zip means zips.
    ExrDeepWriter(const std::string& path, PixelRect display, PixelRect data,
                  const std::vector<ChannelFormat>& channels, const ExrOptions& options);
    ~ExrDeepWriter();

    /// Compresses rows from y on, and writes them as soon as all above are. Each row once, in any order, at once on as
    /// many threads as one likes.
    void write_rows(int y, std::span<const DeepRow> rows);
    /// Finishes the file after all rows, and gives it its name.
    void finish();

  private:
    class State;
    std::unique_ptr<State> state_;
};

}  // namespace burin
