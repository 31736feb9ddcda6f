#include "mesh/obj_part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/interrupt.h"
#include "mesh/row_scan.h"
#include "mesh/text_scan.h"

namespace burin {
namespace {

/// Comments go on nowhere: "# saved in C:\models\" must not swallow the next line.
bool is_comment(std::string_view line) {
    LineScanner scan(line);
    return !scan.at_end() && scan.rest().front() == '#';
}
bool ends_in_backslash(std::string_view line) {
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return !line.empty() && line.back() == '\\';
}

/// Keywords of OBJ for what is not drawn, or belongs to a curve or surface that is counted itself.
bool is_known_to_say_nothing(std::string_view keyword) {
    static constexpr std::string_view kKeywords[] = {
        "vn",    "vt",       "s",          "vp",  "bevel", "bmat", "c_interp",  "con",  "cstype",
        "ctech", "d_interp", "deg",        "end", "hole",  "lod",  "maplib",    "mg",   "parm",
        "res",   "scrv",     "shadow_obj", "sp",  "stech", "step", "trace_obj", "trim", "usemap"};
    return std::find(std::begin(kKeywords), std::end(kKeywords), keyword) != std::end(kKeywords);
}

class ObjParser {
  public:
    ObjParser(const std::string& path, std::string_view text, bool is_whole, const AttributeWish& attributes)
        : path_(path),
          text_(text),
          is_whole_(is_whole),
          has_uv_(attributes.uv),
          has_colors_(attributes.color),
          keeps_all_(attributes.all_named),
          lines_(text) {}

    ObjPart parse() {
        std::string_view line;
        while (true) {
            if ((lines_.line_number() & 0xFFFF) == 0) throw_if_interrupted();
            if (pass_plain_line()) continue;
            if (!lines_.next(line)) break;
            first_line_ = lines_.line_number();
            const bool goes_on = ends_in_backslash(line) && !is_comment(line);
            parse_line(goes_on ? joined_lines(line) : line);
        }
        part_.line_count = lines_.line_number();
        add_attributes();
        return std::move(part_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError({path_, lines_.line_number()}, message);
    }

    /// Takes the next line if it is nothing but "v" or "f" and three plain numbers. (parse_line() takes
    /// any line.)
    bool pass_plain_line() {
        const std::string_view rest = lines_.rest();
        const char* const p = rest.data();
        if (p - text_.data() < kRowReachBack || rest.size() < 2 + kRowReach || p[1] != ' ') return false;
        const auto pass = [&](const char* q) {
            const char* const end = p + rest.size();
            while (q < end && (*q == ' ' || *q == '\t')) ++q;
            if (q < end && *q == '\r') ++q;  // alone it ends a line, too: not here
            if (q == end || *q != '\n') return false;
            lines_.pass(q);
            return true;
        };
        if (p[0] == 'v') {
            glm::dvec3 position;
            const char* const next = scan_three_decimals(p + 2, &position.x);
            if (next == nullptr || !pass(next)) return false;
            soup_.positions.push_back(position);
            return true;
        }
        if (p[0] != 'f') return false;
        std::array<std::uint32_t, 4> four;
        const char* const next = scan_three_integers(p + 2, four.data());
        const std::span<std::uint32_t, 3> numbers(four.data(), 3);
        if (next == nullptr || numbers[0] == 0 || numbers[1] == 0 || numbers[2] == 0) return false;
        if (soup_.corners.size() + 3 > PolygonSoup::kMaxCorners || !pass(next)) return false;
        for (std::uint32_t& n : numbers) {
            note_reference(n);
            --n;
        }
        soup_.add_polygon(numbers);
        if (has_uv_) uv_.rows.resize(soup_.corners.size(), AttributeLayer::kNoRow);
        return true;
    }

    /// The logical line that starts with `line` and goes on behind its backslash.
    std::string_view joined_lines(std::string_view line) {
        joined_.clear();
        bool more = true;
        while (more) {
            more = ends_in_backslash(line);
            if (more) line = line.substr(0, line.rfind('\\'));
            joined_.append(line);
            joined_ += ' ';
            if (more && !lines_.next(line)) more = false;
        }
        return joined_;
    }

    void parse_line(std::string_view line) {
        LineScanner scan(line);
        const std::string_view keyword = scan.word();
        if (parse_statement(keyword, scan)) return;
        // Some programs write all in capitals. No keyword means another thing in the other case.
        if (std::any_of(keyword.begin(), keyword.end(), [](char c) { return c >= 'A' && c <= 'Z'; })) {
            if (parse_statement(lower_case(keyword), scan)) return;
        }
        if (keyword.empty() || keyword.front() == '#' || is_known_to_say_nothing(lower_case(keyword))) return;
        if (part_.unknown.count++ == 0) part_.unknown = {1, first_line_, printable(keyword)};
    }

    /// False for a keyword that is not known, or says nothing about the surface.
    bool parse_statement(std::string_view keyword, LineScanner& scan) {
        if (keyword == "v") {
            parse_vertex(scan);
        } else if (keyword == "vt" && has_uv_) {
            parse_texture_coordinates(scan);
        } else if (keyword == "f" || keyword == "fo") {
            parse_face(scan);
        } else if (keyword == "l") {
            parse_marked_line(scan);
        } else if (keyword == "o") {
            part_.objects.use(scan.rest(), next_place());
        } else if (keyword == "g") {
            part_.groups.use(scan.rest(), next_place());
        } else if (keyword == "usemtl") {
            part_.materials.use(scan.rest(), next_place());
        } else if (keyword == "mtllib") {
            part_.material_files.emplace_back(scan.rest());
        } else if (keyword == "p") {
            ++part_.points;
        } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf" || keyword == "bsp" ||
                   keyword == "bzp" || keyword == "cdc" || keyword == "cdp") {
            ++part_.free_forms;
        } else {
            return false;
        }
        return true;
    }

