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
    const std::size_t places = place(columns_, rows_) + 1;
    index_.assign(places, 0);
    farthest_.assign(places, kNothing);
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
        const std::size_t at =
            place(candidates[i].part.block_x - first_x_, candidates[i].part.block_y - first_y_);
        if (farthest_[at] == kNothing) index_[at] = static_cast<std::uint32_t>(count_++);
        double lowest = std::min(line.nearness_from, line.nearness_to);
        if (line.classes.has(LineClass::border))
            lowest -= kBehindBorder * level_slack(screen_.surfaces(), lowest);
        farthest_[at] = std::min(farthest_[at], static_cast<float>(lowest));
        records[0].push_back({index_[at], i});
    }
    candidates_ = TileLists<std::uint32_t>(records, count_);
}

void FineBlocks::sort_triangles(const TriangleChunk& chunk, std::vector<std::uint32_t>& found,
                                Records& records) const {
    const ScreenMesh mesh = screen_.mesh(chunk.instance);
    const auto origin = [&](int block) { return static_cast<std::int32_t>(grid_.begin(block)); };
    const BlockMap map{farthest_.data(),     origin(first_x_), origin(first_y_),
                       SampleBlocks::kShift, columns_,         rows_};
    found.resize(kChunkTriangles + 8);
    const std::size_t count = kernels_.find_hiding(mesh, chunk.begin, chunk.end, map, found.data());
    for (std::size_t i = 0; i < count; ++i) {
        if (mesh.facing[found[i]] == edge_on) continue;
        const HidingTriangle t = triangle({chunk.instance, found[i]});
        const int left = std::max(grid_.at(t.x0) - first_x_, 0),
                  right = std::min(grid_.at(t.x1) - first_x_, columns_ - 1);
        const int top = std::max(grid_.at(t.y0) - first_y_, 0),
                  bottom = std::min(grid_.at(t.y1) - first_y_, rows_ - 1);
        for (int y = top; y <= bottom; ++y) {
            for (int x = left; x <= right; ++x) {
                const std::size_t at = place(x, y);
                if (t.nearest > farthest_[at]) records.push_back({index_[at], t});
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
