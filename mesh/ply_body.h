#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/huge_pages.h"
#include "base/interrupt.h"
#include "base/mapped_file.h"
#include "mesh/ply_attributes.h"
#include "mesh/ply_header.h"
#include "mesh/ply_pieces.h"
#include "mesh/ply_values.h"
#include "mesh/polygon_soup.h"
#include "mesh/text_scan.h"

// The body of a PLY file becomes polygons, element by element.

namespace burin {

/// How the items of a PLY are looked for in a text. (In a binary body there is but one way.)
enum class PlyItemLayout : std::uint8_t {
    plain_rows,  ///< a row of plain numbers each, where there are such rows; value by value where
                 ///< not
    values,      ///< value by value, whatever lines they stand on
    lines,       ///< each begins a line; what follows its last value on that line is nothing
};

/// Reads a body from AsciiValues or BinaryValues.
template <typename Values>
class PlyBodyReader {
  public:
    PlyBodyReader(const std::string& path, const MappedFile& file, const PlyHeader& header, Values values, int threads,
                  const AttributeWish& attributes, PlyItemLayout layout = PlyItemLayout::plain_rows)
        : path_(path),
          file_(file),
          header_(header),
          wish_(attributes),
          first_values_(values),
          values_(values),
          threads_(threads),
          layout_(layout) {}

    /// Whether anything stands behind what was read.
    bool has_rest() { return !values_.at_end(); }
    /// What stands there.
    const Values& values() const { return values_; }

    /// Lines with more values than the header declares, of the layout `lines`.
    struct LongLines {
        std::uint64_t count = 0;
        std::size_t first = 0;                ///< line number
        const PlyElement* element = nullptr;  ///< of the first one
    };
    const LongLines& long_lines() const { return long_lines_; }

