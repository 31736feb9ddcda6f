#include <cmath>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>

#include "base/interrupt.h"
#include "base/mapped_file.h"
#include "mesh/read_mtl.h"
#include "mesh/readers.h"
#include "mesh/text_scan.h"

namespace burin {
namespace {

/// Names in the order of their first use.
class NameTable {
  public:
    std::uint32_t index_of(std::string_view name) {
        const auto [it, is_new] =
            index_.try_emplace(std::string(name), static_cast<std::uint32_t>(names.size()));
        if (is_new) names.push_back(it->first);
        return it->second;
    }
    std::vector<std::string> names;

  private:
    std::map<std::string, std::uint32_t, std::less<>> index_;
};

class ObjParser {
  public:
    explicit ObjParser(const std::string& path)
        : path_(path), file_(path), lines_(without_byte_order_mark(file_.bytes())) {}

    PolygonSoup parse() {
        const std::string_view text = file_.bytes();
        if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
            throw InputError(path_ + ": the text is UTF-16; save it as UTF-8 or ASCII");
        }
        std::string_view line;
        while (lines_.next(line)) {
            if ((lines_.line_number() & 0xFFFF) == 0) throw_if_interrupted();
            const bool goes_on = ends_in_backslash(line) && !is_comment(line);
            parse_line(goes_on ? joined_lines(line) : line);
        }
        check_forward_references();
        return finished();
    }

  private:
    [[noreturn]] void fail(const std::string& message) const { fail_at(lines_.line_number(), message); }
    [[noreturn]] void fail_at(std::size_t line, const std::string& message) const {
        throw InputError({path_, line}, message);
    }

    /// Comments go on nowhere: "# saved in C:\models\" must not swallow the next line.
    static bool is_comment(std::string_view line) {
        LineScanner scan(line);
        return !scan.at_end() && scan.rest().front() == '#';
    }
    static bool ends_in_backslash(std::string_view line) {
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        return !line.empty() && line.back() == '\\';
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
        if (keyword == "v") {
            parse_vertex(scan);
        } else if (keyword == "f" || keyword == "fo") {
            parse_face(scan);
        } else if (keyword == "l") {
            parse_marked_line(scan);
        } else if (keyword == "o") {
            current_object_ = objects_.index_of(scan.rest());
        } else if (keyword == "g") {
            current_group_ = groups_.index_of(scan.rest());
        } else if (keyword == "usemtl") {
            current_material_ = materials_.index_of(scan.rest());
        } else if (keyword == "mtllib") {
            material_files_.emplace_back(scan.rest());
        }
    }

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
        if (number < 0 && number >= -vertices) return static_cast<std::uint32_t>(vertices + number);
        if (number <= 0 || number > std::int64_t{0xFFFFFFFF}) {
            fail("vertex " + std::to_string(number) + " does not exist (there are " +
                 std::to_string(vertices) + " so far); repair or re-export the file");
        }
        if (number > vertices && number > largest_reference_) {
            // Vertices behind their first use are not standard, but exist: checked at the end.
            largest_reference_ = number;
            largest_reference_line_ = lines_.line_number();
        }
        return static_cast<std::uint32_t>(number - 1);
    }

    void parse_face(LineScanner& scan) {
        corners_.clear();
        for (std::string_view corner = scan.word(); !corner.empty(); corner = scan.word()) {
            if (corner.front() == '#') break;
            corners_.push_back(parse_corner(corner));
        }
        if (corners_.size() < 3 && lines_.rest().empty() && !file_.bytes().ends_with('\n')) {
            fail("the file ends in the middle of a face; was it written completely?");
        }
        if (soup_.corners.size() + corners_.size() > PolygonSoup::kMaxCorners) {
            fail("more than 4 billion polygon corners; split the model");
        }
        soup_.add_polygon(corners_);
        polygon_object_.push_back(current_object_);
        polygon_group_.push_back(current_group_);
        soup_.polygon_material.push_back(current_material_);
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

    void check_forward_references() const {
        if (largest_reference_ > static_cast<std::int64_t>(soup_.positions.size())) {
            fail_at(largest_reference_line_,
                    "vertex " + std::to_string(largest_reference_) +
                        " does not exist (the file has " + std::to_string(soup_.positions.size()) +
                        "); repair or re-export the file");
        }
        if (soup_.positions.empty()) {
            throw InputError(path_ + ": no vertices found; is this an OBJ file?");
        }
        if (soup_.polygon_ends.empty()) {
            throw InputError(path_ + ": no polygons found; burin draws the lines of surfaces");
        }
    }

    PolygonSoup finished() {
        // Index 0 of each table is what stands before the first name.
        const bool has_objects = objects_.names.size() > 1;
        soup_.polygon_object = has_objects ? polygon_object_ : polygon_group_;
        soup_.object_names = has_objects ? objects_.names : groups_.names;
        soup_.object_names[0] = std::filesystem::path(path_).stem().string();
        const auto library = read_material_files(path_, material_files_);
        for (const std::string& name : materials_.names) {
            const auto found = library.find(name);
            Material material;
            if (found != library.end()) material = found->second;
            material.name = name;
            soup_.materials.push_back(material);
        }
        return std::move(soup_);
    }

    std::string path_;
    MappedFile file_;
    LineReader lines_;
    PolygonSoup soup_;
    std::string joined_;
    std::vector<std::uint32_t> corners_;
    NameTable objects_, groups_, materials_;
    std::vector<std::uint32_t> polygon_object_, polygon_group_;
    std::uint32_t current_object_ = objects_.index_of("");
    std::uint32_t current_group_ = groups_.index_of("");
    std::uint32_t current_material_ = materials_.index_of("");
    std::vector<std::string> material_files_;
    std::int64_t largest_reference_ = 0;
    std::size_t largest_reference_line_ = 0;
};

}  // namespace

PolygonSoup read_obj(const std::string& path) { return ObjParser(path).parse(); }

}  // namespace burin
