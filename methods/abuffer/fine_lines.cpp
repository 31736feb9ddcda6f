#include "methods/abuffer/fine_lines.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "base/parallel.h"
#include "methods/abuffer/fold_width.h"
#include "methods/abuffer/layer_edges.h"
#include "methods/abuffer/layer_triangle.h"

namespace burin {
namespace {

constexpr std::uint32_t kChunkTriangles = 1 << 14;
constexpr std::size_t kChunkParts = 256;
/// Shorter parts of lines are not worth a stroke. Pixels.
constexpr double kShortestPiecePx = 1.0 / 32;
/// Folds that turn back by less are no contours (docs/conventions.md). 1/64 pixel.
constexpr double kNegligibleFoldSubpixels = 4;
/// How exactly the place is found where a fold begins. Pixels.
constexpr double kWidthStepPx = 1.0 / 32;
/// What rounding does to nearness, as part of what counts as level.
constexpr double kRounding = 1.0 / 64;
/// In front of the number of a triangle that is cut by the near plane or the guard band.
constexpr std::uint32_t kClipped = 1u << 31;

/// A part of an edge that is a line.
struct Candidate {
    FinePart part;
    LayerLine line;
};

std::vector<Candidate> find_candidates(const Frame& frame, const ScreenSurfaces& screen, PixelRect region,
                                       const std::vector<std::vector<FinePart>>& parts, int threads) {
    std::vector<const FinePart*> all;
    for (const auto& list : parts) {
        for (const FinePart& part : list) all.push_back(&part);
    }
    constexpr bool kHasBothOfSeam = true;
    const LayerEdgeFinder finder(frame, screen, region, kHasBothOfSeam);
    std::vector<std::vector<Candidate>> found((all.size() + kChunkParts - 1) / kChunkParts);
    parallel_for(found.size(), threads, [&](std::size_t chunk, int) {
        std::vector<LayerLine> lines;
        for (std::size_t i = chunk * kChunkParts; i < std::min(all.size(), (chunk + 1) * kChunkParts); ++i) {
            lines.clear();
            finder.find({all[i]->edge.instance, all[i]->edge.half_edge / 3}, all[i]->edge.half_edge, lines);
            if (lines.empty()) continue;
            LayerLine& line = lines.front();
            const ScreenMesh mesh = screen.mesh(all[i]->edge.instance);
            const HalfEdge h = all[i]->edge.half_edge;
            if (mesh.partners[h] == h) line.owners[1] = line.owners[0];  // the other patch of a seam may hide it
            found[chunk].push_back({*all[i], line});
        }
    });
    std::vector<Candidate> candidates;
    for (const auto& list : found) candidates.insert(candidates.end(), list.begin(), list.end());
    return candidates;
}

/// The blocks of a region that have candidates, and what may hide them.
class Blocks {
  public:
    static constexpr std::uint32_t kNone = ~0u;

    Blocks(const ScreenSurfaces& screen, const SampleBlocks& grid, PixelRect region, const std::vector<Candidate>& candidates)
        : screen_(screen),
          grid_(grid),
          first_x_(region.x0 / kMergeBlockPx),
          first_y_(region.y0 / kMergeBlockPx),
          columns_(region.width() / kMergeBlockPx),
          rows_(region.height() / kMergeBlockPx),
          index_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), kNone) {
        std::vector<std::vector<TileLists<std::uint32_t>::Record>> records(1);
        for (std::uint32_t i = 0; i < candidates.size(); ++i) {
            const LayerLine& line = candidates[i].line;
            std::uint32_t& index = at(candidates[i].part.block_x - first_x_, candidates[i].part.block_y - first_y_);
            if (index == kNone) {
                index = static_cast<std::uint32_t>(farthest_.size());
                farthest_.push_back(std::numeric_limits<double>::infinity());
            }
            farthest_[index] = std::min({farthest_[index], line.nearness_from, line.nearness_to});
            records[0].push_back({index, i});
        }
        candidates_ = TileLists<std::uint32_t>(records, count());
    }

