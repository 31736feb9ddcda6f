#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>

#include "base/error.h"
#include "base/mapped_file.h"
#include "mesh/gltf_json.h"
#include "output/lines_file.h"
#include "output/lines_format.h"
#include "scene/animation/frame_list.h"
#include "shading/surface/shadow_casters.h"

namespace burin {
namespace {

/// ArrayReader finds arrays by the directory, and trusts nothing in it.
class ArrayReader {
  public:
    ArrayReader(const std::string& path, std::string_view bytes) : path_(path) {
        std::uint64_t size = 0;
        if (bytes.size() < sizeof size) fail("is too short to be a .lines file");
        std::memcpy(&size, bytes.data(), sizeof size);
        if (size > kMostLinesDirectoryBytes || size > bytes.size() - sizeof size)
            fail("its directory is longer than the file or 16 MiB; this is no .lines file");
        json_ = parse_gltf_json(path, bytes.substr(sizeof size, size));
        data_ = bytes.substr(sizeof size + size);
        if (!json_.is_object()) fail("its directory is no JSON object; this is no .lines file");
        check_tiling();
    }

    const std::string& path() const { return path_; }
    JsonPlace metadata() const { return JsonPlace(path_, json_, "").at("__metadata__"); }

    /// The rows of an array that there must be. `rows`: how many, or ~0 for any number.
    static constexpr std::size_t kAnyRows = ~std::size_t{0};
    template <typename T>
    std::size_t take(const std::string& name, std::size_t rows, std::size_t columns,
                     const std::function<void(std::size_t row, const T* numbers)>& row) const {
        const JsonPlace entry = JsonPlace(path_, json_, "").at(name.c_str());
        if (entry.at("dtype").text() != type_name<T>()) entry.fail("dtype must be " + std::string(type_name<T>()));
        const JsonPlace shape = entry.at("shape");
        const std::size_t sides = columns == 1 ? 1 : 2;
        if (shape.size() != sides) entry.fail("shape must have " + std::to_string(sides) + " numbers");
        const std::uint64_t count = shape.element(0).integer();
        if (rows != kAnyRows && count != rows) entry.fail("must have " + std::to_string(rows) + " rows");
        if (sides == 2 && shape.element(1).integer() != columns)
            entry.fail("must have " + std::to_string(columns) + " columns");
        const std::uint64_t begin = entry.at("data_offsets").element(0).integer(),
                            end = entry.at("data_offsets").element(1).integer();
        if (count > data_.size() || count * columns * sizeof(T) != end - begin)
            entry.fail("its shape does not fit its bytes");
        std::vector<T> numbers(columns);
        for (std::size_t i = 0; i < count; ++i) {
            std::memcpy(numbers.data(), data_.data() + begin + i * columns * sizeof(T), columns * sizeof(T));
            if constexpr (std::is_floating_point_v<T>) {
                for (const T number : numbers) {
                    if (!std::isfinite(number)) entry.fail("row " + std::to_string(i) + " is not finite");
                }
            }
            row(i, numbers.data());
        }
        return count;
    }
    bool has(const std::string& name) const { return json_.contains(name); }
    [[noreturn]] void fail(const std::string& message) const { throw InputError(path_ + ": " + message); }
    [[noreturn]] void fail_at(const std::string& name, std::size_t row, const std::string& message) const {
        fail(name + ": row " + std::to_string(row) + " " + message);
    }

  private:
    /// Arrays lie one behind the other, as the directory lists them, and fill the file.
    void check_tiling() const {
        std::map<std::uint64_t, std::uint64_t> parts;
        for (const auto& [name, value] : json_.items()) {
            if (name == "__metadata__") continue;
            const JsonPlace offsets = JsonPlace(path_, value, name).at("data_offsets");
            if (offsets.size() != 2) offsets.fail("must be two numbers");
            const std::uint64_t begin = offsets.element(0).integer(), end = offsets.element(1).integer();
            if (end < begin || end > data_.size()) offsets.fail("lies beyond the end of the file");
            if (begin != end && !parts.emplace(begin, end).second) offsets.fail("overlaps another array");
        }
        std::uint64_t at = 0;
        for (const auto& [begin, end] : parts) {
            if (begin != at) fail("its arrays overlap or leave gaps");
            at = end;
        }
        if (at != data_.size()) fail("has bytes that no array has");
    }