    NameUses::Place next_place() const { return {soup_.polygon_ends.size(), soup_.marked_edges.size()}; }

    void parse_vertex(LineScanner& scan) {
        glm::dvec3 p;
        for (int axis = 0; axis < 3; ++axis) {
            if (!scan.number(p[axis])) {
                fail("a vertex needs three numbers, found '" + printable(scan.rest()) +
                     "'; repair or re-export the file");
            }
            if (!(std::abs(p[axis]) <= kLargestCoordinate)) {
                fail("a coordinate is not finite or beyond 1e30; repair or re-export the file");
            }
        }
        soup_.positions.push_back(p);
        if (has_colors_) parse_color(scan);
    }

    /// Reads up to as many numbers as there is room for, and returns how many. What is no number is an error for who
    /// asked for these values alone.
    std::size_t parse_values(LineScanner& scan, std::span<float> values, const char* of) {
        std::size_t count = 0;
        for (double number = 0; count < values.size() && scan.number(number); ++count)
            values[count] = static_cast<float>(number);
        if (count == values.size() || keeps_all_) return count;
        const std::string_view rest = scan.rest();
        if (!rest.empty() && rest.front() != '#')
            fail(std::string(of) + " needs numbers, found '" + printable(rest) + "'; repair or re-export the file");
        return count;
    }
    /// A colour of three numbers behind a vertex. One number there is a weight.
    void parse_color(LineScanner& scan) {
        std::array<float, 3> color{};
        if (parse_values(scan, color, "the colour of a vertex") < 3) return;
        color_rows_.resize(soup_.positions.size() - 1, AttributeLayer::kNoRow);
        color_rows_.push_back(static_cast<std::uint32_t>(colors_.row_count()));
        colors_.add_row(color);
    }
    /// One number or two; the second one is 0 unless it is there.
    void parse_texture_coordinates(LineScanner& scan) {
        std::array<float, 2> uv{};
        if (parse_values(scan, uv, "a texture coordinate") == 0 && !keeps_all_)
            fail("a texture coordinate has no numbers; repair or re-export the file");
        uv_.add_row(uv);
    }
    /// Of a corner "7/1", "7/1/2", "7/-1".
    std::uint32_t texture_coordinates_of(std::string_view corner) {
        const std::size_t slash = corner.find('/');
        if (slash == corner.npos || slash + 1 == corner.size() || corner[slash + 1] == '/')
            return AttributeLayer::kNoRow;
        std::int64_t number = 0;
        const char* const p = scan_integer(corner.data() + slash + 1, corner.data() + corner.size(), number);
        if (number < 0) number += static_cast<std::int64_t>(uv_.row_count()) + 1;
        if (p != nullptr && number > 0 && number < std::int64_t{AttributeLayer::kNoRow})
            return static_cast<std::uint32_t>(number - 1);
        ++part_.missing_texture_coordinates;
        return AttributeLayer::kNoRow;
    }
    /// Gives the soup what was found.
    void add_attributes() {
        const auto missing = [](std::uint32_t row, const AttributeLayer& layer) {
            return row != AttributeLayer::kNoRow && row >= layer.row_count();
        };
        for (std::uint32_t& row : uv_.rows) {
            if (!missing(row, uv_)) continue;
            row = AttributeLayer::kNoRow;
            ++part_.missing_texture_coordinates;
        }
        if (!uv_.values.empty()) soup_.attributes.push_back(std::move(uv_));
        if (colors_.values.empty()) return;
        color_rows_.resize(soup_.positions.size(), AttributeLayer::kNoRow);
        colors_.rows.reserve(soup_.corners.size());
        for (const std::uint32_t v : soup_.corners)
            colors_.rows.push_back(v < color_rows_.size() ? color_rows_[v] : AttributeLayer::kNoRow);
        soup_.attributes.push_back(std::move(colors_));
    }

