#include "methods/explain_strokes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/stream_store.h"
#include "mesh/text_scan.h"
#include "methods/abuffer.h"
#include "shading/ink/ink_lines.h"
#include "shading/ink/line_columns.h"
#include "shading/line_shader.h"
#include "shading/sheet/compiled_sheet.h"
#include "shading/sheet/style_sheet.h"
#include "strokes/ink_printer.h"

namespace burin {
namespace {

constexpr const char* kSelect = "its select is false";

double distance_to(glm::dvec2 place, glm::dvec2 a, glm::dvec2 b, double& share) {
    const glm::dvec2 way = b - a;
    const double square = glm::dot(way, way);
    share = square > 0 ? std::clamp(glm::dot(place - a, way) / square, 0.0, 1.0) : 0;
    return glm::distance(place, a + way * share);
}

/// How a value stands in the sheet; empty: as a constant.
std::string source_of(const StyleValue& value) {
    switch (value.kind) {
        case StyleValue::Kind::expression:
            return "=" + value.source.text;
        case StyleValue::Kind::ramp:
            return "ramp over " + value.source.text;
        default:
            return "";
    }
}

/// StrokeExplainer has the strokes that reach a pixel.
class StrokeExplainer {
  public:
    /// `reach_px`: how far from the pixel it looks for one with ink.
    StrokeExplainer(const Frame& frame, int x, int y, int reach_px, int threads)
        : frame_(frame),
          sheet_(*frame.sheet),
          x_(x),
          y_(y),
          surfaces_({0, 0, frame.width, frame.height}, frame.crop,
                    {true, false, false, false, false, false, false, false, {}}, frame.criteria.classes),
          found_(lines_for_sheet(find_drawing(frame, {threads}, surfaces_), frame, threads)),
          columns_(found_, sheet_.needs().classes, all_variables()) {
        inked_ = ink_lines(found_, sheet_, threads, notes_);
        inked_.filter = frame.scene->lines.style.filter;
        pixel_ = frame;
        if (reach_px > 0) go_to_nearest_ink(reach_px, threads);
        pixel_.crop = {x_, y_, x_ + 1, y_ + 1};
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

    int x() const { return x_; }
    int y() const { return y_; }

    std::vector<ExplainedStroke> strokes() const {
        std::vector<ExplainedStroke> strokes;
        std::vector<std::size_t> drawn;
        double before = 0;
        for (const std::vector<std::size_t>& parts : near_strokes()) {
            const double covers = ink_of(parts);
            if (covers == 0) continue;
            drawn.insert(drawn.end(), parts.begin(), parts.end());
            const double all = ink_of(drawn);
            strokes.push_back(explained(inked_.strokes[parts.front()]));
            strokes.back().covers = covers;
            strokes.back().shows = std::max(all - before, 0.0);
            before = all;
        }
        return strokes;
    }

  private:
    static VariableSet all_variables() {
        VariableSet all;
        for (std::size_t v = 0; v < kVariableCount; ++v) all.add(static_cast<Variable>(v));
        return all;
    }
    glm::dvec2 middle() const { return {x_ + 0.5, y_ + 0.5}; }

    /// The parts of each stroke that are near, as its dashes are; the strokes in the order of their uppermost parts.
    std::vector<std::vector<std::size_t>> near_strokes() const {
        std::vector<std::vector<std::size_t>> strokes;
        for (const std::size_t i : near_) {
            const auto is_same = [&](const std::vector<std::size_t>& parts) {
                const InkStroke &a = inked_.strokes[parts.front()], &b = inked_.strokes[i];
                return a.chain == b.chain && a.order == b.order;
            };
            const auto known = std::find_if(strokes.begin(), strokes.end(), is_same);
            if (known != strokes.end()) {
                known->push_back(i);
            } else {
                strokes.push_back({i});
            }
        }
        return strokes;
    }

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
    /// What ink alone leaves in a part of the picture.
    Film drawn(const InkedLines& lines, PixelRect part, int threads) const {
        Frame frame = pixel_;
        frame.crop = part;
        Film film({0, 0, frame_.width, frame_.height}, part,
                  {true, false, false, false, false, false, false, false, {}}, frame_.criteria.classes);
        for (int y = part.y0; y < part.y1; ++y) film.put_background(part.x0, part.x1, y);
        finish_stream_stores();
        draw_ink(frame, lines, threads, film);
        return film;
    }
    void go_to_nearest_ink(int reach_px, int threads) {
        const PixelRect around{std::max(x_ - reach_px, 0), std::max(y_ - reach_px, 0),
                               std::min(x_ + reach_px + 1, frame_.width), std::min(y_ + reach_px + 1, frame_.height)};
        const Film film = drawn(inked_, around, threads);
        const Channel* const alpha = film.image().find("A");
        if (alpha == nullptr) return;
        const int from_x = x_, from_y = y_;
        int least = reach_px * reach_px + 1;
        for (int y = around.y0; y < around.y1; ++y) {
            for (int x = around.x0; x < around.x1; ++x) {
                const int square = (x - from_x) * (x - from_x) + (y - from_y) * (y - from_y);
                if (square >= least || film.image().value(*alpha, x - around.x0, y - around.y0) <= 0) continue;
                least = square;
                x_ = x;
                y_ = y;
            }
        }
    }
    /// How much ink some of the strokes leave in the pixel.
    double ink_of(const std::vector<std::size_t>& strokes) const {
        InkedLines some = inked_;
        some.strokes.clear();
        for (const std::size_t i : strokes) some.strokes.push_back(inked_.strokes[i]);
        const Film film = drawn(some, pixel_.crop, 1);
        const Channel* const alpha = film.image().find("A");
        return alpha == nullptr ? 0 : film.image().value(*alpha, 0, 0);
    }

    /// The place of the stroke's line that is nearest to the pixel.
    LineSample sample_of(const InkStroke& stroke) const {
        const auto run = InkStroke::run_of(stroke.chain);
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

    ExplainedSide side_of(std::uint32_t object, std::uint32_t material) const {
        return {object, material, object == 0 ? "" : found_.objects[object - 1].name,
                material == 0 ? "" : found_.materials[material - 1]};
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
        return kSelect;
    }

    ExplainedStroke explained(const InkStroke& stroke) const {
        const LineSample sample = sample_of(stroke);
        const LinePiece& piece = found_.runs.pieces[sample.piece].piece;
        const LineRun& run = found_.runs.runs[sample.run];
        const LineSides& sides = found_.sides[sample.piece];
        const CompiledSet& set = sheet_.sets()[stroke.order.set];
        ExplainedStroke result;
        result.set = set.name;
        result.style = frame_.scene->sheet->styles[set.style].name;
        for (std::uint32_t earlier = 0; earlier < stroke.order.set; ++earlier) {
            const CompiledSet& other = sheet_.sets()[earlier];
            const std::string reason = refusal(other, sample);
            if (other.also && reason == kSelect && !other.has_select) continue;
            result.earlier_sets.push_back({other.name, reason});
        }
        result.drawn_as = sheet_.class_of(piece.classes).value_or(piece.drawn_as);
        result.classes = piece.classes;
        result.is_edge = piece.line.is_edge();
        result.dihedral_deg = static_cast<double>(sides.dihedral_deg);
        result.crease_from_deg = found_.crease_angle_deg[0];
        result.front = side_of(sides.front_object, sides.front_material);
        result.other = side_of(sides.other_object, sides.other_material);
        result.other_is_behind = sides.is_beyond;
        result.invisibility = piece.invisibility;
        result.chain = sample.run;
        result.copy = InkStroke::copy_of(stroke.chain);
        result.s_px = columns_.at_of(sample);
        result.length_px = run.chain_length_px;
        add_values(stroke, sample, result);
        return result;
    }

    void add_values(const InkStroke& stroke, const LineSample& sample, ExplainedStroke& to) const {
        const CompiledSet& set = sheet_.sets()[stroke.order.set];
        const SheetStyle& style = frame_.scene->sheet->styles[set.style];
        const CompiledStyle& compiled = sheet_.style_of(stroke.order.set);
        const SampleVariant variant{compiled.settings.seed, to.copy, set.name};
        StrokeValues values(columns_, compiled, variant, set.test.get());
        const LineStretch stretch{sample.run, sample.piece, 1};
        const std::vector<ChainValues> chains = values.chain_values({&stretch, 1});
        const ChainValues* const chain = &chains.front();
        std::vector<InkValues> ink;
        values.evaluate({&sample, 1}, {&chain, 1}, ink);
        to.ink = ink.front();
        static_assert(kInkValueCount == 4, "each of them has a source");
        to.sources = {source_of(style.width), source_of(style.opacity), source_of(style.offset),
                      source_of(style.color)};
        if (style.shader) to.shader = style.shader->text;
        VariableSet variables = compiled.variables;
        if (set.test) {
            to.test = frame_.scene->sheet->sets[stroke.order.set].test->text;
            variables |= set.test->needs();
        }
        SampleColumns read;
        columns_.fill({&sample, 1}, variables, variant, read, compiled.attributes);
        for (std::size_t i = 0; i < compiled.attributes.size(); ++i) {
            to.variables.push_back(
                {"attr(\"" + printable(compiled.attributes[i], 200) + "\")", {{0, read.of_attribute(i)[0]}}, false});
        }
        for (const VariableRow& row : variable_table()) {
            ExplainedVariable variable{std::string(row.name), {}, component_count(row.type) == 3};
            for (std::size_t k = 0; k < component_count(row.type); ++k) {
                if (variables.has(row.variable, k)) variable.components.emplace_back(k, read.of(row.variable, k)[0]);
            }
            if (!variable.components.empty()) to.variables.push_back(std::move(variable));
        }
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

std::vector<ExplainedStroke> explain_strokes(const Frame& frame, int x, int y, int threads) {
    return StrokeExplainer(frame, x, y, 0, resolve_thread_count(threads)).strokes();
}

ExplainedPlace explain_strokes_near(const Frame& frame, int x, int y, int reach_px, int threads) {
    const StrokeExplainer explainer(frame, x, y, reach_px, resolve_thread_count(threads));
    return {explainer.x(), explainer.y(), explainer.strokes()};
}

}  // namespace burin
