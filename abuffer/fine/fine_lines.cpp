#include "abuffer/fine/fine_lines.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "abuffer/edges/fold_width.h"
#include "abuffer/edges/occluder.h"
#include "abuffer/fine/covering_triangles.h"
#include "abuffer/fine/drawn_parts.h"
#include "abuffer/fine/fine_cells.h"
#include "abuffer/fine/heaps.h"
#include "abuffer/hiding/contacts.h"
#include "abuffer/screen/edge_on_screen.h"
#include "abuffer/screen/sampling.h"
#include "base/interrupt.h"

namespace burin {
namespace {

constexpr bool kHasBothOfSeam = true;
/// Shorter parts of lines are not worth a stroke. Pixels.
constexpr double kShortestPiecePx = 1.0 / 32;
/// How exactly the place is found where a fold begins. Pixels.
constexpr double kWidthStepPx = 1.0 / 32;
constexpr double kFarthestDepth = 1e300;
/// In a block with more candidates, those behind others on the same straight line are left out.
constexpr std::size_t kFewCandidates = 12;
/// What rounding does to nearness, as part of what counts as level.
constexpr double kRoundingOfNearness = 1.0 / 64;

}  // namespace

/// Finds what is visible in one block after the other. Buffers are used again.
class FineLines::BlockClipper {
  public:
    BlockClipper(const ScreenSurfaces& screen, const EdgeLineFinder& finder, const TileKernels& kernels,
                 const LineCriteria& criteria)
        : screen_(screen),
          finder_(finder),
          kernels_(kernels),
          contacts_(screen),
          criteria_(criteria),
          cells_(screen, kernels) {}

    /// `corner`: of the block, in 1/256 pixel. `line_count`: how many lines will be looked at there.
    void set_triangles(const std::vector<CrossedTriangle>& triangles, glm::ivec2 corner, std::size_t line_count) {
        given_ = &triangles;
        cells_.set(triangles, corner, line_count);
        places_.assign(triangles.size(), {});
        set_up_.clear();
        drawn_.clear();
    }
    std::size_t triangles_per_cell() const { return cells_.triangles_per_cell(); }

    /// Calls add_visible() for all candidates, the nearest first, but for those that strokes of nearer ones surely
    /// cover.
    void add_not_covered(std::span<const FineCandidate> candidates, std::span<const std::uint32_t> numbers,
                         std::vector<LinePiece>& pieces) {
        order_.clear();
        for (const std::uint32_t i : numbers) {
            const FineCandidate& c = candidates[i];
            order_.emplace_back(-std::max(c.line.nearness_at(c.part.begin), c.line.nearness_at(c.part.end)), i);
        }
        std::sort(order_.begin(), order_.end());
        notes_drawn_ = true;
        for (const auto& [far, i] : order_) {
            if (!is_covered(candidates[i])) add_visible(candidates[i], pieces);
        }
        notes_drawn_ = false;
    }

