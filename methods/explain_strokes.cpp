#include "methods/explain_strokes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/stream_store.h"
#include "mesh/text_scan.h"
#include "methods/abuffer.h"
#include "shading/ink/ink_lines.h"
#include "shading/ink/line_chunks.h"
#include "shading/ink/line_columns.h"
#include "shading/line_shader.h"
#include "shading/sheet/compiled_sheet.h"
#include "shading/sheet/style_sheet.h"
#include "strokes/ink_printer.h"

namespace burin {
namespace {

/// Ink that cannot be seen, of a stroke that is there for its halo alone.
constexpr float kNoInk = 1e-9f;

/// Without what such ink and rounding leave.
double cleaned(double share) { return share < 1e-6 ? 0 : share; }

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
          columns_(found_, sheet_.needs().classes, all_variables()),
          matches_(match_pieces(columns_, sheet_)),
          teller_(frame) {
        inked_ = ink_lines(found_, sheet_, threads, notes_);
        inked_.filter = frame.scene->lines.style.filter;
        pixel_ = frame;
        if (reach_px > 0) go_to_nearest_ink(reach_px, threads);
        pixel_.crop = {x_, y_, x_ + 1, y_ + 1};
        for (std::size_t i = 0; i < inked_.strokes.size(); ++i) {
            const InkStroke& stroke = inked_.strokes[i];
            if (reaches(stroke, static_cast<double>(stroke.halo_px))) near_.push_back(i);
        }
        std::stable_sort(near_.begin(), near_.end(), [this](std::size_t a, std::size_t b) {
            const InkStroke &s = inked_.strokes[a], &t = inked_.strokes[b];
            if (s.order != t.order) return s.order < t.order;
            const float p = nearness(s), q = nearness(t);
            return p != q ? p > q : s.chain < t.chain;
        });
        some_.boundaries = inked_.boundaries;
        some_.filter = inked_.filter;
        some_.layers = inked_.layers;
        some_.sets = inked_.sets;
        put_near_strokes();
    }

    int x() const { return x_; }
    int y() const { return y_; }

    std::vector<ExplainedStroke> strokes() {
        std::vector<ExplainedStroke> strokes;
        double before = 0;
        for (std::size_t i = 0; i < near_strokes_.size(); ++i) {
            const double covers = ink_of({&i, 1}, {});
            if (covers == 0) continue;
            const NearStroke& near = near_strokes_[i];
            drawn_.push_back(i);
            // Halos of strokes below erase, too.
            const double all = ink_of(drawn_, halos_without(drawn_));
            strokes.push_back(explained(inked_.strokes[near.parts.front()]));
            ExplainedStroke& stroke = strokes.back();
            stroke.covers = covers;
            stroke.area = ink_of({&i, 1}, {}, true);
            stroke.shows = cleaned(all - before);
            add_erasing(i, stroke);
            before = all;
        }
        return strokes;
    }
    /// After strokes().
    std::vector<UndrawnLine> undrawn(int threads) const {
        std::set<std::pair<std::uint32_t, std::uint32_t>> inked;
        for (const std::size_t i : drawn_) {
            const InkStroke& stroke = inked_.strokes[near_strokes_[i].parts.front()];
            inked.emplace(stroke.order.set, InkStroke::run_of(stroke.chain));
        }
        return undrawn_lines(frame_, {columns_, matches_, inked_}, x_, y_, inked, threads);
    }

  private:
    static VariableSet all_variables() {
        VariableSet all;
        for (std::size_t v = 0; v < kVariableCount; ++v) all.add(static_cast<Variable>(v));
        return all;
    }
    glm::dvec2 middle() const { return {x_ + 0.5, y_ + 0.5}; }

    /// A stroke whose ink or halo may reach the pixel.
    struct NearStroke {
        std::vector<std::size_t> parts;               ///< as its dashes are
        std::vector<InkStroke> inked, opaque, halos;  ///< its near parts in some_: as they are, opaque, without ink
        std::vector<InkStroke> far_halos;             ///< of the parts of which the halo alone may reach the pixel
    };

