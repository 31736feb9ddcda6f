#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "base/interrupt.h"
#include "base/mapped_file.h"
#include "mesh/readers.h"
#include "mesh/surplus.h"
#include "mesh/text_scan.h"

namespace burin {
namespace {

/// How vertices, or polygons, stand in the text.
enum class OffLayout : std::uint8_t {
    lines,   ///< each begins a line; what follows its values on that line is nothing (colours, mostly)
    values,  ///< value after value, on any lines; polygons have no colours then
};

/// The text ends before all is read.
class FileEnds : public InputError {
  public:
    using InputError::InputError;
};

/// Reads an OFF file in one layout. Nearly all programs write one vertex and one polygon per line.
class OffParser {
  public:
    OffParser(const std::string& path, std::string_view text, OffLayout vertices, OffLayout polygons)
        : path_(path), lines_(text), bytes_(text.size()), vertex_layout_(vertices), polygon_layout_(polygons) {}

    PolygonSoup parse() {
        read_counts();
        read_vertices();
        if (vertex_layout_ == OffLayout::values && polygon_layout_ == OffLayout::lines && !item_.at_end()) {
            fail("something stands behind the last vertex on its line; repair or re-export the file");
        }
        read_polygons();
        soup_.object_names = {std::filesystem::path(path_).stem().string()};
        soup_.materials = {Material{}};
        return std::move(soup_);
    }
    /// Throws for what is wrong with the word OFF and the counts, which is the same in all layouts.
    void read_counts() {
        LineScanner counts = behind_keyword(next_line("the word OFF"));
        vertices_ = count(counts, "vertices");
        if (counts.at_end()) counts = line_of_polygon_count();
        polygons_ = count(counts, "polygons");
        // The number of edges says nothing, and is left out here and there.
        if (counts.at_end()) {
            skip_edge_count();
        } else if (vertex_layout_ == OffLayout::values) {
            std::int64_t edges = 0;
            if (!counts.integer(edges)) fail("the number of edges must be an integer; repair the file");
            item_ = counts;
        }
    }
    /// Whether vertices share lines and all polygons have an area: then this layout is no misunderstanding, though
    /// something be left over.
    bool is_certain() const { return do_vertices_share_lines_ && least_corners_ >= 3; }
    /// What is left behind the last polygon.
    SurplusLines surplus() {
        if (polygon_layout_ == OffLayout::lines || item_.at_end())
            return surplus_lines(lines_.rest(), lines_.line_number());
        const char* const begin = item_.rest().data();
        const std::string_view behind = lines_.rest();
        return surplus_lines({begin, static_cast<std::size_t>(behind.data() + behind.size() - begin)},
                             lines_.line_number() - 1);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError({path_, std::max<std::size_t>(1, lines_.line_number())}, message);
    }

    /// Goes to the next line that has more than a comment.
    LineScanner next_line(const char* expected) {
        std::string_view line;
        while (lines_.next(line)) {
            if ((lines_.line_number() & 0xFFFF) == 0) throw_if_interrupted();
            line = line.substr(0, line.find('#'));
            if (LineScanner scan(line); !scan.at_end()) {
                current_ = line;
                return LineScanner(line);
            }
        }
        throw FileEnds({path_, std::max<std::size_t>(1, lines_.line_number())},
                       std::string("the file ends where ") + expected + " should be; was it written completely?");
    }

    /// Goes to where the next item begins.
    void begin_item(OffLayout layout, const char* what) {
        if (layout == OffLayout::lines || item_.at_end()) item_ = next_line(what);
    }
    /// Goes to the next value of an item, which an item that begins a line has on that line.
    void go_to_value(OffLayout layout, const char* what) {
        if (layout == OffLayout::values && item_.at_end()) item_ = next_line(what);
    }

    /// What stands behind the word OFF, or on the next line. The counts may follow it without a
    /// blank, as in the ModelNet data sets, and the word may be missing.
    LineScanner behind_keyword(LineScanner first_line) {
        if (are_counts(first_line)) return first_line;
        const std::string_view word = first_line.word();
        const std::size_t off = lower_case(word).find("off");
        std::string_view keyword = word.substr(0, off == std::string_view::npos ? off : off + 3);
        if (keyword.size() < word.size() &&
            std::string_view("+-.0123456789").find(word[keyword.size()]) == std::string_view::npos)
            keyword = word;
        check_keyword(keyword);
        LineScanner rest({word.data() + keyword.size(),
                          static_cast<std::size_t>(current_.data() + current_.size() - word.data()) - keyword.size()});
        if (has_dimensions_) {
            if (rest.at_end()) rest = next_line("the number of dimensions");
            std::int64_t dimensions = 0;
            if (!rest.integer(dimensions) || dimensions != 3) fail_by_dimensions();
        }
        if (rest.at_end()) return next_line("the counts");
        if (LineScanner ahead = rest; lower_case(ahead.word()) == "binary")
            fail("binary OFF is not read; save it as text");
        return rest;
    }