    std::string path_;
    nlohmann::json json_;
    std::string_view data_;
};

glm::dmat4 matrix_of(const double* numbers) {
    glm::dmat4 m;
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) m[c][r] = *numbers++;
    }
    return m;
}
DepthPlane plane_of(const double* n) { return {n[0], n[1], n[2], n[3], n[4]}; }

/// MetadataReader reads what the directory says beside arrays.
class MetadataReader {
  public:
    explicit MetadataReader(const ArrayReader& in) : in_(in), data_(in.metadata()), file_(in.path()) {}

    std::int64_t integer(const char* key, std::int64_t least, std::int64_t most) const {
        const double number = parsed(key).number();
        if (number != std::floor(number) || number < static_cast<double>(least) || number > static_cast<double>(most))
            in_.fail(std::string(key) + ": must be a whole number from " + std::to_string(least) + " to " +
                     std::to_string(most));
        return static_cast<std::int64_t>(number);
    }
    double number(const char* key) const { return parsed(key).number(); }
    std::vector<std::string> names(const char* key) const {
        const JsonPlace list = parsed(key);
        std::vector<std::string> names;
        for (std::size_t i = 0; i < list.size(); ++i) names.push_back(list.element(i).text());
        return names;
    }
    std::array<double, 2> pair(const char* key) const {
        const JsonPlace list = parsed(key);
        if (list.size() != 2) list.fail("must be two numbers");
        return {list.element(0).number(), list.element(1).number()};
    }
    std::string text(const char* key) const { return data_.at(key).text(); }
    std::optional<ViewLight> light(const char* key) const {
        if (!data_.has(key)) return std::nullopt;
        const JsonPlace list = parsed(key);
        if (list.size() != 4) list.fail("must be four numbers");
        const ViewLight light{list.element(0).number() != 0,
                              {list.element(1).number(), list.element(2).number(), list.element(3).number()}};
        if (!light.is_at_point && !(std::abs(glm::length(light.place) - 1) < 1e-6))
            list.fail("the direction must have the length 1");
        return light;
    }
    bool has(const char* key) const { return data_.has(key); }

  private:
    /// Metadata of safetensors are texts; numbers and lists stand in them as JSON.
    JsonPlace parsed(const char* key) const {
        json_ = parse_gltf_json(file_, data_.at(key).text());
        return {file_, json_, std::string("__metadata__.") + key};
    }

    const ArrayReader& in_;
    JsonPlace data_;
    std::string file_;
    mutable nlohmann::json json_;
};

template <typename Value>
Value checked(const ArrayReader& in, const char* name, std::size_t row, std::uint64_t number, std::uint64_t end) {
    if (number >= end) in.fail_at(name, row, "is out of range");
    return static_cast<Value>(number);
}

