#include "abuffer/samples/surface_tile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/level_reach.h"
#include "view/scan_convert.h"

namespace burin {

namespace {

/// The greatest nearness that may be level with a given one.
float highest_level_with(float nearness, const SampleView& tile) {
    return nearness + (nearness * tile.level_per_nearness + tile.level) * level_reach(tile.level_per_nearness);
}

/// The lists of a tile's runs lie far from each other.
void prefetch(const TriangleRun& run) {
    const char* const first = reinterpret_cast<const char*>(run.triangles);
    const std::size_t bytes = std::min(run.count * sizeof(TileTriangle), std::size_t{2048});
    for (std::size_t at = 0; at < bytes; at += 64) __builtin_prefetch(first + at);
}

__attribute__((always_inline)) inline void prefetch(const ScreenMesh& mesh, std::uint32_t triangle) {
    __builtin_prefetch(mesh.corners + 3 * std::size_t{triangle});
    __builtin_prefetch(mesh.line_edges + triangle);
}

}  // namespace

SurfaceTile::SurfaceTile(const Frame& frame, const ScreenSurfaces& screen, const TriangleBins& bins,
                         int samples_per_pixel, const TileKernels& kernels, std::size_t most_contests)
    : screen_(screen), bins_(bins), kernels_(kernels), per_pixel_(samples_per_pixel), contests_(screen, most_contests) {
    // The tolerance at a distance d is a difference in nearness of kDepthTolerancePx / (focal * d).
    const Projection& p = frame.surfaces.projection;
    const double per_nearness = kDepthTolerancePx / p.focal_px;
    level_ = static_cast<float>(per_nearness * (p.orthographic ? 1.0 : frame.surfaces.farthest_nearness));
    level_per_nearness_ = p.orthographic ? 0.0f : static_cast<float>(per_nearness);
    hidden_level_ = level_ * level_reach(level_per_nearness_);
    hidden_level_per_nearness_ = level_per_nearness_ * level_reach(level_per_nearness_);
}

SampleView SurfaceTile::view() {
    SampleView view{samples_.nearness.data(),
                    samples_.ids.data(),
                    samples_.first_column,
                    samples_.first_row,
                    samples_.columns,
                    samples_.rows,
                    samples_.stride,
                    per_pixel_,
                    level_,
                    level_per_nearness_,
                    nullptr,
                    nullptr,
                    0};
    contests_.put_into(view);
    return view;
}

void SurfaceTile::draw(std::size_t tile) {
    rect_ = bins_.tile(tile);
    farthest_.resize(BlockTable::kSize);
    clear_samples();
    order_large_ones(tile);
    order_runs(tile);
    contests_.clear();
    for (draw_all(); !contests_.has_room(); draw_all()) {
        clear_samples();
        if (contests_.are_too_many()) {
            contests_.begin_selecting(samples_.ids.size());
        } else {
            contests_.make_room();
            contests_.clear();
        }
    }
    contests_.settle(samples_);
}

void SurfaceTile::clear_samples() {
    samples_.reset(rect_.x0 * per_pixel_, rect_.y0 * per_pixel_, rect_.width() * per_pixel_ + 1,
                   rect_.height() * per_pixel_ + 1, per_pixel_);
}

/// Ends early where there is no use in going on, because too many are level.
void SurfaceTile::draw_all() {
    draw_large_ones();
    draw_runs(!large_.empty());
}

bool SurfaceTile::is_in_vain() const { return contests_.are_too_many() && !contests_.has_room(); }

/// Finds what cannot be seen, by what was drawn so far, and is not level with what is; where there is enough that is
/// level, it is what is farther than all that.
void SurfaceTile::find_farthest() {
    SampleView samples = view();
    if (contests_.is_selecting()) {
        left_out_.resize(samples_.nearness.size());
        const float* const last = contests_.last_nearness();
        for (std::size_t i = 0; i < left_out_.size(); ++i) {
            left_out_[i] = samples_.nearness[i];
            if (!(last[i] > -std::numeric_limits<float>::infinity())) continue;
            // What is farther than the last one is less near than this, in either way that it is
            // asked.
            const float level = std::min(highest_level_with(last[i], samples), highest_level_with_hidden(last[i]));
            left_out_[i] = std::max(left_out_[i], level);
        }
        samples.nearness = left_out_.data();
    }
    kernels_.blocks.find_farthest(samples, farthest_.data());
}

/// What is hidden by what was drawn so far need not be drawn. The picture does not depend on the order, only the time
/// does. Runs are short, so those between two looks are drawn together: what comes next is on its way meanwhile.
void SurfaceTile::draw_runs(bool is_worth_a_look) {
    constexpr std::size_t kWorthALook = 256;  // triangles
    std::size_t since_look = is_worth_a_look ? kWorthALook : 0;
    bool has_look = false;
    const auto is_hidden = [&](const TriangleRun& run) {
        return has_look && run.is_behind(farthest_.data(), highest_level_with_hidden(run.highest));
    };
    for (std::size_t i = 0, next = 0; i < runs_.size() && !is_in_vain(); i = next) {
        for (++next; next < runs_.size() && is_hidden(*runs_[next].run);) ++next;
        if (next < runs_.size()) prefetch(*runs_[next].run);
        const TriangleRun& run = *runs_[i].run;
        if (since_look >= kWorthALook) {
            const ScreenMesh& mesh = screen_.mesh(run.instance);
            for (std::size_t k = 0; k < run.count && k < kTrianglesAhead; ++k)
                prefetch(mesh, run.triangles[k].triangle);
            draw_seen();
            find_farthest();
            since_look = 0;
            has_look = true;
        }
        if (run.instance != seen_of_) draw_seen();
        seen_of_ = run.instance;
        const std::size_t before = seen_count_;
        find_seen(run, has_look);
        since_look += seen_count_ - before;
    }
    draw_seen();
}

/// Adds the triangles of a run that are not hidden.
void SurfaceTile::find_seen(const TriangleRun& run, bool has_look) {
    if (seen_.size() < seen_count_ + run.count) seen_.resize(2 * (seen_count_ + run.count));
    std::uint32_t* const found = seen_.data() + seen_count_;
    std::size_t count = run.count;
    if (has_look) {
        count = kernels_.blocks.find_nearer(farthest_.data(), hidden_level_, hidden_level_per_nearness_, run.triangles,
                                            run.count, found);
    } else {
        for (std::size_t i = 0; i < count; ++i) found[i] = run.triangles[i].triangle;
    }
    // Draw::small_triangles() prefetches the rest itself.
    for (std::size_t i = 0; seen_count_ + i < kTrianglesAhead && i < count; ++i)
        prefetch(screen_.mesh(run.instance), found[i]);
    seen_count_ += count;
}

void SurfaceTile::draw_seen() {
    if (seen_count_ == 0) return;
    const ScreenMesh& mesh = screen_.mesh(seen_of_);
    const std::size_t sample_count = samples_.ids.size();
    for (std::size_t begin = 0, end = seen_count_; begin < seen_count_; begin = end) {
        if (contests_.is_selecting()) {
            contests_.make_room_for(sample_count);
            end = std::min(begin + contests_.room_left() / sample_count, seen_count_);
        }
        kernels_.draw.small_triangles(view(), mesh, seen_.data() + begin, end - begin);
    }
    drawn_ += seen_count_;
    seen_count_ = 0;
}

/// Puts the half of a closed surface that is turned to the eye first, whichever way it is wound, and in it near runs
/// first, by the nearness of one triangle of each.
void SurfaceTile::order_runs(std::size_t tile) {
    runs_.clear();
    double sum[2] = {0, 0}, count[2] = {0, 0};
    for (const TriangleRun& run : bins_.runs_in(tile)) {
        runs_.push_back({&run, run.nearness});
        sum[run.kind] += static_cast<double>(run.nearness) * run.count;
        count[run.kind] += run.count;
    }
    const TriangleKind near_kind = sum[1] * count[0] > sum[0] * count[1] ? wound_clockwise : wound_counterclockwise;
    std::sort(runs_.begin(), runs_.end(), [&](const PlacedRun& a, const PlacedRun& b) {
        const bool a_near = a.run->kind == near_kind, b_near = b.run->kind == near_kind;
        return a_near != b_near ? a_near : a.nearness > b.nearness;
    });
}

/// Near polygons come first.
void SurfaceTile::order_large_ones(std::size_t tile) {
    large_.clear();
    for (const std::uint32_t i : bins_.large_in(tile)) {
        large_.push_back({i, highest_in(bins_.large(i).plane, 0, samples_.columns, 0, samples_.rows)});
    }
    std::sort(large_.begin(), large_.end(), [](const PlacedPolygon& a, const PlacedPolygon& b) {
        return a.highest != b.highest ? a.highest > b.highest : a.number < b.number;
    });
}

void SurfaceTile::draw_large_ones() {
    const int worth_a_look =
        samples_.columns * samples_.rows / 2 * (contests_.is_selecting() ? 8 : 1);  // it takes longer then
    int since_look = 0;
    bool has_look = false;
    const SampleView samples = view();
    float farthest = -std::numeric_limits<float>::infinity();  // of all samples
    for (const PlacedPolygon& placed : large_) {
        if (since_look >= worth_a_look) {
            find_farthest();
            farthest = farthest_in_blocks();
            since_look = 0;
            has_look = true;
        }
        if (is_in_vain() || highest_level_with(placed.highest, samples) < farthest) break;  // and so are all that come
        const LargePolygon& large = bins_.large(placed.number);
        since_look += draw_large(large, screen_.is_plain(large.plane.id >> 1), has_look);
    }
}

/// The least nearness in the tile, by the last look.
float SurfaceTile::farthest_in_blocks() const {
    const auto along = [](int count) { return (count + kBlockSamples - 1) >> kBlockShift; };
    float farthest = std::numeric_limits<float>::infinity();
    for (int row = 0; row < along(samples_.rows); ++row) {
        const float* const first = farthest_.data() + row * BlockTable::kPitch;
        farthest = std::min(farthest, *std::min_element(first, first + along(samples_.columns)));
    }
    return farthest;
}

/// The greatest nearness that Draw::span() may find in a rectangle of samples: at one of its corners, for its
/// roundings keep the order of numbers, too.
float SurfaceTile::highest_in(const SpanPlane& plane, int from, int to, int first_row, int end_row) const {
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

/// Draws a large polygon in strips of blocks, without blocks at the strip's ends that hide the polygon; `has_look`:
/// these are known. Returns how many samples were drawn.
int SurfaceTile::draw_large(const LargePolygon& large, bool plain, bool has_look) {
    ++drawn_;
    const ScanConverter scan(large.polygon, per_pixel_);
    SpanPlane plane = large.plane;
    const SampleView tile = view();
    const float pitch = static_cast<float>(kSubpixelsPerPixel / per_pixel_),
                level = plane.low * tile.level_per_nearness + tile.level;
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
            const float high =
                highest_level_with(highest_in(plane, first_column, end_column, first_row, end_row), tile);
            const float* const farthest = farthest_.data() + (strip >> kBlockShift) * BlockTable::kPitch;
            while (begin < end && high < farthest[begin]) ++begin;
            while (begin < end && high < farthest[end - 1]) --end;
        }
        const int least = std::max(first_column, begin << kBlockShift), most = std::min(end_column, end << kBlockShift);
        if (least >= most) continue;
        if (contests_.is_selecting())
            contests_.make_room_for(static_cast<std::size_t>(kBlockSamples * samples_.stride));
        if (scan.fits_doubles()) {
            drawn += kernels_.draw.polygon(tile, scan.edges().data(), scan.edges().size(),
                                           {least, first_row, most, end_row}, plane);
            continue;
        }
        for (int row = first_row; row < end_row; ++row) {
            const SampleSpan span = scan.span(row + samples_.first_row);
            const int from = std::max(span.begin - samples_.first_column, least);
            const int to = std::min(span.end - samples_.first_column, most);
            if (from >= to) continue;
            kernels_.draw.span(tile, row, from, to, plane);
            drawn += to - from;
        }
    }
    return drawn;
}

}  // namespace burin
