#include "image/exr_chunk_file.h"

#include <OpenEXR/openexr.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <variant>

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

}  // namespace

int rows_per_chunk(ExrCompression compression) {
    constexpr int kRowsOfZip = 16;
    return compression == ExrCompression::zip ? kRowsOfZip : 1;
}

class ExrChunkFile::Library {
  public:
    Library(ByteSink& file, const std::string& path) : file_(file) {
        exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
        options.user_data = this;
        options.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
        options.write_fn = [](exr_const_context_t, void* self, const void* bytes, std::uint64_t size,
                              std::uint64_t place, exr_stream_error_func_ptr_t) {
            return static_cast<Library*>(self)->write(bytes, size, place);
        };
        check(exr_start_write(&context_, path.c_str(), EXR_WRITE_FILE_DIRECTLY, &options));
    }
    ~Library() {
        if (context_ != nullptr) exr_finish(&context_);
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    /// Writes the header of one part, or of several, for which tables of chunks follow.
    void write_header(PixelRect display_window, PixelRect data_window, const std::vector<ChannelFormat>& channels,
                      std::span<const std::vector<std::size_t>> orders, const ExrOptions& options) {
        for (std::size_t p = 0; p < orders.size(); ++p) {
            const char* const name = options.parts.empty() ? nullptr : options.parts[p].name.c_str();
            const int part = add_part(name, EXR_STORAGE_SCANLINE, display_window, data_window, options);
            for (const std::size_t c : orders[p]) add_channel(part, channels[c]);
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
    void write_deep_header(PixelRect display_window, PixelRect data_window, const std::vector<ChannelFormat>& channels,
                           const std::string& part_name, const ExrOptions& options) {
        const int part = add_part(part_name.c_str(), EXR_STORAGE_DEEP_SCANLINE, display_window, data_window, options);
        check(exr_set_version(context_, part, 1));  // of deep data
        for (const ChannelFormat& channel : channels) add_channel(part, channel);
        for (const ExrAttribute& attribute : options.attributes) add_attribute(part, attribute);
        check(exr_write_header(context_));
    }
    void write_deep_chunk(int y, std::span<const std::uint8_t> counts, std::span<const std::uint8_t> samples,
                          std::uint64_t raw_size) {
        check(exr_write_deep_scanline_chunk(context_, 0, y, samples.data(), samples.size(), raw_size, counts.data(),
                                            counts.size()));
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

    int add_part(const char* name, exr_storage_t storage, PixelRect display_window, PixelRect data_window,
                 const ExrOptions& options) {
        const exr_attr_box2i_t display = box(display_window), data = box(data_window);
        const exr_attr_v2f_t center = {options.screen_window_center[0], options.screen_window_center[1]};
        int part = 0;
        check(exr_add_part(context_, name, storage, &part));
        check(exr_initialize_required_attr(context_, part, &display, &data, options.pixel_aspect, &center,
                                           options.screen_window_width, EXR_LINEORDER_INCREASING_Y,
                                           exr_compression(options.compression)));
        return part;
    }
    void add_channel(int part, const ChannelFormat& channel) {
        check(exr_add_channel(context_, part, channel.name.c_str(), exr_type(channel.type),
                              EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
    }

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
        } else if (const auto* const other = std::get_if<ExrBytes>(&attribute.value)) {
            check(exr_attr_set_user(context_, part, name, other->type.c_str(),
                                    static_cast<std::int32_t>(other->bytes.size()), other->bytes.data()));
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

ExrChunkFile::ExrChunkFile(ByteSink& file, const std::string& path) : library_(std::make_unique<Library>(file, path)) {}
ExrChunkFile::~ExrChunkFile() = default;

void ExrChunkFile::write_header(PixelRect display, PixelRect data, const std::vector<ChannelFormat>& channels,
                                std::span<const std::vector<std::size_t>> orders, const ExrOptions& options) {
    library_->write_header(display, data, channels, orders, options);
}
void ExrChunkFile::write_deep_header(PixelRect display, PixelRect data, const std::vector<ChannelFormat>& channels,
                                     const std::string& part_name, const ExrOptions& options) {
    library_->write_deep_header(display, data, channels, part_name, options);
}
void ExrChunkFile::write_chunk(std::size_t part, int y, std::span<const std::uint8_t> bytes) {
    library_->write_chunk(part, y, bytes);
}
void ExrChunkFile::write_deep_chunk(int y, std::span<const std::uint8_t> counts, std::span<const std::uint8_t> samples,
                                    std::uint64_t raw_size) {
    library_->write_deep_chunk(y, counts, samples, raw_size);
}
void ExrChunkFile::finish() { library_->finish(); }

}  // namespace burin