void read_picture(const ArrayReader& in, const MetadataReader& data, FoundLines& lines) {
    if (data.text("format") != kLinesFormat)
        in.fail("__metadata__.format: must be '" + std::string(kLinesFormat) + "'");
    lines.width_px = static_cast<int>(data.integer("width", 1, 65535));
    lines.height_px = static_cast<int>(data.integer("height", 1, 65535));
    lines.classes =
        LineClassSet::from_bits(static_cast<unsigned>(data.integer("class_bits", 0, LineClassSet::all().bits)));
    lines.most_invisibility = static_cast<int>(data.integer("most_qi", 0, 255));
    lines.tells_invisibility = data.integer("tells_qi", 0, 1) == 1;
    lines.has_normals = data.integer("has_normals", 0, 1) == 1;
    lines.has_beyond = data.integer("has_beyond", 0, 1) == 1;
    lines.has_chains = data.integer("has_chains", 0, 1) == 1;
    lines.has_hidden_chains =
        lines.has_chains || (data.has("has_hidden_chains") && data.integer("has_hidden_chains", 0, 1) == 1);
    lines.frame = data.number("frame");
    if (!(std::abs(lines.frame) <= kLargestFrame)) in.fail("__metadata__.frame: is out of range");
    lines.fps = data.number("fps");
    lines.dpi = data.number("dpi");
    if (!(lines.fps > 0) || !(lines.dpi > 0)) in.fail("__metadata__: fps and dpi must be greater than 0");
    if (data.has("paper_mm")) {
        const std::array<double, 2> mm = data.pair("paper_mm");
        if (!(mm[0] > 0 && mm[1] > 0)) in.fail("__metadata__.paper_mm: must be greater than 0");
        lines.paper_mm = {mm[0], mm[1]};
    }
    lines.crease_angle_deg = data.pair("crease_angle");
    lines.scene_light = data.light("light");
    lines.has_smooth_contours = data.integer("smooth_contours", 0, 1) == 1;
    lines.filter = static_cast<PixelFilter>(data.integer("filter", 0, static_cast<int>(PixelFilter::mitchell)));
    in.take<double>("camera", 4, 4, [&](std::size_t i, const double* v) {
        for (int r = 0; r < 4; ++r) lines.camera_to_world[static_cast<int>(i)][r] = v[r];
    });
    double projection[5];
    in.take<double>("projection", 5, 1, [&](std::size_t i, const double* v) { projection[i] = v[0]; });
    if (!(projection[1] > 0)) in.fail("projection: the focal length must be greater than 0");
    lines.projection = {projection[0] != 0, projection[1], {projection[2], projection[3]}, projection[4]};
    if (data.has("pixel_aspect")) {
        const double aspect = data.number("pixel_aspect");
        if (!(aspect > 0 && std::isfinite(1 / aspect))) in.fail("__metadata__.pixel_aspect: must be greater than 0");
        lines.projection.set_pixel_aspect(aspect);
    }
    lines.materials = data.names("materials");
    for (std::string& name : data.names("objects")) lines.objects.push_back({std::move(name), 0, glm::dmat4(1.0), 1});
    in.take<double>("object_from_view", lines.objects.size(), 17, [&](std::size_t i, const double* v) {
        lines.objects[i].from_view = matrix_of(v);
        lines.objects[i].units_per_view = v[16];
    });
    in.take<std::uint32_t>("object_number", lines.objects.size(), 1,
                           [&](std::size_t i, const std::uint32_t* v) { lines.objects[i].same_name_before = v[0]; });
    lines.material_colors.resize(lines.materials.size());
    in.take<float>("material_color", lines.materials.size(), 3, [&](std::size_t i, const float* v) {
        for (int k = 0; k < 3; ++k) lines.material_colors[i][k] = v[k];
    });
}

