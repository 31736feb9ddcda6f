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

/// Bytes as ZIP compression packs them: first all of even number and then the others, of each the difference to the byte
/// before, plus 128 (OpenEXR's "zip" with its predictor).
class PairSplitter {
  public:
    /// The runs that are known go to `runs`.
    PairSplitter(std::span<std::uint8_t> bytes, std::vector<Deflater::Run>& runs)
        : begin_(bytes.data()), even_(begin_), odd_(even_ + bytes.size() / 2), first_odd_(odd_), runs_(runs) {
        runs_.clear();
    }

    /// An even number of bytes.
    void put(std::span<const std::uint8_t> bytes) {
        const std::uint8_t* const p = bytes.data();
        const std::size_t pairs = bytes.size() / 2;
        std::uint8_t *const even = even_, *const odd = odd_;  // bytes might be parts of members
        if (odd == first_odd_) first_odd_byte_ = p[1];
        even[0] = difference(p[0], last_even_);
        odd[0] = difference(p[1], last_odd_);
        for (std::size_t i = 1; i < pairs; ++i) {
            even[i] = difference(p[2 * i], p[2 * i - 2]);
            odd[i] = difference(p[2 * i + 1], p[2 * i - 1]);
        }
        last_even_ = p[2 * pairs - 2];
        last_odd_ = p[2 * pairs - 1];
        even_ += pairs;
        odd_ += pairs;
    }
    /// Pixels of the same 2 or 4 bytes: from the second one on, differences repeat, and from the fourth one on they are
    /// those two before.
    void repeat(std::span<const std::uint8_t> pixel, std::size_t count) {
        const std::size_t whole = std::min<std::size_t>(count, 3);
        for (std::size_t i = 0; i < whole; ++i) put(pixel);
        if (count <= whole) return;
        const std::size_t pairs = (count - whole) * pixel.size() / 2;
        fill_pairs(even_, pairs, pixel.size() / 2);
        fill_pairs(odd_, pairs, pixel.size() / 2);
        add_run(runs_, even_, pairs);
        add_run(odd_runs_, odd_, pairs);
        even_ += pairs;
        odd_ += pairs;
    }
    /// After all bytes: the odd ones follow the even ones.
    void finish() {
        *first_odd_ = difference(first_odd_byte_, last_even_);
        runs_.insert(runs_.end(), odd_runs_.begin(), odd_runs_.end());
    }

  private:
    static std::uint8_t difference(std::uint8_t value, std::uint8_t before) {
        return static_cast<std::uint8_t>(value - before + 128);
    }
    /// Goes on as the `period` (1 or 2) bytes before.
    static void fill_pairs(std::uint8_t* to, std::size_t count, std::size_t period) {
        const std::uint8_t first = *(to - period), second = to[-1];
        if (first == second) {
            std::memset(to, first, count);
        } else {
            for (std::size_t i = 0; i < count; ++i) to[i] = i % 2 == 0 ? first : second;
        }
    }

    void add_run(std::vector<Deflater::Run>& runs, const std::uint8_t* at, std::size_t count) const {
        const auto place = static_cast<std::size_t>(at - begin_);
        runs.push_back({place, place + count});
    }

    std::uint8_t* const begin_;
    std::uint8_t *even_, *odd_;
    std::uint8_t* const first_odd_;
    std::vector<Deflater::Run>& runs_;
    std::vector<Deflater::Run> odd_runs_;
    std::uint8_t last_even_ = 128, last_odd_ = 0;  // the first byte stays what it is
    std::uint8_t first_odd_byte_ = 0;
};

/// Rows of a strip as they are compressed: up to 16 at once, each of them channel by channel in the order of names.
class RowPacker {
  public:
    /// `order`: of the channels, whose types are given.
    RowPacker(const ImageStrip& strip, std::span<const PixelType> types, std::span<const std::size_t> order, int first_row, int end_row)
        : strip_(strip), types_(types), order_(order), first_row_(first_row), end_row_(end_row) {}

    /// The bytes as they are.
    void raw(std::vector<std::uint8_t>& bytes) const {
        bytes.clear();
        for_each_run([&](std::span<const std::uint8_t> run) { bytes.insert(bytes.end(), run.begin(), run.end()); },
                     [&](std::span<const std::uint8_t> pixel, std::size_t count) {
                         for (; count > 0; --count) bytes.insert(bytes.end(), pixel.begin(), pixel.end());
                     });
    }
    /// The bytes, sorted and as differences, and runs of them.
    void packed(UnfilledVector<std::uint8_t>& bytes, std::vector<Deflater::Run>& runs) const {
        std::size_t pixel_size = 0;
        for (const PixelType type : types_) pixel_size += size_of(type);
        bytes.resize(pixel_size * width_of(strip_.data) * static_cast<std::size_t>(end_row_ - first_row_));
        PairSplitter split(bytes, runs);
        for_each_run([&](std::span<const std::uint8_t> run) { split.put(run); },
                     [&](std::span<const std::uint8_t> pixel, std::size_t count) { split.repeat(pixel, count); });
        split.finish();
    }

  private:
    static std::size_t width_of(PixelRect rect) { return static_cast<std::size_t>(rect.width()); }
    static const std::uint8_t* bytes_of(const std::byte* p) { return reinterpret_cast<const std::uint8_t*>(p); }

