#include "methods/explain_strokes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "base/stream_store.h"
#include "image/image_io.h"
#include "mesh/text_scan.h"
#include "methods/abuffer.h"
#include "render/line_shading.h"
#include "shading/ink/ink_lines.h"
#include "shading/ink/line_columns.h"
#include "shading/ink/stroke_values.h"
#include "shading/sheet/compiled_sheet.h"
#include "shading/sheet/style_sheet.h"
#include "strokes/ink_printer.h"

namespace burin {
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

double distance_to(glm::dvec2 place, glm::dvec2 a, glm::dvec2 b, double& share) {
    const glm::dvec2 way = b - a;
    const double square = glm::dot(way, way);
    share = square > 0 ? std::clamp(glm::dot(place - a, way) / square, 0.0, 1.0) : 0;
    return glm::distance(place, a + way * share);
}

/// How a value stands in the sheet.
std::string text_of(const StyleValue& value) {
    switch (value.kind) {
        case StyleValue::Kind::expression:
            return " = " + printable(value.source.text, 400);
        case StyleValue::Kind::ramp:
            return " = ramp over " + printable(value.source.text, 400);
        default:
            return "";
    }
}

/// StrokeExplainer has the strokes that reach a pixel.
class StrokeExplainer {
  public:
    StrokeExplainer(const Frame& frame, int x, int y)
        : frame_(frame),
          sheet_(*frame.sheet),
          x_(x),
          y_(y),
          surfaces_({0, 0, frame.width, frame.height}, frame.crop,
                    {true, false, false, false, false, false, false, false, {}}, frame.criteria.classes),
          found_(found_lines(find_drawing(frame, {}, surfaces_), frame, 0)),
          columns_(found_, sheet_.needs().classes, all_variables()) {
        inked_ = ink_lines(found_, sheet_, 0, notes_);
        inked_.filter = frame.scene->lines.style.filter;
        pixel_ = frame;
        pixel_.crop = {x, y, x + 1, y + 1};
        for (std::size_t i = 0; i < inked_.strokes.size(); ++i) {
            if (reaches(inked_.strokes[i])) near_.push_back(i);
        }
        std::stable_sort(near_.begin(), near_.end(), [this](std::size_t a, std::size_t b) {
            const InkStroke &s = inked_.strokes[a], &t = inked_.strokes[b];
            if (s.order != t.order) return s.order < t.order;
            const float p = nearness(s), q = nearness(t);
            return p != q ? p > q : s.chain < t.chain;
        });
    }

    std::string text() const {
        std::string text;
        std::vector<std::size_t> drawn;
        double before = 0;
        for (const std::size_t i : near_) {
            const double covers = ink_of({i});
            if (covers == 0) continue;
            drawn.push_back(i);
            const double all = ink_of(drawn);
            text += describe(drawn.size(), inked_.strokes[i], covers, std::max(all - before, 0.0));
            before = all;
        }
        return text.empty() ? "the style sheet draws nothing in this pixel\n" : text;
    }

  private:
    static VariableSet all_variables() {
        VariableSet all;
        for (std::size_t v = 0; v < kVariableCount; ++v) all.add(static_cast<Variable>(v));
        return all;
    }
    glm::dvec2 middle() const { return {x_ + 0.5, y_ + 0.5}; }

