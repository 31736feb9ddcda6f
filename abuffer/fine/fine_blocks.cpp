#include "abuffer/fine/fine_blocks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "abuffer/edges/occluder.h"
#include "kernels/screen_triangles.h"

namespace burin {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
/// A border asks what is behind it, too, as far as this multiple of level_slack(): 4 pixels' widths.
constexpr double kBehindBorder = 64;
/// How far beside a line triangles are asked for, with what rounding may do to places. 1/256 pixel.
constexpr int kReach = kBeyondSubpixels + 1;
/// 1/256 pixel. Four times as far as any place on the screen.
constexpr float kFarOnScreen = 1 << 24;
constexpr CrossedTriangle kAllOfTheScreen = {
    {-kFarOnScreen, 3 * kFarOnScreen, -kFarOnScreen}, {-kFarOnScreen, -kFarOnScreen, 3 * kFarOnScreen}, kNothing, 0};

}  // namespace

void FineBlocks::fill(std::size_t tile, std::span<const FineCandidate> candidates) {
    rect_ = bins_.tile(tile);
    first_x_ = rect_.x0 / kMergeBlockPx;
    first_y_ = rect_.y0 / kMergeBlockPx;
    columns_ = rect_.width() / kMergeBlockPx;
    rows_ = rect_.height() / kMergeBlockPx;
    count_ = 0;
    index_.assign(block_at(0, rows_), kNone);
    farthest_.assign(HidingGrid::kPlaces * block_at(0, rows_), kNothing);
    const auto begin = [&](int block) { return (block << SampleBlocks::kShift) + grid_.half_pitch; };
    hiding_grid_ = {begin(first_x_), begin(first_y_), columns_, rows_, kReach, farthest_.data()};
    const int samples = kSubpixelsPerPixel / (2 * grid_.half_pitch) * bins_.tile_px();
    sample_blocks_ = (samples >> kBlockShift) + 1;  // a tile has one more column and row of samples
    least_.assign(BlockTable::kSize, kNothing);
    sort_candidates(candidates);
    combine_cells();
    kernels_.blocks.combine(sample_blocks_, sample_blocks_, least_.data());
    for (const TriangleRun& run : bins_.runs_in(tile)) add_small(run);
    for (const TriangleRun& run : bins_.thin_runs_in(tile)) add_small(run);
    sort_listed();
    large_known_.assign(bins_.large_count(), false);
    add_large_of(tile);
    add_beyond(tile);
}

/// Adds triangles of the tiles around, where a border lies so close to the end of this tile that what it is in contact
/// with may not touch it.
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
                    nearer_.resize(std::max(nearer_.size(), std::size_t{run.count}));
                    for (std::uint32_t i = 0; i < run.count; ++i) nearer_[i] = run.triangles[i].triangle;
                    sort_triangles(mesh, nearer_.data(), run.count);
                }
            }
            add_large_of(*other);
        }
    }
}

void FineBlocks::sort_candidates(std::span<const FineCandidate> candidates) {
    beyond_low_ = glm::ivec2(std::numeric_limits<int>::max());
    beyond_high_ = glm::ivec2(std::numeric_limits<int>::min());
    for (std::uint32_t i = 0; i < candidates.size(); ++i) {
        const WholeLine& line = candidates[i].line;
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
        double lowest =
            line.lowest_in(part.begin, part.end) - line_slack(screen_.surfaces(), line, part.begin, part.end);
        const glm::dvec2 a = line.at(part.begin), b = line.at(part.end);
        const glm::ivec2 low = glm::ivec2(glm::floor(glm::min(a, b))) - kReach,
                         high = glm::ivec2(glm::ceil(glm::max(a, b))) + kReach;
        if (line.classes.has(LineClass::border)) {
            lowest -= kBehindBorder * level_slack(screen_.surfaces(), lowest);
            beyond_low_ = glm::min(beyond_low_, low);
            beyond_high_ = glm::max(beyond_high_, high);
        }
        const auto cell = [](int subpixel, int from) {
            return std::clamp((subpixel - from) >> HidingGrid::kCellShift, -1, kCells);
        };
        const int from_x = hiding_grid_.first_x + (block_x << SampleBlocks::kShift);
        const int from_y = hiding_grid_.first_y + (block_y << SampleBlocks::kShift);
        float* const farthest = &farthest_[HidingGrid::kPlaces * block_at(block_x, block_y)];
        for (int y = std::max(cell(low.y, from_y), 0); y <= std::min(cell(high.y, from_y), kCells - 1); ++y) {
            for (int x = std::max(cell(low.x, from_x), 0); x <= std::min(cell(high.x, from_x), kCells - 1); ++x) {
                float& of_cell = farthest[HidingGrid::place(x, x, y, y)];
                of_cell = std::min(of_cell, static_cast<float>(lowest));
            }
        }
        note_least(low, high, static_cast<float>(lowest));
    }
}

