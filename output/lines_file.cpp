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
#include "image/half.h"
#include "mesh/gltf_json.h"
#include "output/lines_format.h"
#include "scene/animation/frame_list.h"
#include "shading/surface/shadow_casters.h"

namespace burin {
namespace {

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
        text.resize((text.size() + sizeof(std::uint64_t) + kLinesAlignment - 1) / kLinesAlignment * kLinesAlignment -
                        sizeof(std::uint64_t),
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

template <typename Matrix>
void put_matrix(const Matrix& m, double* numbers) {
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) *numbers++ = m[c][r];
    }
}
void put_plane(const DepthPlane& p, double* n) {
    n[0] = p.at_origin, n[1] = p.per_x, n[2] = p.per_y, n[3] = p.lowest, n[4] = p.highest;
}
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
    const SurfaceNeeds& surface = lines.surface;
    const auto add_values = [&](const char* name, bool is_known, std::size_t first, std::size_t count) {
        if (!is_known) return;
        out.add<float>(name, 2 * n, count, [&, first, count](std::size_t i, float* v) {
            std::copy_n(&lines.surface_values[i * surface.column_count() + first], count, v);
        });
    };
    add_values("kr", surface.kr, 0, 1);
    add_values("uv", surface.uv, surface.uv_column(), 2);
    add_values("Cv", surface.color, surface.color_column(), 3);
    add_values("attributes", !surface.attributes.empty(), surface.attribute_column(), surface.attributes.size());
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
    out.add<float>("chain_gaps", runs.size(), 4, [&](std::size_t i, float* v) {
        const LineRun& r = runs[i];
        v[0] = r.gaps_px[0], v[1] = r.gaps_px[1], v[2] = r.onward_gaps_px[0], v[3] = r.onward_gaps_px[1];
    });
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

/// What casts shadows: triangles in view space.
void add_casters(const ShadowCasters& casters, ArrayWriter& out) {
    const auto all = casters.casters();
    out.add<double>("casters", all.size(), 10, [&](std::size_t i, double* v) {
        for (int k = 0; k < 3; ++k)
            v[k] = all[i].corner[k], v[3 + k] = all[i].edges[0][k], v[6 + k] = all[i].edges[1][k];
        v[9] = all[i].nearness;
    });
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
    data["format"] = kLinesFormat;
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
    if (lines.has_hidden_chains && !lines.has_chains) data["has_hidden_chains"] = "1";
    data["frame"] = text_of_frame(lines.frame);
    const auto number = [](double value) { return nlohmann::json(value).dump(); };
    data["fps"] = number(lines.fps);
    data["dpi"] = number(lines.dpi);
    const double pixel_aspect = lines.projection.pixel_aspect;
    if (pixel_aspect != 1) data["pixel_aspect"] = nlohmann::json(pixel_aspect).dump();
    if (lines.paper_mm.x > 0) data["paper_mm"] = nlohmann::json{lines.paper_mm.x, lines.paper_mm.y}.dump();
    data["crease_angle"] = nlohmann::json{lines.crease_angle_deg[0], lines.crease_angle_deg[1]}.dump();
    if (const auto& light = lines.scene_light) {
        data["light"] =
            nlohmann::json{light->is_at_point ? 1 : 0, light->place.x, light->place.y, light->place.z}.dump();
    }
    if (lines.casters) {
        const ViewLight& light = lines.casters->light();
        data["shadow_light"] =
            nlohmann::json{light.is_at_point ? 1 : 0, light.place.x, light.place.y, light.place.z}.dump();
        data["shadow_distance"] = number(lines.casters->least_distance());
    }
    data["smooth_contours"] = lines.has_smooth_contours ? "1" : "0";
    data["filter"] = std::to_string(static_cast<int>(lines.filter));
    if (!lines.surface.attributes.empty()) data["attributes"] = names_as_json(lines.surface.attributes);
    if (!surface.pixels.empty()) data["surface_width"] = std::to_string(surface.width);
    return data;
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

void write_lines_file(ByteSink& file, const FoundLines& lines, const KeptSurface& surface,
                      const std::string& fingerprint) {
    ArrayWriter out;
    add_pieces(lines, out);
    add_chains(lines, out);
    add_picture(lines, surface, out);
    if (lines.casters) add_casters(*lines.casters, out);
    std::map<std::string, std::string> metadata = metadata_of(lines, surface);
    if (!fingerprint.empty()) metadata["fingerprint"] = fingerprint;
    out.write(file, metadata);
}

}  // namespace burin
