#include "image/exr_io.h"

#include <OpenEXR/openexr.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <exception>
#include <iterator>
#include <memory>
#include <mutex>
#include <new>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <variant>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/interrupt.h"
#include "base/parallel.h"
#include "base/unfilled_vector.h"
#include "image/deflate.h"
#include "image/row_packer.h"
#include "image/run_packer.h"

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

exr_compression_t exr_compression(ExrCompression compression) {
    switch (compression) {
        case ExrCompression::zip:
            return EXR_COMPRESSION_ZIP;
        case ExrCompression::zips:
            return EXR_COMPRESSION_ZIPS;
        case ExrCompression::rle:
            return EXR_COMPRESSION_RLE;
        case ExrCompression::none:
            return EXR_COMPRESSION_NONE;
    }
    return EXR_COMPRESSION_ZIP;
}

int rows_per_chunk(ExrCompression compression) {
    return compression == ExrCompression::zip ? ExrWriter::kChunkRows : 1;
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

    /// Writes the header of one part, or of several, for which tables of chunks follow.
    void write_header(PixelRect display_window, PixelRect data_window, const std::vector<ChannelFormat>& channels,
                      std::span<const std::vector<std::size_t>> orders, const ExrOptions& options) {
        const exr_attr_box2i_t display = box(display_window), data = box(data_window);
        const exr_attr_v2f_t center = {options.screen_window_center[0], options.screen_window_center[1]};
        for (std::size_t p = 0; p < orders.size(); ++p) {
            int part = 0;
            const char* const name = options.parts.empty() ? nullptr : options.parts[p].name.c_str();
            check(exr_add_part(context_, name, EXR_STORAGE_SCANLINE, &part));
            check(exr_initialize_required_attr(context_, part, &display, &data, options.pixel_aspect, &center,
                                               options.screen_window_width, EXR_LINEORDER_INCREASING_Y,
                                               exr_compression(options.compression)));
            for (const std::size_t c : orders[p]) {
                const ChannelFormat& channel = channels[c];
                check(exr_add_channel(context_, part, channel.name.c_str(), exr_type(channel.type),
                                      EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
            }
            for (const ExrAttribute& attribute : options.attributes) add_attribute(part, attribute);
            if (options.parts.empty()) continue;
            for (const ExrAttribute& attribute : options.parts[p].attributes) add_attribute(part, attribute);
        }
        check(exr_write_header(context_));
        part_count_ = orders.size();
        if (part_count_ == 1) return;
        // The library takes the chunks of one part after those of the other only. Here they come in turns, so this
        // file's chunks and tables are written past it.
        is_past_library_ = true;
        tables_at_ = file_.position();
        const auto rows = static_cast<std::size_t>(data_window.height());
        const std::size_t per_chunk = static_cast<std::size_t>(rows_per_chunk(options.compression));
        chunk_count_ = (rows + per_chunk - 1) / per_chunk;
        offsets_.reserve(part_count_ * chunk_count_);
        const std::vector<std::uint8_t> zeros(part_count_ * chunk_count_ * sizeof(std::uint64_t));
        file_.write(zeros.data(), zeros.size());
    }
    /// Chunks of each part come in the order of their rows.
    void write_chunk(std::size_t part, int y, std::span<const std::uint8_t> bytes) {
        if (!is_past_library_) {
            check(exr_write_scanline_chunk(context_, 0, y, bytes.data(), bytes.size()));
            return;
        }
        offsets_.push_back({part, file_.position()});
        const std::int32_t head[] = {static_cast<std::int32_t>(part), y, static_cast<std::int32_t>(bytes.size())};
        file_.write(head, sizeof head);
        file_.write(bytes.data(), bytes.size());
    }
    /// Writes the tables of the chunks.
    void finish() {
        if (!is_past_library_) return check(exr_finish(&context_));
        std::vector<std::uint64_t> tables;
        for (std::size_t part = 0; part < part_count_; ++part) {
            for (const Offset& offset : offsets_) {
                if (offset.part == part) tables.push_back(offset.place);
            }
        }
        file_.seek(tables_at_);
        file_.write(tables.data(), tables.size() * sizeof tables.front());
    }

  private:
    struct Offset {
        std::size_t part;
        std::uint64_t place;
    };
    static_assert(std::endian::native == std::endian::little);  // as numbers in the file are

    static exr_attr_box2i_t box(PixelRect r) { return {{r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}}; }

    void add_attribute(int part, const ExrAttribute& attribute) {
        const char* const name = attribute.name.c_str();
        if (const auto* const text = std::get_if<std::string>(&attribute.value)) {
            check(exr_attr_set_string(context_, part, name, text->c_str()));
        } else if (const auto* const number = std::get_if<std::int32_t>(&attribute.value)) {
            check(exr_attr_set_int(context_, part, name, *number));
        } else if (const auto* const rational = std::get_if<ExrRational>(&attribute.value)) {
            const exr_attr_rational_t value = {rational->numerator, rational->denominator};
            check(exr_attr_set_rational(context_, part, name, &value));
        } else if (const auto* const matrix = std::get_if<ExrMatrix>(&attribute.value)) {
            exr_attr_m44f_t value;
            std::copy(matrix->begin(), matrix->end(), value.m);
            check(exr_attr_set_m44f(context_, part, name, &value));
        }
    }

    std::int64_t write(const void* bytes, std::uint64_t size, std::uint64_t place) {
        if (is_past_library_) return static_cast<std::int64_t>(size);  // what it writes at its end
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
    bool is_past_library_ = false;
    std::size_t part_count_ = 0, chunk_count_ = 0;
    std::size_t tables_at_ = 0;
    std::vector<Offset> offsets_;  // of all chunks, as they were written
};

/// The places of channels in the order of their names.
std::vector<std::size_t> sorted_by_name(const std::vector<ChannelFormat>& channels) {
    std::vector<std::size_t> order(channels.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
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
    std::optional<ChunkFile> chunks_;
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
