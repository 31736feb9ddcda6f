#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/crypto_layers.h"
#include "render/frame.h"

// Names of objects, materials, lines and sets, and the numbers that stand for them in files of compositors.

namespace burin {

/// The number of a name: its hash, changed where its bits would be no ordinary float.
std::uint32_t crypto_id(std::string_view name);

/// A name without control characters and bytes that are no UTF-8, for which readers have no common answer; "default"
/// where there is none, for nobody can pick an empty one.
std::string matte_name(std::string_view name);

/// The names that a layer of Cryptomatte knows, by their numbers from 0.
struct MatteNames {
    std::vector<std::string> names;
    std::vector<std::uint32_t> ids;

    /// All names in JSON, sorted, each with its number: {"box":"0123abcd"}.
    std::string manifest() const;
};

/// The names of a layer in a frame: of objects and materials by their numbers less 1, of lines by line_name_number(),
/// of sets by theirs.
MatteNames matte_names_of(CryptoLayer layer, const Frame& frame);

constexpr std::size_t line_name_number(LineClass drawn_as, bool is_hidden) {
    return static_cast<std::size_t>(drawn_as) + (is_hidden ? kLineClassCount : 0);
}

/// What makes a name hard to use in Cryptomatte: a sentence for each, beginning with the name; none mostly.
/// Throws Interrupted where the user asked to stop.
std::vector<std::string> warnings_on_names(const std::vector<std::string>& names);

}  // namespace burin