    /// In order: put(bytes) of pixels that are there, repeat(bytes of one, count) of those that are not.
    template <typename Put, typename Repeat>
    void for_each_run(const Put& put, const Repeat& repeat) const {
        const auto& blocks = strip_.blocks;
        UnfilledVector<std::uint8_t> row;  // of blocks side by side
        for (int y = first_row_; y < end_row_; ++y) {
            for (const std::size_t c : order_) {
                const std::size_t size = size_of(types_[c]);
                for (std::size_t i = 0, end; i < blocks.size(); i = end) {
                    const bool is_there = blocks[i] != nullptr;
                    for (end = i + 1; end < blocks.size() && (blocks[end] != nullptr) == is_there;) ++end;
                    if (!is_there) {
                        repeat(std::span(bytes_of(strip_.background[c].data()), size), pixels_of(i, end));
                    } else if (end == i + 1) {
                        put(row_of(*blocks[i], c, y));
                    } else {
                        row.resize(pixels_of(i, end) * size);
                        std::uint8_t* to = row.data();
                        for (std::size_t k = i; k < end; ++k) {
                            const std::span<const std::uint8_t> part = row_of(*blocks[k], c, y);
                            // The end of the next row, which comes soon, and from too many places for the processor to tell.
                            for (std::size_t at = 0; at < part.size(); at += 64) __builtin_prefetch(part.data() + part.size() + at + 63);
                            std::memcpy(to, part.data(), part.size());
                            to += part.size();
                        }
                        put(row);
                    }
                }
            }
        }
    }
    std::size_t pixels_of(std::size_t first_block, std::size_t end_block) const {
        const auto width = static_cast<std::size_t>(strip_.block_width);
        return std::min(end_block * width, width_of(strip_.data)) - first_block * width;
    }
    static std::span<const std::uint8_t> row_of(const Image& block, std::size_t c, int y) {
        const Channel& channel = block.channels()[c];
        const std::size_t size = size_of(channel.type) * width_of(block.data());
        return {bytes_of(channel.bytes.data()) + static_cast<std::size_t>(y) * size, size};
    }

    const ImageStrip& strip_;
    std::span<const PixelType> types_;
    std::span<const std::size_t> order_;
    int first_row_, end_row_;  // in the strip
};

/// A file of OpenEXR's C library, which takes chunks that are compressed already.
class ChunkFile {
  public:
    ChunkFile(AtomicFile& file, const std::string& path) : file_(file) {
        exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
        options.user_data = this;
        options.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
        options.write_fn = [](exr_const_context_t, void* self, const void* bytes,
                              std::uint64_t size, std::uint64_t place,
                              exr_stream_error_func_ptr_t) {
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
        check(exr_initialize_required_attr(context_, part, &display, &data, 1, &center, 1,
                                           EXR_LINEORDER_INCREASING_Y, EXR_COMPRESSION_ZIP));
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
        if (result != EXR_ERR_SUCCESS)
            throw std::runtime_error(exr_get_default_error_message(result));
    }

    AtomicFile& file_;
    exr_context_t context_ = nullptr;
    std::exception_ptr failure_;
};

/// The places of channels in the order of their names.
std::vector<std::size_t> sorted_by_name(const std::vector<ChannelFormat>& channels) {
    std::vector<std::size_t> order(channels.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return channels[a].name < channels[b].name; });
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
    State(const std::string& path, PixelRect display, PixelRect data, const std::vector<ChannelFormat>& channels,
          const ExrOptions& options)
        : path_(path), data_(data), order_(sorted_by_name(channels)), file_(path) {
        for (const ChannelFormat& channel : channels) types_.push_back(channel.type);
        naming_file(path_, [&] {
            if (channels.empty()) throw InputError(path_ + ": cannot write: the image has no channels");
            chunks_.emplace(file_, path_);
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
        file_.commit();
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
    AtomicFile file_;
    std::optional<ChunkFile> chunks_;
    std::mutex mutex_;  // over all that follows
    std::vector<std::vector<std::uint8_t>> waiting_;  // by their numbers
    std::size_t next_ = 0;
    std::vector<std::unique_ptr<Tool>> tools_;
};

ExrWriter::ExrWriter(const std::string& path, PixelRect display, PixelRect data,
                     const std::vector<ChannelFormat>& channels, const ExrOptions& options)
    : state_(std::make_unique<State>(path, display, data, channels, options)) {}
ExrWriter::~ExrWriter() = default;
void ExrWriter::write_chunk(const ImageStrip& part, int y) { state_->write_chunk(part, y); }
void ExrWriter::finish() { state_->finish(); }

void write_exr(const std::string& path, const Image& image, const ExrOptions& options) {
    ExrWriter writer(path, image.display(), image.data(), image.formats(), options);
    const ImageStrip strip = strip_of(image);
    const auto chunks = static_cast<std::size_t>((image.height() + ExrWriter::kChunkRows - 1) / ExrWriter::kChunkRows);
    parallel_for(chunks, resolve_thread_count(options.threads), [&](std::size_t i, int) {
        writer.write_chunk(strip, image.data().y0 + static_cast<int>(i) * ExrWriter::kChunkRows);
    });
    writer.finish();
}

}  // namespace burin
