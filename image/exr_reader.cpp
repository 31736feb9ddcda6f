#include "image/exr_reader.h"

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <cstddef>
#include <exception>

#include "base/error.h"

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
        buffer.insert(channel.name, Imf::Slice::Make(exr_type(channel.type), base, origin, image.width(),
                                                     image.height(), x_stride, y_stride));
    }
    return buffer;
}

}  // namespace

Image read_flattened_exr(const std::string& path) {
    try {
        Imf::InputFile input(path.c_str());
        const Imath::Box2i box = input.header().dataWindow();
        const PixelRect rect{box.min.x, box.min.y, box.max.x + 1, box.max.y + 1};
        Image image(rect, rect);
        for (const char* const name : {"R", "G", "B", "A"}) image.add(name, PixelType::float32);
        input.setFrameBuffer(frame_buffer(image));
        input.readPixels(rect.y0, rect.y1 - 1);
        return image;
    } catch (const std::exception& error) {
        throw InputError(path + ": cannot read: " + error.what());
    }
}

Image read_exr(const std::string& path) {
    try {
        Imf::InputFile input(path.c_str());
        const auto rect = [](const Imath::Box2i& b) { return PixelRect{b.min.x, b.min.y, b.max.x + 1, b.max.y + 1}; };
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