    void add_visible(const FineCandidate& candidate, std::vector<LinePiece>& pieces) {
        const WholeLine& line = candidate.line;
        const double begin = candidate.part.begin, end = candidate.part.end;
        const double nearest = std::max(line.nearness_at(begin), line.nearness_at(end)),
                     by_snapping = snapping_slack(line);
        const auto slack_of = [&](double level_px) {
            return level_slack(screen_.surfaces(), nearest, level_px) + by_snapping;
        };
        const double slack = slack_of(kLevelPx), coincident = slack_of(kCoincidentPx), certain = slack_of(kCertainPx);
        const double rounding = kRoundingOfNearness * level_slack(screen_.surfaces(), line.nearness_at(begin));
        const bool is_border = line.owners[0] == line.owners[1], is_by_itself = line.is_by_itself();
        const double shortest = std::min(kShortestPiecePx / line.length_px(), 0.5 * (end - begin));
        hidden_.clear();
        double reached = begin;  // up to here all is hidden
        bool is_hidden = false;
        const glm::dvec2 a = line.at(begin), b = line.at(end);
        const PlaneLine clipped{{line.from.x, line.to.x, a.x, b.x},
                                {line.from.y, line.to.y, a.y, b.y},
                                {line.nearness_from, line.nearness_to, line.nearness_at(begin), line.nearness_at(end)},
                                begin,
                                end,
                                slack};
        for_triangles(line, a, b, part_or_line(line, a, b, line.lowest_in(begin, end) - slack), [&](const Occluder& t) {
            // A mesh hides its own edges exactly; patches that are not stitched and other objects are snapped
            // apart.
            const bool is_own_mesh = t.instance == candidate.part.edge.instance;
            const double touching = slack + t.slack;
            const double level = !is_own_mesh || is_by_itself ? certain + t.slack
                                 : is_border                  ? rounding + t.slack
                                                              : rounding;
            // What is level hides the most where it is seen instead: what that is, is asked last. It does so along
            // its edges, too, for its neighbour there may turn away.
            HiddenParts parts;
            kernels_.fine.clip_twice(t, clipped, -coincident - t.slack, level, parts);
            // What is hidden already does not become more so.
            if (!parts.is_any_most || parts.most_end <= reached) return true;
            const double most_from = parts.most_begin, most_to = parts.most_end;
            double from = parts.begin, to = parts.end;
            if (parts.is_any && is_own_mesh && !is_by_itself && from < to &&
                contacts_.is_in_plane(line, from, to, t, certain + t.slack))
                parts.is_any = false;  // a body in another one's plane, but for rounding
            const bool is_settled = parts.is_any && from == most_from && to == most_to;
            const auto is_none = [&] {
                return (!is_by_itself && contacts_.is_seen_instead(line, begin, end, t, touching)) ||
                       contacts_.is_flush(line, most_from, most_to, t, touching, criteria_, false);
            };
            if (!is_settled && is_none()) {
                from = most_from;
                to = most_to;
            } else if (!parts.is_any) {
                return true;
            }
            hidden_.push_back({from, to});
            reached = hidden_up_to(reached, shortest);
            is_hidden = end - reached <= shortest;
            return !is_hidden;
        });
        if (is_hidden) return;
        std::sort(hidden_.begin(), hidden_.end(),
                  [](const Interval& p, const Interval& q) { return p.begin < q.begin; });
        reached = begin;
        for (const Interval& h : hidden_) {
            add_wide(candidate, reached, h.begin, shortest, pieces);
            reached = std::max(reached, h.end);
        }
        add_wide(candidate, reached, end, shortest, pieces);
    }

    /// Adds all of a candidate, whatever is in front of it.
    void add_all(const FineCandidate& candidate, std::vector<LinePiece>& pieces) {
        add(candidate, candidate.part.begin, candidate.part.end, pieces);
    }

  private:
    struct Interval {
        double begin, end;
    };

    /// How far what is hidden goes on from a place, but for gaps too short to be drawn.
    double hidden_up_to(double reached, double shortest) const {
        const auto goes_on = [&](const Interval& h) { return h.begin - reached <= shortest && h.end > reached; };
        for (auto next = hidden_.end();
             (next = std::find_if(hidden_.begin(), hidden_.end(), goes_on)) != hidden_.end();) {
            reached = next->end;
        }
        return reached;
    }

    struct Place {
        std::uint32_t first = 0, count = 0;
    };

    static ScreenLine screen_line(glm::dvec2 a, glm::dvec2 b, double least) {
        return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(b.x), static_cast<float>(b.y),
                static_cast<float>(std::max(least, -1e30))};
    }
    /// A part of a line from a to b; or all of it, where that is short and its ends are whole numbers: what only
    /// touches it is told exactly then.
    static ScreenLine part_or_line(const WholeLine& line, glm::dvec2 a, glm::dvec2 b, double least) {
        if (!line.is_exact()) return screen_line(a, b, least);
        ScreenLine whole = screen_line(line.from, line.to, least);
        whole.is_exact = true;
        return whole;
    }