    PolygonSoup read() {
        for (const PlyElement& element : header_.elements) {
            check_room(element);
            element_ = &element;
            if (element.name == "vertex") {
                read_vertices(element);
            } else if (element.name == "face") {
                read_faces(element);
            } else if (element.name == "tristrips") {
                read_strips(element);
            } else if (element.name == "edge" && element.find("vertex1") >= 0 && element.find("vertex2") >= 0) {
                read_edges(element);
            } else {
                for (item_ = 0; item_ < element.count; ++item_) {
                    skip_properties(element, 0);
                    end_item();
                }
            }
        }
        if (soup_.positions.empty()) {
            throw InputError(path_ + ": the file has no vertices; burin draws the lines of surfaces");
        }
        if (soup_.polygon_count() == 0 && soup_.marked_edges.empty()) {
            throw InputError(path_ +
                             ": the file has no polygons and no edges; burin draws the lines of "
                             "surfaces, and edges by themselves");
        }
        if (largest_plain_ >= soup_.positions.size()) {
            soup_ = {};
            PlyBodyReader by_value(path_, file_, header_, first_values_, threads_, wish_, PlyItemLayout::values);
            soup_ = by_value.read();
            values_ = by_value.values_;
            return std::move(soup_);
        }
        check_references();
        corner_uv_.move_to(soup_);
        materials_.move_to(soup_);
        return std::move(soup_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        const std::string item =
            values_.line() > 0 ? "" : printable(element_->name) + " " + std::to_string(item_) + ": ";
        throw InputError({path_, values_.line()}, item + message);
    }
    [[noreturn]] void fail_value() {
        if (values_.at_end()) {
            fail("the file ends in the middle of element '" + printable(element_->name) +
                 "'; was it written completely?");
        }
        fail("a value of element '" + printable(element_->name) + "' is no number of its type; " +
             "repair or re-export the file");
    }

    /// Refuses counts that the file has no room for, before anything is allocated.
    void check_room(const PlyElement& element) const {
        const std::uint64_t values_each =
            header_.encoding == PlyEncoding::ascii ? element.properties.size() : element.smallest_binary_size();
        if (element.count > 0 && values_each == 0) {
            throw InputError(path_ + ": element '" + printable(element.name) +
                             "' has a count but no properties; repair the file");
        }
        if (element.count > 0 && values_.room() / values_each < element.count) {
            throw InputError(path_ + ": the header promises " + std::to_string(element.count) + " of element '" +
                             printable(element.name) + "', the file has room for at most " +
                             std::to_string(values_.room() / values_each) + "; was it written completely?");
        }
        if (element.name == "vertex" && element.count > 0xFFFFFFFFu) {
            throw InputError(path_ + ": more than 4 billion vertices; split the model");
        }
    }

    void end_item() {
        if constexpr (kIsText) {
            if (layout_ != PlyItemLayout::lines || !values_.skip_rest_of_line()) return;
            if (long_lines_.count++ == 0) long_lines_ = {1, values_.line(), element_};
        }
    }

    void poll() const {
        if ((item_ & 0xFFFF) == 0) throw_if_interrupted();
    }

    double number(const PlyProperty& property) {
        double value = 0;
        if (!values_.number(property.type, value)) fail_value();
        return value;
    }

    /// A value that somebody asked for. Where all are kept, whether they are read or not, a word that is no number
    /// counts as 0.
    double number_of_attribute(const PlyProperty& property) {
        double value = 0;
        if (values_.number(property.type, value)) return value;
        if (values_.at_end()) fail_value();
        if (wish_.all_named && values_.skip(property.type, 1)) return 0;
        fail("property '" + printable(property.name) + "' is no number; repair or re-export the file");
    }

    /// The length of a list that starts here; at most what the file has room for.
    std::uint64_t list_length(const PlyProperty& property) {
        std::int64_t length = 0;
        if (!values_.integer(property.count_type, length)) fail_value();
        if (length < 0 || static_cast<std::uint64_t>(length) > values_.room()) {
            fail("a list of " + std::to_string(length) + " values does not fit the file; " + "repair or re-export it");
        }
        return static_cast<std::uint64_t>(length);
    }

    void skip_property(const PlyProperty& property) {
        const std::uint64_t count = property.is_list ? list_length(property) : 1;
        if (!values_.skip(property.type, count)) fail_value();
    }
    void skip_properties(const PlyElement& element, std::size_t first) {
        poll();
        for (std::size_t i = first; i < element.properties.size(); ++i) {
            skip_property(element.properties[i]);
        }
    }

    void read_vertices(const PlyElement& element) {
        const int axis_property[3] = {element.find("x"), element.find("y"), element.find("z")};
        std::vector<int> axis_of(element.properties.size(), -1);
        for (int axis = 0; axis < 3; ++axis) {
            const int p = axis_property[axis];
            if (p < 0 || element.properties[static_cast<std::size_t>(p)].is_list) {
                throw InputError(path_ + ": element 'vertex' has no property '" + "xyz"[axis] +
                                 "'; repair or re-export the file");
            }
            axis_of[static_cast<std::size_t>(p)] = axis;
        }
        reserve_large(soup_.positions, soup_.positions.size() + element.count);
        PlyAttributes attributes(element, wish_);
        const bool has_attributes = !attributes.empty();
        for (item_ = 0; item_ < element.count; ++item_) {
            poll();
            if (!has_attributes) read_plain_positions(element, axis_of);
            if (item_ == element.count) break;
            glm::dvec3 position;
            for (std::size_t i = 0; i < axis_of.size(); ++i) {
                if (has_attributes && attributes.has(i)) {
                    attributes.set(i, number_of_attribute(element.properties[i]));
                } else if (axis_of[i] < 0) {
                    skip_property(element.properties[i]);
                } else {
                    position[axis_of[i]] = number(element.properties[i]);
                }
            }
            if (!is_coordinate(position)) {
                fail("a coordinate is not finite or beyond 1e30; repair or re-export the file");
            }
            soup_.positions.push_back(position);
            if (has_attributes) attributes.end_vertex();
            end_item();
        }
        attributes.move_to(soup_);
    }

    /// Reads items in the usual form; the rest of this class reads any form, one item at a time.
    void read_plain_positions(const PlyElement& element, std::span<const int> axis_of) {
        if constexpr (kIsText) {
            if (layout_ != PlyItemLayout::plain_rows || element.has_lists()) return;
            if (item_ == 0 && is_large()) {
                item_ =
                    read_large(element.count, 1, soup_.positions, [&](AsciiValues& values, std::span<glm::dvec3> rows) {
                        return read_position_rows(values, axis_of, rows);
                    });
            }
            read_blocks<1>(element.count, soup_.positions,
                           [&](std::span<glm::dvec3> rows) { return values_.plain_positions(axis_of, rows); });
        }
    }
    void read_plain_triangles(const PlyElement& element) {
        if constexpr (kIsText) {
            if (layout_ != PlyItemLayout::plain_rows || element.properties.size() != 1) return;
            const auto read_triangles = [this](AsciiValues& values, std::span<std::uint32_t> corners) {
                const std::size_t count = values.plain_triangles(corners);
                std::uint32_t largest = 0;
                for (const std::uint32_t v : corners.first(3 * count)) largest = std::max(largest, v);
                note_plain_index(largest);
                return count;
            };
            if (item_ == 0 && is_large()) {
                const std::uint64_t most =
                    std::min(element.count, (PolygonSoup::kMaxCorners - soup_.corners.size()) / 3);
                item_ = read_large(most, 3, soup_.corners, read_triangles);
            }
            const std::uint64_t most =
                std::min(element.count, item_ + (PolygonSoup::kMaxCorners - soup_.corners.size()) / 3);
            read_blocks<3>(most, soup_.corners,
                           [&](std::span<std::uint32_t> corners) { return read_triangles(values_, corners); });
        }
    }

    /// Pieces pay for themselves where there is enough to read.
    bool is_large() const { return values_.rest().size() > 65536; }
    /// Reads up to `rows` rows in pieces, and returns how many.
    template <typename Value, typename ReadPiece>
    std::uint64_t read_large(std::uint64_t rows, std::size_t per_row, std::vector<Value>& all, const ReadPiece& read) {
        values_.at_end();  // goes to the first row
        const std::string_view rest = values_.rest();
        const auto begin = static_cast<std::size_t>(rest.data() - file_.bytes().data());
        const auto copy = [this, begin](std::size_t place, std::span<char> to) { file_.copy(begin + place, to); };
        return read_in_pieces(values_, copy, LineCutter::size_for(rest.size(), threads_), threads_, rows, per_row, all,
                              read);
    }
    /// Reads rows from item_ on, up to the one in front of `end`, as long as read(place for the values of some) can.
    template <std::size_t kPerRow, typename Value, typename ReadBlock>
    void read_blocks(std::uint64_t end, std::vector<Value>& all, const ReadBlock& read) {
        std::array<Value, kPerRow * 1024> block;
        for (bool goes_on = true; goes_on;) {
            throw_if_interrupted();
            const std::size_t most = std::min<std::uint64_t>(end - item_, 1024);
            const std::size_t count = read(std::span(block).first(kPerRow * most));
            all.insert(all.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(kPerRow * count));
            item_ += count;
            goes_on = count > 0 && count == most;
        }
    }
    /// Where a number in plain rows is too large for the vertices, all is read again, value by value, to see where it
    /// stands. Rows of pieces that are not used in the end count, too: then there may be no such number, and all is
    /// well.
    void note_plain_index(std::uint32_t index) {
        for (std::uint32_t known = largest_plain_;
             known < index && !largest_plain_.compare_exchange_weak(known, index);) {
        }
    }

    /// One value of a vertex number list. Faces may stand before the vertices, so the upper bound
    /// is checked when all is read.
    std::int64_t list_index(const PlyProperty& property) {
        std::int64_t index = 0;
        if (!values_.integer(property.type, index)) fail_value();
        if (index > largest_.index) largest_ = {index, values_.line(), item_};
        return index;
    }

    std::uint32_t vertex_index(const PlyProperty& property) {
        const std::int64_t index = list_index(property);
        if (index < 0 || index > std::int64_t{0xFFFFFFFF}) {
            fail("vertex " + std::to_string(index) + " does not exist; repair or re-export the file");
        }
        return static_cast<std::uint32_t>(index);
    }

    void read_faces(const PlyElement& element) {
        const int list = element.find("vertex_indices", "vertex_index");
        if (list < 0 || !element.properties[static_cast<std::size_t>(list)].is_list) {
            throw InputError(path_ + ": element 'face' has no list 'vertex_indices'; " +
                             "repair or re-export the file");
        }
        reserve_large(soup_.corners, soup_.corners.size() + 3 * element.count);
        bool all_triangles = soup_.polygon_ends.empty();
        for (item_ = 0; item_ < element.count; ++item_) {
            poll();
            if (all_triangles) read_plain_triangles(element);
            if (item_ == element.count) break;
            const std::uint64_t polygons = soup_.polygon_count();
            std::optional<std::uint32_t> material;
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const PlyProperty& property = element.properties[i];
                if (wish_.uv && PlyCornerUv::is_list_of(property)) {
                    read_corner_uv(property);
                    continue;
                }
                if (PlyFaceMaterials::is_index(property)) {
                    material = material_index(property);
                    continue;
                }
                if (i != static_cast<std::size_t>(list)) {
                    skip_property(property);
                    continue;
                }
                const std::uint64_t length = list_length(property);
                if (all_triangles && length != 3) {
                    all_triangles = false;
                    list_all_triangle_ends();
                }
                for (std::uint64_t k = 0; k < length; ++k) {
                    soup_.corners.push_back(vertex_index(property));
                }
                check_corner_count();
                if (!all_triangles) {
                    soup_.polygon_ends.push_back(static_cast<std::uint32_t>(soup_.corners.size()));
                }
            }
            if (wish_.uv) corner_uv_.end_face(soup_.corners.size());
            if (material) materials_.add(polygons, *material);
            end_item();
        }
    }