    std::size_t count() const { return farthest_.size(); }
    std::span<const std::uint32_t> candidates(std::size_t block) const { return candidates_.of(block); }
    /// Numbers, with kClipped.
    std::span<const std::uint32_t> triangles(std::size_t block) const { return triangles_.of(block); }

    void sort_triangles(int threads) {
        const std::vector<TriangleChunk> chunks = screen_.chunks_of_triangles(kChunkTriangles);
        std::vector<std::vector<TileLists<std::uint32_t>::Record>> records(chunks.size());
        parallel_for(chunks.size(), threads, [&](std::size_t c, int) { sort(chunks[c], records[c]); });
        triangles_ = TileLists<std::uint32_t>(records, count());
    }

  private:
    std::uint32_t& at(int x, int y) { return index_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x)]; }

    void sort(const TriangleChunk& chunk, std::vector<TileLists<std::uint32_t>::Record>& records) {
        const ScreenMesh mesh = screen_.mesh(chunk.instance);
        for (std::uint32_t t = chunk.begin; t < chunk.end; ++t) {
            if (mesh.facing[t] == edge_on) continue;
            const std::uint32_t number = mesh.first_number + t;
            if (mesh.facing[t] == off_screen) {
                sort_clipped({chunk.instance, t}, number, records);
                continue;
            }
            const std::uint32_t* const v = mesh.corners + 3 * std::size_t{t};
            const ScreenVertex &a = mesh.vertices[v[0]], &b = mesh.vertices[v[1]], &c = mesh.vertices[v[2]];
            const auto lowest = [](auto p, auto q, auto r) { return std::min(std::min(p, q), r); };
            const auto highest = [](auto p, auto q, auto r) { return std::max(std::max(p, q), r); };
            add(number, lowest(a.x, b.x, c.x), lowest(a.y, b.y, c.y), highest(a.x, b.x, c.x), highest(a.y, b.y, c.y),
                static_cast<double>(highest(a.nearness, b.nearness, c.nearness)), records);
        }
    }

    void sort_clipped(SurfaceId s, std::uint32_t number, std::vector<TileLists<std::uint32_t>::Record>& records) {
        const ScreenPolygon polygon = screen_.surfaces().screen_polygon(s);
        if (polygon.count == 0) return;
        SubpixelPoint low = polygon.corners[0], high = low;
        for (int i = 1; i < polygon.count; ++i) {
            const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
        add(number | kClipped, low.x, low.y, high.x, high.y, std::numeric_limits<double>::infinity(), records);
    }

    void add(std::uint32_t value, int x0, int y0, int x1, int y1, double nearest,
             std::vector<TileLists<std::uint32_t>::Record>& records) {
        const int left = std::max(grid_.at(x0) - first_x_, 0), right = std::min(grid_.at(x1) - first_x_, columns_ - 1);
        const int top = std::max(grid_.at(y0) - first_y_, 0), bottom = std::min(grid_.at(y1) - first_y_, rows_ - 1);
        for (int y = top; y <= bottom; ++y) {
            for (int x = left; x <= right; ++x) {
                const std::uint32_t index = at(x, y);
                if (index != kNone && nearest > farthest_[index]) records.push_back({index, value});
            }
        }
    }

    const ScreenSurfaces& screen_;
    SampleBlocks grid_;
    int first_x_, first_y_, columns_, rows_;
    std::vector<std::uint32_t> index_;  // of a block that has candidates
    std::vector<double> farthest_;      // the least nearness of its candidates
    TileLists<std::uint32_t> candidates_, triangles_;
};

/// Finds what is visible in one block after the other. Buffers are used again.
class BlockClipper {
  public:
    BlockClipper(const ScreenSurfaces& screen, const LineCriteria& criteria) : screen_(screen), criteria_(criteria) {}

    void set_triangles(std::span<const std::uint32_t> values) {
        triangles_.clear();
        for (const std::uint32_t value : values) {
            const std::uint32_t number = value & ~kClipped;
            const SurfaceId s = screen_.surface_of(number);
            if (value == number) {
                triangles_.push_back(layer_triangle(screen_, s, number));
            } else {
                const auto clipped = clipped_layer_triangles(screen_, s, number);
                triangles_.insert(triangles_.end(), clipped.begin(), clipped.end());
            }
        }
    }