void read_pieces(const ArrayReader& in, FoundLines& lines) {
    auto& pieces = lines.runs.pieces;
    std::vector<glm::dvec2> places;
    in.take<double>("xy", ArrayReader::kAnyRows, 2, [&](std::size_t i, const double* v) {
        constexpr double kFarthestPx = 1 << 20;
        if (std::abs(v[0]) > kFarthestPx || std::abs(v[1]) > kFarthestPx)
            in.fail_at("xy", i, "lies far beyond the picture");
        places.emplace_back(v[0], v[1]);
    });
    if (places.size() % 2 != 0 || places.size() / 2 > std::numeric_limits<std::uint32_t>::max())
        in.fail("xy: must have two rows for each piece");
    const std::size_t n = places.size() / 2;
    pieces.resize(n);
    lines.sides.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        pieces[i].piece.from = places[2 * i];
        pieces[i].piece.to = places[2 * i + 1];
    }
    in.take<double>("s", 2 * n, 1, [&](std::size_t i, const double* v) {
        (i % 2 == 0 ? pieces[i / 2].at_from_px : pieces[i / 2].at_to_px) = v[0];
    });
    in.take<float>("nearness", 2 * n, 1, [&](std::size_t i, const float* v) {
        (i % 2 == 0 ? pieces[i / 2].piece.nearness_from : pieces[i / 2].piece.nearness_to) = v[0];
    });
    in.take<float>("N", 2 * n, 6, [&](std::size_t i, const float* v) {
        for (int k = 0; k < 3; ++k) {
            lines.sides[i / 2].front_normals[i % 2][k] = v[k];
            lines.sides[i / 2].other_normals[i % 2][k] = v[3 + k];
        }
    });
    in.take<double>("planes", n, 10, [&](std::size_t i, const double* v) {
        lines.sides[i].front_plane = plane_of(v);
        lines.sides[i].beyond_plane = plane_of(v + 5);
        if (v[3] > v[4] || v[8] > v[9]) in.fail_at("planes", i, "has a lowest nearness above its highest");
    });
    in.take<std::uint64_t>("line", n, 1,
                           [&](std::size_t i, const std::uint64_t* v) { pieces[i].piece.line.bits = v[0]; });
    in.take<std::uint32_t>("owners", n, 4, [&](std::size_t i, const std::uint32_t* v) {
        const std::uint64_t objects = lines.objects.size() + 1, materials = lines.materials.size() + 1;
        LineSides& s = lines.sides[i];
        s.front_object = checked<std::uint32_t>(in, "owners", i, v[0], objects);
        s.front_material = checked<std::uint32_t>(in, "owners", i, v[1], materials);
        s.other_object = checked<std::uint32_t>(in, "owners", i, v[2], objects);
        s.other_material = checked<std::uint32_t>(in, "owners", i, v[3], materials);
    });
    in.take<float>("dihedral", n, 1, [&](std::size_t i, const float* v) { lines.sides[i].dihedral_deg = v[0]; });
    in.take<std::uint16_t>("classes", n, 1, [&](std::size_t i, const std::uint16_t* v) {
        if ((v[0] & ~LineClassSet::all().bits) != 0) in.fail_at("classes", i, "has bits that are no class");
        pieces[i].piece.classes.bits = v[0];
    });
    const auto bytes = [&](const char* name, const auto& use, std::uint64_t end = 256) {
        in.take<std::uint8_t>(name, n, 1, [&](std::size_t i, const std::uint8_t* v) {
            use(i, checked<std::uint8_t>(in, name, i, v[0], end));
        });
    };
    bytes(
        "drawn_as", [&](std::size_t i, std::uint8_t v) { pieces[i].piece.drawn_as = static_cast<LineClass>(v); },
        kLineClassCount);
    bytes("qi", [&](std::size_t i, std::uint8_t v) { pieces[i].piece.invisibility = v; });
    bytes("transmission", [&](std::size_t i, std::uint8_t v) { pieces[i].piece.transmission = v; });
    bytes("opacity", [&](std::size_t i, std::uint8_t v) { pieces[i].piece.opacity = v; });
    bytes(
        "flags",
        [&](std::size_t i, std::uint8_t v) {
            pieces[i].piece.occludes = (v & kOccludes) != 0;
            pieces[i].piece.front_on_left = (v & kFrontOnLeft) != 0;
            lines.sides[i].is_beyond = (v & kIsBeyond) != 0;
        },
        8);
    in.take<std::int8_t>("convex", n, 1, [&](std::size_t i, const std::int8_t* v) {
        if (v[0] < -1 || v[0] > 1) in.fail_at("convex", i, "is out of range");
        lines.sides[i].convex = v[0];
    });
}

