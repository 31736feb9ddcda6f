#include "shading/ink/ink_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "shading/ink/sampled_strokes.h"

namespace burin {
namespace {

/// Stretches are evaluated in chunks of so many pieces, whichever thread takes them.
constexpr std::size_t kChunkPieces = 512;

/// The line sets of each piece.
SetMatches match_pieces(const LineColumns& lines, const CompiledSheet& sheet) {
    const LineRuns& runs = lines.runs();
    std::vector<LineClassSet> classes;
    std::vector<std::uint8_t> invisibility;
    std::vector<LineSample> middles;
    for (std::uint32_t r = 0; r < runs.runs.size(); ++r) {
        const LineRun& run = runs.runs[r];
        for (std::size_t i = run.first; i < run.first + run.count; ++i) {
            classes.push_back(runs.pieces[i].piece.classes);
            invisibility.push_back(runs.pieces[i].piece.invisibility);
            middles.push_back({r, static_cast<std::uint32_t>(i), 0.5});
        }
    }
    SampleColumns columns;
    lines.fill(middles, sheet.select_variables(), {}, columns);
    return sheet.match({classes.size(), classes, invisibility, columns.columns()});
}

/// A part of the work: stretches that one set draws.
struct Chunk {
    std::uint32_t set = 0;
    std::vector<LineStretch> stretches;
    std::size_t pieces = 0;
};

std::vector<Chunk> chunks_of(const LineRuns& runs, const SetMatches& matches, std::size_t set_count) {
    std::vector<std::vector<LineStretch>> of_set(set_count);
    for (std::uint32_t r = 0; r < runs.runs.size(); ++r) {
        const LineRun& run = runs.runs[r];
        for (std::size_t i = run.first; i < run.first + run.count; ++i) {
            for (const std::uint16_t set : matches.of(i)) {
                std::vector<LineStretch>& stretches = of_set[set];
                if (!stretches.empty() && stretches.back().run == r &&
                    stretches.back().first + stretches.back().count == i) {
                    ++stretches.back().count;
                } else {
                    stretches.push_back({r, i, 1});
                }
            }
        }
    }
    std::vector<Chunk> chunks;
    for (std::uint32_t set = 0; set < set_count; ++set) {
        bool is_new = true;
        for (const LineStretch& stretch : of_set[set]) {
            if (is_new) chunks.push_back({set, {}, 0});
            chunks.back().stretches.push_back(stretch);
            chunks.back().pieces += stretch.count;
            is_new = chunks.back().pieces >= kChunkPieces;
        }
    }
    return chunks;
}

/// What comes of one chunk, to be put behind what came of those before it.
struct Inked {
    std::vector<InkPoint> points;
    std::vector<InkStroke> strokes;
    std::vector<NotNumbersOfStyle> not_numbers;  // of its copies
};

/// StrokeMaker makes strokes of the stretches of a chunk.
class StrokeMaker {
  public:
    StrokeMaker(const LineColumns& lines, const CompiledSheet& sheet, const Chunk& chunk, Inked& out)
        : lines_(lines), sheet_(sheet), chunk_(chunk), style_(sheet.style_of(chunk.set)), out_(out) {}

    void make() {
        const StyleSettings& settings = style_.settings;
        const auto turn =
            settings.boil ? static_cast<std::uint32_t>(lines_.lines().frame / std::max(settings.hold, 1)) : 0u;
        for (int copy = 0; copy < settings.copies; ++copy) {
            const SampleVariant variant{settings.seed + turn * 0x9E3779B9u, static_cast<std::uint32_t>(copy),
                                        sheet_.sets()[chunk_.set].name};
            StrokeValues values(lines_, style_, variant);
            for (SampledStroke& stroke : sample_strokes(lines_, chunk_.stretches, values)) {
                finish(stroke, static_cast<std::uint64_t>(copy));
            }
            out_.not_numbers.push_back(values.not_numbers());
        }
    }

