#include "output/svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/interrupt.h"
#include "image/image_io.h"
#include "output/path_data.h"
#include "output/vector_layers.h"
#include "output/xml_text.h"
#include "shading/ink/line_random.h"

namespace burin {
namespace {

std::string hex_color(glm::vec3 linear) {
    std::string text = "#";
    const glm::ivec3 codes = srgb_codes(linear);
    for (int k = 0; k < 3; ++k) {
        for (const int digit : {codes[k] / 16, codes[k] % 16}) text += "0123456789abcdef"[digit];
    }
    if (text[1] == text[2] && text[3] == text[4] && text[5] == text[6]) return {'#', text[1], text[3], text[5]};
    return text;
}

std::string hex(std::uint64_t bits) {
    std::string text;
    for (int shift = 44; shift >= 0; shift -= 4) text += "0123456789abcdef"[bits >> shift & 15];
    return text;
}

/// Attributes that a group's children inherit, and those that paths have in common. Empty: not given.
enum Attribute : std::size_t {
    kFill,
    kStroke,
    kWidth,
    kStrokeOpacity,
    kFillOpacity,
    kCaps,
    kDashes,
    kDashPhase,
    kStyleCount,
    kObject = kStyleCount,
    kClass,
    kSet,
    kInvisibility,
    kAttributeCount
};
constexpr std::array<const char*, kAttributeCount> kNames = {
    "fill",         "stroke",         "stroke-width",     "stroke-opacity",
    "fill-opacity", "stroke-linecap", "stroke-dasharray", "stroke-dashoffset",
    "data-object",  "data-class",     "data-set",         "data-qi"};
using Attributes = std::array<std::string, kAttributeCount>;

/// What is drawn without attributes below the root.
Attributes defaults() { return {"none", "#000", "1", "1", "1", "round", "none", "0", "", "", "", ""}; }

void set_dashes(const VectorStyle& style, float phase_px, Attributes& a) {
    const DashPattern pattern = dash_pattern(style, phase_px);
    if (pattern.lengths.empty()) return;
    std::string text;
    for (const double length : pattern.lengths) text += (text.empty() ? "" : " ") + short_number(length);
    a[kDashes] = text;
    a[kDashPhase] = short_number(pattern.phase);
}

/// A length in mm of which readers make this many pixels of 1/96 inch. Some read single precision, and round up what is
/// left of a pixel; so it is never more.
std::string mm_of_pixels(double px) {
    constexpr int kDecimals = 6;
    auto mm = static_cast<float>(px * 25.4 / 96);
    if (mm == std::round(mm)) return short_number(px * 25.4 / 96);
    constexpr double kLeast = 1e-6;
    while (static_cast<double>(mm) / 25.4 * 96 > px - kLeast) mm = std::nextafter(mm, 0.0f);
    return short_number(static_cast<double>(mm), kDecimals);
}

class SvgWriter {
  public:
    SvgWriter(const VectorDrawing& drawing, const SvgOptions& options) : drawing_(drawing), options_(options) {}

    std::string text() {
        begin_root();
        for (std::size_t i = 0; i < drawing_.groups.size();) i = add_layer(i);
        out_ += "</svg>\n";
        return std::move(out_);
    }

