#include "methods/abuffer/line_tile.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "abuffer/scan_convert.h"
#include "lines/cell_tracer.h"
#include "methods/abuffer/sampling.h"

namespace burin {

namespace {

/// The nearest that may be level with something of a given nearness.
float highest_level_with(float nearness, const SampleView& tile) {
    return nearness + (nearness * tile.level_per_nearness + tile.level);
}

/// The lists of a tile's runs lie far from each other.
void prefetch(const TriangleRun& run) {
    const char* const first = reinterpret_cast<const char*>(run.triangles);
    const std::size_t bytes = std::min(run.count * sizeof(TileTriangle), std::size_t{2048});
    for (std::size_t at = 0; at < bytes; at += 64) __builtin_prefetch(first + at);
}

bool is_occluding(const LineDecision& decision) {
    return decision.reason == LineReason::turns_away || decision.reason == LineReason::ends_at_border ||
           decision.reason == LineReason::unexplained;
}

}  // namespace

LineTile::LineTile(const Frame& frame, const ScreenSurfaces& screen, const TriangleBins& bins,
                   int samples_per_pixel, const TileKernels& kernels)
    : frame_(frame),
      screen_(screen),
      bins_(bins),
      per_pixel_(samples_per_pixel),
      kernels_(kernels),
      keeps_undrawn_(!frame.criteria.classes.empty() && !(frame.criteria.classes.has(LineClass::silhouette) &&
                                                          frame.criteria.classes.has(LineClass::border))),
      fast_(screen, frame.criteria),
      flush_(screen, bins, frame.criteria),
      fade_(frame.scene->lines.crease_fade()) {}

SampleView LineTile::view() {
    // Two pixels' width at a distance d is a difference in nearness of 2 / (focal * d).
    const Projection& p = frame_.surfaces.projection;
    const double per_nearness = 2 / p.focal_px;
    return {samples_.nearness.data(),
            samples_.ids.data(),
            samples_.first_column,
            samples_.first_row,
            samples_.columns,
            samples_.rows,
            samples_.stride,
            per_pixel_,
            static_cast<float>(per_nearness * (p.orthographic ? 1.0 : frame_.surfaces.farthest_nearness)),
            p.orthographic ? 0.0f : static_cast<float>(per_nearness),
            contests_.data(),
            &contest_count_,
            static_cast<std::uint32_t>(contests_.size())};
}

void LineTile::draw(std::size_t tile) {
    rect_ = bins_.tile(tile);
    flush_.set_tile(tile);
    if (contests_.empty()) contests_.resize(1 << 14);
    draw_all(tile);
    if (contest_count_ > contests_.size()) {  // once more, with room for all
        contests_.resize(contest_count_);
        draw_all(tile);
    }
    contests_used_ = contest_count_;
    settle_contests();
}

void LineTile::draw_all(std::size_t tile) {
    contest_count_ = 0;
    samples_.reset(rect_.x0 * per_pixel_, rect_.y0 * per_pixel_, rect_.width() * per_pixel_ + 1,
                   rect_.height() * per_pixel_ + 1, per_pixel_);
    farthest_.resize(BlockTable::kSize);
    draw_large_ones(tile);
    order_runs(tile);
    // What is hidden by what was drawn so far need not be drawn. The picture does not depend on the
    // order, only the time does.
    constexpr std::size_t kWorthALook = 256;  // triangles
    std::size_t since_look = bins_.large_in(tile).empty() ? 0 : kWorthALook;
    bool has_look = false;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
        if (i + 1 < runs_.size()) prefetch(*runs_[i + 1].run);
        const TriangleRun& run = *runs_[i].run;
        if (since_look >= kWorthALook) {
            kernels_.find_farthest(view(), farthest_.data());
            since_look = 0;
            has_look = true;
        }
        const std::size_t drawn = kernels_.draw_small(view(), has_look ? farthest_.data() : nullptr,
                                                      screen_.mesh(run.instance), run.triangles, run.count);
        since_look += drawn;
        drawn_ += drawn;
    }
}

