#include "abuffer/fine/fine_parts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "abuffer/edges/occluder.h"

namespace burin {
namespace {

/// What is left beside a line that was found is looked at if it is as long as this.
constexpr double kShortestRestSubpixels = 16;
/// The shortest part that counts at a vertex: lines that meet there are to do so.
constexpr double kShortestTipSubpixels = 4;
/// Pieces of a line are nearer to its edge than this.
constexpr double kOffSubpixels = 8;
/// Ends of lines are as exact as this.
constexpr double kSlackSubpixels = 1;
/// No surface beside an edge is so steep that a sample on it is in front by this many times kDepthTolerancePx.
constexpr double kFarInFront = 8;

int floor_to_int(double v) {
    const int toward_zero = static_cast<int>(v);
    return toward_zero - (v < toward_zero ? 1 : 0);
}

/// Whether a piece lies on the line that goes through an edge.
bool runs_along(const EdgeOnScreen& edge, const LinePiece& piece) {
    const double limit = kOffSubpixels * glm::distance(edge.from, edge.to);
    return std::abs(edge.side_of(to_subpixels(piece.from))) <= limit &&
           std::abs(edge.side_of(to_subpixels(piece.to))) <= limit;
}

/// From where to where an edge runs between two heights, and a bit more. 1/256 pixel.
std::pair<int, int> columns_beside(const EdgeOnScreen& edge, double top, double bottom) {
    const glm::dvec2 way = edge.to - edge.from;
    const auto x_at = [&](double y) { return edge.from.x + way.x * std::clamp((y - edge.from.y) / way.y, 0.0, 1.0); };
    const double a = way.y == 0 ? edge.from.x : x_at(top), b = way.y == 0 ? edge.to.x : x_at(bottom);
    return {floor_to_int(std::min(a, b)) - 1, floor_to_int(std::max(a, b)) + 2};
}

}  // namespace

FineParts::BlockRange FineParts::blocks_around(const SampleTile& samples, const EdgeOnScreen& edge) {
    const SampleBlocks blocks(samples.samples_per_pixel);
    const glm::dvec2 low = glm::min(edge.from, edge.to), high = glm::max(edge.from, edge.to);
    return {blocks.at(floor_to_int(low.x)), blocks.at(floor_to_int(low.y)), blocks.at(floor_to_int(high.x)),
            blocks.at(floor_to_int(high.y))};
}

/// Calls visit(x, y, begin, end) for the tile's blocks that an edge touches, but where it is far
/// behind, and the part of it there.
template <typename Visit>
void FineParts::for_blocks(const SampleTile& samples, const EdgeOnScreen& edge, const BlockRange& range,
                           const Visit& visit) const {
    const SampleBlocks blocks(samples.samples_per_pixel);
    const int shift = std::countr_zero(static_cast<unsigned>(kMergeBlockPx * samples.samples_per_pixel));
    const int first_x = samples.first_column >> shift, last_x = (samples.first_column + samples.columns - 2) >> shift;
    const int first_y = samples.first_row >> shift, last_y = (samples.first_row + samples.rows - 2) >> shift;
    for (int y = std::max(range.y0, first_y); y <= std::min(range.y1, last_y); ++y) {
        int from = std::max(range.x0, first_x), to = std::min(range.x1, last_x);
        if (to - from > 2) {  // long edges touch few of the blocks in their boxes
            const auto [left, right] = columns_beside(edge, blocks.begin(y), blocks.begin(y + 1));
            from = std::max(from, blocks.at(left));
            to = std::min(to, blocks.at(right));
        }
        for (int x = from; x <= to; ++x) {
            double begin = 0, end = 1;
            if (!range.is_one()) {
                const glm::dvec2 low(blocks.begin(x), blocks.begin(y)), high(blocks.begin(x + 1), blocks.begin(y + 1));
                if (!clip_to_rect(edge.from, edge.to, low, high, begin, end)) continue;
                if (is_behind(blocks_, samples, edge, begin, end)) continue;
            }
            visit(x, y, begin, end);
        }
    }
}

void FineParts::find_loose(const SampleTile& samples, std::span<const TileEdge> loose,
                           std::vector<FinePart>& parts) const {
    for (const TileEdge& e : loose) {
        if (is_surely_behind(e, samples)) continue;
        const auto [one, two] = screen_.surfaces().instances[e.edge.instance].mesh->loose_edge(e.edge.half_edge);
        const auto [first, second] = ends_in_order(screen_, e.edge.instance, one, two);
        const auto edge = edge_on_screen(screen_, e.edge.instance, first, second);
        if (!edge) continue;
        const BlockRange range = blocks_around(samples, *edge);
        if (is_behind(range.is_one() ? blocks_ : areas_, samples, *edge, 0, 1)) continue;
        for_blocks(samples, *edge, range, [&](int x, int y, double begin, double end) {
            parts.push_back({e.edge, x, y, begin, end});
        });
    }
}

void FineParts::find(const SampleTile& samples, std::span<const TileEdge> edges, std::span<const TileEdge> loose,
                     std::span<const LinePiece> drawn, std::vector<FinePart>& parts) {
    if (edges.empty() && loose.empty()) return;
    find_farthest(samples);
    find_loose(samples, loose, parts);
    if (edges.empty()) return;
    drawn_.set(drawn);
    const int shift = std::countr_zero(static_cast<unsigned>(kMergeBlockPx * samples.samples_per_pixel));
    asked_.clear();
    for (const TileEdge& edge : edges) {
        if (is_surely_behind(edge, samples)) continue;
        const ScreenMesh& mesh = screen_.mesh(edge.edge.instance);
        // They are spread over the mesh.
        __builtin_prefetch(mesh.corners + edge.edge.half_edge);
        __builtin_prefetch(mesh.partners + edge.edge.half_edge);
        asked_.push_back(edge.edge);
    }
    const auto ends_of = [](const ScreenMesh& mesh, HalfEdge h) {
        return std::pair(mesh.corners[h], mesh.corners[h % 3 == 2 ? h - 2 : h + 1]);
    };
    constexpr std::size_t kAhead = 4;
    for (std::size_t number = 0; number < asked_.size(); ++number) {
        if (number + kAhead < asked_.size()) {
            const FineEdge& later = asked_[number + kAhead];
            const ScreenMesh& mesh = screen_.mesh(later.instance);
            const auto ends = ends_of(mesh, later.half_edge);
            const HalfEdge partner = mesh.partners[later.half_edge];
            __builtin_prefetch(mesh.vertices + ends.first);
            __builtin_prefetch(mesh.vertices + ends.second);
            __builtin_prefetch(mesh.corners + partner);
            __builtin_prefetch(mesh.facing + partner / 3);
        }
        const FineEdge& e = asked_[number];
        const ScreenMesh& mesh = screen_.mesh(e.instance);
        const auto ends = ends_of(mesh, e.half_edge);
        const auto [first, second] = ends_in_order(screen_, e.instance, ends.first, ends.second);
        const auto on_screen = edge_on_screen(screen_, e.instance, first, second);
        if (!on_screen) continue;
        const EdgeOnScreen& edge = *on_screen;
        const BlockRange range = blocks_around(samples, edge);
        if (is_behind(range.is_one() ? blocks_ : areas_, samples, edge, 0, 1)) continue;
        const Owners owners = owners_of(e);
        const HalfEdge partner = mesh.partners[e.half_edge];
        const LineId line = LineId::of_edge(e.instance, std::min(e.half_edge, partner));
        for_blocks(samples, edge, range, [&](int x, int y, double begin, double end) {
            const std::uint32_t block =
                static_cast<std::uint32_t>(y & 0xFFFF) << 16 | static_cast<std::uint32_t>(x & 0xFFFF);
            find_undrawn(edge, begin, end, drawn_.of_line(block, line));
            open_.clear();
            for (const Interval& i : undrawn_) {
                if (is_tip(samples, edge, i)) {
                    open_.push_back(i);
                } else {
                    find_open(samples, edge, owners, {x << shift, y << shift}, i);
                }
            }
            if (!takes_rests_ && !open_.empty() && is_drawn_by_another(edge, block)) return;
            for (const Interval& i : open_) parts.push_back({e, x, y, i.begin, i.end});
        });
    }
}

void FineParts::find_farthest(const SampleTile& samples) {
    // The kernel only reads.
    const SampleView view{const_cast<float*>(samples.nearness.data()),
                          const_cast<std::uint32_t*>(samples.ids.data()),
                          samples.first_column,
                          samples.first_row,
                          samples.columns,
                          samples.rows,
                          samples.stride,
                          samples.samples_per_pixel,
                          0,
                          0,
                          nullptr,
                          nullptr,
                          0};
    blocks_.farthest.resize(BlockTable::kSize);
    kernels_.blocks.find_farthest(view, blocks_.farthest.data());
    areas_.farthest.assign(kAreaPitch * kAreaPitch, std::numeric_limits<float>::infinity());
    const auto blocks_along = [](int count) {
        return static_cast<std::size_t>((count + kBlockSamples - 1) >> kBlockShift);
    };
    for (std::size_t y = 0; y < blocks_along(samples.rows); ++y) {
        for (std::size_t x = 0; x < blocks_along(samples.columns); ++x) {
            float& farthest =
                areas_.farthest[(y >> (kAreaShift - kBlockShift)) * kAreaPitch + (x >> (kAreaShift - kBlockShift))];
            farthest = std::min(farthest, blocks_.farthest[y * BlockTable::kPitch + x]);
        }
    }
}

FineParts::FineParts(const ScreenSurfaces& screen, const TileKernels& kernels, bool takes_rests)
    : screen_(screen),
      kernels_(kernels),
      takes_rests_(takes_rests),
      level_part_(kDepthTolerancePx / screen.surfaces().projection.focal_px) {}

double FineParts::level(double nearness) const {
    return screen_.surfaces().projection.orthographic ? level_part_
                                                      : level_part_ * (nearness + screen_.surfaces().farthest_nearness);
}

/// The triangles at an edge, and whether each of them shows where the edge is a line.
FineParts::Owners FineParts::owners_of(FineEdge edge) const {
    const ScreenMesh& mesh = screen_.mesh(edge.instance);
    const HalfEdge h = edge.half_edge, partner = mesh.partners[h];
    const Facing own = screen_.facing(mesh.first_number + h / 3),
                 other = screen_.facing(mesh.first_number + partner / 3);
    Owners owners{edge, {mesh.first_number + h / 3, mesh.first_number + partner / 3}, false};
    const bool is_cut = own == off_screen || other == off_screen;  // and has no facing
    // Where both are wound alike, they run along the edge in opposite directions.
    const bool are_wound_alike = mesh.corners[h] != mesh.corners[partner];
    if (h != partner)
        owners.needs_both = is_cut ? side_at(edge, h) * side_at(edge, partner) < 0 : (own == other) == are_wound_alike;
    return owners;
}

/// On which side of an edge the triangle at a half-edge on it is seen.
int FineParts::side_at(FineEdge edge, HalfEdge h) const {
    const ScreenMesh& mesh = screen_.mesh(edge.instance);
    const auto corner = [&](HalfEdge g, std::uint32_t k) { return mesh.corners[g - g % 3 + (g + k) % 3]; };
    const auto [first, second] =
        ends_in_order(screen_, edge.instance, corner(edge.half_edge, 0), corner(edge.half_edge, 1));
    return side_of_edge(screen_, edge.instance, first, second, corner(h, 2));
}

/// On which side the surface is at an edge where it ends or turns away. 0: it goes on.
int FineParts::inner_side(FineEdge edge) const {
    const int own = side_at(edge, edge.half_edge);
    return own != 0 ? own : side_at(edge, screen_.mesh(edge.instance).partners[edge.half_edge]);
}

/// is_behind() of all of it, where whole areas are far in front: without a look at its vertices.
bool FineParts::is_surely_behind(const TileEdge& edge, const SampleTile& samples) const {
    const auto nearest = static_cast<double>(edge.nearest);
    const double limit = nearest + kFarInFront * level(nearest);
    const int right = std::min(int{edge.right}, (samples.columns - 1) >> kAreaShift),
              left = std::min(int{edge.left}, right);
    const int bottom = std::min(int{edge.bottom}, (samples.rows - 1) >> kAreaShift),
              top = std::min(int{edge.top}, bottom);
    for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * kAreaPitch + static_cast<std::size_t>(x);
            if (!(static_cast<double>(areas_.farthest[i]) > limit)) return false;
        }
    }
    return true;
}

