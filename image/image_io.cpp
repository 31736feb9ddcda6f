#include "image/image_io.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/interrupt.h"
#include "base/lower_extension.h"
#include "base/module.h"
#include "image/half.h"
#include "image/naming_file.h"
#include "image/oiio_module.h"
#include "image/png_writer.h"

namespace burin {
namespace {

template <typename Function>
Function* module_function(const char* name) {
    return reinterpret_cast<Function*>(
        burin::module_function("burin_oiio.so", name, "writes TIFF", "write EXR or PNG"));
}

std::uint16_t code_value(float unit) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(unit, 0.0f, 1.0f) * 65535.0f));
}

std::uint16_t srgb_code_value(float linear) {
    // Most of a line drawing is paper or ink; the power would take longer than all the rest.
    if (!(linear > 0)) return 0;
    return linear >= 1 ? std::uint16_t{65535} : code_value(srgb_from_linear(linear));
}

/// The file that the module's bytes go to, and why it stopped, if it did.
struct DisplaySink {
    ByteSink& file;
    std::exception_ptr stopped;

    template <typename Action>
    bool guarded(const Action& action) noexcept {
        // An exception must not pass through the libraries in between.
        try {
            action();
            return true;
        } catch (...) {
            stopped = std::current_exception();
            return false;
        }
    }
    static bool write(void* context, const void* bytes, unsigned long long size) {
        auto& sink = *static_cast<DisplaySink*>(context);
        return sink.guarded([&] { sink.file.write(bytes, size); });
    }
    static bool go_on(void* context) {
        return static_cast<DisplaySink*>(context)->guarded([] { throw_if_interrupted(); });
    }
};

/// A library's message on one line.
std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

/// Writes a row of a channel of the data window into component `c` of the pixels from `dx` on.
void read_row(const Image& image, const Channel& channel, int dx, int y, int c, std::vector<glm::vec4>& row) {
    if (y < 0 || y >= image.height()) return;
    const int begin = std::max(0, -dx), end = std::min(image.width(), static_cast<int>(row.size()) - dx);
    const auto first = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width());
    const auto read = [&](const auto& value_at) {
        for (int x = begin; x < end; ++x)
            row[static_cast<std::size_t>(x + dx)][c] = value_at(first + static_cast<std::size_t>(x));
    };
    switch (channel.type) {
        case PixelType::float16:
            return read([half = channel.as<std::uint16_t>()](std::size_t i) { return float_from_half(half[i]); });
        case PixelType::float32:
            return read([v = channel.as<float>()](std::size_t i) { return v[i]; });
        case PixelType::uint32:
            return read([v = channel.as<std::uint32_t>()](std::size_t i) { return static_cast<float>(v[i]); });
    }
}

/// The pictures for the screen that can be written.
enum class DisplayFormat { png, tiff };

DisplayFormat format_of(const std::string& name, const std::string& extension) {
    if (extension == ".png") return DisplayFormat::png;
    if (extension == ".tif" || extension == ".tiff") return DisplayFormat::tiff;
    throw InputError(name + ": unknown kind of picture '" + extension + "'; write .png or .tif");
}

void write_by_libpng(ByteSink& file, const std::string& name, const DisplayImage& image, int bits) {
    naming_file(name, [&] { write_png(file, image, bits); });
}

void write_by_module(ByteSink& file, const std::string& name, const std::string& extension, const DisplayImage& image,
                     int bits) {
    auto* const write = module_function<decltype(burin_oiio_write)>("burin_oiio_write");
    DisplaySink target{file, nullptr};
    const BurinOiioSink sink{&target, DisplaySink::write, DisplaySink::go_on};
    const std::string description =
        image.fingerprint.empty() ? "" : std::string(kFingerprintName) + " " + image.fingerprint;
    const char* const failure = write(("picture" + extension).c_str(), image.width, image.height, image.channels, bits,
                                      image.pixels.data(), description.c_str(), &sink);
    if (target.stopped) std::rethrow_exception(target.stopped);
    if (failure != nullptr) throw InputError(name + ": cannot write: " + one_line(failure));
}

}  // namespace

float srgb_from_linear(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float linear_from_srgb(float code) {
    return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

DisplayImage to_display(const Image& image, std::optional<glm::vec3> background) {
    DisplayImage result;
    result.width = image.display().width();
    result.height = image.display().height();
    result.channels = background ? 3 : 4;
    const auto channels = static_cast<std::size_t>(result.channels);
    const auto pixel_count = static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height);
    result.pixels.resize(pixel_count * channels);

    const glm::vec3 paper = background.value_or(glm::vec3(0.0f));
    const auto encode = [&](const glm::vec4& color, std::uint16_t* out) {
        const float alpha = color.a;
        float before = 0;
        for (int c = 0; c < 3; ++c) {
            float linear = color[c] + (1 - alpha) * paper[c];
            if (!background && alpha > 0) linear = color[c] / alpha;
            out[c] = c > 0 && linear == before ? out[c - 1] : srgb_code_value(linear);  // most ink is grey
            before = linear;
        }
        if (!background) out[3] = code_value(alpha);
    };
    const Channel* const rgba[4] = {image.find("R"), image.find("G"), image.find("B"), image.find("A")};
    const int dx = image.data().x0 - image.display().x0;
    const int dy = image.data().y0 - image.display().y0;
    std::vector<glm::vec4> row(static_cast<std::size_t>(result.width));
    for (int y = 0; y < result.height; ++y) {
        throw_if_interrupted();
        std::fill(row.begin(), row.end(), glm::vec4(0.0f));
        for (int c = 0; c < 4; ++c) read_row(image, *rgba[c], dx, y - dy, c, row);
        std::uint16_t* out = &result.pixels[static_cast<std::size_t>(y) * row.size() * channels];
        for (std::size_t x = 0; x < row.size(); ++x, out += channels) {
            // Most pixels are as the one before, and encoding takes long.
            if (x > 0 && row[x] == row[x - 1]) {
                std::copy(out - channels, out, out);
            } else {
                encode(row[x], out);
            }
        }
    }
    return result;
}

void check_display_writer(const std::string& path) {
    if (format_of(path, lower_extension(path)) != DisplayFormat::tiff) return;
    try {
        module_function<decltype(burin_oiio_write)>("burin_oiio_write");
    } catch (const InputError& error) {
        throw InputError(path + ": " + error.what());
    }
}

void write_display_image(ByteSink& file, const std::string& name, const std::string& extension,
                         const DisplayImage& image, int bits) {
    switch (format_of(name, extension)) {
        case DisplayFormat::png:
            return write_by_libpng(file, name, image, bits);
        case DisplayFormat::tiff:
            return write_by_module(file, name, extension, image, bits);
    }
}

void write_display_image(const std::string& path, const DisplayImage& image, int bits) {
    check_display_writer(path);  // before there is a file
    AtomicFile file(path);
    write_display_image(file, path, lower_extension(path), image, bits);
    file.commit();
}

DisplayImage read_display_image(const std::string& path) {
    auto* const read = module_function<decltype(burin_oiio_read)>("burin_oiio_read");
    DisplayImage image;
    const auto allocate = [](void* context, unsigned long long count) {
        auto& pixels = *static_cast<std::vector<std::uint16_t>*>(context);
        pixels.resize(count);
        return pixels.data();
    };
    const char* const failure =
        read(path.c_str(), &image.width, &image.height, &image.channels, allocate, &image.pixels);
    if (failure != nullptr) throw InputError(path + ": cannot read: " + one_line(failure));
    return image;
}

}  // namespace burin
