#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>

#include "base/interrupt.h"
#include "base/mapped_file.h"
#include "mesh/readers.h"
#include "mesh/text_scan.h"

namespace burin {
namespace {

constexpr std::size_t kBinaryHeader = 80;    // free text
constexpr std::size_t kBinaryTriangle = 50;  // normal, 3 corners (12 floats), 16 bits of attributes
constexpr const char* kRepair = "; repair or re-export the file";

std::uint32_t little_endian_u32(const char* p) {
    unsigned char b[4];
    std::memcpy(b, p, 4);
    return std::uint32_t{b[0]} | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 |
           std::uint32_t{b[3]} << 24;
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

PolygonSoup read_binary(const std::string& path, std::string_view bytes) {
    const std::uint64_t count = little_endian_u32(bytes.data() + kBinaryHeader);
    const std::uint64_t room = (bytes.size() - kBinaryHeader - 4) / kBinaryTriangle;
    if (count > room) {
        throw InputError(path + ": the header promises " + std::to_string(count) +
                         " triangles, the file has room for " + std::to_string(room) +
                         "; was it written completely?");
    }
    if (3 * count > PolygonSoup::kMaxCorners) {
        throw InputError(path + ": more than 4 billion polygon corners; split the model");
    }
    PolygonSoup soup;
    soup.positions.reserve(3 * count);
    soup.corners.reserve(3 * count);
    const char* p = bytes.data() + kBinaryHeader + 4;
    for (std::uint64_t t = 0; t < count; ++t, p += kBinaryTriangle) {
        if ((t & 0xFFFF) == 0) throw_if_interrupted();
        for (int corner = 0; corner < 3; ++corner) {
            const char* const q = p + 12 + 12 * corner;
            const glm::dvec3 position(little_endian_float(q), little_endian_float(q + 4),
                                      little_endian_float(q + 8));
            if (!is_usable(position)) {
                throw InputError(path + ": triangle " + std::to_string(t) +
                                 ": a coordinate is not finite or beyond 1e30" + kRepair);
            }
            add_corner(soup, position);
        }
    }
    soup.object_names = {std::filesystem::path(path).stem().string()};
    return soup;
}

class AsciiParser {
  public:
    AsciiParser(const std::string& path, std::string_view text) : path_(path), lines_(text) {}

    PolygonSoup parse() {
        std::string_view line;
        while (lines_.next(line)) {
            if ((lines_.line_number() & 0xFFFF) == 0) throw_if_interrupted();
            LineScanner scan(line);
            std::string keyword(scan.word());  // some programs write them in upper case
            std::transform(keyword.begin(), keyword.end(), keyword.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
            if (keyword == "vertex") {
                add_vertex(scan);
            } else if (keyword == "endloop") {
                end_loop();
            } else if (keyword == "facet" || keyword == "endfacet" || keyword == "outer") {
                check_loop_is_closed();
            } else if (keyword == "solid") {
                check_loop_is_closed();
                begin_solid(std::string(scan.rest()));
            } else if (keyword == "endsolid") {
                check_loop_is_closed();
                in_solid_ = false;
            } else if (!keyword.empty() && keyword != "color") {
                fail("unknown word '" + printable(keyword) + "'" + kRepair);
            }
        }
        if (in_solid_) {
            fail("the file ends in the middle of a solid; was it written completely?");
        }
        return std::move(soup_);
    }

  private:
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
    }

    void add_vertex(LineScanner& scan) {
        if (!in_solid_) fail("a vertex stands outside of any solid" + std::string(kRepair));
        glm::dvec3 p;
        if (!scan.number(p.x) || !scan.number(p.y) || !scan.number(p.z)) {
            fail("a vertex needs three numbers" + std::string(kRepair));
        }
        if (!is_usable(p)) fail("a coordinate is not finite or beyond 1e30" + std::string(kRepair));
        if (soup_.corners.size() == PolygonSoup::kMaxCorners) {
            fail("more than 4 billion polygon corners; split the model");
        }
        add_corner(soup_, p);
        in_loop_ = true;
    }

    void end_loop() {
        soup_.polygon_ends.push_back(static_cast<std::uint32_t>(soup_.corners.size()));
        soup_.polygon_object.push_back(static_cast<std::uint32_t>(soup_.object_names.size() - 1));
        in_loop_ = false;
    }

    std::string path_;
    LineReader lines_;
    PolygonSoup soup_;
    bool in_solid_ = false;
    bool in_loop_ = false;
};

}  // namespace

PolygonSoup read_stl(const std::string& path) {
    const MappedFile file(path);
    const std::string_view bytes = file.bytes();
    const bool has_binary_header = bytes.size() >= kBinaryHeader + 4;
    const std::uint64_t binary_size =
        has_binary_header ? kBinaryHeader + 4 + std::uint64_t{kBinaryTriangle} *
                                                    little_endian_u32(bytes.data() + kBinaryHeader)
                          : 0;
    // Binary files may start with "solid" as well; their size gives them away.
    const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
    const std::string_view word = bytes.substr(first, 5);
    const bool starts_as_text = word == "solid" || word == "SOLID";
    const bool has_zero_bytes = std::memchr(bytes.data(), 0, std::min<std::size_t>(bytes.size(), 512)) != nullptr;
    const bool is_text = starts_as_text && binary_size != bytes.size() && !has_zero_bytes;

    PolygonSoup soup;
    if (is_text) {
        soup = AsciiParser(path, bytes).parse();
    } else if (has_binary_header) {
        soup = read_binary(path, bytes);
    } else {
        throw InputError(path + ": neither text that starts with 'solid' nor a binary STL of 84 " +
                         "bytes or more; was it written completely?");
    }
    if (soup.corners.empty()) throw InputError(path + ": the file has no triangles");
    soup.materials = {Material{}};
    return soup;
}

}  // namespace burin
