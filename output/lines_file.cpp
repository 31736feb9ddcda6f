#include "output/lines_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <string_view>
#include <type_traits>

#include "base/error.h"
#include "base/mapped_file.h"
#include "image/half.h"
#include "mesh/gltf_json.h"

namespace burin {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is little-endian, and so are its arrays in memory");

constexpr std::string_view kFormat = "burin-lines 1";
constexpr std::size_t kAlignment = 64;
constexpr std::size_t kMostDirectoryBytes = 16u << 20;
constexpr std::uint8_t kOccludes = 1, kFrontOnLeft = 2, kIsBeyond = 4;                            // of `flags`
constexpr std::uint8_t kHidden = 1, kClosed = 2, kChainClosed = 4, kFirstEnd = 8, kLastEnd = 32;  // of `chain_flags`

template <typename T>
constexpr std::string_view type_name() {
    if constexpr (std::is_same_v<T, double>) return "F64";
    if constexpr (std::is_same_v<T, std::uint64_t>) return "U64";
    if constexpr (std::is_same_v<T, float>) return "F32";
    if constexpr (std::is_same_v<T, std::uint32_t>) return "U32";
    if constexpr (std::is_same_v<T, std::uint16_t>) return "U16";
    if constexpr (std::is_same_v<T, std::uint8_t>) return "U8";
    if constexpr (std::is_same_v<T, std::int8_t>) return "I8";
}

// One description of all arrays serves writing and reading: visit(name, columns, count, numbers of row i).

/// Rows of numbers of one type, as they stand in memory.
template <typename T>
using RowOf = std::function<void(std::size_t row, T* numbers)>;

/// ArrayWriter collects arrays, and writes them behind a directory, those with the widest numbers first.
class ArrayWriter {
  public:
    template <typename T>
    void add(const std::string& name, std::size_t rows, std::size_t columns, const RowOf<T>& row) {
        Array array{std::string(type_name<T>()), rows, columns, sizeof(T), {}};
        array.bytes.resize(rows * columns * sizeof(T));
        std::vector<T> numbers(columns);
        for (std::size_t i = 0; i < rows; ++i) {
            row(i, numbers.data());
            std::memcpy(array.bytes.data() + i * columns * sizeof(T), numbers.data(), columns * sizeof(T));
        }
        arrays_.emplace_back(name, std::move(array));
    }

    void write(ByteSink& file, const std::map<std::string, std::string>& metadata) {
        std::stable_sort(arrays_.begin(), arrays_.end(),
                         [](const auto& a, const auto& b) { return a.second.number_bytes > b.second.number_bytes; });
        nlohmann::ordered_json directory;
        directory["__metadata__"] = metadata;
        std::size_t at = 0;
        for (const auto& [name, array] : arrays_) {
            nlohmann::ordered_json& entry = directory[name];
            entry["dtype"] = array.type;
            entry["shape"] =
                array.columns == 1 ? nlohmann::json{array.rows} : nlohmann::json{array.rows, array.columns};
            entry["data_offsets"] = {at, at + array.bytes.size()};
            at += array.bytes.size();
        }
        std::string text = directory.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
        text.resize(
            (text.size() + sizeof(std::uint64_t) + kAlignment - 1) / kAlignment * kAlignment - sizeof(std::uint64_t),
            ' ');
        const std::uint64_t size = text.size();
        file.write(&size, sizeof size);
        file.write(text.data(), text.size());
        for (const auto& [name, array] : arrays_) file.write(array.bytes.data(), array.bytes.size());
    }

  private:
    struct Array {
        std::string type;
        std::size_t rows, columns, number_bytes;
        std::vector<char> bytes;
    };
    std::vector<std::pair<std::string, Array>> arrays_;
};

/// ArrayReader finds arrays by the directory, and trusts nothing in it.
class ArrayReader {
  public:
    ArrayReader(const std::string& path, std::string_view bytes) : path_(path) {
        std::uint64_t size = 0;
        if (bytes.size() < sizeof size) fail("is too short to be a .lines file");
        std::memcpy(&size, bytes.data(), sizeof size);
        if (size > kMostDirectoryBytes || size > bytes.size() - sizeof size)
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

template <typename Matrix>
void put_matrix(const Matrix& m, double* numbers) {
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) *numbers++ = m[c][r];
    }
}
glm::dmat4 matrix_of(const double* numbers) {
    glm::dmat4 m;
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) m[c][r] = *numbers++;
    }
    return m;
}
void put_plane(const DepthPlane& p, double* n) {
    n[0] = p.at_origin, n[1] = p.per_x, n[2] = p.per_y, n[3] = p.lowest, n[4] = p.highest;
}
DepthPlane plane_of(const double* n) { return {n[0], n[1], n[2], n[3], n[4]}; }

