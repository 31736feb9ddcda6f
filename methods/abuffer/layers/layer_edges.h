#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "image/image.h"
#include "methods/abuffer/layers/layer_line.h"
#include "methods/abuffer/screen/screen_surfaces.h"
#include "render/frame.h"

namespace burin {

/// The sides of edges of some triangles that may be lines in this view: that are sharp, or whose triangles do not face one
/// way. Of a contour, one side may be missing. The facing of all triangles must be known.
std::vector<HalfEdge> sides_of_possible_lines(const ScreenMesh& mesh, std::uint32_t begin, std::uint32_t end);

/// A contour is found from the side that comes first in this order, so that half of a surface without sharp edges need not
/// be read.
constexpr int rank_of_side(std::uint8_t facing) { return facing == counterclockwise ? 1 : facing == clockwise ? 2 : 0; }

/// Whether an edge belongs to exactly two triangles, as its side alone tells: an edge that is not sharp does. False for some that
/// do, too.
inline bool is_surely_pair(const ScreenMesh& mesh, HalfEdge h) { return mesh.sharp != nullptr && (mesh.sharp[h / 3] >> h % 3 & 1) == 0; }

/// Calls visit(triangle, half-edge) for the edges of these triangles. Edges of two triangles come once, as the smaller of
/// their half-edges.
template <typename Visit>
void for_possible_lines(const ScreenSurfaces& screen, const TriangleChunk& chunk, const Visit& visit) {
    const ScreenMesh mesh = screen.mesh(chunk.instance);
    const std::vector<HalfEdge> sides = sides_of_possible_lines(mesh, chunk.begin, chunk.end);
    // What is on the other side of an edge may lie anywhere in memory.
    constexpr std::size_t kAhead = 16;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (i + 2 * kAhead < sides.size()) __builtin_prefetch(mesh.partners + sides[i + 2 * kAhead]);
        if (i + kAhead < sides.size() && !is_surely_pair(mesh, sides[i + kAhead])) {
            __builtin_prefetch(mesh.partners + mesh.partners[sides[i + kAhead]]);
        }
        const HalfEdge h = sides[i], g = mesh.partners[h];
        if (is_surely_pair(mesh, h) || (g != h && mesh.partners[g] == h)) {
            const int own = rank_of_side(mesh.facing[h / 3]), other = rank_of_side(mesh.facing[g / 3]);
            if (own != other ? own > other : g < h) continue;
            visit(SurfaceId{chunk.instance, std::min(h, g) / 3}, std::min(h, g));
        } else {
            visit(SurfaceId{chunk.instance, h / 3}, h);
        }
    }
}

/// Tells which edges are lines in this view: contours, borders that are no seams, and edges with another
/// class asked for.
class LayerEdgeFinder {
  public:
    /// `has_both_of_seam`: where two borders run along each other, both are found, not the longer one only.
    LayerEdgeFinder(const Frame& frame, const ScreenSurfaces& screen, PixelRect region,
                    bool has_both_of_seam = false);
    ~LayerEdgeFinder();

    /// Adds an edge of triangle `s` if it is a line and touches the region; of a border, the parts that are no seams.
    void find(SurfaceId s, HalfEdge h, std::vector<LayerLine>& lines) const;

    /// What counts where a border of triangle `s` is in contact with another surface: the triangle, or behind a sliver the next
    /// one. Nothing if it is a needle.
    std::optional<SurfaceId> solid_at_border(SurfaceId s, HalfEdge h) const;

  private:
    class Rules;
    std::unique_ptr<const Rules> rules_;
};

/// Where edges can be on the screen at all: dashes must not begin at the picture's border.
constexpr PixelRect anywhere_on_screen() {
    constexpr int kFarPx = 1 << 20;
    return {-kFarPx, -kFarPx, kFarPx, kFarPx};
}

/// All lines among the edges of the instances shown, be they seen or not.
std::vector<LayerLine> find_layer_edges(const Frame& frame, const ScreenSurfaces& screen, PixelRect region,
                                        int threads);

}  // namespace burin
