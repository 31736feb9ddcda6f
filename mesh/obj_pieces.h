#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "mesh/obj_part.h"

// A large OBJ file is parsed in pieces, on all threads, and the pieces are joined in order.

namespace burin {

/// What the pieces of a text say together, each parsed by one of `threads` threads (0 = all cores).
/// Nothing if there is any error: which is the first one, and the numbers in its message, only a parser
/// knows that has read all before it.
std::optional<ObjPart> parse_obj_pieces(const std::string& path, std::span<const std::string_view> pieces, int threads);

}  // namespace burin