    /// Puts the points of near strokes into some_. Strokes are in the order of their uppermost parts.
    void put_near_strokes() {
        for (const std::size_t i : near_) {
            const InkStroke& part = inked_.strokes[i];
            const auto is_same = [&](const NearStroke& near) {
                const InkStroke& other = inked_.strokes[near.parts.front()];
                return other.chain == part.chain && other.order == part.order;
            };
            auto known = std::find_if(near_strokes_.begin(), near_strokes_.end(), is_same);
            if (known == near_strokes_.end()) known = near_strokes_.insert(known, NearStroke{});
            known->parts.push_back(i);
            const bool has_ink = reaches(part, 0);
            if (has_ink) {
                known->inked.push_back(put(part, [](float opacity) { return opacity; }));
                known->opaque.push_back(put(part, [](float opacity) { return opacity > 0 ? 1.0f : 0.0f; }));
                known->opaque.back().blend = InkBlend::over;
            }
            if (part.halo_px <= 0) continue;
            known->halos.push_back(put(part, [](float opacity) { return opacity > 0 ? kNoInk : 0.0f; }));
            known->halos.back().blend = InkBlend::over;
            if (!has_ink) known->far_halos.push_back(known->halos.back());
        }
    }
    template <typename Opacity>
    InkStroke put(InkStroke stroke, const Opacity& opacity) {
        const auto points = inked_.points_of(stroke);
        stroke.first_point = some_.points.size();
        for (InkPoint point : points) {
            point.opacity = opacity(point.opacity);
            some_.points.push_back(point);
        }
        return stroke;
    }

    bool reaches(const InkStroke& stroke, double halo_px) const {
        const auto points = inked_.points_of(stroke);
        double share = 0;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const double radius = 0.5 * static_cast<double>(std::max(points[i].width_px, points[i + 1].width_px));
            if (distance_to(middle(), points[i].place, points[i + 1].place, share) < radius + halo_px + 3) return true;
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
    /// How much ink near strokes leave in the pixel, where halos of others erase.
    double ink_of(std::span<const std::size_t> strokes, std::span<const std::size_t> halos, bool is_opaque = false) {
        some_.strokes.clear();
        const auto add = [this](const std::vector<InkStroke>& parts) {
            some_.strokes.insert(some_.strokes.end(), parts.begin(), parts.end());
        };
        for (const std::size_t i : strokes) {
            add(is_opaque ? near_strokes_[i].opaque : near_strokes_[i].inked);
            if (!is_opaque) add(near_strokes_[i].far_halos);
        }
        for (const std::size_t i : halos) add(near_strokes_[i].halos);
        if (some_.strokes.empty()) return 0;
        const Film film = drawn(some_, pixel_.crop, 1);
        const Channel* const alpha = film.image().find("A");
        return alpha == nullptr ? 0 : cleaned(film.image().value(*alpha, 0, 0));
    }
    /// The strokes with halos, without some.
    std::vector<std::size_t> halos_without(std::span<const std::size_t> strokes) const {
        std::vector<std::size_t> halos;
        for (std::size_t i = 0; i < near_strokes_.size(); ++i) {
            const bool is_left_out = std::find(strokes.begin(), strokes.end(), i) != strokes.end();
            if (!is_left_out && !near_strokes_[i].halos.empty()) halos.push_back(i);
        }
        return halos;
    }
    /// Says which halos erase ink of a near stroke.
    void add_erasing(std::size_t number, ExplainedStroke& to) {
        const std::vector<std::size_t> halos = halos_without({&number, 1});
        if (halos.empty()) return;
        to.erased = cleaned(to.covers - ink_of({&number, 1}, halos));
        if (to.erased == 0) return;
        for (const std::size_t i : halos) {
            const double share = cleaned(to.covers - ink_of({&number, 1}, {&i, 1}));
            if (share == 0) continue;
            const InkStroke& by = inked_.strokes[near_strokes_[i].parts.front()];
            const LineSample sample = sample_of(by);
            const ExplainedLine line = teller_.told(found_.runs.pieces[sample.piece].piece, found_.sides[sample.piece]);
            to.erased_by.push_back(
                {sheet_.sets()[by.order.set].name, by.order.drawn_as, line.front, sample.run, share});
        }
    }

    /// The place of what the stroke's set takes of its line that is nearest to the pixel.
    LineSample sample_of(const InkStroke& stroke) const {
        const auto run = InkStroke::run_of(stroke.chain);
        const LineRun& r = found_.runs.runs[run];
        LineSample best{run, static_cast<std::uint32_t>(r.first), 0};
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = r.first; i < r.first + r.count; ++i) {
            const auto takers = matches_.of(i);
            if (std::find(takers.begin(), takers.end(), stroke.order.set) == takers.end()) continue;
            double share = 0;
            const LinePiece& piece = found_.runs.pieces[i].piece;
            const double distance = distance_to(middle(), piece.from, piece.to, share);
            if (distance >= least) continue;
            least = distance;
            best = {run, static_cast<std::uint32_t>(i), share};
        }
        return best;
    }