  private:
    void finish(SampledStroke& stroke, std::uint64_t copy) {
        const LineRun& run = lines_.runs().runs[stroke.stretch.run];
        const bool has_begin = stroke.stretch.first == run.first,
                   has_end = stroke.stretch.first + stroke.stretch.count == run.first + run.count;
        const bool is_loop = run.is_closed && has_begin && has_end;
        if (style_.smooth_px > 0) smooth_ink(stroke.path, static_cast<double>(style_.smooth_px), is_loop);
        if (style_.has_overshoot && !is_loop) {
            const auto px = static_cast<double>(value_of(stroke.chain, ChainValue::overshoot));
            const auto goes_on = [](RunEnd end) { return end == RunEnd::free || end == RunEnd::corner; };
            if (has_begin && !run.is_closed && goes_on(run.ends[0])) lengthen_end(stroke.path, true, px);
            if (has_end && !run.is_closed && goes_on(run.ends[1])) lengthen_end(stroke.path, false, px);
        }
        order_ = {-style_.settings.priority, run.is_hidden, chunk_.set,
                  class_of(lines_.runs().pieces[run.first].piece)};
        chain_ = std::uint64_t{stroke.stretch.run} << 3 | copy;
        halo_px_ = style_.has_halo ? value_of(stroke.chain, ChainValue::halo) : 0;
        halo_depth_px_ = {value_of(stroke.chain, ChainValue::halo_depth_near),
                          value_of(stroke.chain, ChainValue::halo_depth_far)};
        if (style_.dash_lengths == 0) return add(stroke.path, is_loop);
        add_dashes(stroke, run.chain_is_closed ? run.chain_length_px : 0);
    }

    void add_dashes(SampledStroke& stroke, double loop_px) {
        DashPattern pattern;
        for (std::size_t k = 0; k < style_.dash_lengths; ++k) {
            const float length = stroke.chain[static_cast<std::size_t>(ChainValue::dash) + k];
            pattern.lengths_px.push_back(std::max(0.0, static_cast<double>(length)));
        }
        pattern.phase_px = static_cast<double>(value_of(stroke.chain, ChainValue::dash_phase));
        pattern.has_round_caps = style_.settings.caps == StrokeCaps::round;
        if (!(pattern.period_px() >= DashPattern::kShortestPeriodPx)) {
            // Dashes that cannot be seen are a line of less strength.
            for (PathPoint& point : stroke.path) point.ink.opacity *= static_cast<float>(pattern.share());
            return add(stroke.path, loop_px > 0 && stroke.path.size() > 1);
        }
        for_dashes(stroke.path, pattern, loop_px, [this](const StrokePath& dash) { add(dash, false); });
    }

    LineClass class_of(const LinePiece& piece) const { return sheet_.class_of(piece.classes).value_or(piece.drawn_as); }

    void add(const StrokePath& path, bool is_loop) {
        if (path.size() < 2) return;
        const bool is_seen = std::any_of(path.begin(), path.end(),
                                         [](const PathPoint& p) { return p.ink.width_px > 0 && p.ink.opacity > 0; });
        if (!is_seen) return;
        InkStroke stroke;
        stroke.first_point = out_.points.size();
        stroke.point_count = path.size();
        stroke.order = order_;
        stroke.chain = chain_;
        stroke.caps = style_.settings.caps;
        stroke.blend = style_.settings.blend;
        stroke.side = style_.settings.side;
        stroke.is_closed = is_loop && path.front().ink.place == path.back().ink.place;
        stroke.halo_px = halo_px_;
        stroke.halo_depth_px = halo_depth_px_;
        const InkPoint& first = path.front().ink;
        stroke.is_constant = std::all_of(path.begin(), path.end(), [&first](const PathPoint& p) {
            return p.ink.width_px == first.width_px && p.ink.opacity == first.opacity && p.ink.color == first.color;
        });
        for (const PathPoint& p : path) out_.points.push_back(p.ink);
        out_.strokes.push_back(stroke);
    }