/// Values of surfaces at the ends of pieces, as far as they are there.
void read_surface_values(const ArrayReader& in, const MetadataReader& data, FoundLines& lines) {
    SurfaceNeeds& known = lines.surface;
    known.kr = in.has("kr");
    known.uv = in.has("uv");
    known.color = in.has("Cv");
    if (in.has("attributes")) known.attributes = data.names("attributes");
    if (known.attributes.size() > kMostLinesAttributes)
        in.fail("__metadata__.attributes: at most " + std::to_string(kMostLinesAttributes) + " names are possible");
    const auto descends = [](const std::string& a, const std::string& b) { return a >= b; };
    if (std::adjacent_find(known.attributes.begin(), known.attributes.end(), descends) != known.attributes.end() ||
        (in.has("attributes") && known.attributes.empty()))
        in.fail("__metadata__.attributes: must be names in ascending order");
    const std::size_t rows = 2 * lines.sides.size(), columns = known.column_count();
    std::vector<float> values;
    std::vector<std::array<std::size_t, 2>> arrays;  // where each begins in `values`, and how many columns it has
    const auto take = [&](const char* name, bool is_known, std::size_t count) {
        if (!is_known) return;
        arrays.push_back({values.size(), count});
        in.take<float>(name, rows, count,
                       [&](std::size_t, const float* v) { values.insert(values.end(), v, v + count); });
    };
    take("kr", known.kr, 1);
    take("uv", known.uv, 2);
    take("Cv", known.color, 3);
    take("attributes", in.has("attributes"), known.attributes.size());
    lines.surface_values.reserve(rows * columns);
    for (std::size_t i = 0; i < rows; ++i) {
        for (const auto& [begin, count] : arrays) {
            const auto row = values.begin() + static_cast<std::ptrdiff_t>(begin + i * count);
            lines.surface_values.insert(lines.surface_values.end(), row, row + static_cast<std::ptrdiff_t>(count));
        }
    }
}

/// What casts shadows in the light that the lines were found in, if it was kept.
void read_casters(const ArrayReader& in, const MetadataReader& data, FoundLines& lines) {
    const std::optional<ViewLight> light = data.light("shadow_light");
    if (!light) return;
    // Single precision has no larger numbers, and products of a few of these can be computed with.
    constexpr double kFarthest = 1e40;
    const auto is_far = [](double v) { return !(std::abs(v) <= kFarthest); };
    const double distance = data.number("shadow_distance");
    if (!(distance >= 0) || is_far(distance)) in.fail("__metadata__.shadow_distance: is out of range");
    std::vector<ShadowCasters::Caster> casters;
    in.take<double>("casters", ArrayReader::kAnyRows, 10, [&](std::size_t i, const double* v) {
        if (std::any_of(v, v + 10, is_far)) in.fail_at("casters", i, "is out of range");
        casters.push_back(
            {{0, static_cast<std::uint32_t>(i)}, {v[0], v[1], v[2]}, {{v[3], v[4], v[5]}, {v[6], v[7], v[8]}}, v[9]});
    });
    if (casters.size() >= std::numeric_limits<std::uint32_t>::max()) in.fail("casters: has too many rows");
    lines.casters = std::make_shared<const ShadowCasters>(std::move(casters), *light, distance);
}

