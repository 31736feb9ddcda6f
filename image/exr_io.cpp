#include "image/exr_io.h"

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/openexr.h>

#include <algorithm>
#include <cstdint>
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
#include "image/deflate.h"

namespace burin {
namespace {

Imf::PixelType exr_type(PixelType type) {
    switch (type) {
        case PixelType::float16:
            return Imf::HALF;
        case PixelType::float32:
            return Imf::FLOAT;
        case PixelType::uint32:
            return Imf::UINT;
    }
    return Imf::FLOAT;
}

/// Slices for the rows of the data window that start at `channel.bytes`.
Imf::FrameBuffer frame_buffer(const Image& image) {
    Imf::FrameBuffer buffer;
    for (const Channel& channel : image.channels()) {
        const std::size_t x_stride = size_of(channel.type);
        const std::size_t y_stride = x_stride * static_cast<std::size_t>(image.width());
        const Imath::V2i origin(image.data().x0, image.data().y0);
        char* const base = reinterpret_cast<char*>(const_cast<std::byte*>(channel.bytes.data()));
        buffer.insert(channel.name,
                      Imf::Slice::Make(exr_type(channel.type), base, origin, image.width(),
                                       image.height(), x_stride, y_stride));
    }
    return buffer;
}

/// Rows of an image as ZIP compression packs them: up to 16 at once, each of them channel by
/// channel in the order of names. First all bytes of even number and then the others, of each the
/// difference to the byte before, plus 128 (OpenEXR's "zip" with its predictor).
class RowPacker {
  public:
    /// `order`: of the channels.
    RowPacker(const Image& image, std::span<const std::size_t> order, int first_row, int end_row)
        : image_(image), order_(order), first_row_(first_row), end_row_(end_row) {}

    /// The bytes as they are.
    void raw(std::vector<std::uint8_t>& bytes) const {
        bytes.clear();
        for_each_row([&](std::span<const std::uint8_t> row) {
            bytes.insert(bytes.end(), row.begin(), row.end());
        });
    }
    /// The bytes, sorted and as differences.
    void packed(std::vector<std::uint8_t>& bytes) const {
        std::size_t size = 0;
        for_each_row([&](std::span<const std::uint8_t> row) { size += row.size(); });
        bytes.resize(size);
        // Rows have even numbers of bytes, so that all start with an even one.
        std::uint8_t* even = bytes.data();
        std::uint8_t* odd = even + size / 2;
        std::uint8_t last_even = 128, last_odd = 0;  // the first byte stays what it is
        std::uint8_t first_odd = 0;
        for_each_row([&](std::span<const std::uint8_t> row) {
            const std::uint8_t* const p = row.data();
            const std::size_t pairs = row.size() / 2;
            if (even == bytes.data()) first_odd = p[1];
            even[0] = difference(p[0], last_even);
            odd[0] = difference(p[1], last_odd);
            for (std::size_t i = 1; i < pairs; ++i) {
                even[i] = difference(p[2 * i], p[2 * i - 2]);
                odd[i] = difference(p[2 * i + 1], p[2 * i - 1]);
            }
            last_even = p[2 * pairs - 2];
            last_odd = p[2 * pairs - 1];
            even += pairs;
            odd += pairs;
        });
        bytes[size / 2] = difference(first_odd, last_even);
    }

  private:
    static std::uint8_t difference(std::uint8_t value, std::uint8_t before) {
        return static_cast<std::uint8_t>(value - before + 128);
    }
    template <typename Use>
    void for_each_row(const Use& use) const {
        for (int y = first_row_; y < end_row_; ++y) {
            for (const std::size_t c : order_) {
                const Channel& channel = image_.channels()[c];
                const std::size_t size = size_of(channel.type) * static_cast<std::size_t>(image_.width());
                const auto* const bytes = reinterpret_cast<const std::uint8_t*>(channel.bytes.data());
                use(std::span(bytes + static_cast<std::size_t>(y) * size, size));
            }
        }
    }