/// Whether all samples around a part of an edge are far in front of it, and so around each square on its way.
bool FineParts::is_behind(const Squares& squares, const SampleTile& samples, const EdgeOnScreen& edge, double begin,
                          double end) const {
    const double per_sample = samples.samples_per_pixel / double{kSubpixelsPerPixel};
    const glm::dvec2 first(samples.first_column + 0.5, samples.first_row + 0.5);
    const glm::dvec2 a = edge.at(begin) * per_sample - first, b = edge.at(end) * per_sample - first;
    const auto square_at = [&](double sample, int more, int count) {
        return std::min(static_cast<int>(std::max(sample, 0.0)) + more, count - 1) >> squares.shift;
    };
    const int x0 = square_at(std::min(a.x, b.x), 0, samples.columns),
              x1 = square_at(std::max(a.x, b.x), 1, samples.columns);
    const int y0 = square_at(std::min(a.y, b.y), 0, samples.rows), y1 = square_at(std::max(a.y, b.y), 1, samples.rows);
    const double nearest = std::max(edge.nearness_at(begin), edge.nearness_at(end));
    const double limit = nearest + kFarInFront * level(nearest);
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * squares.pitch + static_cast<std::size_t>(x);
            if (!(static_cast<double>(squares.farthest[i]) > limit)) return false;
        }
    }
    return true;
}

