#include "image/exr_io.h"

#include <OpenEXR/openexr.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/interrupt.h"
#include "base/parallel.h"
#include "base/unfilled_vector.h"
#include "image/deflate.h"
#include "image/row_packer.h"

namespace burin {
namespace {

exr_pixel_type_t exr_type(PixelType type) {
    switch (type) {
        case PixelType::float16:
            return EXR_PIXEL_HALF;
        case PixelType::float32:
            return EXR_PIXEL_FLOAT;
        case PixelType::uint32:
            return EXR_PIXEL_UINT;
    }
    return EXR_PIXEL_FLOAT;
}

/// A file of OpenEXR's C library, which takes chunks that are compressed already.
class ChunkFile {
  public:
    ChunkFile(ByteSink& file, const std::string& path) : file_(file) {
        exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
        options.user_data = this;
        options.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
        options.write_fn = [](exr_const_context_t, void* self, const void* bytes, std::uint64_t size,
                              std::uint64_t place, exr_stream_error_func_ptr_t) {
            return static_cast<ChunkFile*>(self)->write(bytes, size, place);
        };
        check(exr_start_write(&context_, path.c_str(), EXR_WRITE_FILE_DIRECTLY, &options));
    }
    ~ChunkFile() {
        if (context_ != nullptr) exr_finish(&context_);
    }
    ChunkFile(const ChunkFile&) = delete;
    ChunkFile& operator=(const ChunkFile&) = delete;

    void write_header(PixelRect display_window, PixelRect data_window, const std::vector<ChannelFormat>& channels,
                      std::span<const std::size_t> order, const ExrOptions& options) {
        int part = 0;
        check(exr_add_part(context_, nullptr, EXR_STORAGE_SCANLINE, &part));
        const exr_attr_box2i_t display = box(display_window), data = box(data_window);
        const exr_attr_v2f_t center = {0, 0};
        check(exr_initialize_required_attr(context_, part, &display, &data, 1, &center, 1, EXR_LINEORDER_INCREASING_Y,
                                           EXR_COMPRESSION_ZIP));
        for (const std::size_t c : order) {
            const ChannelFormat& channel = channels[c];
            check(exr_add_channel(context_, part, channel.name.c_str(), exr_type(channel.type),
                                  EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
        }
        for (const auto& [name, text] : options.texts) {
            check(exr_attr_set_string(context_, part, name.c_str(), text.c_str()));
        }
        check(exr_write_header(context_));
    }
    void write_chunk(int y, std::span<const std::uint8_t> bytes) {
        check(exr_write_scanline_chunk(context_, 0, y, bytes.data(), bytes.size()));
    }
    /// Writes the table of the chunks.
    void finish() { check(exr_finish(&context_)); }

  private:
    static exr_attr_box2i_t box(PixelRect r) { return {{r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}}; }

    std::int64_t write(const void* bytes, std::uint64_t size, std::uint64_t place) {
        try {
            if (place != file_.position()) file_.seek(place);
            file_.write(bytes, size);
            return static_cast<std::int64_t>(size);
        } catch (...) {
            failure_ = std::current_exception();  // must not pass through the library
            return -1;
        }
    }
    void check(exr_result_t result) const {
        if (failure_) std::rethrow_exception(failure_);
        if (result != EXR_ERR_SUCCESS) throw std::runtime_error(exr_get_default_error_message(result));
    }

    ByteSink& file_;
    exr_context_t context_ = nullptr;
    std::exception_ptr failure_;
};

/// The places of channels in the order of their names.
std::vector<std::size_t> sorted_by_name(const std::vector<ChannelFormat>& channels) {
    std::vector<std::size_t> order(channels.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return channels[a].name < channels[b].name; });
    return order;
}

/// Runs what writes to `path`; what it throws becomes an InputError that names the file.
template <typename Work>
void naming_file(const std::string& path, const Work& work) {
    try {
        work();
    } catch (const InputError&) {
        throw;
    } catch (const Interrupted&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(path + ": cannot write: " + error.what());
    }
}

}  // namespace

/// Chunks that are ready before those above them wait, compressed.
class ExrWriter::State {
  public:
    State(ByteSink& file, const std::string& path, PixelRect display, PixelRect data,
          const std::vector<ChannelFormat>& channels, const ExrOptions& options)
        : path_(path), data_(data), order_(sorted_by_name(channels)) {
        for (const ChannelFormat& channel : channels) types_.push_back(channel.type);
        naming_file(path_, [&] {
            if (channels.empty()) throw InputError(path_ + ": cannot write: the image has no channels");
            chunks_.emplace(file, path_);
            chunks_->write_header(display, data, channels, order_, options);
        });
        waiting_.resize(static_cast<std::size_t>((data.height() + kChunkRows - 1) / kChunkRows));
    }

    void write_chunk(const ImageStrip& part, int y) {
        naming_file(path_, [&] {
            const int y0 = part.data.y0;
            const RowPacker rows(part, types_, order_, y - y0, std::min(y + kChunkRows, data_.y1) - y0);
            std::unique_ptr<Tool> tool = take_tool();
            rows.packed(tool->bytes, tool->runs);
            const std::span<const std::uint8_t> stream = tool->deflater.compress(tool->bytes, tool->runs);
            std::vector<std::uint8_t> raw;
            std::span<const std::uint8_t> bytes = stream;
            if (stream.size() >= tool->bytes.size()) {
                rows.raw(raw);  // readers know by the size that nothing is compressed
                bytes = raw;
            }
            const std::lock_guard lock(mutex_);
            const auto chunk = static_cast<std::size_t>((y - data_.y0) / kChunkRows);
            if (chunk == next_) {
                write_next(bytes);
                while (next_ < waiting_.size() && !waiting_[next_].empty()) {
                    const std::vector<std::uint8_t> waited = std::move(waiting_[next_]);
                    write_next(waited);
                }
            } else {
                waiting_[chunk].assign(bytes.begin(), bytes.end());
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
    void write_next(std::span<const std::uint8_t> bytes) {
        chunks_->write_chunk(data_.y0 + static_cast<int>(next_) * kChunkRows, bytes);
        ++next_;
    }
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

    std::string path_;
    PixelRect data_;
    std::vector<PixelType> types_;
    std::vector<std::size_t> order_;
    std::optional<ChunkFile> chunks_;
    std::mutex mutex_;                                // over all that follows
    std::vector<std::vector<std::uint8_t>> waiting_;  // by their numbers
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