    /// Calls use(triangle) for those that may hide `part` of a line, from a to b, and that the line is no edge of,
    /// until it says false.
    template <typename Use>
    void for_triangles(const WholeLine& line, glm::dvec2 a, glm::dvec2 b, const ScreenLine& part, const Use& use) {
        cells_.for_hiding(part, a, b, [&](std::uint32_t i) {
            if (is_owner(line, (*given_)[i].number)) return true;
            if (places_[i].count == 0) set_up(i);
            for (std::uint32_t k = 0; k < places_[i].count; ++k) {
                const Occluder& t = set_up_[places_[i].first + k];
                if (!lies_on(line, t) && !use(t)) return false;
            }
            return true;
        });
    }

    void set_up(std::size_t i) {
        const CrossedTriangle& given = (*given_)[i];
        const SurfaceId s = screen_.surface_of(given.number);
        places_[i].first = static_cast<std::uint32_t>(set_up_.size());
        if (screen_.facing(given.number) == off_screen) {
            const auto parts = clipped_occluders(screen_, s, given.number);
            set_up_.insert(set_up_.end(), parts.begin(), parts.end());
        } else {
            set_up_.push_back(occluder_of(screen_, s, given.number));
        }
        places_[i].count = static_cast<std::uint32_t>(set_up_.size()) - places_[i].first;
    }

    /// A border may be a contact where it is seen, which is not known before; what fades is drawn below the rest.
    bool is_covered(const FineCandidate& candidate) const {
        const WholeLine& line = candidate.line;
        const bool may_be_contact = line.classes.has(LineClass::border) && !line.is_wire;
        if (may_be_contact || line.opacity < 255 || line.classes.empty()) return false;
        const bool occludes = line.classes.has_any_of(kSurfaceEnds);
        return drawn_.cover(line, candidate.part.begin, candidate.part.end,
                            {*line.classes.first(), occludes, is_front_on_left(candidate)},
                            level_slack(screen_.surfaces(), line.nearness_at(candidate.part.begin), kCertainPx));
    }

    /// Adds what is no negligible fold.
    void add_wide(const FineCandidate& candidate, double begin, double end, double shortest,
                  std::vector<LinePiece>& pieces) {
        if (candidate.line.classes.has(LineClass::silhouette) && !candidate.line.is_wire) {
            const double step = kWidthStepPx / candidate.line.length_px();
            // At a vertex rounding says which triangle one gets to.
            const double inset = std::min(0.5, 0.5 * step);
            OpenRange narrow;  // around the last place that was looked at
            const auto is_wide_at = [&](double t) {
                return is_wide(candidate, std::clamp(t, inset, 1 - inset), narrow);
            };
            // A fold that begins narrow is none before it is wide, unless it is a tip of something by itself.
            const auto is_wire_at = [&](double t) { return is_wire(candidate, std::clamp(t, inset, 1 - inset)); };
            if (!is_wide_at(begin) && !is_wire_at(begin)) {
                while (end - begin > shortest && !is_wide_at(begin)) begin = std::min(end, begin + step);
            }
            if (end - begin > shortest && !is_wide_at(end) && !is_wire_at(end)) {
                while (end - begin > shortest && !is_wide_at(end)) end = std::max(begin, end - step);
            }
        }
        if (end - begin > shortest) add(candidate, begin, end, pieces);
    }

    /// Whether both surfaces at a contour go on for more than a negligible fold.
    bool is_wide(const FineCandidate& candidate, double t, OpenRange& narrow) const {
        const WholeLine& line = candidate.line;
        const glm::dvec2 at = line.at(t);
        const bool is_level = line.from.y == line.to.y, is_upright = line.from.x == line.to.x;
        const double place = is_level ? at.x : at.y;
        if (narrow.contains(place)) return false;
        const ScreenMesh& mesh = screen_.mesh(candidate.part.edge.instance);
        const double nearness = line.nearness_at(t);
        if (is_fold_wide(mesh, candidate.part.edge.half_edge, at, nearness,
                         32 * level_slack(screen_.surfaces(), nearness)))
            return true;
        if (is_level || is_upright) narrow = narrow_range(mesh, candidate.part.edge.half_edge, at);
        return false;
    }

