#pragma once

#include <algorithm>
#include <bit>
#include <memory>
#include <vector>

#include "image/image.h"
#include "methods/abuffer/layer_line.h"
#include "methods/abuffer/screen_surfaces.h"
#include "render/frame.h"

namespace burin {

/// Calls visit(triangle, half-edge) for the edges of some triangles that may be lines in this view: that
/// are sharp, or whose triangles do not face one way. Edges of two triangles come once, as the smaller of
/// their half-edges. The facing of all triangles must be known.
template <typename Visit>
void for_possible_lines(const ScreenSurfaces& screen, const TriangleChunk& chunk, const Visit& visit) {
    const ScreenMesh mesh = screen.mesh(chunk.instance);
    // A contour is found from the side that comes first here, so that half of a surface without sharp edges
    // need not be read.
    static_assert(edge_on == 0 && clockwise == 1 && counterclockwise == 2 && off_screen == 3);
    constexpr std::uint8_t kRank[4] = {0, 2, 1, 0};
    for (std::uint32_t t = chunk.begin; t < chunk.end; ++t) {
        unsigned edges = mesh.line_edges[t] & 7u;
        if (edges == 0) continue;
        const unsigned rank = kRank[mesh.facing[t]];
        if (rank == 2 && mesh.sharp != nullptr && mesh.sharp[t] == 0) continue;
        const HalfEdge* const partner = mesh.partners + 3 * std::size_t{t};
        for (; edges != 0; edges &= edges - 1) {
            const HalfEdge h = 3 * t + static_cast<unsigned>(std::countr_zero(edges)), g = partner[h - 3 * t];
            const std::uint8_t other = mesh.facing[g / 3];
            if (g != h && mesh.partners[g] == h) {
                if (rank != kRank[other] ? rank > kRank[other] : g < h) continue;
                visit(SurfaceId{chunk.instance, std::min(h, g) / 3}, std::min(h, g));
            } else {
                visit(SurfaceId{chunk.instance, t}, h);
            }
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

    /// Adds an edge of triangle `s` if it is a line and touches the region.
    void find(SurfaceId s, HalfEdge h, std::vector<LayerLine>& lines) const;

  private:
    class Rules;
    std::unique_ptr<const Rules> rules_;
};

/// All lines among the edges of the instances shown, be they seen or not.
std::vector<LayerLine> find_layer_edges(const Frame& frame, const ScreenSurfaces& screen, PixelRect region,
                                        int threads);

}  // namespace burin