    ExplainedStroke explained(const InkStroke& stroke) const {
        const LineSample sample = sample_of(stroke);
        const LinePiece& piece = found_.runs.pieces[sample.piece].piece;
        const LineRun& run = found_.runs.runs[sample.run];
        const LineSides& sides = found_.sides[sample.piece];
        const CompiledSet& set = sheet_.sets()[stroke.order.set];
        ExplainedStroke result;
        static_cast<ExplainedLine&>(result) = teller_.told(piece, sides);
        result.set = set.name;
        result.style = frame_.scene->sheet->styles[set.style].name;
        const auto takers = matches_.of(sample.piece);
        for (std::uint32_t earlier = 0; earlier < stroke.order.set; ++earlier) {
            const CompiledSet& other = sheet_.sets()[earlier];
            if (std::find(takers.begin(), takers.end(), earlier) != takers.end()) continue;
            result.earlier_sets.push_back({other.name, teller_.refusal(other, piece, sides)});
        }
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
        to.taper = static_cast<double>(values.taper_at(sample, *chain));
        to.min_length = static_cast<double>(values.length_strength(sample.run, *chain));
        to.moved = static_cast<double>(values.moved_strength(sample.run, to.ink.offset_px));
        to.ink.offset_px *= to_right(found_.runs.pieces[sample.piece].piece);  // as in the sheet
        const LinePiece& piece = found_.runs.pieces[sample.piece].piece;
        to.fade = piece.opacity / 255.0;
        to.seen = piece.transmission / 255.0;
        static_assert(kInkValueCount == 4, "each of them has a source");
        to.sources = {source_of(style.width), source_of(style.opacity), source_of(style.offset),
                      source_of(style.color)};
        to.names = names_in(std::array{&style.width, &style.opacity, &style.offset, &style.color}, frame_, columns_,
                            sample, variant);
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
    SetMatches matches_;
    LineTeller teller_;
    InkedLines inked_;
    std::vector<std::string> notes_;
    Frame pixel_;
    std::vector<std::size_t> near_;  // strokes, top first
    std::vector<NearStroke> near_strokes_;
    InkedLines some_;                 // of near strokes
    std::vector<std::size_t> drawn_;  // of near strokes: those with ink in the pixel
};

}  // namespace

ExplainedPlace explain_strokes(const Frame& frame, int x, int y, int threads) {
    const int count = resolve_thread_count(threads);
    StrokeExplainer explainer(frame, x, y, 0, count);
    ExplainedPlace place{x, y, frame.width, frame.height, explainer.strokes(), {}};
    place.undrawn = explainer.undrawn(count);
    return place;
}

ExplainedPlace explain_strokes_near(const Frame& frame, int x, int y, int reach_px, int threads) {
    StrokeExplainer explainer(frame, x, y, reach_px, resolve_thread_count(threads));
    return {explainer.x(), explainer.y(), frame.width, frame.height, explainer.strokes(), {}};
}

}  // namespace burin
