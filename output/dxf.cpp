#include "output/dxf.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "base/interrupt.h"
#include "output/path_data.h"
#include "output/paths/dash_pattern.h"
#include "output/paths/path_order.h"
#include "output/utf8.h"
#include "output/vector_layers.h"

namespace burin {
namespace {

/// AutoCAD's colour index: named colours, then 24 hues, each at five values, full and pale, then greys.
std::array<glm::ivec3, 256> make_palette() {
    std::array<glm::ivec3, 256> palette{};
    constexpr glm::ivec3 kNamed[] = {{0, 0, 0},   {255, 0, 0},   {255, 255, 0}, {0, 255, 0},     {0, 255, 255},
                                     {0, 0, 255}, {255, 0, 255}, {0, 0, 0},     {128, 128, 128}, {192, 192, 192}};
    std::copy(std::begin(kNamed), std::end(kNamed), palette.begin());
    constexpr int kValues[] = {255, 165, 127, 76, 38};
    for (int i = 10; i < 250; ++i) {
        const double hue = (i - 10) / 10 * 15 / 60.0;
        const int value = kValues[i % 10 / 2];
        for (int k = 0; k < 3; ++k) {
            // How much of red, green and blue a hue has: 1 within a sixth of its own, 0 from two sixths on.
            double apart = std::abs(hue - 2 * k);
            apart = std::min(apart, 6 - apart);
            double part = std::clamp(2 - apart, 0.0, 1.0);
            if (i % 2 == 1) part = 0.5 + 0.5 * part;
            palette[static_cast<std::size_t>(i)][k] = static_cast<int>(part * value);
        }
    }
    constexpr int kGreys[] = {51, 80, 105, 130, 190, 255};
    for (std::size_t i = 0; i < 6; ++i) palette[250 + i] = glm::ivec3(kGreys[i]);
    return palette;
}

int square_apart(glm::ivec3 a, glm::ivec3 b) {
    const glm::ivec3 d = a - b;
    return d.x * d.x + d.y * d.y + d.z * d.z;
}

/// A name as release 12 has them: letters, digits, $, - and _, at most 31.
std::string plain_name(std::string_view text) {
    constexpr std::size_t kMost = 31;
    std::string name;
    while (!text.empty() && name.size() < kMost) {
        const Utf8Character c = first_character(text);
        text.remove_prefix(c.bytes);
        const char letter = c.code < 0x80 ? static_cast<char>(c.code) : '_';
        if (letter >= 'a' && letter <= 'z') {
            name += static_cast<char>(letter - 'a' + 'A');
        } else if ((letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9') || letter == '$' ||
                   letter == '-') {
            name += letter;
        } else {
            name += '_';
        }
    }
    return name;
}

class DxfWriter {
  public:
    DxfWriter(const VectorDrawing& drawing, const DxfOptions& options)
        : drawing_(drawing), options_(options), area_(shown_area(drawing)) {}

    std::string text(std::vector<std::string>& notes) {
        name_layers();
        name_dashes();
        add_header();
        add_tables();
        add_entities();
        if (renamed_ > 0) {
            notes.push_back("DXF R12: the names of " + std::to_string(renamed_) +
                            (renamed_ == 1 ? " layer are" : " layers are") +
                            " not those of objects: they have letters, digits, $, - and _ only, at most 31");
        }
        if (regions_ > 0) {
            notes.push_back("DXF R12 has no filled regions: " + std::to_string(regions_) +
                            (regions_ == 1 ? " region of a surface is" : " regions of surfaces are") + " left out");
        }
        add_note(transparent_, " drawn opaque", notes);
        add_note(faded_, " left out, paler than half of the strongest of its set", notes);
        add_note(outlines_, " the outline of a stroke whose width varies, not filled", notes);
        add_note(recolored_, " in the nearest of 255 colours", notes);
        return std::move(out_);
    }

  private:
    static void add_note(std::size_t count, const char* what, std::vector<std::string>& notes) {
        if (count == 0) return;
        notes.push_back("DXF R12: " + std::to_string(count) + (count == 1 ? " path is" : " paths are") + what);
    }

    void group(int code, const std::string& value) { out_ += std::to_string(code) + "\n" + value + "\n"; }
    void number(int code, double value) { group(code, short_number(value)); }

    void name_layers() {
        std::map<std::string, std::size_t> numbers;  // what a layer is: its number
        std::map<std::string, int> counts;           // of names that were wanted
        std::set<std::string> taken;
        for (const VectorGroup& g : drawing_.groups) {
            if (g.is_surface) {
                regions_ += g.path_count;
                layer_of_group_.push_back(0);
                continue;
            }
            std::string prefix = g.is_hidden ? "HIDDEN_" : "VISIBLE_";
            if (g.is_hidden && g.invisibility > 0) prefix += std::to_string(g.invisibility) + "_";
            const bool is_object = drawing_.grouping == VectorGrouping::object;
            std::string object = is_object && g.object > 0 ? drawing_.objects[g.object - 1] : "";
            if (is_object && object.empty()) object = g.object > 0 ? "OBJECT" : "NO_OBJECT";
            const std::string what = is_object ? std::to_string(g.object) + object : std::string(name_of(g.line_class));
            const auto [found, is_new] = numbers.try_emplace(prefix + what, layers_.size());
            if (is_new) {
                const std::string whole = prefix + (is_object ? object : what), wanted = plain_name(whole);
                const auto is_same = [](unsigned char a, unsigned char b) { return std::toupper(a) == b; };
                std::string name = wanted;
                int& count = counts[wanted];
                if (count == 0) count = 1;
                while (!taken.insert(name).second) {
                    const std::string end = "-" + std::to_string(++count);
                    name = wanted.substr(0, 31 - end.size()) + end;
                }
                if (!std::equal(whole.begin(), whole.end(), name.begin(), name.end(), is_same)) ++renamed_;
                const auto paths = drawing_.paths_of(g);
                layers_.push_back({name, paths.empty() ? nullptr : &drawing_.styles[paths.front().style]});
            }
            layer_of_group_.push_back(found->second);
        }
    }

    void name_dashes() {
        std::map<std::vector<float>, std::size_t> counts;
        for (const VectorPath& path : drawing_.paths) {
            const std::vector<float>& dash_px = drawing_.styles[path.style].dash_px;
            if (!dash_px.empty()) ++counts[dash_px];
        }
        // Line types have no phase, so what stretches a pattern to the length of a loop is left out: patterns that are
        // one have the name of that which most paths have.
        using Counted = std::pair<std::vector<float>, std::size_t>;
        std::vector<Counted> order(counts.begin(), counts.end());
        std::stable_sort(order.begin(), order.end(),
                         [](const Counted& a, const Counted& b) { return a.second > b.second; });
        for (const Counted& counted : order) {
            const std::vector<float>& dash_px = counted.first;
            const auto same = std::find_if(line_types_.begin(), line_types_.end(),
                                           [&](const auto& known) { return is_one_pattern(known, dash_px); });
            dashes_[dash_px] = "DASHES_" + std::to_string(same - line_types_.begin() + 1);
            if (same == line_types_.end()) line_types_.push_back(dash_px);
        }
    }
    std::string line_type(const VectorStyle* style) const {
        return style == nullptr || style->dash_px.empty() ? "CONTINUOUS" : dashes_.find(style->dash_px)->second;
    }
    static int color_of(const VectorStyle* style) {
        return style == nullptr ? 7 : nearest_color_index(srgb_codes(style->color));
    }

    void add_header() {
        if (!options_.fingerprint.empty()) group(999, "burin/fingerprint " + options_.fingerprint);
        const glm::dvec2 size = area_.size_mm();
        group(0, "SECTION");
        group(2, "HEADER");
        group(9, "$ACADVER");
        group(1, "AC1009");
        group(9, "$INSUNITS");  // of later releases, which readers of this one look at: millimetres
        group(70, "4");
        for (const char* name : {"$EXTMIN", "$LIMMIN"}) add_place(name, {0, 0});
        for (const char* name : {"$EXTMAX", "$LIMMAX"}) add_place(name, size);
        group(9, "$PLINEGEN");  // dashes run on over the corners of polylines
        group(70, "1");
        group(0, "ENDSEC");
    }
    void add_place(const std::string& name, glm::dvec2 at) {
        group(9, name);
        number(10, at.x);
        number(20, at.y);
        if (name.starts_with("$EXT")) number(30, 0);
    }

    void begin_table(const char* name, std::size_t entries) {
        group(0, "TABLE");
        group(2, name);
        group(70, std::to_string(entries));
    }
    void add_tables() {
        group(0, "SECTION");
        group(2, "TABLES");
        begin_table("LTYPE", line_types_.size() + 1);
        add_line_type("CONTINUOUS", {});
        for (const std::vector<float>& dash_px : line_types_) add_line_type(dashes_.at(dash_px), dash_px);
        group(0, "ENDTAB");
        begin_table("LAYER", layers_.size() + 1);
        add_layer("0", nullptr);
        for (const Layer& layer : layers_) add_layer(layer.name, layer.first_style);
        group(0, "ENDTAB");
        group(0, "ENDSEC");
    }
    void add_line_type(const std::string& name, const std::vector<float>& dash_px) {
        double length = 0;
        for (const float part : dash_px) length += static_cast<double>(part) * area_.mm_per_px;
        group(0, "LTYPE");
        group(2, name);
        group(70, "0");
        group(3, dash_px.empty() ? "Solid line" : "__ __ __ __ __");
        group(72, "65");
        group(73, std::to_string(dash_px.size()));
        number(40, length);
        for (std::size_t i = 0; i < dash_px.size(); ++i)
            number(49, static_cast<double>(dash_px[i]) * area_.mm_per_px * (i % 2 == 0 ? 1 : -1));
    }
    void add_layer(const std::string& name, const VectorStyle* style) {
        group(0, "LAYER");
        group(2, name);
        group(70, "0");
        group(62, std::to_string(color_of(style)));
        group(6, line_type(style));
    }

    void add_entities() {
        group(0, "SECTION");
        group(2, "ENTITIES");
        const std::vector<float> least = least_opacities(drawing_);
        for (std::size_t i = 0; i < drawing_.groups.size(); ++i) {
            if (drawing_.groups[i].is_surface) continue;
            for (const VectorPath& path : drawing_.paths_of(drawing_.groups[i])) {
                if (drawing_.styles[path.style].opacity < least[i]) {
                    ++faded_;
                } else {
                    add_path(path, layers_[layer_of_group_[i]]);
                }
            }
        }
        group(0, "ENDSEC");
        group(0, "EOF");
    }

    struct Layer {
        std::string name;
        const VectorStyle* first_style;  ///< nullptr: it has no path
    };

    void add_path(const VectorPath& path, const Layer& layer) {
        throw_if_interrupted();
        const VectorStyle& style = drawing_.styles[path.style];
        if (style.opacity < 1 || style.blend != InkBlend::over) ++transparent_;
        if (style.is_outline()) ++outlines_;
        const glm::ivec3 codes = srgb_codes(style.color);
        const int color = nearest_color_index(codes);
        if (square_apart(palette()[static_cast<std::size_t>(color)], codes) > 0) ++recolored_;

        std::vector<glm::dvec2> points = flattened(path, drawing_.steps_of(path), options_.tolerance_px);
        if (path.is_closed && points.size() > 2) points.pop_back();
        group(0, "POLYLINE");
        group(8, layer.name);
        if (color != color_of(layer.first_style)) group(62, std::to_string(color));
        if (line_type(&style) != line_type(layer.first_style)) group(6, line_type(&style));
        group(66, "1");
        for (const int code : {10, 20, 30}) group(code, "0");
        group(70, std::to_string((path.is_closed ? 1 : 0) + (style.dash_px.empty() ? 0 : 128)));
        if (style.width_px > 0) {
            const double width = static_cast<double>(style.width_px) * area_.mm_per_px;
            number(40, width);
            number(41, width);
        }
        const double top = area_.low_px.y + area_.size_px.y;
        for (const glm::dvec2 p : points) {
            group(0, "VERTEX");
            group(8, layer.name);
            number(10, (p.x - area_.low_px.x) * area_.mm_per_px);
            number(20, (top - p.y) * area_.mm_per_px);
            group(30, "0");
        }
        group(0, "SEQEND");
        group(8, layer.name);
    }

  public:
    static const std::array<glm::ivec3, 256>& palette() {
        static const std::array<glm::ivec3, 256> kPalette = make_palette();
        return kPalette;
    }

  private:
    const VectorDrawing& drawing_;
    const DxfOptions& options_;
    ShownArea area_;
    std::vector<Layer> layers_;
    std::vector<std::size_t> layer_of_group_;
    std::map<std::vector<float>, std::string> dashes_;  ///< names of patterns, several of which may have one
    std::vector<std::vector<float>> line_types_;
    std::size_t regions_ = 0, renamed_ = 0, transparent_ = 0, outlines_ = 0, recolored_ = 0, faded_ = 0;
    std::string out_;
};

}  // namespace

int nearest_color_index(glm::ivec3 codes) {
    if (codes == glm::ivec3(0)) return 7;
    const auto& palette = DxfWriter::palette();
    int nearest = 1;
    for (int i = 2; i < 256; ++i) {
        if (square_apart(palette[static_cast<std::size_t>(i)], codes) <
            square_apart(palette[static_cast<std::size_t>(nearest)], codes))
            nearest = i;
    }
    return nearest;
}

std::string dxf_of(const VectorDrawing& drawing, const DxfOptions& options, std::vector<std::string>& notes) {
    return DxfWriter(drawing, options).text(notes);
}

}  // namespace burin