  private:
    void begin_root() {
        const ShownArea area = shown_area(drawing_);
        out_ += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"";
        out_ += " xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" version=\"1.1\"";
        // A sheet has its exact size; a picture without one is in pixels.
        const auto mm = [&](int axis) {
            const double px = area.size_px[axis] * area.mm_per_px * 96 / 25.4;
            const bool is_pixels = drawing_.paper_mm.x == 0 && std::abs(px - std::round(px)) < 1e-6;
            return is_pixels ? mm_of_pixels(std::round(px)) : short_number(area.size_mm()[axis]);
        };
        out_ += " width=\"" + mm(0) + "mm\" height=\"" + mm(1) + "mm\" viewBox=\"";
        for (const double v : {area.low_px.x, area.low_px.y, area.size_px.x, area.size_px.y})
            out_ += (out_.back() == '"' ? "" : " ") + short_number(v);
        out_ += '"';
        if (!options_.fingerprint.empty()) out_ += " data-burin-fingerprint=\"" + options_.fingerprint + "\"";
        root_ = defaults();
        if (!drawing_.paths.empty()) {
            const Attributes common = common_of(drawing_.paths, true);
            for (const Attribute a : {kStroke, kWidth, kCaps}) {
                if (!common[a].empty()) root_[a] = common[a];
            }
        }
        for (const Attribute a : {kFill, kStroke, kWidth, kCaps}) add(kNames[a], root_[a]);
        out_ += " stroke-linejoin=\"round\">\n";
        if (drawing_.paper) {
            out_ += "<rect id=\"paper\"";
            add("x", short_number(area.low_px.x));
            add("y", short_number(area.low_px.y));
            add("width", short_number(area.size_px.x));
            add("height", short_number(area.size_px.y));
            add("fill", hex_color(*drawing_.paper));
            out_ += " stroke=\"none\"/>\n";
        }
    }

    /// Adds the layer that begins with a group, and returns the number of the first group after it.
    std::size_t add_layer(std::size_t begin) {
        const VectorGroup& first = drawing_.groups[begin];
        std::string name = first.is_surface ? "surfaces" : first.is_hidden ? "hidden" : "visible";
        if (first.invisibility > 0) name += "-" + std::to_string(first.invisibility);
        out_ += "<g";
        add("id", unique("layer-" + name));
        add("inkscape:groupmode", "layer");
        add("inkscape:label", label_of_layer(first));
        out_ += ">\n";
        for (; begin < drawing_.groups.size() && is_one_layer(drawing_.groups[begin], first); ++begin)
            add_group(drawing_.groups[begin], name);
        out_ += "</g>\n";
        return begin;
    }

    void add_group(const VectorGroup& group, const std::string& layer) {
        const std::span<const VectorPath> paths = drawing_.paths_of(group);
        Attributes common = common_of(paths);
        const bool is_object = group.is_surface || drawing_.grouping == VectorGrouping::object;
        std::string id = layer + "-" + view_prefix(group);
        if (is_object) {
            id += group.object == 0 ? "none" : "o" + hex(LineHash().add(object_name(group.object)).bits());
        } else {
            common[kClass] = name_of(group.line_class);
            if (group.set < drawing_.sets.size()) common[kSet] = drawing_.sets[group.set];
            id += "s" + std::to_string(group.set) + "-" + common[kClass];
        }
        out_ += "<g";
        add("id", unique(id));
        if (is_object && group.object > 0) {
            add("inkscape:label", object_name(group.object));
        } else if (!is_object) {
            add("class", common[kClass]);
        }
        Attributes inherited = root_;
        for (std::size_t a = 0; a < kAttributeCount; ++a) {
            if (common[a].empty() || common[a] == inherited[a]) continue;
            if (a >= kStyleCount && !options_.has_names) continue;
            inherited[a] = common[a];
            add(kNames[a], common[a]);
        }
        out_ += ">\n";
        for (const VectorPath& path : paths) add_path(path, group, inherited);
        out_ += "</g>\n";
    }

    void add_path(const VectorPath& path, const VectorGroup& group, const Attributes& inherited) {
        throw_if_interrupted();
        out_ += "<path";
        const std::span<const std::uint64_t> edges = drawing_.edges_of(path);
        if (options_.has_names) {
            const std::string id = group.is_surface
                                       ? "s" + name_of_region(path)
                                       : (group.is_hidden ? "h" : "v") + (edges.empty() ? "" : hex(edges[0]));
            add("id", unique(view_prefix(group) + id));
        }
        const Attributes own = attributes_of(path);
        for (std::size_t a = 0; a < kAttributeCount; ++a) {
            if (own[a].empty() || own[a] == inherited[a] || (a >= kStyleCount && !options_.has_names)) continue;
            add(kNames[a], own[a]);
        }
        if (options_.has_names && !edges.empty()) {
            std::string names;
            for (const std::uint64_t edge : edges) names += (names.empty() ? "" : " ") + hex(edge);
            add("data-edge", names);
            if (path.unnamed_edges > 0) add("data-edge-count", std::to_string(path.edge_count + path.unnamed_edges));
        }
        // There is no other way to say this.
        if (drawing_.styles[path.style].blend == InkBlend::multiply) add("style", "mix-blend-mode:multiply");
        add("d", path_data(path, drawing_.steps_of(path)));
        out_ += "/>\n";
    }

