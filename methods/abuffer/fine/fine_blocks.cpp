#include "methods/abuffer/fine/fine_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "methods/abuffer/layers/layer_triangle.h"

namespace burin {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
/// A border asks what is behind it, too. As a multiple of level_slack(): 4 pixels' widths.
constexpr double kBehindBorder = 64;
/// So far beside a line triangles are asked for, with what rounding may do to places. 1/256 pixel.
constexpr int kReach = kBeyondSubpixels + 1;
/// 1/256 pixel. Four times as far as any place on the screen.
constexpr float kFar = 1 << 24;
constexpr FlatTriangle kAllOfTheScreen = {{-kFar, 3 * kFar, -kFar}, {-kFar, -kFar, 3 * kFar}, kNothing};

}  // namespace

void FineBlocks::fill(std::size_t tile, std::span<const FineCandidate> candidates) {
    rect_ = bins_.tile(tile);
    first_x_ = rect_.x0 / kMergeBlockPx;
    first_y_ = rect_.y0 / kMergeBlockPx;
    columns_ = rect_.width() / kMergeBlockPx;
    rows_ = rect_.height() / kMergeBlockPx;
    count_ = 0;
    index_.assign(block_at(0, rows_), kNone);
    farthest_.assign(cell_at(0, kCells * rows_), kNothing);
    const int samples = kSubpixelsPerPixel / (2 * grid_.half_pitch) * bins_.tile_px();
    sample_blocks_ = (samples >> kBlockShift) + 1;  // a tile has one more column and row of samples
    least_.assign(BlockTable::kSize, kNothing);
    sort_candidates(candidates);
    kernels_.combine_blocks(sample_blocks_, sample_blocks_, least_.data());
    for (const TriangleRun& run : bins_.runs_in(tile)) add_small(run);
    for (const TriangleRun& run : bins_.thin_runs_in(tile)) add_small(run);
    for (const std::uint32_t i : bins_.large_in(tile)) add_large(bins_.large(i));
    for (const std::uint32_t i : bins_.thin_large_in(tile)) add_large(bins_.large(i));
    add_beyond(tile);
}

/// From the tiles around it, where a border lies so close to the end of this one that what it is in contact with may not touch it.
void FineBlocks::add_beyond(std::size_t tile) {
    const glm::ivec2 low = kSubpixelsPerPixel * glm::ivec2(rect_.x0, rect_.y0) + grid_.half_pitch;
    const glm::ivec2 high = kSubpixelsPerPixel * glm::ivec2(rect_.x1, rect_.y1) + grid_.half_pitch;
    for (int y = beyond_low_.y < low.y ? -1 : 0; y <= (beyond_high_.y > high.y ? 1 : 0); ++y) {
        for (int x = beyond_low_.x < low.x ? -1 : 0; x <= (beyond_high_.x > high.x ? 1 : 0); ++x) {
            const auto other = x == 0 && y == 0 ? std::nullopt : bins_.tile_beside(tile, x, y);
            if (!other) continue;
            for (const auto& runs : {bins_.runs_in(*other), bins_.thin_runs_in(*other)}) {
                for (const TriangleRun& run : runs) {
                    const ScreenMesh& mesh = screen_.mesh(run.instance);
                    for (std::uint32_t i = 0; i < run.count; ++i) sort_triangle(mesh, run.triangles[i].triangle);
                }
            }
            for (const auto& list : {bins_.large_in(*other), bins_.thin_large_in(*other)}) {
                for (const std::uint32_t i : list) add_large(bins_.large(i));
            }
        }
    }
}

void FineBlocks::sort_candidates(std::span<const FineCandidate> candidates) {
    beyond_low_ = glm::ivec2(std::numeric_limits<int>::max());
    beyond_high_ = glm::ivec2(std::numeric_limits<int>::min());
    for (std::uint32_t i = 0; i < candidates.size(); ++i) {
        const LayerLine& line = candidates[i].line;
        const FinePart& part = candidates[i].part;
        const int block_x = part.block_x - first_x_, block_y = part.block_y - first_y_;
        std::uint32_t& index = index_[block_at(block_x, block_y)];
        if (index == kNone) {
            index = static_cast<std::uint32_t>(count_++);
            if (candidates_.size() < count_) {
                candidates_.resize(count_);
                triangles_.resize(count_);
                places_.resize(count_);
            }
            places_[index] = {block_x, block_y};
            candidates_[index].clear();
            triangles_[index].clear();
        }
        candidates_[index].push_back(i);
        double lowest = line.lowest_in(part.begin, part.end) - line_slack(screen_.surfaces(), line, part.begin, part.end);
        const glm::dvec2 a = line.at(part.begin), b = line.at(part.end);
        const glm::ivec2 low = glm::ivec2(glm::floor(glm::min(a, b))) - kReach, high = glm::ivec2(glm::ceil(glm::max(a, b))) + kReach;
        if (line.classes.has(LineClass::border)) {
            lowest -= kBehindBorder * level_slack(screen_.surfaces(), lowest);
            beyond_low_ = glm::min(beyond_low_, low);
            beyond_high_ = glm::max(beyond_high_, high);
        }
        const auto first = [&](int subpixel, int origin, int block) {
            return std::max(cell_of(subpixel) - kCells * origin, kCells * block);
        };
        const auto last = [&](int subpixel, int origin, int block) {
            return std::min(cell_of(subpixel) - kCells * origin, kCells * block + kCells - 1);
        };
        for (int y = first(low.y, first_y_, block_y); y <= last(high.y, first_y_, block_y); ++y) {
            for (int x = first(low.x, first_x_, block_x); x <= last(high.x, first_x_, block_x); ++x) {
                float& farthest = farthest_[cell_at(x, y)];
                farthest = std::min(farthest, static_cast<float>(lowest));
            }
        }
        note_least(low, high, static_cast<float>(lowest));
    }
}