/// Combines the numbers of single cells to those of rectangles of them.
void FineBlocks::combine_cells() {
    for (std::size_t i = 0; i < count_; ++i) {
        float* const farthest = &farthest_[HidingGrid::kPlaces * block_at(places_[i].x, places_[i].y)];
        const auto at = [&](int x0, int x1, int y0, int y1) -> float& {
            return farthest[HidingGrid::place(x0, x1, y0, y1)];
        };
        for (int k = 0; k < kCells; ++k) {
            at(0, 1, k, k) = std::min(at(0, 0, k, k), at(1, 1, k, k));
            at(k, k, 0, 1) = std::min(at(k, k, 0, 0), at(k, k, 1, 1));
        }
        at(0, 1, 0, 1) = std::min(at(0, 1, 0, 0), at(0, 1, 1, 1));
    }
}

/// Notes a nearness in all blocks of samples in which a triangle that touches the box may be listed, see TileTriangle.
void FineBlocks::note_least(glm::ivec2 low, glm::ivec2 high, float lowest) {
    const int pitch = 2 * grid_.half_pitch, per_pixel = kSubpixelsPerPixel / pitch;
    const int pitch_shift = std::countr_zero(static_cast<unsigned>(pitch));
    const auto block = [&](int sample) { return std::clamp(sample >> kBlockShift, 0, sample_blocks_ - 1); };
    const auto before = [&](int subpixel, int first_px) {
        return ((subpixel - grid_.half_pitch) >> pitch_shift) - first_px * per_pixel;
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
    if (run.is_behind(least_.data(), run.highest)) return;
    if (run.instance != listed_instance_) sort_listed();
    listed_instance_ = run.instance;
    if (nearer_.size() < listed_ + run.count) nearer_.resize(2 * (listed_ + run.count));
    constexpr float kNoLevel = 0;
    listed_ += kernels_.blocks.find_nearer(least_.data(), kNoLevel, kNoLevel, run.triangles, run.count,
                                           nearer_.data() + listed_);
    // Triangles of several runs are taken together: one run leaves too few to prefetch the next ones meanwhile.
    constexpr std::size_t kEnough = 4 * kAtOnce;
    if (listed_ >= kEnough) sort_listed();
}

void FineBlocks::sort_listed() {
    if (listed_ > 0) sort_triangles(screen_.mesh(listed_instance_), nearer_.data(), listed_);
    listed_ = 0;
}

/// Adds the large triangles of a tile, this one or one around it, but for those that were added already.
void FineBlocks::add_large_of(std::size_t tile) {
    for (const auto& list : {bins_.large_in(tile), bins_.thin_large_in(tile)}) {
        for (const std::uint32_t i : list) {
            if (large_known_[i]) continue;
            large_known_[i] = true;
            add_large(bins_.large(i));
        }
    }
}

void FineBlocks::add_large(const LargePolygon& large) {
    const ScreenPolygon& polygon = large.polygon;
    CrossedTriangle triangle = kAllOfTheScreen;
    triangle.number = screen_.number_of(large.surface);
    const Facing facing = screen_.facing(triangle.number);
    if (facing != off_screen) {
        const auto [a, b, c] = screen_.triangle(large.surface).corners;
        triangle = crossed_triangle(a, b, c, facing, triangle.number);
    }
    Box box{polygon.corners[0].x, polygon.corners[0].y, polygon.corners[0].x, polygon.corners[0].y};
    for (int i = 1; i < polygon.count; ++i) {
        const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
        box = {std::min(box.x0, p.x), std::min(box.y0, p.y), std::max(box.x1, p.x), std::max(box.y1, p.y)};
    }
    std::array<PolygonRows::Corner, ScreenPolygon::kMaxCorners> corners;
    const auto count = static_cast<std::size_t>(polygon.count);
    std::transform(polygon.corners.begin(), polygon.corners.begin() + polygon.count, corners.begin(),
                   [](const SubpixelPoint& p) {
                       return PolygonRows::Corner{static_cast<double>(p.x), static_cast<double>(p.y)};
                   });
    add(triangle, box, std::span(corners).first(count));
}

void FineBlocks::add(const CrossedTriangle& triangle, const Box& box, std::span<const PolygonRows::Corner> corners) {
    const int left = grid_.at(box.x0 - kReach) - first_x_, right = grid_.at(box.x1 + kReach) - first_x_;
    const int top = grid_.at(box.y0 - kReach) - first_y_, bottom = grid_.at(box.y1 + kReach) - first_y_;
    const bool fills_box = left == right || top == bottom;
    // A long triangle touches few of the blocks in its box.
    const auto touches = [&](glm::ivec2 block) {
        constexpr int kAround = kReach + 1;  // with rounding
        const int y = first_y_ + block.y, x = first_x_ + block.x;
        const PolygonRows::Range range =
            PolygonRows(corners).between(grid_.begin(y) - kAround, grid_.begin(y + 1) + kAround);
        return range.low - kAround <= grid_.begin(x + 1) && range.high + kAround >= grid_.begin(x);
    };
    for (std::size_t i = 0; i < count_; ++i) {
        const glm::ivec2 at = places_[i];
        const bool is_in_box = at.x >= left && at.x <= right && at.y >= top && at.y <= bottom;
        if (is_in_box && hides_something(box, triangle.highest, at.x, at.y) && (fills_box || touches(at)))
            triangles_[i].push_back(triangle);
    }
}

bool FineBlocks::hides_something(const Box& box, float highest, int block_x, int block_y) const {
    const int origin_x = kCells * (first_x_ + block_x), origin_y = kCells * (first_y_ + block_y);
    // Triangles beyond the block lie beside the cells at its end.
    const auto cell = [&](std::int32_t subpixel, int origin) {
        return std::clamp(cell_of(subpixel) - origin, 0, kCells - 1);
    };
    const int x0 = cell(box.x0, origin_x), x1 = cell(box.x1, origin_x), y0 = cell(box.y0, origin_y),
              y1 = cell(box.y1, origin_y);
    const std::size_t place = HidingGrid::place(x0, x1, y0, y1);
    return highest > farthest_[HidingGrid::kPlaces * block_at(block_x, block_y) + place];
}

void FineBlocks::sort_triangles(const ScreenMesh& mesh, const std::uint32_t* listed, std::size_t count) {
    for (std::size_t first = 0; first < count; first += kAtOnce) {
        std::size_t other_count = 0;
        const std::size_t found = kernels_.fine.sort_hiding(mesh, listed + first, std::min(kAtOnce, count - first),
                                                            hiding_grid_, found_.data(), others_.data(), &other_count);
        for (std::size_t i = 0; i < found; ++i) triangles_[index_[found_[i].block]].push_back(found_[i].triangle);
        for (std::size_t i = 0; i < other_count; ++i) {
            const std::uint32_t t = others_[i], *const corner = mesh.corners + 3 * static_cast<std::size_t>(t);
            const ScreenVertex &a = mesh.vertices[corner[0]], &b = mesh.vertices[corner[1]],
                               &c = mesh.vertices[corner[2]];
            const auto corner_of = [](const ScreenVertex& v) {
                return PolygonRows::Corner{static_cast<double>(v.x), static_cast<double>(v.y)};
            };
            add(crossed_triangle(a, b, c, static_cast<Facing>(mesh.facing[t]), mesh.first_number + t),
                {std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::max({a.x, b.x, c.x}),
                 std::max({a.y, b.y, c.y})},
                std::array{corner_of(a), corner_of(b), corner_of(c)});
        }
    }
}

}  // namespace burin
