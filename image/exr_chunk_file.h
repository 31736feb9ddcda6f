#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/byte_sink.h"
#include "image/exr_options.h"
#include "image/image.h"

namespace burin {

/// Rows of a chunk of a flat EXR.
int rows_per_chunk(ExrCompression compression);

/// ExrChunkFile writes an EXR of chunks that are compressed already: OpenEXR's C library writes its headers. What goes
/// wrong is thrown as std::exception.
class ExrChunkFile {
  public:
    /// `path`: for messages. Both must outlive it.
    ExrChunkFile(ByteSink& file, const std::string& path);
    ~ExrChunkFile();

    /// Writes the headers of flat parts, for which tables of chunks follow. `orders`: the channels of each part in the
    /// order of their names.
    void write_header(PixelRect display, PixelRect data, const std::vector<ChannelFormat>& channels,
                      std::span<const std::vector<std::size_t>> orders, const ExrOptions& options);
    /// Writes the header of one deep part, whose channels are in the order of their names.
    void write_deep_header(PixelRect display, PixelRect data, const std::vector<ChannelFormat>& channels,
                           const std::string& part_name, const ExrOptions& options);
    /// Chunks of each part come in the order of their rows.
    void write_chunk(std::size_t part, int y, std::span<const std::uint8_t> bytes);
    /// `counts`: the table of how many samples there are; `raw_size`: of the samples before compression.
    void write_deep_chunk(int y, std::span<const std::uint8_t> counts, std::span<const std::uint8_t> samples,
                          std::uint64_t raw_size);
    /// Writes the tables of the chunks.
    void finish();

  private:
    class Library;
    std::unique_ptr<Library> library_;
};

}  // namespace burin
