#include "methods/undrawn_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <tuple>

#include "abuffer/line_finder.h"
#include "mesh/text_scan.h"
#include "shading/ink/stroke_values.h"
#include "shading/sheet/style_sheet.h"

namespace burin {
namespace {

constexpr double kNearPx = 2;

std::string rounded(double value) {
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

class UndrawnLinesFinder {
  public:
    UndrawnLinesFinder(const Frame& frame, const DrawnLines& drawn, int x, int y)
        : frame_(frame), sheet_(*frame.sheet), drawn_(drawn), teller_(frame), x_(x), y_(y), middle_(x + 0.5, y + 0.5) {}

    /// Adds lines of which no ink is in the pixel, though the sheet asks for such.
    void add_asked(const std::set<std::pair<std::uint32_t, std::uint32_t>>& inked) {
        const LineRuns& runs = drawn_.columns.runs();
        struct Nearest {
            LineSample sample;
            double distance_px;
        };
        std::map<std::pair<std::uint32_t, std::uint32_t>, Nearest> nearest;  // by set and run
        for (std::uint32_t r = 0; r < runs.runs.size(); ++r) {
            const LineRun& run = runs.runs[r];
            for (std::size_t i = run.first; i < run.first + run.count; ++i) {
                const LinePiece& piece = runs.pieces[i].piece;
                double share = 0;
                const double distance_px = distance_to(middle_, piece.from, piece.to, share);
                const auto note = [&](std::uint32_t set) {
                    const Nearest found{{r, static_cast<std::uint32_t>(i), share}, distance_px};
                    const auto [at, is_new] = nearest.try_emplace({set, r}, found);
                    if (distance_px < at->second.distance_px) at->second = found;
                };
                const auto sets = drawn_.matches.of(i);
                if (sets.empty() && distance_px < kNearPx) note(kNoSet);
                for (const std::uint16_t set : sets) {
                    if (distance_px < kNearPx + static_cast<double>(sheet_.style_of(set).most_reach_px)) note(set);
                }
            }
        }
        for (const auto& [key, found] : nearest) {
            const auto [set, run] = key;
            const LineSides& sides = drawn_.columns.lines().sides[found.sample.piece];
            const LinePiece& piece = runs.pieces[found.sample.piece].piece;
            if (set == kNoSet) {
                add_refused(piece, sides, found.distance_px);
            } else if (!inked.contains(key)) {
                if (const std::string reason = reason_of(set, found.sample, found.distance_px); !reason.empty())
                    add(piece, sides, found.distance_px, reason, set, {});
            }
        }
    }

    /// Adds lines that the sheet did not have looked for.
    void add_unasked(int threads) {
        Frame all = frame_;
        all.prepared = nullptr;  // it is for the classes that are asked for
        all.criteria.classes = LineClassSet::all();
        all.criteria.cos_crease_angle = std::cos(glm::radians(frame_.scene->lines.crease_fade().from_deg));
        all.needs = {};
        all.needs.classes = LineClassSet::all();
        all.needs.most_invisibility = DrawingNeeds::kAnyInvisibility;
        all.needs.tells_invisibility = true;
        all.needs.surfaces_beyond = true;
        all.needs.is_transparent = frame_.needs.is_transparent;
        all.needs.reach_px = kNearPx + 1;
        all.crop = {x_, y_, x_ + 1, y_ + 1};
        Film film({0, 0, all.width, all.height}, all.crop, {true, false, false, false, false, false, false, false, {}},
                  all.criteria.classes);
        LineDrawing drawing;
        RenderStats stats;
        find_lines(all, {threads}, film, drawing, nullptr, stats);
        const LineSidesFinder finder(all.surfaces, all.criteria.cos_crease_angle);
        const SheetNeeds& asked = sheet_.needs();
        const auto add_list = [&](const LineDrawing::Lists& lists) {
            for (const std::span<const LinePiece> list : lists) {
                for (const LinePiece& piece : list) {
                    if (!piece.is_drawn) continue;
                    if (sheet_.class_of(piece.classes) && piece.invisibility <= asked.most_invisibility) continue;
                    double share = 0;
                    const double distance_px = distance_to(middle_, piece.from, piece.to, share);
                    if (distance_px < kNearPx) add_refused(piece, finder.sides_of(piece, false), distance_px);
                }
            }
        };
        add_list(drawing.visible());
        add_list(drawing.behind());
    }

    std::vector<UndrawnLine> lines() {
        std::stable_sort(lines_.begin(), lines_.end(), [](const UndrawnLine& a, const UndrawnLine& b) {
            const auto rank = [](const UndrawnLine& line) {
                return std::tuple(!line.is_asked && line.invisibility > 0, line.set.empty(), line.invisibility,
                                  !line.is_asked, line.distance_px);
            };
            return rank(a) < rank(b);
        });
        return std::move(lines_);
    }

  private:
    static constexpr std::uint32_t kNoSet = ~0u;

    /// Adds a line; of several that nothing tells apart only the nearest one.
    void add(const LinePiece& piece, const LineSides& sides, double distance_px, std::string reason, std::uint32_t set,
             std::vector<RefusedSet> refused) {
        UndrawnLine line{teller_.told(piece, sides), "", "", std::move(refused), std::move(reason), distance_px, true};
        line.is_asked = sheet_.class_of(piece.classes).has_value();
        if (set != kNoSet) {
            line.set = sheet_.sets()[set].name;
            line.style = sheet_.style_of(set).name;
        }
        for (UndrawnLine& other : lines_) {
            if (std::tie(other.drawn_as, other.front, other.other, other.other_is_behind, other.invisibility, other.set,
                         other.refused, other.reason) != std::tie(line.drawn_as, line.front, line.other,
                                                                  line.other_is_behind, line.invisibility, line.set,
                                                                  line.refused, line.reason))
                continue;
            other.distance_px = std::min(other.distance_px, line.distance_px);
            return;
        }
        lines_.push_back(std::move(line));
    }

    void add_refused(const LinePiece& piece, const LineSides& sides, double distance_px) {
        std::vector<RefusedSet> refused;
        std::string of_its_class, disabled;
        const auto c = sheet_.class_of(piece.classes);
        for (const CompiledSet& set : sheet_.sets()) {
            refused.push_back({set.name, teller_.refusal(set, piece, sides)});
            if (c && set.classes.has(*c))
                of_its_class +=
                    (of_its_class.empty() ? "" : "; ") + printable(set.name, 100) + ": " + refused.back().reason;
            if (!set.is_enabled && !(set.classes & piece.classes).empty() && disabled.empty())
                disabled = ", but set " + printable(set.name, 100) + ", which is not enabled";
        }
        if (c) return add(piece, sides, distance_px, "no set takes it (" + of_its_class + ")", kNoSet, refused);
        std::string reason = "no set asks for class " + std::string(name_of(piece.drawn_as)) + disabled;
        if (piece.drawn_as == LineClass::polygon && sheet_.needs().classes.has(LineClass::crease) &&
            sides.dihedral_deg >= 1)
            reason += "; creases begin at " + rounded(frame_.scene->lines.crease_fade().from_deg) +
                      "°, and its polygons turn by " + rounded(std::round(static_cast<double>(sides.dihedral_deg))) +
                      "°";
        add(piece, sides, distance_px, reason, kNoSet, std::move(refused));
    }

    /// The place that a set moves a sample to.
    glm::dvec2 moved(const LineSample& sample, double offset_px) const {
        const LinePiece& piece = drawn_.columns.runs().pieces[sample.piece].piece;
        const glm::dvec2 way = piece.to - piece.from, place = drawn_.columns.place_of(sample);
        const double length = glm::length(way);
        return length > 0 ? place + glm::dvec2(-way.y, way.x) * (offset_px / length) : place;
    }

    /// How far the ink of a run ends from the middle of the pixel; less than 0: it covers it.
    double gap_to_ink(std::uint32_t set, std::uint32_t run) const {
        double least = std::numeric_limits<double>::infinity(), share = 0;
        for (const InkStroke& stroke : drawn_.inked.strokes) {
            if (stroke.order.set != set || InkStroke::run_of(stroke.chain) != run) continue;
            const auto points = drawn_.inked.points_of(stroke);
            for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                const double distance = distance_to(middle_, points[i].place, points[i + 1].place, share);
                const float width_px = glm::mix(points[i].width_px, points[i + 1].width_px, static_cast<float>(share));
                const double gap = distance - 0.5 * static_cast<double>(width_px);
                // Ends that are cut off cover nothing beyond them.
                const bool is_beyond = (i == 0 && share == 0) || (i + 2 == points.size() && share == 1);
                least = std::min(least, is_beyond && stroke.caps == StrokeCaps::butt ? std::max(gap, 0.0) : gap);
            }
        }
        return least;
    }

    /// Why a run that a set takes has no ink in the pixel; nothing if it is not near.
    std::string reason_of(std::uint32_t set, const LineSample& sample, double distance_px) const {
        const CompiledStyle& style = sheet_.style_of(set);
        const CompiledSet& of = sheet_.sets()[set];
        const SampleVariant variant{style.settings.seed, 0, of.name};
        const LineStretch stretch{sample.run, sample.piece, 1};
        StrokeValues values(drawn_.columns, style, variant, of.test.get());
        const ChainValues chain = values.chain_values({&stretch, 1}).front();
        const InkValues ink = ink_of(values, sample, chain);
        const double radius_px = 0.5 * static_cast<double>(ink.width_px);
        const double moved_px = glm::distance(middle_, moved(sample, static_cast<double>(ink.offset_px)));
        if (std::min(distance_px, moved_px) >= std::max(kNearPx, radius_px)) return "";
        if (ink.width_px <= 0 || ink.opacity <= 0) return nothing_of(set, sample, values, chain);
        const double gap_px = gap_to_ink(set, sample.run);
        if (gap_px < 0) {
            if (style.settings.side != StrokeSide::both)
                return std::string("side = \"") + (style.settings.side == StrokeSide::inside ? "inside" : "outside") +
                       "\" has it on its other side only";
            return "what is in front of it covers it";
        }
        if (moved_px < radius_px) {
            if (style.dash_lengths > 0) return "the pixel is in a gap of its dashes";
            if (style.has_overshoot && value_of(chain, ChainValue::overshoot) < 0)
                return "its overshoot of " + rounded(static_cast<double>(value_of(chain, ChainValue::overshoot))) +
                       " px ends it before";
            return "its stroke ends before";
        }
        if (distance_px < radius_px)
            return "it is moved aside by " + rounded(static_cast<double>(std::abs(ink.offset_px))) + " px";
        if (!std::isfinite(gap_px)) return "nothing of its run is left: its dashes, overshoot or fading take all of it";
        return "its ink is " + rounded(static_cast<double>(ink.width_px)) + " px wide and ends " + rounded(gap_px) +
               " px from the middle of the pixel";
    }

    InkValues ink_of(StrokeValues& values, const LineSample& sample, const ChainValues& chain) const {
        const ChainValues* const of_sample = &chain;
        std::vector<InkValues> ink;
        values.evaluate({&sample, 1}, {&of_sample, 1}, ink);
        return ink.front();
    }

    /// What makes the width or the opacity 0, the first one in the order of work.
    std::string nothing_of(std::uint32_t set, const LineSample& sample, const StrokeValues& values,
                           const ChainValues& chain) const {
        const CompiledSet& of = sheet_.sets()[set];
        const SheetStyle& style = frame_.scene->sheet->styles[of.style];
        CompiledStyle plain = sheet_.style_of(set);
        const SampleVariant variant{plain.settings.seed, 0, of.name};
        plain.has_taper = plain.has_min_length = false;
        StrokeValues shaded(drawn_.columns, plain, variant, nullptr);
        const InkValues of_shader = ink_of(shaded, sample, chain);
        plain.shader.reset();
        StrokeValues alone(drawn_.columns, plain, variant, nullptr);
        const InkValues of_sheet = ink_of(alone, sample, chain);
        const LineRuns& runs = drawn_.columns.runs();
        const LinePiece& piece = runs.pieces[sample.piece].piece;
        if (of_sheet.width_px <= 0) return "its width is 0 there";
        if (piece.opacity == 0) return "its crease has not begun to fade in";
        if (piece.seen_opacity() == 0) return "what is in front of it lets nothing through";
        if (of_sheet.opacity <= 0 && values.moved_strength(sample.run, of_sheet.offset_px) <= 0)
            return "its run of " + rounded(runs.length_px(runs.runs[sample.run])) + " px is too short to be moved by " +
                   rounded(static_cast<double>(std::abs(of_sheet.offset_px))) + " px";
        if (of_sheet.opacity <= 0) return "its opacity is 0 there";
        if (of_shader.width_px <= 0) return "shader " + printable(style.shader->text, 100) + " makes its width 0";
        if (of_shader.opacity <= 0) return "shader " + printable(style.shader->text, 100) + " makes its opacity 0";
        if (values.taper_at(sample, chain) <= 0) return "its taper makes its width 0 there";
        if (values.length_strength(sample.run, chain) <= 0)
            return "its run of " + rounded(runs.length_px(runs.runs[sample.run])) + " px is too short for min_length " +
                   rounded(static_cast<double>(value_of(chain, ChainValue::min_length_low)));
        if (!of.test) return "its ink comes to nothing";
        return "test " + printable(frame_.scene->sheet->sets[set].test->text, 100) + " makes its opacity 0";
    }

    const Frame& frame_;
    const CompiledSheet& sheet_;
    const DrawnLines drawn_;
    LineTeller teller_;
    int x_, y_;
    glm::dvec2 middle_;
    std::vector<UndrawnLine> lines_;
};

}  // namespace

std::vector<UndrawnLine> undrawn_lines(const Frame& frame, const DrawnLines& drawn, int x, int y,
                                       const std::set<std::pair<std::uint32_t, std::uint32_t>>& inked, int threads) {
    UndrawnLinesFinder finder(frame, drawn, x, y);
    finder.add_asked(inked);
    finder.add_unasked(threads);
    return finder.lines();
}

}  // namespace burin