    /// Whether the surface closes around at a contour, as a wire's does.
    bool is_wire(const FineCandidate& candidate, double t) const {
        const WholeLine& line = candidate.line;
        return ring_around(screen_.mesh(candidate.part.edge.instance), candidate.part.edge.half_edge, line.at(t),
                           line.nearness_at(t), 0) != Ring::none;
    }

    void add(const FineCandidate& candidate, double begin, double end, std::vector<LinePiece>& pieces) {
        const WholeLine& line = candidate.line;
        LineClassSet classes = line.classes;
        bool occludes = classes.has_any_of(kSurfaceEnds);
        if (classes.has(LineClass::border) && !line.is_wire) {
            if (const auto contact = contact_behind(candidate, 0.5 * (begin + end))) {
                classes = (classes & LineClass::mark) | (*contact & criteria_.classes);
                occludes = false;
                if (classes.empty()) return;
            }
        }
        LinePiece s;
        s.from = to_pixels(line.at(begin));
        s.to = to_pixels(line.at(end));
        s.classes = classes;
        s.drawn_as = *classes.first();
        s.opacity = line.opacity;
        s.line = line.id;
        s.block = static_cast<std::uint32_t>(candidate.part.block_y & 0xFFFF) << 16 |
                  static_cast<std::uint32_t>(candidate.part.block_x & 0xFFFF);
        const double zero = screen_.surfaces().farthest_nearness;
        s.nearness_from = static_cast<float>(zero + line.nearness_at(begin));
        s.nearness_to = static_cast<float>(zero + line.nearness_at(end));
        s.occludes = occludes;
        s.front_on_left = is_front_on_left(candidate);
        pieces.push_back(s);
        if (notes_drawn_ && line.opacity == 255)
            drawn_.add(line, begin, end, {s.drawn_as, s.occludes, s.front_on_left});
    }

    /// A surface that ends in contact with another one has no border there, but the classes of a contact.
    std::optional<LineClassSet> contact_behind(const FineCandidate& candidate, double t) {
        const WholeLine& line = candidate.line;
        const glm::dvec2 at = line.at(t), beyond = at + outward(candidate);
        const double nearness = line.nearness_at(t);
        std::optional<Occluder> behind;
        double nearest = -kFarthestDepth;
        for_triangles(line, beyond, beyond, screen_line(beyond, beyond, -kFarthestDepth),
                      [&](const Occluder& triangle) {
                          const double other = triangle.nearness_at(at);
                          const bool is_nearest =
                              other > nearest || (behind && other == nearest && triangle.number < behind->number);
                          if (!triangle.covers(beyond) || !is_nearest) return true;
                          behind = triangle;
                          nearest = other;
                          return true;
                      });
        if (!behind) return std::nullopt;
        const SurfaceSet& surfaces = screen_.surfaces();
        const Projection& p = surfaces.projection;
        const SurfaceId own = screen_.surface_of(line.owners[0]), other = screen_.surface_of(behind->number);
        const double distance = distance_of(p, surfaces.farthest_nearness + nearness);
        const double gap = distance_of(p, surfaces.farthest_nearness + nearest) - distance;
        if (gap > depth_tolerance(surfaces, distance, surfaces.plane(other))) return std::nullopt;
        const auto solid = finder_.solid_at_border(own, candidate.part.edge.half_edge);
        return solid ? contact_classes(surfaces, *solid, other, to_pixels(at), criteria_) : LineClassSet{};
    }

    /// From the edge of the surface to beyond it. 1/256 pixel.
    glm::dvec2 outward(const FineCandidate& candidate) const {
        const glm::dvec2 along = glm::normalize(candidate.line.to - candidate.line.from), right(-along.y, along.x);
        return double{kBeyondSubpixels} * (is_front_on_left(candidate) ? right : -right);
    }