/// On the edge of a surface that ends at another one, and where two faces fold over, both are level, and rounding says which
/// is seen. Of those the one in front wins, and of coincident surfaces the first one, as in resolve_visibility().
void LineTile::settle_contests() {
    // Mostly nothing is to be done: those of samples where nothing takes the winner's place are left out.
    if (is_open_.size() < samples_.ids.size()) is_open_.assign(samples_.ids.size(), 0);
    bool has_open = false;
    for (std::uint32_t i = 0; i < contests_used_; ++i) {
        const std::uint32_t winner = samples_.ids[contests_[i].sample] >> 1, loser = contests_[i].loser >> 1;
        if (loser == winner || !relation(loser, winner).any()) continue;
        is_open_[contests_[i].sample] = 1;
        has_open = true;
    }
    if (!has_open) return;
    const auto end_of_open = std::remove_if(contests_.begin(), contests_.begin() + contests_used_,
                                            [&](const Contest& c) { return is_open_[c.sample] == 0; });
    std::sort(contests_.begin(), end_of_open, [](const Contest& a, const Contest& b) {
        return std::tie(a.sample, a.loser) < std::tie(b.sample, b.loser);
    });
    for (auto begin = contests_.begin(), end = begin; begin != end_of_open; begin = end) {
        const std::uint32_t sample = begin->sample;
        std::uint32_t winner = samples_.ids[sample] >> 1;
        while (end != end_of_open && end->sample == sample) ++end;
        const auto for_losers = [&](const auto& wins) {  // in the order of their numbers
            for (auto contest = begin; contest != end; ++contest) {
                const std::uint32_t loser = contest->loser >> 1;
                if (loser == winner || !wins(loser)) continue;
                winner = loser;
                samples_.ids[sample] = loser << 1;
            }
        };
        const auto put_folds_in_front = [&] { for_losers([&](std::uint32_t loser) { return relation(loser, winner).folds_over; }); };
        for_losers([&](std::uint32_t loser) { return relation(loser, winner).is_in_front; });
        put_folds_in_front();
        bool settled = false;
        for_losers([&](std::uint32_t loser) {
            if (settled) return false;
            settled = relation(loser, winner).comes_first;
            return settled;
        });
        if (settled) put_folds_in_front();
        is_open_[sample] = 0;
    }
}

/// Mostly asked of the same two for one sample after the other.
const LineTile::Relation& LineTile::relation(std::uint32_t loser, std::uint32_t winner) {
    constexpr std::size_t kAtFirst = 512, kMost = std::size_t{1} << 16;
    // In a heap of nearly equal surfaces each is asked about each, for every sample: room for all saves most of the time.
    if (relations_.empty() || (forgotten_ > relations_.size() && relations_.size() < kMost)) {
        relations_.assign(std::clamp(4 * relations_.size(), kAtFirst, kMost), {});
        forgotten_ = 0;
    }
    const std::uint64_t mixed = (std::uint64_t{loser} << 32 | winner) * 0x9E3779B97F4A7C15u;
    Relation& r = relations_[(mixed >> 32) % relations_.size()];
    if (r.loser == loser && r.winner == winner) return r;
    if (r.loser != r.winner) ++forgotten_;
    SurfaceOrder o;
    if (loser < winner || may_be_in_front(loser, winner)) o = order(loser, winner);
    r = {loser, winner, o.is_in_front(), is_fold_over(loser, winner), loser < winner && o.are_coincident()};
    return r;
}

/// Whether a part of `back` is behind the plane of `front` by more than snapping does: else the order of the two, which takes
/// longer, need not be asked for.
bool LineTile::may_be_in_front(std::uint32_t front, std::uint32_t back) const {
    if (screen_.facing(front) == off_screen || screen_.facing(back) == off_screen) return true;
    if (screen_.facing(front) == edge_on) return false;
    const ScreenTriangle plane = screen_.triangle(screen_.surface_of(front)), other = screen_.triangle(screen_.surface_of(back));
    const ScreenVertex& origin = plane.corners[0];
    const double here = extended_nearness(plane, origin.x, origin.y);
    const double snapping = std::abs(extended_nearness(plane, origin.x + 1, origin.y) - here) + std::abs(extended_nearness(plane, origin.x, origin.y + 1) - here);
    return std::any_of(std::begin(other.corners), std::end(other.corners), [&](const ScreenVertex& corner) {
        return extended_nearness(plane, corner.x, corner.y) - static_cast<double>(corner.nearness) > snapping;
    });
}

