#include "methods/abuffer/fine_blocks.h"

#include <algorithm>
#include <limits>

#include "base/parallel.h"
#include "methods/abuffer/layer_triangle.h"

namespace burin {
namespace {

constexpr std::uint32_t kChunkTriangles = 1 << 14;
constexpr float kNothing = std::numeric_limits<float>::infinity();
/// A border asks what is behind it, too. As a multiple of level_slack(): 4 pixels' widths.
constexpr double kBehindBorder = 64;
/// What rounding may do to places. 1/256 pixel.
constexpr double kReach = 1;

}  // namespace

FineBlocks::FineBlocks(const ScreenSurfaces& screen, const TileKernels& kernels, int samples_per_pixel,
                       PixelRect region, const std::vector<FineCandidate>& candidates, int threads)
    : screen_(screen),
      kernels_(kernels),
      grid_(samples_per_pixel),
      first_x_(region.x0 / kMergeBlockPx),
      first_y_(region.y0 / kMergeBlockPx),
      columns_(region.width() / kMergeBlockPx),
      rows_(region.height() / kMergeBlockPx) {
    index_.assign(block_at(0, rows_), kNone);
    farthest_.assign(cell_at(kCells * columns_, kCells * rows_) + 1, kNothing);
    sort_candidates(candidates);
    if (count_ == 0) return;
    const std::vector<TriangleChunk> chunks = screen_.chunks_of_triangles(kChunkTriangles);
    std::vector<Records> records(chunks.size());
    std::vector<std::vector<std::uint32_t>> found(static_cast<std::size_t>(threads));
    parallel_for(chunks.size(), threads, [&](std::size_t c, int worker) {
        sort_triangles(chunks[c], found[static_cast<std::size_t>(worker)], records[c]);
    });
    triangles_ = TileLists<HidingTriangle>(records, count_);
}

void FineBlocks::sort_candidates(const std::vector<FineCandidate>& candidates) {
    std::vector<std::vector<TileLists<std::uint32_t>::Record>> records(1);
    for (std::uint32_t i = 0; i < candidates.size(); ++i) {
        const LayerLine& line = candidates[i].line;
        const FinePart& part = candidates[i].part;
        const int block_x = part.block_x - first_x_, block_y = part.block_y - first_y_;
        std::uint32_t& index = index_[block_at(block_x, block_y)];
        if (index == kNone) index = static_cast<std::uint32_t>(count_++);
        double lowest = std::min(line.nearness_from, line.nearness_to) - line_slack(screen_.surfaces(), line);
        if (line.classes.has(LineClass::border))
            lowest -= kBehindBorder * level_slack(screen_.surfaces(), lowest);
        const glm::dvec2 a = glm::mix(line.from, line.to, part.begin), b = glm::mix(line.from, line.to, part.end);
        const glm::ivec2 low(glm::floor(glm::min(a, b) - kReach)), high(glm::ceil(glm::max(a, b) + kReach));
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
        records[0].push_back({index, i});
    }
    candidates_ = TileLists<std::uint32_t>(records, count_);
}

void FineBlocks::sort_triangles(const TriangleChunk& chunk, std::vector<std::uint32_t>& found,
                                Records& records) const {
    const ScreenMesh mesh = screen_.mesh(chunk.instance);
    const auto origin = [&](int block) { return static_cast<std::int32_t>(grid_.begin(block)); };
    const BlockMap map{farthest_.data(), origin(first_x_),   origin(first_y_),
                       kCellShift,       kCells * columns_, kCells * rows_};
    found.resize(kChunkTriangles + 8);
    const std::size_t count = kernels_.find_hiding(mesh, chunk.begin, chunk.end, map, found.data());
    for (std::size_t i = 0; i < count; ++i) {
        if (mesh.facing[found[i]] == edge_on) continue;
        const HidingTriangle t = triangle({chunk.instance, found[i]});
        const int left = std::max(grid_.at(t.x0) - first_x_, 0),
                  right = std::min(grid_.at(t.x1) - first_x_, columns_ - 1);
        const int top = std::max(grid_.at(t.y0) - first_y_, 0),
                  bottom = std::min(grid_.at(t.y1) - first_y_, rows_ - 1);
        const auto hides_something = [&](int x, int y) {
            const int origin_x = kCells * (first_x_ + x), origin_y = kCells * (first_y_ + y);
            const int x0 = std::max(cell_of(t.x0) - origin_x, 0), x1 = std::min(cell_of(t.x1) - origin_x, kCells - 1);
            const int y0 = std::max(cell_of(t.y0) - origin_y, 0), y1 = std::min(cell_of(t.y1) - origin_y, kCells - 1);
            for (int cell_y = y0; cell_y <= y1; ++cell_y) {
                for (int cell_x = x0; cell_x <= x1; ++cell_x) {
                    if (t.nearest > farthest_[cell_at(kCells * x + cell_x, kCells * y + cell_y)]) return true;
                }
            }
            return false;
        };
        for (int y = top; y <= bottom; ++y) {
            for (int x = left; x <= right; ++x) {
                const std::uint32_t index = index_[block_at(x, y)];
                if (index != kNone && hides_something(x, y)) records.push_back({index, t});
            }
        }
    }
}

HidingTriangle FineBlocks::triangle(SurfaceId s) const {
    HidingTriangle t{screen_.number_of(s), false, 0, 0, -1, -1, 0};
    const auto set = [&](auto x, auto y, bool is_first) {
        t.x0 = is_first ? x : std::min(t.x0, x);
        t.y0 = is_first ? y : std::min(t.y0, y);
        t.x1 = is_first ? x : std::max(t.x1, x);
        t.y1 = is_first ? y : std::max(t.y1, y);
    };
    if (screen_.facing(t.number) == off_screen) {
        t.is_clipped = true;
        const ScreenPolygon polygon = screen_.surfaces().screen_polygon(s);
        for (int i = 0; i < polygon.count; ++i) {
            const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
            set(p.x, p.y, i == 0);
        }
        t.nearest = polygon.count == 0 ? -kNothing : kNothing;
        return t;
    }
    const ScreenTriangle triangle = screen_.triangle(s);
    for (std::size_t k = 0; k < 3; ++k) set(triangle.corners[k].x, triangle.corners[k].y, k == 0);
    t.nearest =
        std::max({triangle.corners[0].nearness, triangle.corners[1].nearness, triangle.corners[2].nearness});
    return t;
}

}  // namespace burin
