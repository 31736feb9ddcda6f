#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/exr_options.h"
#include "image/image.h"
#include "output/matte_channels.h"

// How the channels of a film are named in an EXR, and which of them form a part.

namespace burin {

/// Blender shows only channels whose last name is one letter, and a few words: its names have one where ours have not.
enum class ChannelNames : std::uint8_t { plain, blender };

/// What can be chosen about an EXR.
struct ExrChoice {
    bool has_parts = false;  ///< a part per layer; else one
    ChannelNames names = ChannelNames::plain;
    ExrCompression compression = ExrCompression::zip;
    bool has_camera = true;  ///< else the picture is of several views
};

/// A channel's name for those readers: `coverage.crease` becomes `coverage_crease.V`.
std::string channel_name(std::string_view name, ChannelNames names);

/// The part that a channel belongs to: `rgba`, `lines`, `N`, `CryptoObject` ...
std::string part_of(std::string_view channel);

/// The parts that channels form, in their order, with the attributes of Cryptomatte in the first one, where some
/// readers look for them, and in their own.
std::vector<ExrPart> parts_of(const std::vector<ChannelFormat>& channels, const std::vector<CryptoAttributes>& crypto);

}  // namespace burin