/// Whether two neighbours lie on one side of their common edge, and `front` in front of the other one.
bool LineTile::is_fold_over(std::uint32_t front, std::uint32_t back) const {
    const SurfaceId a = screen_.surface_of(front), b = screen_.surface_of(back);
    if (a.instance != b.instance || a.triangle == b.triangle) return false;
    const auto& s = frame_.surfaces.mesh_of(a).triangles[a.triangle];
    const auto& t = frame_.surfaces.mesh_of(a).triangles[b.triangle];
    const ScreenVertex* const vertices = screen_.vertices(a.instance);
    ScreenTriangle own;
    std::array<ScreenVertex, 2> edge;
    std::size_t common = 0;
    std::uint32_t apex = 0, other_apex = t[0] ^ t[1] ^ t[2];
    for (std::size_t k = 0; k < 3; ++k) {
        own.corners[k] = vertices[s[k]];
        if (own.corners[k].x == ScreenVertex::kOffScreen) return false;
        if (std::find(t.begin(), t.end(), s[k]) == t.end()) {
            apex = s[k];
        } else {
            if (common < 2) edge[common] = own.corners[k];
            ++common;
            other_apex ^= s[k];
        }
    }
    if (common != 2 || vertices[other_apex].x == ScreenVertex::kOffScreen) return false;
    const ScreenVertex& beyond = vertices[other_apex];
    const std::int64_t side = doubled_area(edge[0], edge[1], vertices[apex]), other_side = doubled_area(edge[0], edge[1], beyond);
    if ((side < 0) != (other_side < 0) || side == 0 || other_side == 0) return false;
    return extended_nearness(own, beyond.x, beyond.y) > static_cast<double>(beyond.nearness);
}

SurfaceOrder LineTile::order(std::uint32_t loser, std::uint32_t winner) const {
    const SurfaceId a = screen_.surface_of(loser), b = screen_.surface_of(winner);
    if (a.instance == b.instance) {
        // Neighbours that fold over are level along their edge, and no more.
        const auto& s = frame_.surfaces.mesh_of(a).triangles[a.triangle];
        const auto& t = frame_.surfaces.mesh_of(a).triangles[b.triangle];
        for (const std::uint32_t v : s) {
            if (std::find(t.begin(), t.end(), v) != t.end()) return {};
        }
    }
    return frame_.surfaces.order(a, b);
}

/// Of a closed surface, the half that is turned to the eye first, whichever way it is wound, and in it
/// near runs first, by the nearness of one triangle of each.
void LineTile::order_runs(std::size_t tile) {
    runs_.clear();
    double sum[2] = {0, 0}, count[2] = {0, 0};
    for (const TriangleRun& run : bins_.runs_in(tile)) {
        const ScreenTriangle t = screen_.triangle({run.instance, run.triangles[run.count / 2].triangle});
        runs_.push_back({&run, t.corners[0].nearness});
        sum[run.kind] += static_cast<double>(t.corners[0].nearness) * run.count;
        count[run.kind] += run.count;
    }
    const TriangleKind near_kind = sum[1] * count[0] > sum[0] * count[1] ? wound_clockwise : wound_counterclockwise;
    std::sort(runs_.begin(), runs_.end(), [&](const PlacedRun& a, const PlacedRun& b) {
        const bool a_near = a.run->kind == near_kind, b_near = b.run->kind == near_kind;
        return a_near != b_near ? a_near : a.nearness > b.nearness;
    });
}

/// Near ones first.
void LineTile::draw_large_ones(std::size_t tile) {
    large_.clear();
    for (const std::uint32_t i : bins_.large_in(tile)) {
        large_.push_back({i, highest_in(bins_.large(i).plane, 0, samples_.columns, 0, samples_.rows)});
    }
    std::sort(large_.begin(), large_.end(), [](const PlacedPolygon& a, const PlacedPolygon& b) {
        return a.highest != b.highest ? a.highest > b.highest : a.number < b.number;
    });
    const int worth_a_look = samples_.columns * samples_.rows / 2;
    int since_look = 0;
    bool has_look = false;
    const SampleView samples = view();
    float farthest = -std::numeric_limits<float>::infinity();  // of all samples
    for (const PlacedPolygon& placed : large_) {
        if (since_look >= worth_a_look) {
            kernels_.find_farthest(samples, farthest_.data());
            farthest = farthest_in_blocks();
            since_look = 0;
            has_look = true;
        }
        if (highest_level_with(placed.highest, samples) < farthest) break;  // and so are all that come
        const LargePolygon& large = bins_.large(placed.number);
        since_look += draw_large(large, screen_.is_plain(large.plane.id >> 1), has_look);
    }
}

/// The least nearness in the tile, by the last look.
float LineTile::farthest_in_blocks() const {
    const auto along = [](int count) { return (count + kBlockSamples - 1) >> kBlockShift; };
    float farthest = std::numeric_limits<float>::infinity();
    for (int row = 0; row < along(samples_.rows); ++row) {
        const float* const first = farthest_.data() + row * BlockTable::kPitch;
        farthest = std::min(farthest, *std::min_element(first, first + along(samples_.columns)));
    }
    return farthest;
}

