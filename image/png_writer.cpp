#include "image/png_writer.h"

#include <png.h>

#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <vector>

#include "base/interrupt.h"

namespace burin {
namespace {

/// What libpng's callbacks need. No exception may pass through libpng: it is kept until libpng has jumped back.
struct PngTarget {
    ByteSink& file;
    std::exception_ptr stopped;
    char message[200] = "";
};

void on_error(png_structp png, png_const_charp message) {
    auto& target = *static_cast<PngTarget*>(png_get_error_ptr(png));
    std::snprintf(target.message, sizeof target.message, "%s", message);
    png_longjmp(png, 1);
}

void on_write(png_structp png, png_bytep bytes, std::size_t size) {
    auto& target = *static_cast<PngTarget*>(png_get_io_ptr(png));
    try {
        target.file.write(bytes, size);
    } catch (...) {
        target.stopped = std::current_exception();
    }
    if (target.stopped) png_error(png, "cannot write");
}

/// Between setjmp() and where libpng jumps from are no objects with destructors.
bool write_header(png_structp png, png_infop info, const DisplayImage& image, int bits) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    // Drawings are mostly runs: filters make files larger, and more effort hardly smaller.
    png_set_compression_level(png, 3);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), bits,
                 image.channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
    char keys[2][20] = {"Software", ""}, values[2][20] = {"burin", ""};
    std::snprintf(keys[1], sizeof keys[1], "%s", kFingerprintName);
    std::snprintf(values[1], sizeof values[1], "%s", image.fingerprint.c_str());
    png_text texts[2] = {};
    for (int i = 0; i < 2; ++i) {
        texts[i].compression = PNG_TEXT_COMPRESSION_NONE;
        texts[i].key = keys[i];
        texts[i].text = values[i];
    }
    png_set_text(png, info, texts, image.fingerprint.empty() ? 1 : 2);
    png_write_info(png, info);
    return true;
}

bool write_row(png_structp png, const std::uint8_t* row) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_write_row(png, row);
    return true;
}

bool write_end(png_structp png, png_infop info) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_write_end(png, info);
    return true;
}

/// A row in the order of bytes of the file.
void pack(const std::uint16_t* values, int bits, std::vector<std::uint8_t>& row) {
    if (bits == 8) {
        for (std::size_t i = 0; i < row.size(); ++i)
            row[i] = static_cast<std::uint8_t>((std::uint32_t{values[i]} * 255 + 32767) / 65535);
        return;
    }
    for (std::size_t i = 0; i < row.size(); i += 2) {
        row[i] = static_cast<std::uint8_t>(values[i / 2] >> 8);
        row[i + 1] = static_cast<std::uint8_t>(values[i / 2]);
    }
}

}  // namespace

void write_png(ByteSink& file, const DisplayImage& image, int bits) {
    PngTarget target{file, nullptr};
    const auto ignore = [](png_structp, png_const_charp) {};  // warnings
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &target, on_error, ignore);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    struct Destroy {
        png_structp* png;
        png_infop* info;
        ~Destroy() { png_destroy_write_struct(png, info); }
    } const destroy{&png, &info};
    const auto check = [&](bool good) {
        if (good) return;
        if (target.stopped) std::rethrow_exception(target.stopped);
        throw std::runtime_error(target.message[0] != '\0' ? target.message : "libpng failed");
    };
    check(info != nullptr);
    png_set_write_fn(png, &target, on_write, nullptr);
    const std::size_t values = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
    std::vector<std::uint8_t> row(values * static_cast<std::size_t>(bits / 8));
    check(write_header(png, info, image, bits));
    for (int y = 0; y < image.height; ++y) {
        throw_if_interrupted();
        pack(&image.pixels[static_cast<std::size_t>(y) * values], bits, row);
        check(write_row(png, row.data()));
    }
    check(write_end(png, info));
}

}  // namespace burin