    /// Whether the front is on the left of the way from the line's beginning to its end.
    bool is_front_on_left(const FineCandidate& candidate) const {
        const WholeLine& line = candidate.line;
        const int side = line.front_side != 0 || line.is_loose() ? line.front_side : owner_side(candidate);
        // For a loose edge, or a surface that is seen edge-on, either side will do, but the same one whichever way the
        // line runs.
        if (side == 0) return line.from.x != line.to.x ? line.from.x < line.to.x : line.from.y < line.to.y;
        return side < 0;  // y runs down
    }
    int owner_side(const FineCandidate& candidate) const {
        const std::uint32_t instance = candidate.part.edge.instance;
        const HalfEdge h = candidate.part.edge.half_edge;
        const auto corner = [&](HalfEdge k) { return screen_.mesh(instance).corners[h - h % 3 + (h + k) % 3]; };
        const auto [from, to] = ends_in_order(screen_, instance, corner(0), corner(1));
        return side_of_edge(screen_, instance, from, to, corner(2));
    }

    const ScreenSurfaces& screen_;
    const EdgeLineFinder& finder_;
    const TileKernels& kernels_;
    Contacts contacts_;
    const LineCriteria& criteria_;
    const std::vector<CrossedTriangle>* given_ = nullptr;
    FineCells cells_;
    std::vector<Place> places_;  // of given triangles in set_up_
    std::vector<Occluder> set_up_;
    std::vector<Interval> hidden_;
    std::vector<std::pair<double, std::uint32_t>> order_;  // of candidates, the nearest first
    DrawnParts drawn_;
    bool notes_drawn_ = false;
};

FineLines::FineLines(const Frame& frame, const ScreenSurfaces& screen, const TriangleBins& bins,
                     const TileKernels& kernels, PixelRect region, bool draws_each, KnownBorders& known_borders)
    : screen_(screen),
      bins_(bins),
      draws_each_(draws_each),
      grid_(samples_per_pixel_of(frame)),
      // The last blocks reach half a sample beyond the region (SampleBlocks).
      finder_(frame, screen, {region.x0, region.y0, region.x1 + 1, region.y1 + 1}, kHasBothOfSeam),
      blocks_(screen, bins, kernels, samples_per_pixel_of(frame)),
      clipper_(std::make_unique<BlockClipper>(screen, finder_, kernels, frame.criteria)),
      known_borders_(known_borders) {}

FineLines::~FineLines() = default;

void FineLines::find(std::size_t tile, std::span<const FinePart> parts, std::vector<LinePiece>& pieces) {
    heaps_.clear();
    if (may_have_heaps(bins_, tile, parts)) note_heaps(tile, parts);
    constexpr bool kWithWalls = true;
    find_candidates(parts, kWithWalls);
    if (candidates_.empty()) return;
    blocks_.fill(tile, candidates_);
    for (std::size_t block = 0; block < blocks_.count(); ++block) {
        throw_if_interrupted();
        const std::span<const std::uint32_t> numbers = blocks_.candidates(block);
        const FinePart& any = candidates_[numbers.front()].part;
        const glm::ivec2 corner(glm::dvec2(grid_.begin(any.block_x), grid_.begin(any.block_y)));
        if (is_heap(block) || is_left_to_samples(block, corner)) continue;
        clipper_->set_triangles(blocks_.triangles(block), corner, numbers.size());
        find_in_block(block, pieces);
    }
}

/// Notes blocks that are heaps already by lines that are told soon: most parts of meshes with thousands of triangles in
/// a pixel may be walls, and to tell which are would take longer than all else.
void FineLines::note_heaps(std::size_t tile, std::span<const FinePart> parts) {
    constexpr bool kWithWalls = false;
    find_candidates(parts, kWithWalls);
    if (candidates_.empty()) return;
    blocks_.fill(tile, candidates_);
    std::vector<glm::ivec2> heaps;
    for (std::size_t block = 0; block < blocks_.count(); ++block) {
        const FinePart& any = candidates_[blocks_.candidates(block).front()].part;
        if (is_heap(block)) heaps.emplace_back(any.block_x, any.block_y);
    }
    heaps_ = std::move(heaps);
}

bool FineLines::is_in_heap(const FinePart& part) const {
    return std::find(heaps_.begin(), heaps_.end(), glm::ivec2(part.block_x, part.block_y)) != heaps_.end();
}

bool FineLines::has_loose(std::size_t block) const {
    const std::span<const std::uint32_t> numbers = blocks_.candidates(block);
    return std::any_of(numbers.begin(), numbers.end(), [&](std::uint32_t i) { return candidates_[i].line.is_loose(); });
}

