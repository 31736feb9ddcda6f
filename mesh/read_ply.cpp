#include <filesystem>
#include <optional>
#include <utility>

#include "base/mapped_file.h"
#include "mesh/ply_body.h"
#include "mesh/ply_header.h"
#include "mesh/readers.h"
#include "mesh/surplus.h"

namespace burin {
namespace {

/// The values of an item stand on a line of their own by convention, but files exist that have them
/// on several lines, or all on one; and others have lines with more values than the header
/// declares, which programs that go line by line never see. So a text is read value by value; if
/// that fails, or something is left over, line by line.
PolygonSoup read_text(const std::string& path, const MappedFile& file, const PlyHeader& header,
                      const AsciiValues& values, int threads, bool strict, const AttributeWish& attributes) {
    PlyBodyReader by_value(path, file, header, values, threads, attributes);
    std::optional<InputError> error;
    PolygonSoup soup;
    try {
        soup = by_value.read();
        if (!by_value.has_rest()) return soup;
    } catch (const InputError& e) {
        error = e;
    }
    const auto note_rest = [&](auto& reader) {
        const bool has_rest = reader.has_rest();  // and goes to the line that it begins on
        if (!has_rest) return;
        note_surplus(soup, path, surplus_lines(reader.values().rest(), reader.values().line() - 1), "the last element",
                     strict);
    };
    PlyBodyReader by_line(path, file, header, values, threads, attributes, PlyItemLayout::lines);
    const auto& surplus = by_line.long_lines();
    try {
        PolygonSoup lines = by_line.read();
        if (error || surplus.count > 0) soup = std::move(lines);
    } catch (const InputError&) {
        // Where the first items have lines of their own, it is lines that count, and what is wrong
        // is wrong in them.
        if (error && surplus.count > 0 && surplus.element != &header.elements.front()) throw;
        if (error) throw *error;
        note_rest(by_value);
        return soup;
    }
    if (surplus.count > 0) {
        if (strict) {
            throw InputError({path, surplus.first},
                             "the line has more values than the header declares; re-export the file, "
                             "or leave out --strict");
        }
        soup.notes.push_back((surplus.count == 1 ? "line " + std::to_string(surplus.first) + " has"
                                                 : std::to_string(surplus.count) + " lines, the first one is line " +
                                                       std::to_string(surplus.first) + ", have") +
                             " more values than the header declares; the rest of the line is left out");
    }
    note_rest(error || surplus.count > 0 ? by_line : by_value);
    return soup;
}

}  // namespace

PolygonSoup read_ply(const std::string& path, int threads, bool strict, const AttributeWish& attributes) {
    const MappedFile file(path, true);
    const PlyHeader header = read_ply_header(path, file.bytes());
    const std::string_view body = file.bytes().substr(header.size);
    PolygonSoup soup;
    if (header.encoding == PlyEncoding::ascii) {
        soup = read_text(path, file, header, AsciiValues(body, header.lines + 1), threads, strict, attributes);
    } else {
        const bool big_endian = header.encoding == PlyEncoding::big_endian;
        PlyBodyReader reader(path, file, header, BinaryValues(body, big_endian), threads, attributes);
        soup = reader.read();
        note_surplus(soup, path, reader.values().rest(), "the last element", strict);
    }
    soup.object_names = {std::filesystem::path(path).stem().string()};
    if (soup.materials.empty()) soup.materials = {Material{}};
    return soup;
}

}  // namespace burin
