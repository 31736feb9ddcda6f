#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>

#include "base/interrupt.h"
#include "base/mapped_file.h"
#include "mesh/readers.h"
#include "mesh/surplus.h"
#include "mesh/text_scan.h"

namespace burin {
namespace {

constexpr std::size_t kBinaryHeader = 80;    // free text
constexpr std::size_t kBinaryTriangle = 50;  // normal, 3 corners (12 floats), 16 bits of attributes
constexpr const char* kRepair = "; repair or re-export the file";

std::uint32_t little_endian_u32(const char* p) {
    unsigned char b[4];
    std::memcpy(b, p, 4);
    return std::uint32_t{b[0]} | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
}

float little_endian_float(const char* p) {
    const std::uint32_t bits = little_endian_u32(p);
    float value = 0;
    std::memcpy(&value, &bits, 4);
    return value;
}

bool is_usable(const glm::dvec3& p) {
    return std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate &&
           std::abs(p.z) <= kLargestCoordinate;  // false for NaN
}

void add_corner(PolygonSoup& soup, const glm::dvec3& position) {
    soup.corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
    soup.positions.push_back(position);
}

constexpr const char* kNotFinite = "a coordinate is not finite or beyond 1e30";

/// Notes how many triangles without finite coordinates are left out. Throws InputError if no triangle is left.
void note_non_finite(const SourcePosition& place, PolygonSoup& soup, const std::string& first) {
    if (soup.non_finite_polygons == 0) return;
    if (soup.corners.empty()) throw InputError(place, std::string("no triangle has finite coordinates") + kRepair);
    soup.notes.push_back("triangles left out: " + std::to_string(soup.non_finite_polygons) + "; the first one " +
                         first + ": " + kNotFinite);
}

/// Whether a file is a text of any kind that is no STL. Triangles have zero bytes, nearly always.
bool is_plain_text(std::string_view bytes) {
    return std::all_of(bytes.begin(),
                       bytes.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(bytes.size(), 4096)),
                       [](char c) { return static_cast<unsigned char>(c) >= 0x20 || (c >= '\t' && c <= '\r'); });
}

/// Text that may lack the word 'solid' at its start, but has facets.
bool is_text_with_facets(std::string_view bytes) {
    if (!is_plain_text(bytes)) return false;
    const std::string begin = lower_case(bytes.substr(0, 4096));
    return begin.find("facet") != std::string::npos && begin.find("loop") != std::string::npos;
}

/// The number of triangles, which `count` should be. Where it is not and the file holds whole
/// triangles behind the header, it is their number that counts: some exporters do not go back to
/// write it.
std::uint64_t triangle_count(const std::string& path, std::uint64_t count, std::string_view triangles, bool strict,
                             PolygonSoup& soup) {
    const std::uint64_t room = triangles.size() / kBinaryTriangle;
    const bool is_whole = triangles.size() % kBinaryTriangle == 0 && room > 0 && !is_plain_text(triangles);
    if (count == room || (count < room && !is_whole)) return count;
    const std::string found = "the header promises " + std::to_string(count) + " triangles, the file has ";
    if (!is_whole || strict) {
        throw InputError(path + ": " + found + (count > room ? "room for " : "") + std::to_string(room) +
                         "; was it written completely?");
    }
    soup.notes.push_back(found + std::to_string(room) + ", which are read" +
                         (count > room ? "; was it written completely?" : ""));
    return room;
}

PolygonSoup read_binary(const std::string& path, std::string_view bytes, bool strict) {
    PolygonSoup soup;
    const std::uint64_t count = triangle_count(path, little_endian_u32(bytes.data() + kBinaryHeader),
                                               bytes.substr(kBinaryHeader + 4), strict, soup);
    if (3 * count > PolygonSoup::kMaxCorners) {
        throw InputError(path + ": more than 4 billion polygon corners; split the model");
    }
    soup.positions.reserve(3 * count);
    soup.corners.reserve(3 * count);
    std::uint64_t first_non_finite = 0;
    const char* p = bytes.data() + kBinaryHeader + 4;
    for (std::uint64_t t = 0; t < count; ++t, p += kBinaryTriangle) {
        if ((t & 0xFFFF) == 0) throw_if_interrupted();
        std::array<glm::dvec3, 3> corners;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const char* const q = p + 12 + 12 * corner;
            corners[corner] =
                glm::dvec3(little_endian_float(q), little_endian_float(q + 4), little_endian_float(q + 8));
        }
        if (!is_usable(corners[0]) || !is_usable(corners[1]) || !is_usable(corners[2])) {
            if (strict) throw InputError(path + ": triangle " + std::to_string(t) + ": " + kNotFinite + kRepair);
            if (soup.non_finite_polygons++ == 0) first_non_finite = t;
            continue;
        }
        for (const glm::dvec3& corner : corners) add_corner(soup, corner);
    }
    note_surplus(soup, path, bytes.substr(static_cast<std::size_t>(p - bytes.data())), "the last triangle", strict);
    soup.object_names = {std::filesystem::path(path).stem().string()};
    note_non_finite({path}, soup, "is triangle " + std::to_string(first_non_finite));
    return soup;
}