    bool reaches(const InkStroke& stroke) const {
        const auto points = inked_.points_of(stroke);
        double share = 0;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const double radius = 0.5 * static_cast<double>(std::max(points[i].width_px, points[i + 1].width_px));
            if (distance_to(middle(), points[i].place, points[i + 1].place, share) < radius + 3) return true;
        }
        return false;
    }
    float nearness(const InkStroke& stroke) const {
        const auto points = inked_.points_of(stroke);
        double least = std::numeric_limits<double>::infinity(), share = 0;
        float nearness = 0;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const double distance = distance_to(middle(), points[i].place, points[i + 1].place, share);
            if (distance >= least) continue;
            least = distance;
            nearness = points[i].nearness;
        }
        return nearness;
    }
    /// How much ink some of the strokes leave in the pixel.
    double ink_of(const std::vector<std::size_t>& strokes) const {
        InkedLines some = inked_;
        some.strokes.clear();
        for (const std::size_t i : strokes) some.strokes.push_back(inked_.strokes[i]);
        Film film({0, 0, frame_.width, frame_.height}, pixel_.crop,
                  {true, false, false, false, false, false, false, false, {}}, frame_.criteria.classes);
        film.put_background(x_, x_ + 1, y_);
        finish_stream_stores();
        draw_ink(pixel_, some, 1, film);
        const Channel* const alpha = film.image().find("A");
        return alpha == nullptr ? 0 : film.image().value(*alpha, 0, 0);
    }

    /// The place of the stroke's line that is nearest to the pixel.
    LineSample sample_of(const InkStroke& stroke) const {
        const auto run = static_cast<std::uint32_t>(stroke.chain >> 3);
        const LineRun& r = found_.runs.runs[run];
        LineSample best{run, static_cast<std::uint32_t>(r.first), 0};
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = r.first; i < r.first + r.count; ++i) {
            double share = 0;
            const LinePiece& piece = found_.runs.pieces[i].piece;
            const double distance = distance_to(middle(), piece.from, piece.to, share);
            if (distance >= least) continue;
            least = distance;
            best = {run, static_cast<std::uint32_t>(i), share};
        }
        return best;
    }

    std::string name_of_owner(std::uint32_t object, std::uint32_t material) const {
        std::string name = object == 0 ? "background" : printable(found_.objects[object - 1].name, 100);
        if (material != 0) name += "/" + printable(found_.materials[material - 1], 100);
        return name;
    }

    /// Why a set does not take a piece; empty: it does, or its `select` is false.
    std::string refusal(const CompiledSet& set, const LineSample& sample) const {
        const LinePiece& piece = found_.runs.pieces[sample.piece].piece;
        const LineClass c = sheet_.class_of(piece.classes).value_or(piece.drawn_as);
        if (!set.is_enabled) return "it is not enabled";
        if (!set.classes.has(c)) return "class " + std::string(name_of(c)) + " is not in its classes";
        if (piece.invisibility < set.qi[0] || piece.invisibility > set.qi[1])
            return "qi " + std::to_string(piece.invisibility) + " is not in its range";
        const LineSides& sides = found_.sides[sample.piece];
        const auto has = [](const std::vector<bool>& taken, std::uint32_t number) {
            return number < taken.size() && taken[number];
        };
        if (set.has_object_globs && !has(set.objects, sides.front_object) && !has(set.objects, sides.other_object))
            return "no object fits its objects";
        if (set.has_material_globs && !has(set.materials, sides.front_material) &&
            !has(set.materials, sides.other_material))
            return "no material fits its materials";
        return "its select is false";
    }

    std::string describe(std::size_t rank, const InkStroke& stroke, double covers, double shows) const {
        const LineSample sample = sample_of(stroke);
        const LinePiece& piece = found_.runs.pieces[sample.piece].piece;
        const LineRun& run = found_.runs.runs[sample.run];
        const LineSides& sides = found_.sides[sample.piece];
        const CompiledSet& set = sheet_.sets()[stroke.order.set];
        const SheetStyle& style = frame_.scene->sheet->styles[set.style];
        std::string text = std::to_string(rank) + " set " + printable(set.name, 100);
        std::string refusals;
        for (std::uint32_t earlier = 0; earlier < stroke.order.set; ++earlier) {
            const CompiledSet& other = sheet_.sets()[earlier];
            if (other.also && refusal(other, sample) == "its select is false" && !other.has_select) continue;
            refusals += (refusals.empty() ? " (" : "; ") + printable(other.name, 100) + ": " + refusal(other, sample);
        }
        if (!refusals.empty()) text += refusals + ")";
        text += ", style " + printable(style.name, 100) + ": " +
                std::string(name_of(sheet_.class_of(piece.classes).value_or(piece.drawn_as))) + " of " +
                name_of_owner(sides.front_object, sides.front_material);
        if (sides.other_object != sides.front_object || sides.is_beyond)
            text += (sides.is_beyond ? " before " : " and ") + name_of_owner(sides.other_object, sides.other_material);
        if (piece.invisibility > 0) text += ", behind " + std::to_string(piece.invisibility);
        text += ", chain " + std::to_string(sample.run) + ", s " + number(columns_.at_of(sample)) + " of " +
                number(run.chain_length_px) + " px\n";
        text += "    covers " + number(covers) + ", shows " + number(shows);
        return text + values_of(stroke, sample, style) + "\n";
    }

    std::string values_of(const InkStroke& stroke, const LineSample& sample, const SheetStyle& style) const {
        const CompiledStyle& compiled = sheet_.style_of(stroke.order.set);
        const SampleVariant variant{compiled.settings.seed, static_cast<std::uint32_t>(stroke.chain & 7),
                                    sheet_.sets()[stroke.order.set].name};
        StrokeValues values(columns_, compiled, variant);
        const LineStretch stretch{sample.run, sample.piece, 1};
        const std::vector<ChainValues> chains = values.chain_values({&stretch, 1});
        const ChainValues* const chain = &chains.front();
        std::vector<InkValues> ink;
        values.evaluate({&sample, 1}, {&chain, 1}, ink);
        const auto byte = [](float linear) {
            return static_cast<unsigned>(std::lround(srgb_from_linear(std::clamp(linear, 0.0f, 1.0f)) * 255.0f));
        };
        char color[16];
        std::snprintf(color, sizeof color, "#%02x%02x%02x", byte(ink[0].color.r), byte(ink[0].color.g),
                      byte(ink[0].color.b));
        std::string text = "\n    width " + number(ink[0].width_px) + " px" + text_of(style.width);
        text += "\n    opacity " + number(ink[0].opacity) + text_of(style.opacity);
        text += "\n    color " + std::string(color) + text_of(style.color);
        if (ink[0].offset_px != 0) text += "\n    offset " + number(ink[0].offset_px) + " px" + text_of(style.offset);
        SampleColumns read;
        columns_.fill({&sample, 1}, compiled.variables, variant, read, compiled.attributes);
        std::string variables;
        for (std::size_t i = 0; i < compiled.attributes.size(); ++i) {
            variables += (variables.empty() ? "" : ", ") + ("attr(\"" + printable(compiled.attributes[i], 200)) +
                         "\") " + number(read.of_attribute(i)[0]);
        }
        for (const VariableRow& row : variable_table()) {
            for (std::size_t k = 0; k < component_count(row.type); ++k) {
                if (!compiled.variables.has(row.variable, k)) continue;
                variables += (variables.empty() ? "" : ", ") + std::string(row.name);
                if (component_count(row.type) == 3) variables += std::string(".") + "xyz"[k];
                variables += " " + number(read.of(row.variable, k)[0]);
            }
        }
        return variables.empty() ? text : text + "\n    where " + variables;
    }

    const Frame& frame_;
    const CompiledSheet& sheet_;
    int x_, y_;
    Film surfaces_;
    FoundLines found_;
    LineColumns columns_;
    InkedLines inked_;
    std::vector<std::string> notes_;
    Frame pixel_;
    std::vector<std::size_t> near_;  // strokes, top first
};

}  // namespace

std::string explain_strokes(const Frame& frame, int x, int y) { return StrokeExplainer(frame, x, y).text(); }

}  // namespace burin