    void add_visible(const Candidate& candidate, std::vector<LineSegment>& segments) {
        const LayerLine& line = candidate.line;
        const double begin = candidate.part.begin, end = candidate.part.end;
        const double slack = line_slack(screen_.surfaces(), line);
        const double rounding = kRounding * level_slack(screen_.surfaces(), line.nearness_from);
        const bool is_border = line.owners[0] == line.owners[1];
        hidden_.clear();
        for (const LayerTriangle& t : triangles_) {
            double from = begin, to = end;
            if (lies_on(line, t)) continue;
            // A mesh hides its own edges exactly; patches that are not stitched are snapped apart, and other
            // objects may touch.
            const bool is_own_mesh = t.instance == candidate.part.edge.instance;
            const double level = !is_own_mesh ? slack + t.slack : is_border ? rounding + t.slack : rounding;
            if (!clip_where_hidden(line, level, t, from, to)) continue;
            if (from <= begin && to >= end) return;
            hidden_.push_back({from, to});
        }
        std::sort(hidden_.begin(), hidden_.end(), [](const Interval& a, const Interval& b) { return a.begin < b.begin; });
        const double shortest = std::min(kShortestPiecePx / line.length_px(), 0.5 * (end - begin));
        double reached = begin;
        for (const Interval& h : hidden_) {
            add_wide(candidate, reached, h.begin, shortest, segments);
            reached = std::max(reached, h.end);
        }
        add_wide(candidate, reached, end, shortest, segments);
    }

  private:
    struct Interval {
        double begin, end;
    };

    /// Adds what is no negligible fold.
    void add_wide(const Candidate& candidate, double begin, double end, double shortest,
                  std::vector<LineSegment>& segments) const {
        if (candidate.line.classes.has(LineClass::silhouette)) {
            while (end - begin > shortest && !is_wide(candidate, begin)) begin = std::min(end, begin + step_of(candidate));
            while (end - begin > shortest && !is_wide(candidate, end)) end = std::max(begin, end - step_of(candidate));
        }
        if (end - begin > shortest) add(candidate, begin, end, segments);
    }
    static double step_of(const Candidate& candidate) { return kWidthStepPx / candidate.line.length_px(); }

    /// Whether both surfaces at a contour go on for more than a negligible fold.
    bool is_wide(const Candidate& candidate, double t) const {
        const glm::dvec2 at = glm::mix(candidate.line.from, candidate.line.to, t);
        const ScreenMesh mesh = screen_.mesh(candidate.part.edge.instance);
        const HalfEdge h = candidate.part.edge.half_edge, partner = mesh.partners[h];
        const double nearness = glm::mix(candidate.line.nearness_from, candidate.line.nearness_to, t);
        const double level = 32 * level_slack(screen_.surfaces(), nearness);
        // Along rows and columns, as samples would see it.
        for (const glm::dvec2 way : {glm::dvec2(1, 0), glm::dvec2(0, 1)}) {
            const auto goes_on = [&](HalfEdge side) {
                return is_surface_wide(mesh, side, at, nearness, way, kNegligibleFoldSubpixels, level);
            };
            if (goes_on(h) && (partner == h || goes_on(partner))) return true;
        }
        return false;
    }