/// Goes along an edge from square to square of four samples, in a block whose upper left sample is given.
/// All places are on the picture's grid of samples: equal in all tiles.
void FineParts::find_open(const SampleTile& samples, const EdgeOnScreen& edge, const Owners& owners, glm::ivec2 block,
                          Interval part) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const int last = kMergeBlockPx * samples.samples_per_pixel - 1;
    const double per_sample = samples.samples_per_pixel / double{kSubpixelsPerPixel};
    const glm::dvec2 origin = edge.from * per_sample - 0.5, along = (edge.to - edge.from) * per_sample;
    const glm::dvec2 start = origin + along * part.begin;
    double next[2], step[2];
    for (int k = 0; k < 2; ++k) {
        const int floored = floor_to_int(start[k]);
        const double border = along[k] > 0                               ? floored + 1
                              : static_cast<double>(floored) == start[k] ? floored - 1
                                                                         : floored;
        next[k] = along[k] == 0 ? kNever : (border - origin[k]) / along[k];
        step[k] = along[k] == 0 ? kNever : 1 / std::abs(along[k]);
    }
    for (double t = part.begin; t < part.end;) {
        const int axis = next[0] < next[1] ? 0 : 1;
        const double to = std::min(next[axis], part.end);
        const double middle = 0.5 * (t + to);
        const glm::dvec2 place = origin + along * middle;
        const glm::ivec2 at(floor_to_int(place.x), floor_to_int(place.y));
        const glm::ivec2 square = glm::clamp(at, block, block + last);
        bool found = to > t && is_open(samples, square, edge, middle, owners);
        // An edge along a row or column of samples has squares on both sides.
        for (int k = 0; k < 2; ++k) {
            glm::ivec2 other = square;
            if (found || to <= t || along[k] != 0 || place[k] != at[k] || --other[k] < block[k]) continue;
            found = is_open(samples, other, edge, middle, owners);
        }
        if (found) {
            if (!open_.empty() && open_.back().end == t) {
                open_.back().end = to;
            } else {
                open_.push_back({t, to});
            }
        }
        t = std::max(t, to);
        next[axis] += step[axis];
    }
}