    std::uint32_t material_index(const PlyProperty& property) {
        const double value = number(property);
        if (value >= 0 && value <= PlyFaceMaterials::kLargest && value == std::floor(value))
            return static_cast<std::uint32_t>(value);
        fail("material_index must be a whole number from 0 to 2147483647; repair or re-export the file");
    }
    void read_corner_uv(const PlyProperty& property) {
        const std::uint64_t length = list_length(property);
        for (std::uint64_t k = 0; k < length; ++k) corner_uv_.add(number_of_attribute(property));
    }

    void read_strips(const PlyElement& element) {
        const int list = element.find("vertex_indices", "vertex_index");
        if (list < 0 || !element.properties[static_cast<std::size_t>(list)].is_list) {
            throw InputError(path_ + ": element 'tristrips' has no list 'vertex_indices'; " +
                             "repair or re-export the file");
        }
        for (item_ = 0; item_ < element.count; ++item_) {
            poll();
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                if (i == static_cast<std::size_t>(list)) {
                    read_strip(element.properties[i]);
                } else {
                    skip_property(element.properties[i]);
                }
            }
            end_item();
        }
    }

    /// Strips follow each other in one list, separated by -1; every second triangle is turned.
    void read_strip(const PlyProperty& property) {
        const std::uint64_t length = list_length(property);
        std::uint32_t previous[2] = {0, 0};
        std::uint64_t in_strip = 0;
        for (std::uint64_t k = 0; k < length; ++k) {
            if ((k & 0xFFFF) == 0) throw_if_interrupted();
            const std::int64_t index = list_index(property);
            if (index == -1) {
                in_strip = 0;
                continue;
            }
            if (index < 0 || index > std::int64_t{0xFFFFFFFF}) {
                fail("vertex " + std::to_string(index) + " does not exist; repair the file");
            }
            const auto vertex = static_cast<std::uint32_t>(index);
            if (in_strip >= 2) {
                const std::size_t turned = in_strip % 2;
                const std::uint32_t corners[3] = {previous[turned], previous[1 - turned], vertex};
                soup_.corners.insert(soup_.corners.end(), corners, corners + 3);
                check_corner_count();
                if (!soup_.polygon_ends.empty()) {
                    soup_.polygon_ends.push_back(static_cast<std::uint32_t>(soup_.corners.size()));
                }
            }
            previous[0] = previous[1];
            previous[1] = vertex;
            ++in_strip;
        }
    }