    void add(const Candidate& candidate, double begin, double end, std::vector<LineSegment>& segments) const {
        const LayerLine& line = candidate.line;
        LineClassSet classes = line.classes;
        bool occludes = classes.has(LineClass::silhouette) || classes.has(LineClass::border);
        if (classes.has(LineClass::border)) {
            if (const auto contact = contact_behind(line, 0.5 * (begin + end))) {
                classes = (classes & LineClass::mark) | (*contact & criteria_.classes);
                occludes = false;
                if (classes.empty()) return;
            }
        }
        LineSegment s;
        s.from = glm::mix(line.from, line.to, begin) / 256.0;
        s.to = glm::mix(line.from, line.to, end) / 256.0;
        s.drawn_as = *classes.first();
        s.opacity = line.opacity;
        s.line_key = line.line_key;
        s.block = static_cast<std::uint32_t>(candidate.part.block_y & 0xFFFF) << 16 |
                  static_cast<std::uint32_t>(candidate.part.block_x & 0xFFFF);
        const double zero = screen_.surfaces().farthest_nearness;
        s.nearness_from = static_cast<float>(zero + line.nearness_from + (line.nearness_to - line.nearness_from) * begin);
        s.nearness_to = static_cast<float>(zero + line.nearness_from + (line.nearness_to - line.nearness_from) * end);
        s.occludes = occludes;
        s.front_on_left = is_owner_on_left(candidate);
        segments.push_back(s);
    }

    /// A surface that ends in contact with another one has no border there, but the classes of a contact.
    std::optional<LineClassSet> contact_behind(const LayerLine& line, double t) const {
        const glm::dvec2 at = glm::mix(line.from, line.to, t);
        const double nearness = glm::mix(line.nearness_from, line.nearness_to, t);
        const LayerTriangle* behind = nullptr;
        double nearest = 0;
        for (const LayerTriangle& triangle : triangles_) {
            const double other = triangle.nearness_at(at);
            if (lies_on(line, triangle) || !triangle.covers(at) || (behind != nullptr && other <= nearest)) continue;
            behind = &triangle;
            nearest = other;
        }
        if (behind == nullptr) return std::nullopt;
        const SurfaceSet& surfaces = screen_.surfaces();
        const Projection& p = surfaces.projection;
        const SurfaceId own = screen_.surface_of(line.owners[0]), other = screen_.surface_of(behind->number);
        const double distance = distance_of(p, surfaces.farthest_nearness + nearness);
        const double gap = distance_of(p, surfaces.farthest_nearness + nearest) - distance;
        if (gap > depth_tolerance(surfaces, distance, surfaces.plane(other))) return std::nullopt;
        return contact_classes(surfaces, own, other, at / 256.0, criteria_);
    }

    /// Of the way from the line's beginning to its end.
    bool is_owner_on_left(const Candidate& candidate) const {
        const HalfEdge h = candidate.part.edge.half_edge;
        const ScreenMesh mesh = screen_.mesh(candidate.part.edge.instance);
        const ScreenVertex& apex = mesh.vertices[mesh.corners[h - h % 3 + (h + 2) % 3]];
        const glm::dvec2 along = candidate.line.to - candidate.line.from;
        const glm::dvec2 across = glm::dvec2(apex.x, apex.y) - candidate.line.from;
        return along.x * across.y - along.y * across.x < 0;  // y runs down
    }

    const ScreenSurfaces& screen_;
    const LineCriteria& criteria_;
    std::vector<LayerTriangle> triangles_;
    std::vector<Interval> hidden_;
};

}  // namespace

std::vector<LineSegment> find_fine_lines(const Frame& frame, const ScreenSurfaces& screen, PixelRect region,
                                         const std::vector<std::vector<FinePart>>& parts, int threads) {
    std::vector<LineSegment> segments;
    const std::vector<Candidate> candidates = find_candidates(frame, screen, region, parts, threads);
    if (candidates.empty()) return segments;
    Blocks blocks(screen, SampleBlocks(frame.scene->abuffer.samples_per_pixel), region, candidates);
    blocks.sort_triangles(threads);
    std::vector<BlockClipper> clippers(static_cast<std::size_t>(threads), BlockClipper(screen, frame.criteria));
    std::vector<std::vector<LineSegment>> found(blocks.count());
    parallel_for(blocks.count(), threads, [&](std::size_t block, int worker) {
        BlockClipper& clipper = clippers[static_cast<std::size_t>(worker)];
        clipper.set_triangles(blocks.triangles(block));
        for (const std::uint32_t i : blocks.candidates(block)) clipper.add_visible(candidates[i], found[block]);
    });
    for (const auto& list : found) segments.insert(segments.end(), list.begin(), list.end());
    return segments;
}

}  // namespace burin
