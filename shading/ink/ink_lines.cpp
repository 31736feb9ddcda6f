#include "shading/ink/ink_lines.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "shading/ink/line_chunks.h"
#include "shading/ink/sampled_strokes.h"

namespace burin {
namespace {

/// Opaque ink all along a piece.
struct OpaqueInk {
    std::uint32_t piece = 0;
    InkOrder order;
    float width_px = 0;  ///< at least
};

/// What comes of one chunk, to be put behind what came of those before it.
struct Inked {
    std::vector<InkPoint> points;
    std::vector<InkStroke> strokes;
    std::vector<StrokeOrigin> origins;
    std::vector<OpaqueInk> opaque;
    std::vector<NotNumbersOfStyle> not_numbers;  // of its copies
};

/// StrokeMaker makes strokes of the stretches of a chunk.
class StrokeMaker {
  public:
    /// `boundaries`: the number of the boundary that each piece is, or InkPoint::kNoBoundary.
    StrokeMaker(const LineColumns& lines, const CompiledSheet& sheet, std::span<const std::uint32_t> boundaries,
                const LineChunk& chunk, const InkWishes& wishes, Inked& out)
        : lines_(lines),
          sheet_(sheet),
          boundaries_(boundaries),
          chunk_(chunk),
          style_(sheet.style_of(chunk.set)),
          wishes_(wishes),
          out_(out) {}

    void make() {
        const StyleSettings& settings = style_.settings;
        const auto turn = settings.boil ? static_cast<std::uint32_t>(static_cast<std::int64_t>(
                                              lines_.lines().frame / std::max(settings.hold, 1)))
                                        : 0u;
        for (int copy = 0; copy < settings.copies; ++copy) {
            const SampleVariant variant{settings.seed + turn * 0x9E3779B9u, static_cast<std::uint32_t>(copy),
                                        sheet_.sets()[chunk_.set].name};
            variant_.copy = variant.copy;
            StrokeValues values(lines_, style_, variant, sheet_.sets()[chunk_.set].test.get());
            for (SampledStroke& stroke : sample_strokes(lines_, chunk_.stretches, values)) {
                finish(stroke, static_cast<std::uint64_t>(copy));
            }
            out_.not_numbers.push_back(values.not_numbers());
        }
    }

  private:
    void finish(SampledStroke& stroke, std::uint64_t copy) {
        is_moved_ = stroke.is_moved;
        const LineRun& run = lines_.runs().runs[stroke.stretch.run];
        const bool has_begin = stroke.stretch.first == run.first,
                   has_end = stroke.stretch.first + stroke.stretch.count == run.first + run.count;
        const bool is_loop = run.is_closed && has_begin && has_end;
        if (style_.smooth_px > 0) smooth_ink(stroke.path, static_cast<double>(style_.smooth_px), is_loop);
        if (style_.has_overshoot && !is_loop) {
            // Short runs, as crumbs beside cusps, come and go: they grow by no more than they are long.
            const double px = std::min(static_cast<double>(value_of(stroke.chain, ChainValue::overshoot)),
                                       lines_.runs().length_px(run));
            const auto lengthen = [&](bool at_begin, std::size_t which) {
                const double share = freedom(run.onward_gaps_px[which]);
                if (!run.is_closed && share > 0) lengthen_end(stroke.path, at_begin, px * share);
            };
            if (has_begin) lengthen(true, 0);
            if (has_end) lengthen(false, 1);
        }
        chain_ = InkStroke::chain_of(stroke.stretch.run, copy);
        if (wishes_.origins) edge_ = lines_.chain_hash(run, variant_).bits();
        halo_px_ = style_.has_halo ? value_of(stroke.chain, ChainValue::halo) : 0;
        halo_depth_px_ = {value_of(stroke.chain, ChainValue::halo_depth_near),
                          value_of(stroke.chain, ChainValue::halo_depth_far)};
        if (style_.dash_lengths == 0) {
            if (!run.is_hidden) add_opaque(stroke.path);
            return add(stroke.path, is_loop);
        }
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
        if (!wishes_.cuts_dashes && is_constant(stroke.path)) {
            const double scale = dash_scale(pattern, loop_px);
            for (const double length : pattern.lengths_px) dash_px_.push_back(static_cast<float>(length * scale));
            dash_begin_px_ = pattern.phase_px * scale;
            add(stroke.path, stroke.path.size() > 1 && loop_px > 0);
            dash_px_.clear();
            return;
        }
        for_dashes(stroke.path, pattern, loop_px, [this](const StrokePath& dash) { add(dash, false); });
    }