/// Whether there are too many triangles for each line in a block however small they are: so without a look at them.
bool FineLines::is_heap(std::size_t block) const {
    return !are_few(blocks_.candidates(block).size(), FineCells::least_per_cell(blocks_.triangles(block).size())) &&
           !has_loose(block);
}

/// Whether so many triangles lie over all of a block that there are too many for each line, whatever cells it is cut
/// into. Loose edges are never left to the samples.
bool FineLines::is_left_to_samples(std::size_t block, glm::ivec2 corner) const {
    const std::span<const std::uint32_t> numbers = blocks_.candidates(block);
    const std::vector<CrossedTriangle>& triangles = blocks_.triangles(block);
    return !are_few(numbers.size(), triangles.size()) &&
           !are_few(numbers.size(), count_covering(screen_, triangles, corner)) && !has_loose(block);
}

void FineLines::find_in_block(std::size_t block, std::vector<LinePiece>& pieces) {
    const std::span<const std::uint32_t> numbers = blocks_.candidates(block);
    const std::size_t per_cell = clipper_->triangles_per_cell();
    if (are_few(numbers.size(), per_cell)) {
        if (numbers.size() > kFewCandidates && !draws_each_)
            return clipper_->add_not_covered(candidates_, numbers, pieces);
        for (const std::uint32_t i : numbers) clipper_->add_visible(candidates_[i], pieces);
        return;
    }
    // Samples tell nothing about loose edges: where these alone are too many, all of them are drawn.
    const auto is_loose_one = [&](std::uint32_t i) { return candidates_[i].line.is_loose(); };
    const bool are_few_loose =
        are_few(static_cast<std::size_t>(std::count_if(numbers.begin(), numbers.end(), is_loose_one)), per_cell);
    for (const std::uint32_t i : numbers) {
        if (!is_loose_one(i)) continue;
        if (are_few_loose) {
            clipper_->add_visible(candidates_[i], pieces);
        } else {
            clipper_->add_all(candidates_[i], pieces);
        }
    }
}

/// Finds those that are in no heap.
void FineLines::find_candidates(std::span<const FinePart> parts, bool walls) {
    candidates_.clear();
    const FinePart* before = nullptr;
    std::span<const WholeLine> lines;
    for (const FinePart& part : parts) {
        if (is_in_heap(part)) continue;
        const std::uint32_t instance = part.edge.instance;
        const HalfEdge h = part.edge.half_edge;
        const bool is_same = before != nullptr && before->edge.instance == instance && before->edge.half_edge == h;
        if (!is_same) lines = lines_of(instance, h, walls);
        before = &part;
        for (const WholeLine& line : lines) {
            const double begin =
                (std::max(part.begin, line.edge_begin) - line.edge_begin) / (line.edge_end - line.edge_begin);
            const double end =
                (std::min(part.end, line.edge_end) - line.edge_begin) / (line.edge_end - line.edge_begin);
            if (begin >= end) continue;
            FineCandidate& candidate = candidates_.emplace_back(part, line);
            candidate.part.begin = begin;
            candidate.part.end = end;
            // The other patch of a seam may hide it.
            if (!line.is_loose() && screen_.mesh(instance).partners[h] == h)
                candidate.line.owners[1] = candidate.line.owners[0];
        }
    }
}

/// The lines that an edge is; they are good until the next call.
std::span<const WholeLine> FineLines::lines_of(std::uint32_t instance, HalfEdge h, bool walls) {
    const SurfaceId s{instance, h / 3};
    if (is_loose({instance, h})) {
        lines_.clear();
        finder_.find_loose(instance, h, lines_);
        return lines_;
    }
    if (screen_.mesh(instance).partners[h] != h) {
        lines_.clear();
        finder_.find(s, h, lines_, walls);
        return lines_;
    }
    known_borders_.lines_of(instance, h, lines_, [&](std::vector<WholeLine>& lines) { finder_.find(s, h, lines); });
    return lines_;
}

}  // namespace burin