/// In all blocks of samples that a triangle may be listed in that touches the box, see TileTriangle.
void FineBlocks::note_least(glm::ivec2 low, glm::ivec2 high, float lowest) {
    const int pitch = 2 * grid_.half_pitch, per_pixel = kSubpixelsPerPixel / pitch;
    const auto block = [&](int sample) { return std::clamp(sample >> kBlockShift, 0, sample_blocks_ - 1); };
    const auto before = [&](int subpixel, int first_px) {
        return static_cast<int>(std::floor(static_cast<double>(subpixel - grid_.half_pitch) / pitch)) - first_px * per_pixel;
    };
    const auto behind = [&](int subpixel, int first_px) { return before(subpixel + pitch - 1, first_px); };
    const int x0 = block(before(low.x, rect_.x0)), x1 = block(behind(high.x, rect_.x0));
    const int y0 = block(before(low.y, rect_.y0)), y1 = block(behind(high.y, rect_.y0));
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            float& least = least_[static_cast<std::size_t>(y * BlockTable::kPitch + x)];
            least = std::min(least, lowest);
        }
    }
}

void FineBlocks::add_small(const TriangleRun& run) {
    if (nearer_.size() < run.count) nearer_.resize(run.count);
    constexpr float kNoLevel = 0;
    const std::size_t count =
        kernels_.find_nearer(least_.data(), kNoLevel, kNoLevel, run.triangles, run.count, nearer_.data());
    const ScreenMesh& mesh = screen_.mesh(run.instance);
    for (std::size_t i = 0; i < count; ++i) sort_triangle(mesh, nearer_[i]);
}

void FineBlocks::add_large(const LargePolygon& large) {
    const ScreenPolygon& polygon = large.polygon;
    HidingTriangle t{screen_.number_of(large.surface), false, 0, 0, -1, -1};
    FlatTriangle flat = kAllOfTheScreen;
    const Facing facing = screen_.facing(t.number);
    t.is_clipped = facing == off_screen;
    if (!t.is_clipped) {
        const auto [a, b, c] = screen_.triangle(large.surface).corners;
        flat = flat_triangle(a, b, c, facing);
    }
    t.x0 = t.x1 = polygon.corners[0].x;
    t.y0 = t.y1 = polygon.corners[0].y;
    for (int i = 1; i < polygon.count; ++i) {
        const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
        t.x0 = std::min(t.x0, p.x);
        t.y0 = std::min(t.y0, p.y);
        t.x1 = std::max(t.x1, p.x);
        t.y1 = std::max(t.y1, p.y);
    }
    // It may fill the tile, and few blocks have candidates.
    const int left = grid_.at(t.x0 - kReach) - first_x_, right = grid_.at(t.x1 + kReach) - first_x_;
    const int top = grid_.at(t.y0 - kReach) - first_y_, bottom = grid_.at(t.y1 + kReach) - first_y_;
    for (std::size_t i = 0; i < count_; ++i) {
        const glm::ivec2 at = places_[i];
        const bool touches = at.x >= left && at.x <= right && at.y >= top && at.y <= bottom;
        if (touches && hides_something(t, flat.highest, at.x, at.y)) triangles_[i].add(t, flat);
    }
}

bool FineBlocks::hides_something(const HidingTriangle& t, float highest, int block_x, int block_y) const {
    const int origin_x = kCells * (first_x_ + block_x), origin_y = kCells * (first_y_ + block_y);
    // Those beyond the block lie beside the cells at its end.
    const int last = kCells - 1;
    const int x0 = std::clamp(cell_of(t.x0) - origin_x, 0, last), x1 = std::clamp(cell_of(t.x1) - origin_x, 0, last);
    const int y0 = std::clamp(cell_of(t.y0) - origin_y, 0, last), y1 = std::clamp(cell_of(t.y1) - origin_y, 0, last);
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            if (highest > farthest_[cell_at(kCells * block_x + x, kCells * block_y + y)]) return true;
        }
    }
    return false;
}

void FineBlocks::sort_triangle(const ScreenMesh& mesh, std::uint32_t t) {
    const std::uint32_t* const corner = mesh.corners + 3 * static_cast<std::size_t>(t);
    const ScreenVertex &a = mesh.vertices[corner[0]], &b = mesh.vertices[corner[1]], &c = mesh.vertices[corner[2]];
    const HidingTriangle hiding{mesh.first_number + t, false, std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::max({a.x, b.x, c.x}),
                                std::max({a.y, b.y, c.y})};
    const FlatTriangle flat = flat_triangle(a, b, c, static_cast<Facing>(mesh.facing[t]));
    const int left = std::max(grid_.at(hiding.x0 - kReach) - first_x_, 0), right = std::min(grid_.at(hiding.x1 + kReach) - first_x_, columns_ - 1);
    const int top = std::max(grid_.at(hiding.y0 - kReach) - first_y_, 0), bottom = std::min(grid_.at(hiding.y1 + kReach) - first_y_, rows_ - 1);
    for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
            const std::uint32_t index = index_[block_at(x, y)];
            if (index != kNone && hides_something(hiding, flat.highest, x, y)) triangles_[index].add(hiding, flat);
        }
    }
}

}  // namespace burin