    /// The vertex number at the start of a corner "7", "7/1", "7//2", "7/1/2", "-1/…".
    std::uint32_t parse_corner(std::string_view corner) {
        const char* const end = corner.data() + corner.size();
        std::int64_t number = 0;
        const char* p = scan_integer(corner.data(), end, number);
        if (p == nullptr || (p < end && *p != '/')) {
            fail("'" + printable(corner) + "' is no vertex number; repair or re-export the file");
        }
        const auto vertices = static_cast<std::int64_t>(soup_.positions.size());
        if (number < 0 && (number >= -vertices || !is_whole_)) return counted_back(vertices + number);
        if (number <= 0 || number > std::int64_t{0xFFFFFFFF}) {
            fail("vertex " + std::to_string(number) + " does not exist (there are " + std::to_string(vertices) +
                 " so far); repair or re-export the file");
        }
        note_reference(number);
        return static_cast<std::uint32_t>(number - 1);
    }
    /// Vertices behind their first use are not standard, but exist: checked at the end.
    void note_reference(std::int64_t number) {
        if (number <= part_.largest_reference || number <= static_cast<std::int64_t>(soup_.positions.size())) return;
        part_.largest_reference = number;
        part_.largest_reference_line = lines_.line_number();
    }
    std::uint32_t counted_back(std::int64_t vertex) {
        if (is_whole_) return static_cast<std::uint32_t>(vertex);
        part_.least_counted_back = std::min(part_.least_counted_back, vertex);
        return ObjPart::kFirstOfPiece + static_cast<std::uint32_t>(vertex);
    }

    void parse_face(LineScanner& scan) {
        corners_.clear();
        for (std::string_view corner = scan.word(); !corner.empty(); corner = scan.word()) {
            if (corner.front() == '#') break;
            corners_.push_back(parse_corner(corner));
            if (has_uv_) uv_.rows.push_back(texture_coordinates_of(corner));
        }
        if (corners_.size() < 3 && lines_.rest().empty() && !is_line_end(text_.back())) {
            fail("the file ends in the middle of a face; was it written completely?");
        }
        if (soup_.corners.size() + corners_.size() > PolygonSoup::kMaxCorners) {
            fail("more than 4 billion polygon corners; split the model");
        }
        soup_.add_polygon(corners_);
    }

    void parse_marked_line(LineScanner& scan) {
        corners_.clear();
        for (std::string_view corner = scan.word(); !corner.empty(); corner = scan.word()) {
            if (corner.front() == '#') break;
            corners_.push_back(parse_corner(corner));
        }
        for (std::size_t i = 1; i < corners_.size(); ++i) {
            soup_.marked_edges.push_back({corners_[i - 1], corners_[i]});
        }
    }

    const std::string& path_;
    const std::string_view text_;
    const bool is_whole_;
    const bool has_uv_, has_colors_;  // whether they are asked for
    const bool keeps_all_;            // values of all kinds, whether they are read or not
    LineReader lines_;
    std::size_t first_line_ = 0;  // of the statement
    ObjPart part_;
    PolygonSoup& soup_ = part_.soup;
    std::string joined_;
    std::vector<std::uint32_t> corners_;
    AttributeLayer uv_{AttributeKind::uv, {}, {}, {}}, colors_{AttributeKind::color, {}, {}, {}};
    std::vector<std::uint32_t> color_rows_;  // per vertex
};

}  // namespace

ObjPart parse_obj_part(const std::string& path, std::string_view text, bool is_whole, const AttributeWish& attributes) {
    return ObjParser(path, text, is_whole, attributes).parse();
}

std::vector<std::string_view> cut_between_statements(std::string_view text, std::size_t size) {
    std::vector<std::string_view> pieces;
    while (text.size() > size) {
        std::size_t feed = text.find('\n', size - 1);
        while (feed != text.npos && ends_in_backslash(text.substr(0, feed))) feed = text.find('\n', feed + 1);
        if (feed == text.npos || feed + 1 == text.size()) break;
        pieces.push_back(text.substr(0, feed + 1));
        text.remove_prefix(feed + 1);
    }
    pieces.push_back(text);
    return pieces;
}

}  // namespace burin
