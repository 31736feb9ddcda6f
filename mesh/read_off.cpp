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
    OffParser(const std::string& path, std::string_view text)
        : path_(path), lines_(text), bytes_(text.size()) {}

    PolygonSoup parse() {
        LineScanner header = next_line("the word OFF");
        const std::string_view word = header.word();
        if (!word.ends_with("OFF") || word.find_first_not_of("STCNOF") != std::string_view::npos) {
            fail(word.ends_with("OFF") ? "OFF files with more or fewer than three dimensions are not read"
                                       : "this is no OFF file (it does not start with 'OFF')");
        }
        if (header.word() == "BINARY") fail("binary OFF is not read; save it as text");
        LineScanner counts = header_rest(word);
        const std::uint64_t vertices = count(counts, "vertices");
        const std::uint64_t polygons = count(counts, "polygons");
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

    /// The next line that has more than a comment.
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

    /// The counts, which stand on the line of the word OFF or on the next one.
    LineScanner header_rest(std::string_view word) {
        const char* const behind = word.data() + word.size();
        LineScanner same_line(
            {behind, static_cast<std::size_t>(current_.data() + current_.size() - behind)});
        return same_line.at_end() ? next_line("the counts") : same_line;
    }

    std::uint64_t count(LineScanner& scan, const char* what) {
        std::int64_t value = 0;
        if (!scan.integer(value) || value <= 0) {
            fail(std::string("the number of ") + what + " must be a positive integer; repair the file");
        }
        // A line needs two characters at least.
        if (static_cast<std::uint64_t>(value) > bytes_ / 2) {
            fail(std::to_string(value) + " " + what + " do not fit a file of " +
                 std::to_string(bytes_) + " bytes; was it written completely?");
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
                    fail("a polygon of " + std::to_string(size) + " corners has only " +
                         std::to_string(k) + " vertex numbers on its line; repair the file");
                }
                if (index < 0 || static_cast<std::uint64_t>(index) >= soup_.positions.size()) {
                    fail("vertex " + std::to_string(index) + " does not exist (the file has " +
                         std::to_string(soup_.positions.size()) +
                         ", counted from 0); repair or re-export the file");
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
    return OffParser(path, file.bytes()).parse();
}

}  // namespace burin