/// The greatest nearness that draw_span() may find in a rectangle of samples: at one of its corners, for its
/// roundings keep the order of numbers, too.
float LineTile::highest_in(const SpanPlane& plane, int from, int to, int first_row, int end_row) const {
    const std::int32_t pitch = kSubpixelsPerPixel / per_pixel_;
    const auto nearness_at = [&](int column, int row) {
        const auto x = static_cast<float>((samples_.first_column + column) * pitch + pitch / 2 - plane.x);
        const auto y = static_cast<float>((samples_.first_row + row) * pitch + pitch / 2 - plane.y);
        const float down = y * plane.per_y;
        return x * plane.per_x + plane.nearness + down;
    };
    const int column = plane.per_x > 0 ? to - 1 : from, row = plane.per_y > 0 ? end_row - 1 : first_row;
    const float nearness = nearness_at(column, row);
    return nearness < plane.high ? std::max(nearness, plane.low) : plane.high;  // not a number: the highest
}

/// In strips of blocks, without those at the strip's ends that hide the polygon; `has_look`: they are known.
/// Returns how many samples were drawn.
int LineTile::draw_large(const LargePolygon& large, bool plain, bool has_look) {
    ++drawn_;
    const ScanConverter scan(large.polygon, per_pixel_);
    SpanPlane plane = large.plane;
    const SampleView tile = view();
    const float pitch = static_cast<float>(kSubpixelsPerPixel / per_pixel_), level = plane.low * tile.level_per_nearness + tile.level;
    const bool is_steep = !(std::max(std::abs(plane.per_x), std::abs(plane.per_y)) * pitch <= level);
    plane.id |= plain && !is_steep ? 1u : 0u;
    const int left = std::max(scan.first_column() - samples_.first_column, 0);
    const int right = std::min(scan.end_column() - samples_.first_column, samples_.columns);
    const int top = std::max(scan.first_row() - samples_.first_row, 0);
    const int bottom = std::min(scan.end_row() - samples_.first_row, samples_.rows);
    int drawn = 0;
    if (left >= right) return drawn;
    for (int strip = top & -kBlockSamples; strip < bottom; strip += kBlockSamples) {
        const int first_row = std::max(strip, top), end_row = std::min(strip + kBlockSamples, bottom);
        const SampleSpan in_strip = scan.columns_in(samples_.first_row + first_row, samples_.first_row + end_row);
        const int first_column = std::max(left, in_strip.begin - samples_.first_column);
        const int end_column = std::min(right, in_strip.end - samples_.first_column);
        if (first_column >= end_column) continue;
        int begin = first_column >> kBlockShift, end = ((end_column - 1) >> kBlockShift) + 1;
        if (has_look) {
            const float high = highest_level_with(highest_in(plane, first_column, end_column, first_row, end_row), tile);
            const float* const farthest = farthest_.data() + (strip >> kBlockShift) * BlockTable::kPitch;
            while (begin < end && high < farthest[begin]) ++begin;
            while (begin < end && high < farthest[end - 1]) --end;
        }
        const int least = std::max(first_column, begin << kBlockShift), most = std::min(end_column, end << kBlockShift);
        if (least >= most) continue;
        if (scan.fits_doubles()) {
            drawn += kernels_.draw_polygon(tile, scan.edges().data(), scan.edges().size(), {least, first_row, most, end_row}, plane);
            continue;
        }
        for (int row = first_row; row < end_row; ++row) {
            const SampleSpan span = scan.span(row + samples_.first_row);
            const int from = std::max(span.begin - samples_.first_column, least);
            const int to = std::min(span.end - samples_.first_column, most);
            if (from >= to) continue;
            kernels_.draw_span(tile, row, from, to, plane);
            drawn += to - from;
        }
    }
    return drawn;
}

glm::dvec2 LineTile::position(int column, int row) const {
    // A sample exactly on an edge belongs to the polygon below or to the right, so its place is taken
    // a trifle further there.
    constexpr double kTrifleX = 0x1p-14, kTrifleY = 0x1p-20;
    const double s = per_pixel_;
    return {(samples_.first_column + column + 0.5) / s + kTrifleX, (samples_.first_row + row + 0.5) / s + kTrifleY};
}

