#include "image/oiio_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace {

const char* failure(const std::string& text) {
    thread_local char kept[500];
    std::snprintf(kept, sizeof kept, "%s", text.empty() ? "unknown error" : text.c_str());
    return kept;
}

/// A file in memory. OpenImageIO 2.4 does not notice when the last bytes of a real one get lost:
/// it ignores what fclose and TIFFClose say.
class MemoryProxy : public OIIO::Filesystem::IOProxy {
  public:
    explicit MemoryProxy(const char* name) : IOProxy(name, Write) {}
    const char* proxytype() const override { return "memory"; }
    std::size_t write(const void* from, std::size_t size) override {
        m_pos += static_cast<std::int64_t>(pwrite(from, size, m_pos));
        return size;
    }
    std::size_t pwrite(const void* from, std::size_t size, std::int64_t position) override {
        const auto to = static_cast<std::size_t>(position);
        if (to + size > bytes_.size()) bytes_.resize(to + size);
        std::memcpy(bytes_.data() + to, from, size);
        return size;
    }
    std::size_t size() const override { return bytes_.size(); }
    const std::vector<char>& bytes() const { return bytes_; }

  private:
    std::vector<char> bytes_;
};

}  // namespace

const char* burin_oiio_write(const char* name, int width, int height, int channels, int bits,
                             const unsigned short* pixels, const char* description, const BurinOiioSink* sink) {
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name);
    if (!output) return failure(OIIO::geterror());
    if (!output->supports("ioproxy")) return failure("this format cannot be written");
    OIIO::ImageSpec spec(width, height, channels, bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    // It would go into an Exif directory, for which OpenImageIO reads back what it wrote; through a
    // proxy that gives a broken file. Readers take TIFFs of 8 and 16 bits for sRGB anyway.
    spec.attribute("tiff:write_exif", 0);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("Software", "burin");
    if (description[0] != '\0') spec.attribute("ImageDescription", description);
    // Without a DateTime the time of writing goes into a TIFF; one that is no text is left out.
    spec.attribute("DateTime", 0);
    spec.attribute("compression", "zip");

    OIIO::attribute("threads", 1);  // --threads is a promise
    MemoryProxy proxy(name);
    OIIO::Filesystem::IOProxy* const proxy_pointer = &proxy;
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy_pointer);
    bool good = output->open(name, spec);
    constexpr int kRowsAtOnce = 64;
    const std::size_t row_values = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
    for (int y = 0; y < height && good; y += kRowsAtOnce) {
        good = sink->go_on(sink->context) &&
               output->write_scanlines(y, std::min(y + kRowsAtOnce, height), 0, OIIO::TypeDesc::UINT16,
                                       pixels + static_cast<std::size_t>(y) * row_values);
    }
    good = output->close() && good;
    if (!good || output->has_error()) return failure(output->geterror());
    const std::vector<char>& bytes = proxy.bytes();
    return sink->write(sink->context, bytes.data(), bytes.size()) ? nullptr : failure("the sink is full");
}

const char* burin_oiio_read(const char* path, int* width, int* height, int* channels,
                            unsigned short* (*allocate)(void*, unsigned long long), void* context) {
    OIIO::ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);  // do not multiply alpha in
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &wishes);
    if (!input) return failure(OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    *width = spec.width;
    *height = spec.height;
    *channels = spec.nchannels;
    const auto channel_count = static_cast<std::uint64_t>(spec.nchannels);
    unsigned short* const pixels = allocate(context, spec.image_pixels() * channel_count);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT16, pixels)) {
        return failure(input->geterror());
    }
    return nullptr;
}
