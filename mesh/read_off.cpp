#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/interrupt.h"
#include "base/mapped_file.h"
#include "mesh/readers.h"
#include "mesh/text_scan.h"

namespace burin {
namespace {

/// OFF as nearly all programs write it: one vertex and one polygon per line.
class OffParser {
  public:
    OffParser(const std::string& path, std::string_view text) : path_(path), lines_(text), bytes_(text.size()) {}

    PolygonSoup parse() {
        LineScanner counts = behind_keyword(next_line("the word OFF"));
        const std::uint64_t vertices = count(counts, "vertices");
        if (counts.at_end()) counts = line_of_polygon_count();
        const std::uint64_t polygons = count(counts, "polygons");
        // The number of edges says nothing, and is left out here and there.
        if (counts.at_end()) skip_edge_count();
        read_vertices(vertices);
        read_polygons(polygons);
        soup_.object_names = {std::filesystem::path(path_).stem().string()};
        soup_.materials = {Material{}};
        return std::move(soup_);
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
        fail(std::string("the file ends where ") + expected + " should be; was it written completely?");
    }

    /// What stands behind the word OFF, or on the next line. The counts may follow it without a
    /// blank, as in the ModelNet data sets.
    LineScanner behind_keyword(LineScanner first_line) {
        const std::string_view word = first_line.word();
        const std::size_t off = lower_case(word).find("off");
        std::string_view keyword = word.substr(0, off == std::string_view::npos ? off : off + 3);
        if (keyword.size() < word.size() &&
            std::string_view("+-.0123456789").find(word[keyword.size()]) == std::string_view::npos)
            keyword = word;
        check_keyword(keyword);
        LineScanner rest({word.data() + keyword.size(),
                          static_cast<std::size_t>(current_.data() + current_.size() - word.data()) - keyword.size()});
        if (rest.at_end()) return next_line("the counts");
        if (LineScanner ahead = rest; lower_case(ahead.word()) == "binary")
            fail("binary OFF is not read; save it as text");
        return rest;
    }

    void check_keyword(std::string_view keyword) const {
        const std::string small = lower_case(keyword);
        std::string_view prefix = small;
        if (!prefix.ends_with("off") || prefix.find_first_not_of("stcn4of") != std::string_view::npos) {
            fail("this is no OFF file (it does not start with 'OFF')");
        }
        prefix.remove_suffix(3);
        // In capitals, N is for normals; a small n before OFF in capitals is for the number of
        // dimensions.
        const bool in_small_letters = small == keyword;
        if (in_small_letters && prefix.ends_with('n')) {
            fail("'" + printable(keyword) + "' may mean normals (NOFF) or dimensions (nOFF); write it so");
        }
        if (prefix.find('4') != std::string_view::npos || keyword.find('n') != std::string_view::npos) {
            fail("OFF files with more or fewer than three dimensions are not read");
        }
    }

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

    void read_vertices(std::uint64_t vertices) {
        soup_.positions.reserve(vertices);
        for (std::uint64_t i = 0; i < vertices; ++i) {
            LineScanner scan = next_line("a vertex");
            glm::dvec3 p;
            if (!scan.number(p.x) || !scan.number(p.y) || !scan.number(p.z)) {
                fail("a vertex needs three numbers; repair or re-export the file");
            }
            if (!(std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate &&
                  std::abs(p.z) <= kLargestCoordinate)) {
                fail("a coordinate is not finite or beyond 1e30; repair or re-export the file");
            }
            soup_.positions.push_back(p);
        }
    }

    void read_polygons(std::uint64_t polygons) {
        std::vector<std::uint32_t> corners;
        for (std::uint64_t i = 0; i < polygons; ++i) {
            LineScanner scan = next_line("a polygon");
            std::int64_t size = 0;
            if (!scan.integer(size) || size < 0) {
                fail("a polygon starts with its number of corners; repair or re-export the file");
            }
            corners.clear();
            for (std::int64_t k = 0; k < size; ++k) {
                std::int64_t index = 0;
                if (!scan.integer(index)) {
                    fail("a polygon of " + std::to_string(size) + " corners has only " + std::to_string(k) +
                         " vertex numbers on its line; repair the file");
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
            soup_.add_polygon(corners);
        }
    }

    std::string path_;
    LineReader lines_;
    std::size_t bytes_;
    std::string_view current_;
    PolygonSoup soup_;
};

}  // namespace

PolygonSoup read_off(const std::string& path) {
    const MappedFile file(path);
    return OffParser(path, without_byte_order_mark(file.bytes())).parse();
}

}  // namespace burin
