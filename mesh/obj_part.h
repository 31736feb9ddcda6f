#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/name_uses.h"
#include "mesh/polygon_soup.h"

// A piece of an OBJ file is parsed without what stands before it.

namespace burin {

/// What a piece of the text of an OBJ file says, or all of it.
struct ObjPart {
    /// Vertices, corners and marked edges. A piece does not know the number of its first vertex: vertices
    /// that it counts backwards are numbered kFirstOfPiece + n, where n is negative for those before the
    /// piece. Others have smaller numbers, if the file has up to kMostVertices.
    PolygonSoup soup;
    NameUses objects, groups, materials;
    std::vector<std::string> material_files;
    std::uint64_t points = 0, free_forms = 0;  ///< `p`; `curv`, `curv2`, `surf` and what they were before version 3.0
    /// Lines that begin with a word that OBJ does not have.
    struct UnknownLines {
        std::uint64_t count = 0;
        std::size_t first = 0;  ///< line number, from 1
        std::string word;       ///< of the first one
    } unknown;
    std::size_t line_count = 0;

    static constexpr std::uint32_t kMostVertices = 1u << 30, kFirstOfPiece = 3 * kMostVertices;
    static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();
    std::int64_t least_counted_back = kNone;  ///< the least n

    /// The largest number, from 1, of a vertex that does not stand before it in this piece, and where
    /// that is first.
    std::int64_t largest_reference = 0;
    std::size_t largest_reference_line = 0;

    std::uint64_t missing_texture_coordinates = 0;  ///< corners that name some which do not exist
};

/// Parses all the text of an OBJ file (`is_whole`) or a piece. Throws InputError, which names the right
/// line and number of vertices if it is all. `attributes`: what the soup gets of them; a piece must have none.
ObjPart parse_obj_part(const std::string& path, std::string_view text, bool is_whole,
                       const AttributeWish& attributes = {});

/// Cuts a text into pieces of at least `size` bytes at line ends, but not behind a backslash, where a
/// statement goes on.
std::vector<std::string_view> cut_between_statements(std::string_view text, std::size_t size);

}  // namespace burin
