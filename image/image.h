#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/unfilled_vector.h"

// An image is a rectangle of pixels with typed channels: what is written to an EXR and read back.

namespace burin {

enum class PixelType : std::uint8_t { float16, float32, uint32 };

constexpr std::size_t size_of(PixelType type) { return type == PixelType::float16 ? 2 : 4; }

/// A rectangle of pixels, half open: [x0, x1) x [y0, y1). Row 0 is the top.
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    bool operator==(const PixelRect&) const = default;
};

/// What a channel is, without pixels.
struct ChannelFormat {
    std::string name;
    PixelType type = PixelType::float32;
};

/// One channel of an image, row by row from the top.
struct Channel {
    std::string name;  ///< as in the EXR file: "R", "lines.A", "id.object"
    PixelType type = PixelType::float32;
    UnfilledVector<std::byte> bytes;

    template <typename T>
    std::span<T> as() {
        return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
    }
    template <typename T>
    std::span<const T> as() const {
        return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
    }
};

/// Named channels over one rectangle of pixels, each of its own type.
class Image {
  public:
    Image() = default;
    /// `display` is the whole picture, `data` the part of it that there are pixels for.
    Image(PixelRect display, PixelRect data) : display_(display), data_(data) {}

    PixelRect display() const { return display_; }
    PixelRect data() const { return data_; }
    /// Has the same pixels stand for others.
    void move_to(int x0, int y0) { data_ = {x0, y0, x0 + width(), y0 + height()}; }
    int width() const { return data_.width(); }
    int height() const { return data_.height(); }
    std::size_t pixel_count() const { return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()); }

    /// Adds a channel of zeros.
    Channel& add(std::string name, PixelType type);
    /// Adds a channel whose pixels mean nothing before they are written.
    Channel& add_unfilled(std::string name, PixelType type);
    /// nullptr when there is no channel of that name.
    const Channel* find(std::string_view name) const;
    Channel* find(std::string_view name);
    const std::vector<Channel>& channels() const { return channels_; }
    std::vector<ChannelFormat> formats() const;

    /// A value as a number, whatever its type; x and y count from the data rectangle's corner.
    double value(const Channel& channel, int x, int y) const;

  private:
    PixelRect display_;
    PixelRect data_;
    std::vector<Channel> channels_;
};

}  // namespace burin