    const LinePiece& piece_of(const PathPoint& p) const { return lines_.runs().pieces[p.piece].piece; }
    InkOrder order_of(const PathPoint& p) const {
        const LinePiece& piece = piece_of(p);
        return {-style_.settings.priority, piece.is_hidden(), chunk_.set,
                sheet_.class_of(piece.classes).value_or(piece.drawn_as)};
    }
    static bool is_behind(const LinePiece& piece) { return piece.is_hidden() || piece.transmission < 255; }

    /// Notes along which pieces opaque ink lies that covers what comes out from behind them.
    void add_opaque(const StrokePath& path) {
        if (is_moved_ || style_.settings.blend != InkBlend::over || style_.settings.side == StrokeSide::outside) return;
        for (std::size_t i = 0; i + 1 < path.size(); ++i) {
            const PathPoint &from = path[i], &to = path[i + 1];
            if (boundaries_[from.piece] == InkPoint::kNoBoundary) continue;
            // Ends may be shorter than their pieces.
            if (style_.has_overshoot && (from.piece == path.front().piece || from.piece == path.back().piece)) continue;
            const float opacity = std::min(from.ink.opacity, to.ink.opacity);
            const float width_px = opacity < 1 ? 0.0f : std::min(from.ink.width_px, to.ink.width_px);
            if (!out_.opaque.empty() && out_.opaque.back().piece == from.piece && i > 0) {
                out_.opaque.back().width_px = std::min(out_.opaque.back().width_px, width_px);
            } else {
                out_.opaque.push_back({from.piece, order_of(path[i]), width_px});
            }
        }
    }

    /// Whether one point of a path is drawn to the next. Pieces of a chain may be apart by a little, and change their
    /// depth or ink where they meet; their round ends close what is between them.
    bool goes_on(const PathPoint& a, const PathPoint& b) const {
        return !a.ends_piece || (is_moved_ && a.ink.place != b.ink.place);
    }
    /// Adds a stroke, in parts: what is seen through a surface is one of its own, strokes of opaque ink have one class
    /// each, and where the depth or the ink jumps nothing is drawn from the one to the other. Round ends hide that.
    void add(const StrokePath& path, bool is_loop) {
        if (path.size() < 2) return;
        const bool is_round = style_.settings.caps == StrokeCaps::round;
        const bool is_opaque = is_round && std::all_of(path.begin(), path.end(), [this](const PathPoint& p) {
                                   return p.ink.opacity >= static_cast<float>(piece_of(p).seen_opacity()) / 255.0f;
                               });
        const auto go_together = [&](const PathPoint& a, const PathPoint& b) {
            return is_behind(piece_of(a)) == is_behind(piece_of(b)) && (!is_opaque || order_of(a) == order_of(b));
        };
        std::size_t first = 0;
        for (std::size_t i = 1; i + 1 < path.size(); ++i) {
            const bool jumps = is_round && i > first + 1 && !goes_on(path[i - 1], path[i]);
            if (!jumps && (path[i].piece == path[i - 1].piece || go_together(path[i - 1], path[i]))) continue;
            add_part(std::span(path).subspan(first, i + (jumps ? 0 : 1) - first), false);
            first = i;
        }
        add_part(std::span(path).subspan(first), is_loop && first == 0);
    }

    static bool is_constant(std::span<const PathPoint> path) {
        const InkPoint& first = path.front().ink;
        return std::all_of(path.begin(), path.end(),
                           [&first](const PathPoint& p) { return has_one_ink(p.ink, first); });
    }