    /// Whether a line has two integers or three and nothing else.
    static bool are_counts(LineScanner line) {
        std::int64_t count = 0;
        return line.integer(count) && line.integer(count) && (line.at_end() || (line.integer(count) && line.at_end()));
    }

    void check_keyword(std::string_view keyword) {
        const std::string small = lower_case(keyword);
        std::string_view prefix = small;
        if (!prefix.ends_with("off") || prefix.find_first_not_of("stcn4of") != std::string_view::npos) {
            fail("this is no OFF file (it does not start with 'OFF')");
        }
        prefix.remove_suffix(3);
        // In capitals, N is for normals; a small n before OFF in capitals is for the number of
        // dimensions.
        const bool in_small_letters = small == keyword;
        if (in_small_letters && prefix.find('n') != std::string_view::npos) {
            fail("'" + printable(keyword) + "' may mean normals (NOFF) or dimensions (nOFF); write it so");
        }
        if (prefix.find('4') != std::string_view::npos) fail_by_dimensions();
        has_dimensions_ = keyword.find('n') != std::string_view::npos;
        const auto has = [&](std::string_view letters) { return prefix.find(letters) != std::string_view::npos; };
        attributes_ = (keyword.find('N') != std::string_view::npos ? 3 : 0) + (has("c") ? 4 : 0) + (has("st") ? 2 : 0);
    }

    [[noreturn]] void fail_by_dimensions() { fail("OFF files with more or fewer than three dimensions are not read"); }

    /// The next line, with one count or two behind that of the vertices. A vertex has three
    /// numbers.
    LineScanner line_of_polygon_count() {
        const std::size_t line_number = lines_.line_number();
        const LineScanner next = next_line("the number of polygons");
        LineScanner ahead = next;
        for (int words = 0; words < 2; ++words) ahead.word();
        if (ahead.at_end()) return next;
        throw InputError({path_, line_number},
                         "the number of polygons is missing behind that of the vertices; repair the file");
    }
    void skip_edge_count() {
        const LineReader before = lines_;
        LineScanner line = next_line("a vertex");
        std::int64_t edges = 0;
        if (!line.integer(edges) || !line.at_end()) lines_ = before;
    }

    std::uint64_t count(LineScanner& scan, const char* what) {
        std::int64_t value = 0;
        if (!scan.integer(value) || value <= 0) {
            fail(std::string("the number of ") + what + " must be a positive integer; repair the file");
        }
        // A line needs two characters at least.
        if (static_cast<std::uint64_t>(value) > bytes_ / 2) {
            fail(std::to_string(value) + " " + what + " do not fit a file of " + std::to_string(bytes_) +
                 " bytes; was it written completely?");
        }
        return static_cast<std::uint64_t>(value);
    }

    void read_vertices() {
        soup_.positions.reserve(vertices_);
        for (std::uint64_t i = 0; i < vertices_; ++i) {
            if ((i & 0xFFFF) == 0) throw_if_interrupted();
            do_vertices_share_lines_ = do_vertices_share_lines_ || (i > 0 && !item_.at_end());
            begin_item(vertex_layout_, "a vertex");
            glm::dvec3 p;
            for (int axis = 0; axis < 3; ++axis) {
                go_to_value(vertex_layout_, "a vertex");
                if (!item_.number(p[axis])) fail("a vertex needs three numbers; repair or re-export the file");
            }
            if (!(std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate &&
                  std::abs(p.z) <= kLargestCoordinate)) {
                fail("a coordinate is not finite or beyond 1e30; repair or re-export the file");
            }
            soup_.positions.push_back(p);
            if (vertex_layout_ == OffLayout::values) skip_attributes();
        }
    }
    /// Normal, colour and texture coordinates of a vertex, as the letters in front of OFF announce them.
    void skip_attributes() {
        for (int k = 0; k < attributes_; ++k) {
            go_to_value(OffLayout::values, "a vertex");
            double value = 0;
            if (!item_.number(value)) fail("a vertex needs more numbers; repair or re-export the file");
        }
    }

