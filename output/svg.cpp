#include "output/svg.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>
#include <vector>

#include "image/image_io.h"
#include "output/path_data.h"
#include "output/xml_text.h"
#include "shading/ink/line_random.h"

namespace burin {
namespace {

std::string hex_color(glm::vec3 linear) {
    std::string text = "#";
    for (int k = 0; k < 3; ++k) {
        const float code = srgb_from_linear(std::clamp(linear[k], 0.0f, 1.0f));
        const int byte = std::clamp(static_cast<int>(code * 255.0f + 0.5f), 0, 255);
        for (const int digit : {byte / 16, byte % 16}) text += "0123456789abcdef"[digit];
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

/// Round ends belong to a dash: it is shorter by the width of the pen, and a dash that is no longer is a dot.
void set_dashes(const VectorStyle& style, float phase_px, Attributes& a) {
    if (style.dash_px.empty()) return;
    const double ends = style.caps == StrokeCaps::round ? static_cast<double>(style.width_px) : 0;
    double first = 0;
    std::string text;
    for (std::size_t i = 0; i + 1 < style.dash_px.size(); i += 2) {
        const auto on = static_cast<double>(style.dash_px[i]), off = static_cast<double>(style.dash_px[i + 1]);
        const double shorter = std::min(on, ends);
        if (i == 0) first = shorter;
        double next = std::min(static_cast<double>(style.dash_px[i + 2 < style.dash_px.size() ? i + 2 : 0]), ends);
        text +=
            (text.empty() ? "" : " ") + short_number(on - shorter) + " " + short_number(off + 0.5 * (shorter + next));
    }
    a[kDashes] = text;
    a[kDashPhase] = short_number(static_cast<double>(phase_px) - 0.5 * first);
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
        const PixelRect& crop = drawing_.crop;
        const auto mm = [this](int px) { return short_number(px * 25.4 / drawing_.dpi) + "mm"; };
        out_ += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"";
        out_ += " xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" version=\"1.1\"";
        out_ += " width=\"" + mm(crop.width()) + "\" height=\"" + mm(crop.height()) + "\" viewBox=\"";
        for (const int v : {crop.x0, crop.y0, crop.width(), crop.height()})
            out_ += (out_.back() == '"' ? "" : " ") + std::to_string(v);
        out_ += '"';
        root_ = defaults();
        if (!drawing_.paths.empty()) {
            const Attributes common = common_of(drawing_.paths);
            for (const Attribute a : {kStroke, kWidth, kCaps}) {
                if (!common[a].empty()) root_[a] = common[a];
            }
        }
        for (const Attribute a : {kFill, kStroke, kWidth, kCaps}) add(kNames[a], root_[a]);
        out_ += " stroke-linejoin=\"round\">\n";
        if (drawing_.paper) {
            out_ += "<rect id=\"paper\"";
            add("x", std::to_string(crop.x0));
            add("y", std::to_string(crop.y0));
            add("width", std::to_string(crop.width()));
            add("height", std::to_string(crop.height()));
            add("fill", hex_color(*drawing_.paper));
            out_ += " stroke=\"none\"/>\n";
        }
    }

    /// Adds the layer that begins with a group, and returns the number of the first group after it.
    std::size_t add_layer(std::size_t begin) {
        const VectorGroup& first = drawing_.groups[begin];
        const auto is_of_layer = [&first](const VectorGroup& g) {
            return g.is_hidden == first.is_hidden && g.invisibility == first.invisibility;
        };
        std::string name = first.is_hidden ? "hidden" : "visible";
        if (first.invisibility > 0) name += "-" + std::to_string(first.invisibility);
        std::string label = first.is_hidden ? "2 hidden" : "1 visible";
        if (first.invisibility > 0)
            label = std::to_string(1 + first.invisibility) + " hidden " + std::to_string(first.invisibility);
        out_ += "<g";
        add("id", unique("layer-" + name));
        add("inkscape:groupmode", "layer");
        add("inkscape:label", label);
        out_ += ">\n";
        for (; begin < drawing_.groups.size() && is_of_layer(drawing_.groups[begin]); ++begin) {
            if (is_of_layer(drawing_.groups[begin])) add_group(drawing_.groups[begin], name);
        }
        out_ += "</g>\n";
        return begin;
    }

    void add_group(const VectorGroup& group, const std::string& layer) {
        const std::span<const VectorPath> paths = drawing_.paths_of(group);
        Attributes common = common_of(paths);
        const bool is_object = drawing_.grouping == VectorGrouping::object;
        std::string id = layer + "-";
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
        out_ += "<path";
        const std::span<const std::uint64_t> edges = drawing_.edges_of(path);
        if (options_.has_names) add("id", unique((group.is_hidden ? "h" : "v") + (edges.empty() ? "" : hex(edges[0]))));
        const Attributes own = attributes_of(path);
        for (std::size_t a = 0; a < kAttributeCount; ++a) {
            if (own[a].empty() || own[a] == inherited[a] || (a >= kStyleCount && !options_.has_names)) continue;
            add(kNames[a], own[a]);
        }
        if (options_.has_names && !edges.empty()) {
            std::string names;
            for (const std::uint64_t edge : edges) names += (names.empty() ? "" : " ") + hex(edge);
            add("data-edge", names);
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
        if (style.is_outline()) {
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
        a[kInvisibility] = std::to_string(path.invisibility);
        return a;
    }
    /// Attributes that all of some paths have; the others are empty.
    Attributes common_of(std::span<const VectorPath> paths) const {
        Attributes common = attributes_of(paths.front());
        for (const VectorPath& path : paths.subspan(1)) {
            const Attributes own = attributes_of(path);
            for (std::size_t a = 0; a < kAttributeCount; ++a) {
                if (own[a] != common[a]) common[a].clear();
            }
        }
        return common;
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