void read_chains(const ArrayReader& in, FoundLines& lines) {
    auto& runs = lines.runs.runs;
    std::vector<std::uint64_t> first;
    in.take<std::uint64_t>("chain_first", ArrayReader::kAnyRows, 1, [&](std::size_t i, const std::uint64_t* v) {
        if (i == 0 ? v[0] != 0 : v[0] <= first.back()) in.fail_at("chain_first", i, "does not ascend from 0");
        first.push_back(v[0]);
    });
    if (first.empty() || first.back() != lines.runs.pieces.size())
        in.fail("chain_first: must end with the number of pieces");
    runs.resize(first.size() - 1);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        runs[i].first = first[i];
        runs[i].count = first[i + 1] - first[i];
    }
    in.take<std::uint64_t>("chain_key", runs.size(), 1,
                           [&](std::size_t i, const std::uint64_t* v) { runs[i].chain_place = v[0]; });
    in.take<double>("chain_length", runs.size(), 1, [&](std::size_t i, const double* v) {
        if (v[0] < 0) in.fail_at("chain_length", i, "is negative");
        runs[i].chain_length_px = v[0];
    });
    in.take<float>("chain_gaps", runs.size(), 4, [&](std::size_t i, const float* v) {
        if (std::any_of(v, v + 4, [](float gap) { return gap < 0 || gap > kFarthestGapPx; }))
            in.fail_at("chain_gaps", i, "is out of range");
        runs[i].gaps_px = {v[0], v[1]};
        runs[i].onward_gaps_px = {v[2], v[3]};
    });
    in.take<std::uint8_t>("chain_flags", runs.size(), 1, [&](std::size_t i, const std::uint8_t* v) {
        if (v[0] >= 4 * kLastEnd) in.fail_at("chain_flags", i, "is out of range");
        runs[i].is_hidden = (v[0] & kHidden) != 0;
        runs[i].is_closed = (v[0] & kClosed) != 0;
        runs[i].chain_is_closed = (v[0] & kChainClosed) != 0;
        runs[i].ends = {static_cast<RunEnd>(v[0] / kFirstEnd % 4), static_cast<RunEnd>(v[0] / kLastEnd % 4)};
    });
    auto& b = lines.boundaries;
    in.take<double>("boundary_xy", ArrayReader::kAnyRows, 4, [&](std::size_t, const double* v) {
        LinePiece& piece = b.emplace_back();
        piece.from = {v[0], v[1]};
        piece.to = {v[2], v[3]};
        piece.is_drawn = false;
        piece.occludes = true;
    });
    in.take<float>("boundary_nearness", b.size(), 2, [&](std::size_t i, const float* v) {
        b[i].nearness_from = v[0];
        b[i].nearness_to = v[1];
    });
    in.take<std::uint8_t>("boundary_flags", b.size(), 1, [&](std::size_t i, const std::uint8_t* v) {
        b[i].front_on_left = (v[0] & kFrontOnLeft) != 0;
    });
    // Places ascend along a run, in which dashes are cut.
    for (std::size_t r = 0; r < runs.size(); ++r) {
        for (std::size_t i = runs[r].first; i < runs[r].first + runs[r].count; ++i) {
            const RunPiece& p = lines.runs.pieces[i];
            constexpr double kLongestPx = 1e9;
            if (!(p.at_from_px <= p.at_to_px) || std::abs(p.at_from_px) > kLongestPx ||
                std::abs(p.at_to_px) > kLongestPx)
                in.fail_at("s", 2 * i, "does not ascend along its chain");
            if (p.piece.is_hidden() != runs[r].is_hidden) in.fail_at("qi", i, "is not that of its chain");
        }
    }
}

}  // namespace

LinesFile read_lines_file(const std::string& path) {
    const MappedFile file(path);
    const ArrayReader in(path, file.bytes());
    const MetadataReader data(in);
    LinesFile result;
    read_picture(in, data, result.lines);
    read_pieces(in, result.lines);
    read_surface_values(in, data, result.lines);
    read_chains(in, result.lines);
    read_casters(in, data, result.lines);
    if (in.has("surface")) {
        KeptSurface& surface = result.surface;
        surface.width = static_cast<int>(data.integer("surface_width", 1, 65535));
        in.take<float>("surface", ArrayReader::kAnyRows, 4, [&](std::size_t, const float* v) {
            surface.pixels.push_back({v[0], v[1], v[2], v[3]});
        });
        const std::size_t pixels =
            static_cast<std::size_t>(result.lines.width_px) * static_cast<std::size_t>(result.lines.height_px);
        if (surface.width != result.lines.width_px || surface.pixels.size() != pixels)
            in.fail("surface: must have as many rows as the picture has pixels");
        surface.height = result.lines.height_px;
    }
    file.check_is_whole();
    return result;
}

}  // namespace burin