    void add_origin(std::span<const PathPoint> path) {
        StrokeOrigin origin;
        origin.object = lines_.object_of(path.front().piece);
        origin.material = lines_.material_of(path.front().piece);
        origin.invisibility = 255;
        for (const PathPoint& p : path) origin.invisibility = std::min(origin.invisibility, piece_of(p).invisibility);
        origin.edge = edge_;
        origin.dash_px = dash_px_;
        if (!dash_px_.empty()) {
            double period = 0;
            for (const float length : dash_px_) period += static_cast<double>(length);
            origin.dash_phase_px = static_cast<float>(std::fmod(dash_begin_px_ + path.front().at_px, period));
            if (origin.dash_phase_px < 0) origin.dash_phase_px += static_cast<float>(period);
        }
        out_.origins.push_back(std::move(origin));
    }

    void add_part(std::span<const PathPoint> path, bool is_loop) {
        const bool is_seen = std::any_of(path.begin(), path.end(),
                                         [](const PathPoint& p) { return p.ink.width_px > 0 && p.ink.opacity > 0; });
        if (!is_seen) return;
        InkStroke stroke;
        stroke.first_point = out_.points.size();
        stroke.point_count = path.size();
        stroke.order = order_of(path.front());
        stroke.is_behind = is_behind(piece_of(path.front()));
        stroke.chain = chain_;
        stroke.caps = style_.settings.caps;
        stroke.blend = style_.settings.blend;
        stroke.side = style_.settings.side;
        stroke.is_closed = is_loop && path.front().ink.place == path.back().ink.place;
        stroke.halo_px = halo_px_;
        stroke.halo_depth_px = halo_depth_px_;
        stroke.is_constant = is_constant(path);
        if (wishes_.origins) add_origin(path);
        for (const PathPoint& p : path) {
            out_.points.push_back(p.ink);
            if (!is_moved_) out_.points.back().boundary = boundaries_[p.piece];
        }
        out_.strokes.push_back(stroke);
    }

