#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

// What an EXR says beside its pixels.

namespace burin {

/// How the rows of an EXR are compressed, without loss.
enum class ExrCompression : std::uint8_t {
    zip,   ///< 16 rows together
    zips,  ///< each row by itself
    rle,   ///< each row by itself, runs of equal bytes only
    none,
};

/// A fraction, as frames per second are given.
struct ExrRational {
    std::int32_t numerator = 0;
    std::uint32_t denominator = 1;
    bool operator==(const ExrRational&) const = default;
};

/// A matrix for row vectors, row by row.
using ExrMatrix = std::array<float, 16>;

/// A value of any other type, as it stands in the file.
struct ExrBytes {
    std::string type;
    std::vector<std::uint8_t> bytes;
};

struct ExrAttribute {
    std::string name;
    std::variant<std::string, std::int32_t, ExrRational, ExrMatrix, ExrBytes> value;
};

/// Channels that form a part of their own.
struct ExrPart {
    std::string name;
    std::vector<std::size_t> channels;     ///< numbers, in any order
    std::vector<ExrAttribute> attributes;  ///< beside those of all parts
};

struct ExrOptions {
    int threads = 1;
    /// Of every part. No date is among them: equal images give equal files.
    std::vector<ExrAttribute> attributes = {};
    ExrCompression compression = ExrCompression::zip;
    float pixel_aspect = 1;  ///< a pixel's width / its height
    /// The width of the display window at distance 1, and its middle, as cameras have it.
    float screen_window_width = 1;
    std::array<float, 2> screen_window_center = {0, 0};
    std::vector<ExrPart> parts = {};  ///< none: one part without a name has all channels
};

}  // namespace burin