std::string names_as_json(const std::vector<std::string>& names) {
    return nlohmann::json(names).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void add_pieces(const FoundLines& lines, ArrayWriter& out) {
    const auto& pieces = lines.runs.pieces;
    const auto piece = [&](std::size_t sample) -> const RunPiece& { return pieces[sample / 2]; };
    const std::size_t n = pieces.size();
    out.add<double>("xy", 2 * n, 2, [&](std::size_t i, double* v) {
        const glm::dvec2 p = i % 2 == 0 ? piece(i).piece.from : piece(i).piece.to;
        v[0] = p.x, v[1] = p.y;
    });
    out.add<double>("s", 2 * n, 1,
                    [&](std::size_t i, double* v) { v[0] = i % 2 == 0 ? piece(i).at_from_px : piece(i).at_to_px; });
    out.add<float>("nearness", 2 * n, 1, [&](std::size_t i, float* v) {
        v[0] = i % 2 == 0 ? piece(i).piece.nearness_from : piece(i).piece.nearness_to;
    });
    out.add<float>("N", 2 * n, 6, [&](std::size_t i, float* v) {
        const LineSides& s = lines.sides[i / 2];
        for (int k = 0; k < 3; ++k) v[k] = s.front_normals[i % 2][k], v[3 + k] = s.other_normals[i % 2][k];
    });
    out.add<double>("planes", n, 10, [&](std::size_t i, double* v) {
        put_plane(lines.sides[i].front_plane, v);
        put_plane(lines.sides[i].beyond_plane, v + 5);
    });
    out.add<std::uint64_t>("line", n, 1, [&](std::size_t i, std::uint64_t* v) { v[0] = pieces[i].piece.line.bits; });
    out.add<std::uint32_t>("owners", n, 4, [&](std::size_t i, std::uint32_t* v) {
        const LineSides& s = lines.sides[i];
        v[0] = s.front_object, v[1] = s.front_material, v[2] = s.other_object, v[3] = s.other_material;
    });
    out.add<float>("dihedral", n, 1, [&](std::size_t i, float* v) { v[0] = lines.sides[i].dihedral_deg; });
    out.add<std::uint16_t>("classes", n, 1,
                           [&](std::size_t i, std::uint16_t* v) { v[0] = pieces[i].piece.classes.bits; });
    const auto bytes = [&](const char* name, auto value) {
        out.add<std::uint8_t>(name, n, 1, [&pieces, &value](std::size_t i, std::uint8_t* v) {
            v[0] = static_cast<std::uint8_t>(value(pieces[i].piece));
        });
    };
    bytes("drawn_as", [](const LinePiece& p) { return p.drawn_as; });
    bytes("qi", [](const LinePiece& p) { return p.invisibility; });
    bytes("transmission", [](const LinePiece& p) { return p.transmission; });
    bytes("opacity", [](const LinePiece& p) { return p.opacity; });
    out.add<std::uint8_t>("flags", n, 1, [&](std::size_t i, std::uint8_t* v) {
        const LinePiece& p = pieces[i].piece;
        v[0] = static_cast<std::uint8_t>((p.occludes ? kOccludes : 0) | (p.front_on_left ? kFrontOnLeft : 0) |
                                         (lines.sides[i].is_beyond ? kIsBeyond : 0));
    });
    out.add<std::int8_t>("convex", n, 1, [&](std::size_t i, std::int8_t* v) { v[0] = lines.sides[i].convex; });
}

void add_chains(const FoundLines& lines, ArrayWriter& out) {
    const auto& runs = lines.runs.runs;
    out.add<std::uint64_t>("chain_first", runs.size() + 1, 1, [&](std::size_t i, std::uint64_t* v) {
        v[0] = i < runs.size() ? runs[i].first : lines.runs.pieces.size();
    });
    out.add<std::uint64_t>("chain_key", runs.size(), 1,
                           [&](std::size_t i, std::uint64_t* v) { v[0] = runs[i].chain_place; });
    out.add<double>("chain_length", runs.size(), 1, [&](std::size_t i, double* v) { v[0] = runs[i].chain_length_px; });
    out.add<std::uint8_t>("chain_flags", runs.size(), 1, [&](std::size_t i, std::uint8_t* v) {
        const LineRun& r = runs[i];
        v[0] = static_cast<std::uint8_t>(
            (r.is_hidden ? kHidden : 0) | (r.is_closed ? kClosed : 0) | (r.chain_is_closed ? kChainClosed : 0) |
            kFirstEnd * static_cast<int>(r.ends[0]) | kLastEnd * static_cast<int>(r.ends[1]));
    });
    const auto& b = lines.boundaries;
    out.add<double>("boundary_xy", b.size(), 4, [&](std::size_t i, double* v) {
        v[0] = b[i].from.x, v[1] = b[i].from.y, v[2] = b[i].to.x, v[3] = b[i].to.y;
    });
    out.add<float>("boundary_nearness", b.size(), 2,
                   [&](std::size_t i, float* v) { v[0] = b[i].nearness_from, v[1] = b[i].nearness_to; });
    out.add<std::uint8_t>("boundary_flags", b.size(), 1,
                          [&](std::size_t i, std::uint8_t* v) { v[0] = b[i].front_on_left ? kFrontOnLeft : 0; });
}

void add_picture(const FoundLines& lines, const KeptSurface& surface, ArrayWriter& out) {
    out.add<double>("camera", 4, 4, [&](std::size_t i, double* v) {
        for (int r = 0; r < 4; ++r) v[r] = lines.camera_to_world[static_cast<int>(i)][r];
    });
    out.add<double>("projection", 5, 1, [&](std::size_t i, double* v) {
        const Projection& p = lines.projection;
        const double numbers[5] = {p.orthographic ? 1.0 : 0.0, p.focal_px, p.center_px.x, p.center_px.y,
                                   p.near_distance};
        v[0] = numbers[i];
    });
    out.add<double>("object_from_view", lines.objects.size(), 17, [&](std::size_t i, double* v) {
        put_matrix(lines.objects[i].from_view, v);
        v[16] = lines.objects[i].units_per_view;
    });
    out.add<std::uint32_t>("object_number", lines.objects.size(), 1,
                           [&](std::size_t i, std::uint32_t* v) { v[0] = lines.objects[i].same_name_before; });
    out.add<float>("material_color", lines.material_colors.size(), 3, [&](std::size_t i, float* v) {
        for (int k = 0; k < 3; ++k) v[k] = lines.material_colors[i][k];
    });
    if (surface.pixels.empty()) return;
    out.add<float>("surface", surface.pixels.size(), 4,
                   [&](std::size_t i, float* v) { std::memcpy(v, surface.pixels[i].data(), 4 * sizeof(float)); });
}

std::map<std::string, std::string> metadata_of(const FoundLines& lines, const KeptSurface& surface) {
    std::vector<std::string> objects;
    for (const ObjectOfLines& object : lines.objects) objects.push_back(object.name);
    std::map<std::string, std::string> data;
    data["format"] = kFormat;
    data["width"] = std::to_string(lines.width_px);
    data["height"] = std::to_string(lines.height_px);
    data["objects"] = names_as_json(objects);
    data["materials"] = names_as_json(lines.materials);
    data["classes"] = to_string(lines.classes);
    data["class_bits"] = std::to_string(lines.classes.bits);
    data["most_qi"] = std::to_string(lines.most_invisibility);
    data["tells_qi"] = lines.tells_invisibility ? "1" : "0";
    data["has_normals"] = lines.has_normals ? "1" : "0";
    data["has_beyond"] = lines.has_beyond ? "1" : "0";
    data["has_chains"] = lines.has_chains ? "1" : "0";
    data["frame"] = std::to_string(lines.frame);
    const auto number = [](double value) { return nlohmann::json(value).dump(); };
    data["fps"] = number(lines.fps);
    data["dpi"] = number(lines.dpi);
    data["crease_angle"] = nlohmann::json{lines.crease_angle_deg[0], lines.crease_angle_deg[1]}.dump();
    data["smooth_contours"] = lines.has_smooth_contours ? "1" : "0";
    data["filter"] = std::to_string(static_cast<int>(lines.filter));
    if (!surface.pixels.empty()) data["surface_width"] = std::to_string(surface.width);
    return data;
}

// ---- reading ----

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
    if (data.text("format") != kFormat) in.fail("__metadata__.format: must be '" + std::string(kFormat) + "'");
    lines.width_px = static_cast<int>(data.integer("width", 1, 65535));
    lines.height_px = static_cast<int>(data.integer("height", 1, 65535));
    lines.classes =
        LineClassSet::from_bits(static_cast<unsigned>(data.integer("class_bits", 0, LineClassSet::all().bits)));
    lines.most_invisibility = static_cast<int>(data.integer("most_qi", 0, 255));
    lines.tells_invisibility = data.integer("tells_qi", 0, 1) == 1;
    lines.has_normals = data.integer("has_normals", 0, 1) == 1;
    lines.has_beyond = data.integer("has_beyond", 0, 1) == 1;
    lines.has_chains = data.integer("has_chains", 0, 1) == 1;
    lines.frame =
        static_cast<int>(data.integer("frame", std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
    lines.fps = data.number("fps");
    lines.dpi = data.number("dpi");
    if (!(lines.fps > 0) || !(lines.dpi > 0)) in.fail("__metadata__: fps and dpi must be greater than 0");
    lines.crease_angle_deg = data.pair("crease_angle");
    lines.has_smooth_contours = data.integer("smooth_contours", 0, 1) == 1;
    lines.filter = static_cast<PixelFilter>(data.integer("filter", 0, static_cast<int>(PixelFilter::mitchell)));
    in.take<double>("camera", 4, 4, [&](std::size_t i, const double* v) {
        for (int r = 0; r < 4; ++r) lines.camera_to_world[static_cast<int>(i)][r] = v[r];
    });
    double projection[5];
    in.take<double>("projection", 5, 1, [&](std::size_t i, const double* v) { projection[i] = v[0]; });
    if (!(projection[1] > 0)) in.fail("projection: the focal length must be greater than 0");
    lines.projection = {projection[0] != 0, projection[1], {projection[2], projection[3]}, projection[4]};
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

KeptSurface kept_surface(const Film& film) {
    const Image& image = film.image();
    std::array<const std::uint16_t*, 4> planes{};
    for (std::size_t k = 0; k < planes.size(); ++k) {
        constexpr std::array<std::string_view, 4> kNames = {"R", "G", "B", "A"};
        if (const Channel* const channel = image.find(kNames[k])) planes[k] = channel->as<std::uint16_t>().data();
        if (planes[k] == nullptr) throw UsageError("--save-surface: needs the layer beauty");
    }
    KeptSurface surface{film.display().width(), film.display().height(), {}};
    surface.pixels.resize(static_cast<std::size_t>(surface.width) * static_cast<std::size_t>(surface.height));
    for (std::size_t i = 0; i < surface.pixels.size(); ++i) {
        for (std::size_t k = 0; k < planes.size(); ++k) surface.pixels[i][k] = float_from_half(planes[k][i]);
    }
    return surface;
}

void write_lines_file(ByteSink& file, const FoundLines& lines, const KeptSurface& surface) {
    ArrayWriter out;
    add_pieces(lines, out);
    add_chains(lines, out);
    add_picture(lines, surface, out);
    out.write(file, metadata_of(lines, surface));
}

LinesFile read_lines_file(const std::string& path) {
    const MappedFile file(path);
    const ArrayReader in(path, file.bytes());
    const MetadataReader data(in);
    LinesFile result;
    read_picture(in, data, result.lines);
    read_pieces(in, result.lines);
    read_chains(in, result.lines);
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