/// Reads a number, or as NaN what stands for none: nan, -nan(ind), inf, infinity, 1.#QNAN, -1.#IND
/// and their like.
bool read_coordinate(LineScanner& scan, double& value) {
    if (scan.number(value)) return true;
    LineScanner ahead = scan;
    std::string word = lower_case(ahead.word());
    word.erase(0, word.find_first_not_of("+-"));
    if (!word.starts_with("nan") && !word.starts_with("inf") && !word.starts_with("1.#") && !word.starts_with("1#"))
        return false;
    value = std::numeric_limits<double>::quiet_NaN();
    scan = ahead;
    return true;
}

// Most files have one statement a line; some have the whole file on one line. What stands between two statements of a
// line, like the normal of a facet, is passed over.

bool is_keyword(std::string_view word) {
    constexpr std::array<std::string_view, 8> kKeywords = {"facet",   "outer",    "vertex",   "end",
                                                           "endloop", "endfacet", "endsolid", "solid"};
    if (word.empty() || std::string_view("fovesFOVES").find(word[0]) == std::string_view::npos) return false;
    return std::find(kKeywords.begin(), kKeywords.end(), lower_case(word)) != kKeywords.end();
}

/// Goes on to the next keyword of the line; false at the line's end.
bool find_keyword(LineScanner& scan) {
    LineScanner ahead = scan;
    for (std::string_view word = ahead.word(); !word.empty(); word = ahead.word()) {
        if (is_keyword(word)) return true;
        scan = ahead;
    }
    return false;
}

/// Goes on to the words 'facet normal', which no name of a solid has, or to the word 'endsolid'; false where the line
/// has neither.
bool find_end_of_name(LineScanner& scan) {
    LineScanner ahead = scan;
    for (std::string_view word = ahead.word(); !word.empty(); word = ahead.word()) {
        if (is_keyword(word)) {
            LineScanner next = ahead;
            const std::string keyword = lower_case(word);
            if (keyword == "endsolid" || (keyword == "facet" && lower_case(next.word()) == "normal")) return true;
        }
        scan = ahead;
    }
    return false;
}

/// The name behind the word 'solid', which ends with the line unless the solid goes on there.
std::string_view scan_name(LineScanner& scan) {
    const std::string_view line = scan.rest();
    find_end_of_name(scan);
    std::string_view name = line.substr(0, line.size() - scan.rest().size());
    while (!name.empty() && is_blank(name.back())) name.remove_suffix(1);
    return name;
}

/// Passes over the name behind the word 'endsolid', which ends with the line unless another solid stands there.
void skip_end_name(LineScanner& scan) {
    LineScanner name_end = scan;
    if (!find_end_of_name(name_end)) {
        scan = name_end;
        return;
    }
    // The name may have the word 'solid' as well: the last one begins the solid.
    LineScanner begin = name_end;
    for (LineScanner ahead = scan; ahead.rest().size() > name_end.rest().size();) {
        const LineScanner at = ahead;
        if (lower_case(ahead.word()) == "solid") begin = at;
    }
    scan = begin;
}

class AsciiParser {
  public:
    AsciiParser(const std::string& path, std::string_view text, bool strict)
        : path_(path), lines_(text), strict_(strict) {}

    PolygonSoup parse() {
        std::string_view line;
        while (lines_.next(line)) {
            LineScanner scan(line);
            do {
                if ((++statements_ & 0xFFFF) == 0) throw_if_interrupted();
                read_statement(scan);
            } while (find_keyword(scan));
        }
        if (in_solid_ && (in_facet_ || in_loop_ || !lacks_solid_)) {
            fail(std::string("the file ends in the middle of a ") + (lacks_solid_ ? "facet" : "solid") +
                 "; was it written completely?");
        }
        note_non_finite({path_, first_non_finite_line_}, soup_, "is on line " + std::to_string(first_non_finite_line_));
        return std::move(soup_);
    }

  private:
    void read_statement(LineScanner& scan) {
        std::string keyword = lower_case(scan.word());
        if (keyword == "end") keyword += lower_case(scan.word());  // some write "end loop"
        if (keyword == "vertex") {
            add_vertex(scan);
        } else if (keyword == "endloop") {
            end_loop();
        } else if (keyword == "facet" || keyword == "endfacet" || keyword == "outer") {
            check_loop_is_closed();
            if (keyword == "facet" && soup_.object_names.empty()) begin_without_solid();
            if (keyword != "outer") in_facet_ = keyword == "facet";
        } else if (keyword == "solid") {
            check_loop_is_closed();
            begin_solid(std::string(scan_name(scan)));
        } else if (keyword == "endsolid") {
            check_loop_is_closed();
            in_solid_ = false;
            skip_end_name(scan);
        } else if (!keyword.empty() && keyword != "color") {
            fail("unknown word '" + printable(keyword) + "'" + kRepair);
        }
    }

