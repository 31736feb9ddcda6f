#include "image/image.h"

#include <algorithm>
#include <utility>

#include "base/huge_pages.h"
#include "base/interrupt.h"
#include "image/half.h"

namespace burin {

Channel& Image::add(std::string name, PixelType type) {
    Channel& channel = add_unfilled(std::move(name), type);
    fill_stoppably(channel.bytes.data(), channel.bytes.size(), std::byte{0});
    return channel;
}

Channel& Image::add_unfilled(std::string name, PixelType type) {
    throw_if_interrupted();
    Channel channel;
    channel.name = std::move(name);
    channel.type = type;
    // Huge pages for larger images may take seconds to be found, and nothing can interrupt that.
    constexpr std::size_t kMostPixels = std::size_t{1} << 23;
    if (pixel_count() <= kMostPixels) reserve_large(channel.bytes, pixel_count() * size_of(type));
    channel.bytes.resize(pixel_count() * size_of(type));
    channels_.push_back(std::move(channel));
    return channels_.back();
}

const Channel* Image::find(std::string_view name) const {
    const auto it = std::find_if(channels_.begin(), channels_.end(), [&](const Channel& c) { return c.name == name; });
    return it == channels_.end() ? nullptr : &*it;
}

Channel* Image::find(std::string_view name) { return const_cast<Channel*>(std::as_const(*this).find(name)); }

std::vector<ChannelFormat> Image::formats() const {
    std::vector<ChannelFormat> formats;
    for (const Channel& c : channels_) formats.push_back({c.name, c.type});
    return formats;
}

double Image::value(const Channel& channel, int x, int y) const {
    const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x);
    switch (channel.type) {
        case PixelType::float16:
            return static_cast<double>(float_from_half(channel.as<std::uint16_t>()[i]));
        case PixelType::float32:
            return static_cast<double>(channel.as<float>()[i]);
        case PixelType::uint32:
            return channel.as<std::uint32_t>()[i];
    }
    return 0;
}

}  // namespace burin