    void read_edges(const PlyElement& element) {
        const auto first = static_cast<std::size_t>(element.find("vertex1"));
        const auto second = static_cast<std::size_t>(element.find("vertex2"));
        for (item_ = 0; item_ < element.count; ++item_) {
            poll();
            std::array<std::uint32_t, 2> edge{};
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const PlyProperty& property = element.properties[i];
                if (property.is_list || (i != first && i != second)) {
                    skip_property(property);
                } else {
                    edge[i == first ? 0 : 1] = vertex_index(property);
                }
            }
            soup_.marked_edges.push_back(edge);
            end_item();
        }
    }

    void list_all_triangle_ends() {
        for (std::size_t end = 3; end <= soup_.corners.size(); end += 3) {
            soup_.polygon_ends.push_back(static_cast<std::uint32_t>(end));
        }
    }
    void check_corner_count() const {
        if (soup_.corners.size() > PolygonSoup::kMaxCorners) {
            fail("more than 4 billion polygon corners; split the model");
        }
    }
    void check_references() const {
        if (largest_.index < static_cast<std::int64_t>(soup_.positions.size())) return;
        const std::string item = largest_.line > 0 ? "" : "item " + std::to_string(largest_.item) + ": ";
        throw InputError({path_, largest_.line}, item + "vertex " + std::to_string(largest_.index) +
                                                     " does not exist (the file has " +
                                                     std::to_string(soup_.positions.size()) +
                                                     ", counted from 0); repair or re-export the file");
    }

    static constexpr bool kIsText = std::is_same_v<Values, AsciiValues>;

    const std::string& path_;
    const MappedFile& file_;
    const PlyHeader& header_;
    const AttributeWish& wish_;
    const Values first_values_;
    Values values_;
    PolygonSoup soup_;
    PlyCornerUv corner_uv_;
    PlyFaceMaterials materials_;
    const PlyElement* element_ = nullptr;
    std::uint64_t item_ = 0;
    /// The largest vertex number of rows that are not plain, and where it stands first.
    struct {
        std::int64_t index = -1;
        std::size_t line = 0;
        std::uint64_t item = 0;
    } largest_;
    std::atomic<std::uint32_t> largest_plain_ = 0;  // of plain rows; there is a vertex 0
    int threads_;
    PlyItemLayout layout_;
    LongLines long_lines_;
};

}  // namespace burin