    const LineColumns& lines_;
    const CompiledSheet& sheet_;
    const Chunk& chunk_;
    const CompiledStyle& style_;
    Inked& out_;
    InkOrder order_;
    std::uint64_t chain_ = 0;
    float halo_px_ = 0;
    glm::vec2 halo_depth_px_{0.0f};
};

void add_boundaries(const LineColumns& lines, const SetMatches& matches, const CompiledSheet& sheet,
                    InkedLines& inked) {
    const auto add = [&](const LinePiece& piece, const InkOrder* order) {
        if (!piece.occludes) return;
        InkBoundary boundary{piece.from, piece.to, piece.nearness_from, piece.nearness_to, piece.front_on_left,
                             {},         false};
        if (order != nullptr) boundary.order = *order;
        boundary.is_drawn = order != nullptr;
        inked.boundaries.push_back(boundary);
    };
    const LineRuns& runs = lines.runs();
    for (const LineRun& run : runs.runs) {
        if (run.is_hidden) continue;
        for (std::size_t i = run.first; i < run.first + run.count; ++i) {
            const LinePiece& piece = runs.pieces[i].piece;
            std::optional<InkOrder> order;
            for (const std::uint16_t set : matches.of(i)) {
                const InkOrder own{-sheet.style_of(set).settings.priority, false, set,
                                   sheet.class_of(piece.classes).value_or(piece.drawn_as)};
                if (!order || own < *order) order = own;
            }
            add(piece, order ? &*order : nullptr);
        }
    }
    for (const LinePiece& piece : lines.lines().boundaries) add(piece, nullptr);
}

void add_notes_on_numbers(const CompiledSheet& sheet, std::span<const Chunk> chunks, std::span<const Inked> parts,
                          std::vector<std::string>& notes) {
    constexpr std::array<const char*, kInkValueCount> kNames = {"width", "opacity", "offset", "color"};
    for (std::size_t style = 0; style < sheet.styles().size(); ++style) {
        NotNumbersOfStyle sum;
        for (std::size_t i = 0; i < chunks.size(); ++i) {
            if (sheet.sets()[chunks[i].set].style != style) continue;
            for (const NotNumbersOfStyle& own : parts[i].not_numbers) {
                for (std::size_t k = 0; k < kInkValueCount; ++k) {
                    if (sum.counts[k] == 0) sum.places[k] = own.places[k];
                    sum.counts[k] += own.counts[k];
                }
            }
        }
        for (std::size_t k = 0; k < kInkValueCount; ++k) {
            if (sum.counts[k] == 0) continue;
            notes.push_back("style " + sheet.styles()[style].name + ": " + kNames[k] + " is not a number at " +
                            std::to_string(sum.counts[k]) + " samples, first at pixel " +
                            std::to_string(static_cast<int>(std::floor(sum.places[k].x))) + "," +
                            std::to_string(static_cast<int>(std::floor(sum.places[k].y))));
        }
    }
}

}  // namespace

InkedLines ink_lines(const FoundLines& found, const CompiledSheet& sheet, int threads,
                     std::vector<std::string>& notes) {
    const LineColumns lines(found, sheet.needs().classes, sheet.needs().variables);
    const SetMatches matches = match_pieces(lines, sheet);
    const std::vector<Chunk> chunks = chunks_of(found.runs, matches, sheet.sets().size());
    std::vector<Inked> parts(chunks.size());
    parallel_for(chunks.size(), threads,
                 [&](std::size_t i, int) { StrokeMaker(lines, sheet, chunks[i], parts[i]).make(); });

    InkedLines inked;
    std::size_t points = 0, strokes = 0;
    for (const Inked& part : parts) {
        points += part.points.size();
        strokes += part.strokes.size();
    }
    inked.points.reserve(points);
    inked.strokes.reserve(strokes);
    for (const Inked& part : parts) {
        const std::size_t before = inked.points.size();
        inked.points.insert(inked.points.end(), part.points.begin(), part.points.end());
        for (InkStroke stroke : part.strokes) {
            stroke.first_point += before;
            inked.strokes.push_back(stroke);
        }
    }
    for (const CompiledSet& set : sheet.sets()) inked.layers.push_back(set.layer);
    add_boundaries(lines, matches, sheet, inked);
    add_notes_on_numbers(sheet, chunks, parts, notes);
    return inked;
}

}  // namespace burin
