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
    static constexpr int kRows = 16;

    explicit RowPacker(const Image& image) : image_(image) {
        for (const Channel& channel : image.channels()) channels_.push_back(&channel);
        std::sort(channels_.begin(), channels_.end(),
                  [](const Channel* a, const Channel* b) { return a->name < b->name; });
    }

    std::span<const Channel* const> channels() const { return channels_; }
    std::size_t chunk_count() const {
        return static_cast<std::size_t>((image_.height() + kRows - 1) / kRows);
    }

    /// The bytes of a chunk as they are.
    void raw(std::size_t chunk, std::vector<std::uint8_t>& bytes) const {
        bytes.clear();
        for_each_row(chunk, [&](std::span<const std::uint8_t> row) {
            bytes.insert(bytes.end(), row.begin(), row.end());
        });
    }
    /// The bytes of a chunk, sorted and as differences.
    void packed(std::size_t chunk, std::vector<std::uint8_t>& bytes) const {
        std::size_t size = 0;
        for_each_row(chunk, [&](std::span<const std::uint8_t> row) { size += row.size(); });
        bytes.resize(size);
        // Rows have even numbers of bytes, so that all start with an even one.
        std::uint8_t* even = bytes.data();
        std::uint8_t* odd = even + size / 2;
        std::uint8_t last_even = 128, last_odd = 0;  // the first byte stays what it is
        std::uint8_t first_odd = 0;
        for_each_row(chunk, [&](std::span<const std::uint8_t> row) {
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
    void for_each_row(std::size_t chunk, const Use& use) const {
        const int first = static_cast<int>(chunk) * kRows;
        for (int y = first; y < std::min(first + kRows, image_.height()); ++y) {
            for (const Channel* const channel : channels_) {
                const std::size_t size =
                    size_of(channel->type) * static_cast<std::size_t>(image_.width());
                const auto* const bytes =
                    reinterpret_cast<const std::uint8_t*>(channel->bytes.data());
                use(std::span(bytes + static_cast<std::size_t>(y) * size, size));
            }
        }
    }

    const Image& image_;
    std::vector<const Channel*> channels_;
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

    void write_header(const Image& image, std::span<const Channel* const> channels,
                      const ExrOptions& options) {
        int part = 0;
        check(exr_add_part(context_, nullptr, EXR_STORAGE_SCANLINE, &part));
        const exr_attr_box2i_t display = box(image.display()), data = box(image.data());
        const exr_attr_v2f_t center = {0, 0};
        check(exr_initialize_required_attr(context_, part, &display, &data, 1, &center, 1,
                                           EXR_LINEORDER_INCREASING_Y, EXR_COMPRESSION_ZIP));
        for (const Channel* const channel : channels) {
            const auto type = static_cast<exr_pixel_type_t>(exr_type(channel->type));
            check(exr_add_channel(context_, part, channel->name.c_str(), type,
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

/// Compresses chunks on many threads and writes them in order, each as soon as those before are.
void write_chunks(ChunkFile& file, const RowPacker& rows, int first_y, int threads) {
    struct Chunk {
        std::vector<std::uint8_t> bytes;
        bool is_ready = false;
    };
    std::vector<Chunk> chunks(rows.chunk_count());
    std::size_t next = 0;
    std::mutex writing;
    struct Worker {
        Deflater deflater;
        std::vector<std::uint8_t> bytes;
    };
    std::vector<std::unique_ptr<Worker>> workers(static_cast<std::size_t>(threads));
    parallel_for(chunks.size(), threads, [&](std::size_t i, int number) {
        std::unique_ptr<Worker>& worker = workers[static_cast<std::size_t>(number)];
        if (worker == nullptr) worker = std::make_unique<Worker>();
        rows.packed(i, worker->bytes);
        const std::span<const std::uint8_t> stream = worker->deflater.compress(worker->bytes);
        Chunk& chunk = chunks[i];
        if (stream.size() < worker->bytes.size()) {
            chunk.bytes.assign(stream.begin(), stream.end());
        } else {
            rows.raw(i, chunk.bytes);  // readers know by the size that nothing is compressed
        }
        const std::lock_guard lock(writing);
        chunk.is_ready = true;
        for (; next < chunks.size() && chunks[next].is_ready; ++next) {
            file.write_chunk(first_y + static_cast<int>(next) * RowPacker::kRows,
                             chunks[next].bytes);
            chunks[next].bytes = {};
        }
    });
}

}  // namespace

void write_exr(const std::string& path, const Image& image, const ExrOptions& options) {
    AtomicFile file(path);
    try {
        if (image.channels().empty())
            throw InputError(path + ": cannot write: the image has no channels");
        const RowPacker rows(image);
        ChunkFile chunks(file, path);
        chunks.write_header(image, rows.channels(), options);
        write_chunks(chunks, rows, image.data().y0, resolve_thread_count(options.threads));
        chunks.finish();
    } catch (const InputError&) {
        throw;
    } catch (const Interrupted&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(path + ": cannot write: " + error.what());
    }
    file.commit();
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