    [[noreturn]] void fail(const std::string& message) const {
        throw InputError({path_, lines_.line_number()}, message);
    }

    /// Without this, two facets would become one polygon.
    void check_loop_is_closed() const {
        if (in_loop_) fail("the facet before is not closed by 'endloop'" + std::string(kRepair));
    }

    void begin_solid(std::string name) {
        if (name.empty()) name = std::filesystem::path(path_).stem().string();
        soup_.object_names.push_back(std::move(name));
        in_solid_ = true;
        lacks_solid_ = false;
    }
    /// Some programs write facets and nothing else.
    void begin_without_solid() {
        begin_solid("");
        lacks_solid_ = true;
        note_left_out(soup_, {path_, lines_.line_number()},
                      "the word 'solid' is missing in front of the first facet, which is on line " +
                          std::to_string(lines_.line_number()),
                      strict_);
    }

    void add_vertex(LineScanner& scan) {
        if (!in_solid_) fail("a vertex stands outside of any solid" + std::string(kRepair));
        glm::dvec3 p;
        if (!read_coordinate(scan, p.x) || !read_coordinate(scan, p.y) || !read_coordinate(scan, p.z)) {
            fail("a vertex needs three numbers" + std::string(kRepair));
        }
        in_loop_ = true;
        if (!is_usable(p)) {
            if (strict_) fail(kNotFinite + std::string(kRepair));
            is_finite_ = false;
            if (first_non_finite_line_ == 0) first_non_finite_line_ = lines_.line_number();
            return;
        }
        if (soup_.corners.size() == PolygonSoup::kMaxCorners) {
            fail("more than 4 billion polygon corners; split the model");
        }
        add_corner(soup_, p);
    }

    void end_loop() {
        in_loop_ = false;
        if (!std::exchange(is_finite_, true)) {
            ++soup_.non_finite_polygons;
            const std::size_t begin = soup_.polygon_ends.empty() ? 0 : soup_.polygon_ends.back();
            soup_.corners.resize(begin);
            soup_.positions.resize(begin);  // each corner has its own
            return;
        }
        soup_.polygon_ends.push_back(static_cast<std::uint32_t>(soup_.corners.size()));
        soup_.polygon_object.push_back(static_cast<std::uint32_t>(soup_.object_names.size() - 1));
    }

    std::string path_;
    LineReader lines_;
    PolygonSoup soup_;
    bool strict_;
    bool in_solid_ = false;
    bool lacks_solid_ = false;  // the solid that is being read
    bool in_facet_ = false;
    bool in_loop_ = false;
    std::uint64_t statements_ = 0;
    bool is_finite_ = true;  // the loop so far
    std::size_t first_non_finite_line_ = 0;
};

}  // namespace

PolygonSoup read_stl(const std::string& path, bool strict) {
    const MappedFile file(path);
    const std::string_view bytes = file.bytes();
    const bool has_binary_header = bytes.size() >= kBinaryHeader + 4;
    const std::uint64_t binary_size =
        has_binary_header
            ? kBinaryHeader + 4 + std::uint64_t{kBinaryTriangle} * little_endian_u32(bytes.data() + kBinaryHeader)
            : 0;
    // Binary files may start with "solid" as well; their size gives them away.
    const std::string_view text = without_byte_order_mark(bytes);
    const std::size_t first = std::min(text.find_first_not_of(" \t\r\n"), text.size());
    const bool starts_as_text = lower_case(text.substr(first, 5)) == "solid" || is_text_with_facets(text);
    const bool has_zero_bytes = std::memchr(bytes.data(), 0, std::min<std::size_t>(bytes.size(), 512)) != nullptr;
    const bool is_text = starts_as_text && binary_size != bytes.size() && !has_zero_bytes;

    if ((bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) && binary_size != bytes.size() &&
        bytes.size() % 2 == 0) {
        throw InputError(path + ": the text is UTF-16; save it as UTF-8 or ASCII");
    }
    PolygonSoup soup;
    if (is_text) {
        soup = AsciiParser(path, text, strict).parse();
    } else if (has_binary_header && (binary_size == bytes.size() || !is_plain_text(bytes))) {
        soup = read_binary(path, bytes, strict);
    } else {
        throw InputError(path + ": neither text that starts with 'solid' or has facets, nor a binary STL of 84 " +
                         "bytes or more; was it written completely?");
    }
    if (soup.corners.empty()) throw InputError(path + ": the file has no triangles");
    soup.materials = {Material{}};
    return soup;
}

}  // namespace burin