/// Whether there is a line between two samples that are not known to lie on one smooth surface.
bool LineTile::decide(const SamplePair& pair, const NeighbourSamples& neighbours, LineCrossing& crossing) {
    LineDecision decision;
    const glm::dvec2 a = position(pair.column, pair.row);
    const glm::dvec2 b = position(pair.column + (pair.down ? 0 : 1), pair.row + (pair.down ? 1 : 0));
    if (!fast_.decide(neighbours, decision, crossing.nearness)) {
        const VisiblePoint points[2] = {{a, neighbours.surfaces[0]}, {b, neighbours.surfaces[1]}};
        decision = decide_line(frame_.surfaces, points[0], points[1], frame_.criteria);
        if (!decision.classes.empty()) {
            const DepthPlane plane = frame_.surfaces.plane(neighbours.surfaces[decision.front]);
            crossing.nearness = plane.nearness(glm::mix(a, b, decision.fraction));
        }
    }
    crossing.classes = decision.classes & frame_.criteria.classes;
    crossing.opacity = fade_.opacity(crossing.classes, decision.crease_cosine);
    if (crossing.opacity == 0) crossing.classes = {};
    crossing.occludes = is_occluding(decision);
    if (crossing.classes.empty() && !(keeps_undrawn_ && crossing.occludes)) return false;
    if (!crossing.classes.has(LineClass::mark)) {
        const std::size_t first = pair.row * static_cast<std::size_t>(samples_.stride) + pair.column;
        const std::size_t second = first + (pair.down ? static_cast<std::size_t>(samples_.stride) : 1);
        const float nearness[2] = {samples_.nearness[first], samples_.nearness[second]};
        if (flush_.covers(neighbours, {pair.column, pair.row}, nearness, decision.edge.half_edge)) return false;
    }
    crossing.pixel = glm::mix(a, b, std::clamp(decision.fraction, 0.0, 1.0));
    crossing.towards_front = decision.front == 0 ? a - b : b - a;
    const HalfEdge h = decision.edge.half_edge;
    if (h != kNoHalfEdge) {
        const std::uint32_t instance = decision.edge.surface.instance;
        const ScreenMesh& mesh = screen_.mesh(instance);
        crossing.line_key = std::uint64_t{instance} << 32 | std::min(h, mesh.partners[h]);
        const std::uint32_t first = h - h % 3;
        const ScreenVertex& from = mesh.vertices[mesh.corners[h]];
        const ScreenVertex& to = mesh.vertices[mesh.corners[first + (h - first + 1) % 3]];
        if (from.x != ScreenVertex::kOffScreen && to.x != ScreenVertex::kOffScreen) {
            crossing.edge_ends[0] = glm::dvec2(from.x, from.y) / double{kSubpixelsPerPixel};
            crossing.edge_ends[1] = glm::dvec2(to.x, to.y) / double{kSubpixelsPerPixel};
            crossing.along = crossing.edge_ends[1] - crossing.edge_ends[0];
        }
    } else {
        if (decision.reason == LineReason::passes_through) {
            const DepthPlane p = frame_.surfaces.plane(neighbours.surfaces[0]);
            const DepthPlane q = frame_.surfaces.plane(neighbours.surfaces[1]);
            crossing.along = {q.per_y - p.per_y, p.per_x - q.per_x};
        }
        // The background is beside a surface where no edge of it is found: views too narrow for numbers.
        const auto number = [this](SurfaceId id) { return id.is_background() ? ~0u : screen_.number_of(id); };
        const auto [low, high] = std::minmax({number(neighbours.surfaces[0]), number(neighbours.surfaces[1])});
        crossing.line_key = std::uint64_t{1} << 63 | std::uint64_t{low} << 32 | high;
    }
    return true;
}

/// Finds the pairs between which a line may lie, and which of them are known to be of one smooth surface.
void LineTile::find_pairs() {
    pairs_.resize(2 * static_cast<std::size_t>(samples_.columns) * static_cast<std::size_t>(samples_.rows));
    const SampleView tile = view();
    pair_count_ = kernels_.find_pairs(tile, pairs_.data());
    is_smooth_.assign(pair_count_, 0);
    const auto first_id = [&](std::size_t i) {
        return samples_.ids[pairs_[i].row * static_cast<std::size_t>(samples_.stride) + pairs_[i].column];
    };
    // Those of one mesh after the other.
    for (std::size_t begin = 0; begin < pair_count_;) {
        if (first_id(begin) == SampleTile::kBackground) {
            ++begin;
            continue;
        }
        const ScreenMesh& mesh = screen_.mesh(screen_.surface_of(first_id(begin) >> 1).instance);
        const auto is_of_another = [&](std::uint32_t id) {
            return id != SampleTile::kBackground && (id >> 1) - mesh.first_number >= mesh.triangle_count;
        };
        std::size_t end = begin + 1;
        while (end < pair_count_ && !is_of_another(first_id(end))) ++end;
        if (mesh.sharp != nullptr) {
            kernels_.find_smooth(tile, mesh, fast_.smooth_limits(), pairs_.data() + begin, end - begin, is_smooth_.data() + begin);
        }
        begin = end;
    }
}