    void read_polygons() {
        std::vector<std::uint32_t> corners;
        // No program writes polygons without corners; in the other layout they would make sense of nearly any zeros.
        const std::int64_t least_size = polygon_layout_ == OffLayout::lines ? 0 : 1;
        for (std::uint64_t i = 0; i < polygons_; ++i) {
            if ((i & 0xFFFF) == 0) throw_if_interrupted();
            begin_item(polygon_layout_, "a polygon");
            std::int64_t size = 0;
            if (!item_.integer(size) || size < least_size) {
                fail("a polygon starts with its number of corners; repair or re-export the file");
            }
            corners.clear();
            for (std::int64_t k = 0; k < size; ++k) {
                go_to_value(polygon_layout_, "a corner of a polygon");
                std::int64_t index = 0;
                if (!item_.integer(index)) {
                    fail("a polygon of " + std::to_string(size) + " corners has only " + std::to_string(k) +
                         " vertex numbers" + (polygon_layout_ == OffLayout::lines ? " on its line" : "") +
                         "; repair the file");
                }
                if (index < 0 || static_cast<std::uint64_t>(index) >= soup_.positions.size()) {
                    fail("vertex " + std::to_string(index) + " does not exist (the file has " +
                         std::to_string(soup_.positions.size()) + ", counted from 0); repair or re-export the file");
                }
                corners.push_back(static_cast<std::uint32_t>(index));
            }
            if (soup_.corners.size() + corners.size() > PolygonSoup::kMaxCorners) {
                fail("more than 4 billion polygon corners; split the model");
            }
            least_corners_ = std::min(least_corners_, size);
            soup_.add_polygon(corners);
        }
    }

    std::string path_;
    LineReader lines_;
    std::size_t bytes_;
    OffLayout vertex_layout_, polygon_layout_;
    std::string_view current_;
    LineScanner item_{std::string_view()};  // what is left of the line that is being read
    std::uint64_t vertices_ = 0, polygons_ = 0;
    int attributes_ = 0;           // numbers of a vertex behind its coordinates
    bool has_dimensions_ = false;  // their number stands before the counts
    bool do_vertices_share_lines_ = false;
    std::int64_t least_corners_ = 3;  // of a polygon
    PolygonSoup soup_;
};

/// Reads item by item, each on a line of its own, as nearly all programs write them. Where that fails, or leaves lines
/// over, several vertices or polygons may share a line: the layout that makes sense of the whole file counts.
PolygonSoup read_text(const std::string& path, std::string_view text, bool strict) {
    using enum OffLayout;
    OffParser by_line(path, text, lines, lines);
    PolygonSoup soup;
    std::optional<InputError> error;
    bool ends_early = false;
    try {
        soup = by_line.parse();
        if (by_line.surplus().count == 0) return soup;
    } catch (const InputError& e) {
        OffParser(path, text, lines, lines).read_counts();
        error = e;
        ends_early = dynamic_cast<const FileEnds*>(&e) != nullptr;
    }
    std::string by_value_error;
    constexpr std::pair<OffLayout, OffLayout> kOthers[] = {{values, lines}, {lines, values}, {values, values}};
    for (const auto& [vertices, polygons] : kOthers) {
        OffParser by_value(path, text, vertices, polygons);
        PolygonSoup other;
        try {
            other = by_value.parse();
        } catch (const FileEnds&) {
            continue;
        } catch (const InputError& e) {
            by_value_error = e.what();
            continue;
        }
        const SurplusLines surplus = by_value.surplus();
        if (surplus.count > 0 && !(error && by_value.is_certain())) continue;
        note_surplus(other, path, surplus, "the last polygon", strict);
        return other;
    }
    if (ends_early && !by_value_error.empty()) {
        throw InputError(std::string(error->what()) + " (if items share lines: " + by_value_error + ")");
    }
    if (error) throw InputError(*error);
    note_surplus(soup, path, by_line.surplus(), "the last polygon", strict);
    return soup;
}

}  // namespace

PolygonSoup read_off(const std::string& path, bool strict) {
    const MappedFile file(path);
    return read_text(path, without_byte_order_mark(file.bytes()), strict);
}

}  // namespace burin