    Attributes attributes_of(const VectorPath& path) const {
        const VectorStyle& style = drawing_.styles[path.style];
        Attributes a = defaults();
        const std::string opacity = short_number(static_cast<double>(style.opacity));
        if (style.is_region && !style.is_outline()) {
            a[kFill] = a[kStroke] = hex_color(style.color);
            a[kWidth] = short_number(static_cast<double>(style.width_px));
            a[kCaps] = root_[kCaps];
        } else if (style.is_outline()) {
            a[kFill] = hex_color(style.color);
            a[kFillOpacity] = opacity;
            a[kStroke] = "none";
            a[kWidth] = root_[kWidth];
            a[kCaps] = root_[kCaps];
        } else {
            a[kStroke] = hex_color(style.color);
            a[kStrokeOpacity] = opacity;
            a[kWidth] = short_number(static_cast<double>(style.width_px));
            a[kCaps] = style.caps == StrokeCaps::round ? "round" : "butt";
            set_dashes(style, path.dash_phase_px, a);
        }
        a[kObject] = path.object == 0 ? "" : object_name(path.object);
        if (!style.is_region) a[kInvisibility] = std::to_string(path.invisibility);
        return a;
    }
    /// A name of what is seen of an object in one colour.
    std::string name_of_region(const VectorPath& path) const {
        const VectorStyle& style = drawing_.styles[path.style];
        LineHash hash;
        hash.add(path.object == 0 ? std::string() : object_name(path.object));
        hash.add(hex_color(style.color) + " " + short_number(static_cast<double>(style.opacity)));
        return hex(hash.bits());
    }
    /// Attributes that all of some paths have; the others are empty. `of_lines`: the other paths do not count.
    Attributes common_of(std::span<const VectorPath> paths, bool of_lines = false) const {
        Attributes common = attributes_of(paths.front());
        bool is_first = true;
        for (const VectorPath& path : paths) {
            throw_if_interrupted();
            if (of_lines && drawing_.styles[path.style].is_region) continue;
            const Attributes own = attributes_of(path);
            if (std::exchange(is_first, false)) common = own;
            for (std::size_t a = 0; a < kAttributeCount; ++a) {
                if (own[a] != common[a]) common[a].clear();
            }
        }
        return common;
    }
    /// What begins the ids of one of several views.
    std::string view_prefix(const VectorGroup& group) const {
        return group.view > 0 ? drawing_.views[group.view - 1] + "-" : "";
    }
    const std::string& object_name(std::uint32_t object) const { return drawing_.objects[object - 1]; }

    /// An id that no element before has: the same with a number behind it from the second one on.
    std::string unique(const std::string& id) {
        const std::size_t count = ++count_of(id);
        return count == 1 ? id : id + "-" + std::to_string(count);
    }
    std::size_t& count_of(const std::string& id) { return counts_[id]; }

    void add(const char* name, const std::string& value) {
        out_ += ' ';
        out_ += name;
        out_ += "=\"" + xml_text(value) + '"';
    }

    const VectorDrawing& drawing_;
    const SvgOptions& options_;
    Attributes root_;
    std::unordered_map<std::string, std::size_t> counts_;
    std::string out_;
};

}  // namespace

std::string svg_of(const VectorDrawing& drawing, const SvgOptions& options) {
    return SvgWriter(drawing, options).text();
}

}  // namespace burin