NeighbourSamples LineTile::neighbours_of(const SamplePair& pair) const {
    const std::int32_t pitch = kSubpixelsPerPixel / per_pixel_;
    const auto stride = static_cast<std::size_t>(samples_.stride);
    const std::size_t at = pair.row * stride + pair.column;
    return {(samples_.first_column + pair.column) * pitch + pitch / 2, (samples_.first_row + pair.row) * pitch + pitch / 2,
            pitch, pair.down, {surface_at(at), surface_at(at + (pair.down ? stride : 1))}};
}

void LineTile::find_crossings() {
    find_pairs();
    crossings_.clear();
    crossing_places_.clear();
    for (std::size_t i = 0; i < pair_count_; ++i) {
        if (is_smooth_[i] != 0) continue;
        const SamplePair& pair = pairs_[i];
        if (!decide(pair, neighbours_of(pair), crossings_.emplace_back())) {
            crossings_.pop_back();
            continue;
        }
        crossing_places_.push_back(pair);
        const std::size_t at = pair.row * static_cast<std::size_t>(samples_.stride) + pair.column;
        (pair.down ? down_ : right_)[at] = static_cast<std::uint32_t>(crossings_.size());
    }
}

void LineTile::find_lines(std::vector<LineSegment>& segments) {
    const std::size_t size = samples_.ids.size();
    if (right_.size() < size) {
        right_.assign(size, 0);
        down_.assign(size, 0);
    }
    find_crossings();
    pieces_.clear();
    trace_cells(pieces_);
    merger_.merge(pieces_);
    segments.insert(segments.end(), pieces_.begin(), pieces_.end());
    for (const SamplePair& place : crossing_places_) {
        (place.down ? down_ : right_)[static_cast<std::size_t>(place.row) *
                                          static_cast<std::size_t>(samples_.stride) +
                                      place.column] = 0;
    }
}

void LineTile::trace_cells(std::vector<LineSegment>& segments) {
    const auto stride = static_cast<std::size_t>(samples_.stride);
    const double s = per_pixel_;
    const bool has_bridges = !completes_lines(*frame_.scene);
    const int block_shift = std::countr_zero(static_cast<unsigned>(kMergeBlockPx * per_pixel_));
    const auto block_of = [block_shift](int sample) {
        return static_cast<std::uint32_t>(sample >> block_shift) & 0xFFFFu;
    };
    // Each cell is traced when its first crossing is met, in the order left, upper, lower, right side.
    const auto trace = [&](int column, int row, const SamplePair& from) {
        if (column < 0 || row < 0 || column + 1 >= samples_.columns || row + 1 >= samples_.rows) return;
        const std::size_t i = static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(column);
        const std::uint32_t sides[4] = {right_[i], down_[i], down_[i + 1], right_[i + stride]};
        std::array<const LineCrossing*, 4> found{};
        std::size_t count = 0;
        for (const std::uint32_t side : sides) {
            if (side != 0) found[count++] = &crossings_[side - 1];
        }
        const std::uint32_t own = (from.down ? down_ : right_)[from.row * stride + from.column];
        if (found[0] != &crossings_[own - 1]) return;  // another crossing traces this cell
        const glm::dvec2 low((samples_.first_column + column + 0.5) / s, (samples_.first_row + row + 0.5) / s);
        std::size_t fresh = segments.size();
        trace_cell({found.data(), count}, low, low + 1.0 / s, has_bridges, segments);
        const std::uint32_t block = block_of(samples_.first_row + row) << 16 | block_of(samples_.first_column + column);
        for (; fresh < segments.size(); ++fresh) segments[fresh].block = block;
    };
    for (const SamplePair& place : crossing_places_) {
        if (place.down) {
            trace(place.column - 1, place.row, place);
            trace(place.column, place.row, place);
        } else {
            trace(place.column, place.row - 1, place);
            trace(place.column, place.row, place);
        }
    }
}

}  // namespace burin
