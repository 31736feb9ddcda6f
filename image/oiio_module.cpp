#include "image/oiio_module.h"

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>

namespace {

const char* failure(std::string text) {
    thread_local std::string kept;
    kept = text.empty() ? "unknown error" : std::move(text);
    return kept.c_str();
}

}  // namespace

const char* burin_oiio_write(const char* path, int width, int height, int channels, int bits,
                             const unsigned short* pixels) {
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(path);
    if (!output) return failure(OIIO::geterror());
    OIIO::ImageSpec spec(width, height, channels,
                         bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("Software", "burin");
    spec.attribute("DateTime", "");
    spec.erase_attribute("DateTime");
    spec.attribute("compression", "zip");
    // A full disk shows in any of these, never in all of them.
    bool good = output->open(path, spec);
    good = good && output->write_image(OIIO::TypeDesc::UINT16, pixels);
    good = output->close() && good;
    if (!good || output->has_error()) return failure(output->geterror());
    return nullptr;
}

const char* burin_oiio_read(const char* path, int* width, int* height, int* channels,
                            unsigned short* (*allocate)(void*, unsigned long long), void* context) {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
    if (!input) return failure(OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    *width = spec.width;
    *height = spec.height;
    *channels = spec.nchannels;
    unsigned short* const pixels = allocate(context, spec.image_pixels() * spec.nchannels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT16, pixels)) {
        return failure(input->geterror());
    }
    return nullptr;
}