bool FineParts::is_open(const SampleTile& samples, glm::ivec2 square, const EdgeOnScreen& edge, double t,
                        const Owners& owners) const {
    const std::size_t i = samples.index(square.x, square.y);
    const std::size_t corners[4] = {i, i + 1, i + static_cast<std::size_t>(samples.stride),
                                    i + static_cast<std::size_t>(samples.stride) + 1};
    std::uint32_t numbers[4];
    for (std::size_t k = 0; k < 4; ++k) numbers[k] = samples.ids[corners[k]] >> 1;
    const auto sees = [&](std::uint32_t n) {
        return numbers[0] == n || numbers[1] == n || numbers[2] == n || numbers[3] == n;
    };
    const std::uint32_t a = owners.numbers[0], b = owners.numbers[1];
    const double nearness = edge.nearness_at(t), clearly = level(nearness);
    if (owners.needs_both ? sees(a) && sees(b) : sees(a) || sees(b)) {
        if (!takes_rests_) return false;
        // A line that ends in the square at another one, on the screen, may go on beside that.
        if (owners.needs_both)
            return std::any_of(std::begin(numbers), std::end(numbers),
                               [&](std::uint32_t n) { return n != a && n != b; });
        const int inner = inner_side(owners.edge);
        if (inner == 0) return false;
        // Where two lines have a narrow gap between them, samples tell of one only. Whether what they see beyond is in
        // contact instead, its triangles tell.
        for (std::size_t k = 0; k < 4; ++k) {
            const glm::dvec2 corner(square.x + static_cast<int>(k % 2), square.y + static_cast<int>(k / 2));
            const glm::dvec2 at = (corner + 0.5) * (double{kSubpixelsPerPixel} / samples.samples_per_pixel);
            if (numbers[k] != a && numbers[k] != b && edge.side_of(at) * inner <= 0) return true;
        }
        return false;
    }
    const float farthest = std::min(std::min(samples.nearness[corners[0]], samples.nearness[corners[1]]),
                                    std::min(samples.nearness[corners[2]], samples.nearness[corners[3]]));
    const double gap = static_cast<double>(farthest) - nearness;
    if (!(gap > clearly)) return true;
    // Samples lie on steep surfaces beside the edge, or on something else.
    if (gap > kFarInFront * clearly) return false;
    for (int k = 0; k < 4; ++k) {
        const bool is_known = std::find(numbers, numbers + k, numbers[k]) != numbers + k;
        if (!is_known && !is_in_front(numbers[k], edge.at(t), nearness)) return true;
    }
    return false;
}