    const LineColumns& lines_;
    const CompiledSheet& sheet_;
    std::span<const std::uint32_t> boundaries_;
    const LineChunk& chunk_;
    const CompiledStyle& style_;
    bool is_moved_ = false;  ///< the stroke
    const InkWishes& wishes_;
    Inked& out_;
    SampleVariant variant_;  // for names of edges
    std::uint64_t chain_ = 0, edge_ = 0;
    std::vector<float> dash_px_;
    double dash_begin_px_ = 0;
    float halo_px_ = 0;
    glm::vec2 halo_depth_px_{0.0f};
};

/// Adds the boundaries of what is seen, and says of each piece which one it is.
std::vector<std::uint32_t> add_boundaries(const LineColumns& lines, InkedLines& inked) {
    std::vector<std::uint32_t> numbers(lines.runs().pieces.size(), InkPoint::kNoBoundary);
    const auto add = [&](const LinePiece& piece) {
        InkBoundary boundary;
        boundary.from = piece.from;
        boundary.to = piece.to;
        boundary.nearness_from = piece.nearness_from;
        boundary.nearness_to = piece.nearness_to;
        boundary.front_on_left = piece.front_on_left;
        inked.boundaries.push_back(boundary);
    };
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const LinePiece& piece = lines.runs().pieces[i].piece;
        if (piece.is_hidden() || !piece.occludes) continue;
        numbers[i] = static_cast<std::uint32_t>(inked.boundaries.size());
        add(piece);
    }
    for (const LinePiece& piece : lines.lines().boundaries) add(piece);
    return numbers;
}

/// Notes the widest ink along each boundary; of equally wide ones, what lies on top.
void add_ink_along(std::span<const Inked> parts, std::span<const std::uint32_t> boundaries, InkedLines& inked) {
    for (const Inked& part : parts) {
        throw_if_interrupted();
        for (const OpaqueInk& ink : part.opaque) {
            InkBoundary& boundary = inked.boundaries[boundaries[ink.piece]];
            if (!(ink.width_px > 0)) continue;
            if (boundary.is_drawn && (ink.width_px < boundary.drawn_width_px ||
                                      (ink.width_px == boundary.drawn_width_px && boundary.order < ink.order)))
                continue;
            boundary.is_drawn = true;
            boundary.order = ink.order;
            boundary.drawn_width_px = ink.width_px;
        }
    }
}

void add_notes_on_numbers(const CompiledSheet& sheet, std::span<const LineChunk> chunks, std::span<const Inked> parts,
                          std::vector<std::string>& notes) {
    for (std::size_t style = 0; style < sheet.styles().size(); ++style) {
        NotNumbersOfStyle sum;
        for (std::size_t i = 0; i < chunks.size(); ++i) {
            if (sheet.sets()[chunks[i].set].style != style) continue;
            for (const NotNumbersOfStyle& own : parts[i].not_numbers) {
                for (std::size_t k = 0; k < NotNumbersOfStyle::kCount; ++k) {
                    if (sum.counts[k] == 0) sum.places[k] = own.places[k];
                    sum.counts[k] += own.counts[k];
                }
            }
        }
        std::string_view noted;
        for (std::size_t k = 0; k < NotNumbersOfStyle::kCount; ++k) {
            const std::string_view key = NotNumbersOfStyle::key_of(k);
            if (sum.counts[k] == 0 || key == noted) continue;  // a list of lengths is one value
            noted = key;
            notes.push_back("style " + sheet.styles()[style].name + ": " + std::string(noted) + " is not a number at " +
                            std::to_string(sum.counts[k]) +
                            (k < NotNumbersOfStyle::kFirstOfChain ? " samples" : " lines") + ", first at pixel " +
                            std::to_string(static_cast<int>(std::floor(sum.places[k].x))) + "," +
                            std::to_string(static_cast<int>(std::floor(sum.places[k].y))));
        }
    }
}

}  // namespace

InkedLines ink_lines(const FoundLines& found, const CompiledSheet& sheet, int threads, std::vector<std::string>& notes,
                     const InkWishes& wishes) {
    const LineColumns lines(found, sheet.needs().classes, sheet.needs().variables);
    const SetMatches matches = match_pieces(lines, sheet);
    const std::vector<LineChunk> chunks = chunks_of(found.runs, matches, sheet.sets().size());
    InkedLines inked;
    const std::vector<std::uint32_t> boundaries = add_boundaries(lines, inked);
    std::vector<Inked> parts(chunks.size());
    parallel_for(chunks.size(), threads, [&](std::size_t i, int) {
        StrokeMaker(lines, sheet, boundaries, chunks[i], wishes, parts[i]).make();
    });

    std::size_t points = 0, strokes = 0;
    for (const Inked& part : parts) {
        points += part.points.size();
        strokes += part.strokes.size();
    }
    inked.points.reserve(points);
    inked.strokes.reserve(strokes);
    if (wishes.origins) inked.origins.reserve(strokes);
    for (Inked& part : parts) {
        throw_if_interrupted();
        const std::size_t before = inked.points.size();
        inked.points.insert(inked.points.end(), part.points.begin(), part.points.end());
        for (InkStroke stroke : part.strokes) {
            stroke.first_point += before;
            inked.strokes.push_back(stroke);
        }
        std::move(part.origins.begin(), part.origins.end(), std::back_inserter(inked.origins));
    }
    for (const CompiledSet& set : sheet.sets()) {
        inked.layers.push_back(set.layer);
        inked.sets.push_back(set.name);
    }
    add_ink_along(parts, boundaries, inked);
    notes.insert(notes.end(), sheet.notes_on_names().begin(), sheet.notes_on_names().end());
    for (std::string& note : sheet.notes_on_wobble()) notes.push_back(std::move(note));
    add_notes_on_numbers(sheet, chunks, parts, notes);
    return inked;
}

}  // namespace burin
