#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/image.h"

// An EXR file as its container holds it: headers and compressed chunks, which are not looked into. After "OpenEXR File
// Layout" of the OpenEXR documentation: magic number, version, a list of attributes per part, a table of places of
// chunks per part, chunks.

namespace burin {

/// An attribute of a header, as bytes of the file.
struct ContainedAttribute {
    std::string_view name, type, value;
};

/// A part of scan lines, flat or deep.
struct ContainedPart {
    std::vector<ContainedAttribute> attributes;  ///< in the file's order
    PixelRect display, data;                     ///< windows
    int rows_per_chunk = 1;
    bool is_deep = false;
    std::vector<std::string_view> chunks;  ///< whole ones, with what stands in front of their data, from the top

    /// nullptr: the part has none of this name.
    const ContainedAttribute* find(std::string_view name) const;
    /// The text of a string attribute; none: there is no such attribute, or it is no text.
    std::optional<std::string_view> text(std::string_view name) const;
};

/// What a file holds; it refers to the file's bytes.
struct ExrContainer {
    std::string_view magic_and_version;  ///< 8 bytes
    bool has_parts = false;              ///< the file says that it has several, be there one or more
    std::vector<ContainedPart> parts;
};

/// Reads headers and tables of a file's bytes, and finds its chunks; checks all of it. `path`: for messages. Throws
/// InputError for what is no EXR, broken, half written (a place in the table is 0), or has tiles.
ExrContainer parse_exr_container(const std::string& path, std::string_view bytes);

}  // namespace burin