/// Whether the plane of a triangle beside a place is clearly in front there.
bool FineParts::is_in_front(std::uint32_t number, glm::dvec2 subpixel, double nearness) const {
    return screen_.nearness_of(number, subpixel) > nearness + level(nearness);
}

/// Whether a line of another edge in the same place on the screen was found in the block.
bool FineParts::is_drawn_by_another(const EdgeOnScreen& edge, std::uint32_t block) const {
    const auto in_block = drawn_.in_block(block);
    return std::any_of(in_block.begin(), in_block.end(), [&](const LinePiece& s) { return runs_along(edge, s); });
}

/// What is left of an edge where pieces of its line were found.
void FineParts::find_undrawn(const EdgeOnScreen& edge, double begin, double end, std::span<const LinePiece> pieces) {
    undrawn_.assign(1, {begin, end});
    if (pieces.empty()) return;
    if (!takes_rests_) return undrawn_.clear();
    const glm::dvec2 along = edge.to - edge.from;
    const double square = glm::dot(along, along);
    const double slack = kSlackSubpixels / std::sqrt(square), shortest = kShortestRestSubpixels / std::sqrt(square);
    const double shortest_tip = kShortestTipSubpixels / std::sqrt(square);
    for (const LinePiece& s : pieces) {
        // A bridge to another line, which only begins at this one.
        if (!runs_along(edge, s)) continue;
        const double p = glm::dot(to_subpixels(s.from) - edge.from, along) / square;
        const double q = glm::dot(to_subpixels(s.to) - edge.from, along) / square;
        const Interval piece{std::min(p, q) - slack, std::max(p, q) + slack};
        const std::size_t count = undrawn_.size();
        for (std::size_t i = 0; i < count; ++i) {
            const Interval whole = undrawn_[i];
            if (piece.end <= whole.begin || piece.begin >= whole.end) continue;
            undrawn_[i].end = piece.begin;  // may be empty now
            if (piece.end < whole.end) undrawn_.push_back({piece.end, whole.end});
        }
    }
    std::erase_if(undrawn_, [&](const Interval& i) {
        return !(i.end - i.begin >= (i.begin == 0 || i.end == 1 ? shortest_tip : shortest));
    });
}

/// Whether a line was found but for its last bit to a vertex, which lies between samples.
bool FineParts::is_tip(const SampleTile& samples, const EdgeOnScreen& edge, Interval part) {
    if ((part.begin == 0) == (part.end == 1)) return false;
    const double longest = 1.5 * kSubpixelsPerPixel / samples.samples_per_pixel;
    return (part.end - part.begin) * glm::distance(edge.from, edge.to) <= longest;
}

}  // namespace burin