    const Image& image_;
    std::span<const std::size_t> order_;
    int first_row_, end_row_;  // in the image
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
            const auto type = static_cast<exr_pixel_type_t>(exr_type(channel.type));
            check(exr_add_channel(context_, part, channel.name.c_str(), type,
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
        naming_file(path_, [&] {
            if (channels.empty()) throw InputError(path_ + ": cannot write: the image has no channels");
            chunks_.emplace(file_, path_);
            chunks_->write_header(display, data, channels, order_, options);
        });
        waiting_.resize(static_cast<std::size_t>((data.height() + kChunkRows - 1) / kChunkRows));
    }

    void write_chunk(const Image& part, int y) {
        naming_file(path_, [&] {
            const int first = y - part.data().y0;
            const RowPacker rows(part, order_, first, std::min(y + kChunkRows, data_.y1) - part.data().y0);
            std::unique_ptr<Tool> tool = take_tool();
            rows.packed(tool->bytes);
            const std::span<const std::uint8_t> stream = tool->deflater.compress(tool->bytes);
            Chunk chunk;
            chunk.is_ready = true;
            if (stream.size() < tool->bytes.size()) {
                chunk.bytes.assign(stream.begin(), stream.end());
            } else {
                rows.raw(chunk.bytes);  // readers know by the size that nothing is compressed
            }
            const std::lock_guard lock(mutex_);
            tools_.push_back(std::move(tool));
            waiting_[static_cast<std::size_t>((y - data_.y0) / kChunkRows)] = std::move(chunk);
            for (; next_ < waiting_.size() && waiting_[next_].is_ready; ++next_) {
                chunks_->write_chunk(data_.y0 + static_cast<int>(next_) * kChunkRows, waiting_[next_].bytes);
                waiting_[next_].bytes = std::vector<std::uint8_t>();  // {} would keep its memory
            }
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
    struct Chunk {
        std::vector<std::uint8_t> bytes;
        bool is_ready = false;
    };
    struct Tool {  // of one thread at a time
        Deflater deflater;
        std::vector<std::uint8_t> bytes;
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
    std::vector<std::size_t> order_;
    AtomicFile file_;
    std::optional<ChunkFile> chunks_;
    std::mutex mutex_;  // over all that follows
    std::vector<Chunk> waiting_;
    std::size_t next_ = 0;
    std::vector<std::unique_ptr<Tool>> tools_;
};

ExrWriter::ExrWriter(const std::string& path, PixelRect display, PixelRect data,
                     const std::vector<ChannelFormat>& channels, const ExrOptions& options)
    : state_(std::make_unique<State>(path, display, data, channels, options)) {}
ExrWriter::~ExrWriter() = default;
void ExrWriter::write_chunk(const Image& part, int y) { state_->write_chunk(part, y); }
void ExrWriter::finish() { state_->finish(); }

void write_exr(const std::string& path, const Image& image, const ExrOptions& options) {
    ExrWriter writer(path, image.display(), image.data(), image.formats(), options);
    const auto chunks = static_cast<std::size_t>((image.height() + ExrWriter::kChunkRows - 1) / ExrWriter::kChunkRows);
    parallel_for(chunks, resolve_thread_count(options.threads), [&](std::size_t i, int) {
        writer.write_chunk(image, image.data().y0 + static_cast<int>(i) * ExrWriter::kChunkRows);
    });
    writer.finish();
}

Image read_exr(const std::string& path) {
    try {
        Imf::InputFile input(path.c_str());
        const auto rect = [](const Imath::Box2i& b) {
            return PixelRect{b.min.x, b.min.y, b.max.x + 1, b.max.y + 1};
        };
        Image image(rect(input.header().displayWindow()), rect(input.header().dataWindow()));
        const Imf::ChannelList& channels = input.header().channels();
        for (auto it = channels.begin(); it != channels.end(); ++it) {
            const Imf::PixelType type = it.channel().type;
            image.add(it.name(), type == Imf::HALF    ? PixelType::float16
                                 : type == Imf::FLOAT ? PixelType::float32
                                                      : PixelType::uint32);
        }
        input.setFrameBuffer(frame_buffer(image));
        input.readPixels(image.data().y0, image.data().y1 - 1);
        return image;
    } catch (const std::exception& error) {
        throw InputError(path + ": cannot read: " + error.what());
    }
}

}  // namespace burin
