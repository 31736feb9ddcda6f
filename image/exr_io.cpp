#include "image/exr_io.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parallel.h"
#include "base/unfilled_vector.h"
#include "image/deflate.h"
#include "image/exr_chunk_file.h"
#include "image/naming_file.h"
#include "image/row_packer.h"
#include "image/run_packer.h"

namespace burin {
namespace {

/// The places of channels in the order of their names, but for those without.
std::vector<std::size_t> sorted_by_name(const std::vector<ChannelFormat>& channels) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (!channels[i].name.empty()) order.push_back(i);
    }
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return channels[a].name < channels[b].name; });
    return order;
}

/// The channels of each part in the order of their names.
std::vector<std::vector<std::size_t>> orders_of(const std::vector<ChannelFormat>& channels,
                                                const std::vector<ExrPart>& parts) {
    if (parts.empty()) return {sorted_by_name(channels)};
    std::vector<std::vector<std::size_t>> orders;
    const std::vector<std::size_t> all = sorted_by_name(channels);
    for (const ExrPart& part : parts) {
        std::vector<std::size_t>& order = orders.emplace_back();
        std::copy_if(all.begin(), all.end(), std::back_inserter(order), [&](std::size_t c) {
            return std::find(part.channels.begin(), part.channels.end(), c) != part.channels.end();
        });
    }
    return orders;
}

}  // namespace

/// Rows that are ready before those above them wait, compressed.
class ExrWriter::State {
  public:
    State(ByteSink& file, const std::string& path, PixelRect display, PixelRect data,
          const std::vector<ChannelFormat>& channels, const ExrOptions& options)
        : path_(path),
          data_(data),
          compression_(options.compression),
          rows_per_chunk_(rows_per_chunk(compression_)),
          orders_(orders_of(channels, options.parts)) {
        for (const ChannelFormat& channel : channels) types_.push_back(channel.type);
        naming_file(path_, [&] {
            if (channels.empty()) throw InputError(path_ + ": cannot write: the image has no channels");
            chunks_.emplace(file, path_);
            chunks_->write_header(display, data, channels, orders_, options);
        });
        waiting_.resize(static_cast<std::size_t>((data.height() + kChunkRows - 1) / kChunkRows));
    }

    void write_chunk(const ImageStrip& part, int y) {
        naming_file(path_, [&] {
            std::unique_ptr<Tool> tool = take_tool();
            const int end = std::min(y + kChunkRows, data_.y1);
            std::vector<Packed> packed;
            for (std::size_t p = 0; p < orders_.size(); ++p) {
                for (int row = y; row < end; row += rows_per_chunk_) {
                    const RowPacker rows(part, types_, orders_[p], row - part.data.y0,
                                         std::min(row + rows_per_chunk_, end) - part.data.y0);
                    packed.push_back({p, row, {}});
                    pack(rows, *tool, packed.back().bytes);
                }
            }
            const std::lock_guard lock(mutex_);
            const auto number = static_cast<std::size_t>((y - data_.y0) / kChunkRows);
            waiting_[number] = std::move(packed);
            while (next_ < waiting_.size() && !waiting_[next_].empty()) {
                const std::vector<Packed> ready = std::move(waiting_[next_]);
                for (const Packed& chunk : ready) chunks_->write_chunk(chunk.part, chunk.y, chunk.bytes);
                ++next_;
            }
            tools_.push_back(std::move(tool));
        });
    }

    void finish() {
        naming_file(path_, [&] {
            if (next_ < waiting_.size()) throw std::logic_error("rows are missing");
            chunks_->finish();
        });
    }

  private:
    /// A chunk of the file.
    struct Packed {
        std::size_t part;
        int y;
        std::vector<std::uint8_t> bytes;
    };
    struct Tool {  // of one thread at a time
        Deflater deflater;
        UnfilledVector<std::uint8_t> bytes;
        std::vector<Deflater::Run> runs;
    };
    std::unique_ptr<Tool> take_tool() {
        const std::lock_guard lock(mutex_);
        if (tools_.empty()) return std::make_unique<Tool>();
        std::unique_ptr<Tool> tool = std::move(tools_.back());
        tools_.pop_back();
        return tool;
    }
    void pack(const RowPacker& rows, Tool& tool, std::vector<std::uint8_t>& bytes) const {
        if (compression_ == ExrCompression::none) return rows.raw(bytes);
        rows.packed(tool.bytes, tool.runs);
        if (compression_ == ExrCompression::rle) {
            pack_runs(tool.bytes, bytes);
        } else {
            const std::span<const std::uint8_t> stream = tool.deflater.compress(tool.bytes, tool.runs);
            if (stream.size() < tool.bytes.size()) bytes.assign(stream.begin(), stream.end());
        }
        // Readers know by the size that nothing is compressed.
        if (bytes.empty() || bytes.size() >= tool.bytes.size()) rows.raw(bytes);
    }

    std::string path_;
    PixelRect data_;
    ExrCompression compression_;
    int rows_per_chunk_;
    std::vector<PixelType> types_;
    std::vector<std::vector<std::size_t>> orders_;  // of the channels of each part
    std::optional<ExrChunkFile> chunks_;
    std::mutex mutex_;                          // over all that follows
    std::vector<std::vector<Packed>> waiting_;  // by the number of kChunkRows rows
    std::size_t next_ = 0;
    std::vector<std::unique_ptr<Tool>> tools_;
};

ExrWriter::ExrWriter(const std::string& path, PixelRect display, PixelRect data,
                     const std::vector<ChannelFormat>& channels, const ExrOptions& options)
    : own_file_(std::make_unique<AtomicFile>(path)),
      state_(std::make_unique<State>(*own_file_, path, display, data, channels, options)) {}
ExrWriter::ExrWriter(ByteSink& file, const std::string& name, PixelRect display, PixelRect data,
                     const std::vector<ChannelFormat>& channels, const ExrOptions& options)
    : state_(std::make_unique<State>(file, name, display, data, channels, options)) {}
ExrWriter::~ExrWriter() = default;
void ExrWriter::write_chunk(const ImageStrip& part, int y) { state_->write_chunk(part, y); }
void ExrWriter::finish() {
    state_->finish();
    if (own_file_) own_file_->commit();
}

namespace {

void write_all(ExrWriter& writer, const Image& image, int threads) {
    const ImageStrip strip = strip_of(image);
    const auto chunks = static_cast<std::size_t>((image.height() + ExrWriter::kChunkRows - 1) / ExrWriter::kChunkRows);
    parallel_for(chunks, resolve_thread_count(threads), [&](std::size_t i, int) {
        writer.write_chunk(strip, image.data().y0 + static_cast<int>(i) * ExrWriter::kChunkRows);
    });
    writer.finish();
}

}  // namespace

void write_exr(const std::string& path, const Image& image, const ExrOptions& options) {
    ExrWriter writer(path, image.display(), image.data(), image.formats(), options);
    write_all(writer, image, options.threads);
}

void write_exr(ByteSink& file, const std::string& name, const Image& image, const ExrOptions& options) {
    ExrWriter writer(file, name, image.display(), image.data(), image.formats(), options);
    write_all(writer, image, options.threads);
}

}  // namespace burin
