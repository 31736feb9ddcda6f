#pragma once

#include <memory>
#include <vector>

#include "image/image.h"
#include "methods/abuffer/layer_line.h"
#include "methods/abuffer/screen_surfaces.h"
#include "render/frame.h"

namespace burin {

/// Calls visit(triangle, half-edge) for the edges of some triangles that may be lines in this view: that
/// are sharp, or whose triangles do not face one way. Edges of two triangles come once. The facing of all
/// triangles must be known.
template <typename Visit>
void for_possible_lines(const ScreenSurfaces& screen, const TriangleChunk& chunk, const Visit& visit) {
    const ScreenMesh mesh = screen.mesh(chunk.instance);
    for (std::uint32_t t = chunk.begin; t < chunk.end; ++t) {
        const std::uint8_t own = mesh.facing[t];
        const bool is_solid = own == clockwise || own == counterclockwise;
        const unsigned sharp = !is_solid || mesh.sharp == nullptr ? 7u : mesh.sharp[t];
        const HalfEdge* const partner = mesh.partners + 3 * t;
        if (sharp == 0 && mesh.facing[partner[0] / 3] == own && mesh.facing[partner[1] / 3] == own &&
            mesh.facing[partner[2] / 3] == own) {
            continue;
        }
        for (unsigned k = 0; k < 3; ++k) {
            const HalfEdge h = 3 * t + k, g = partner[k];
            if ((sharp >> k & 1) == 0 && mesh.facing[g / 3] == own) continue;
            if (g < h && mesh.partners[g] == h) continue;
            visit(SurfaceId{chunk.instance, t}, h);
        }
    }
}

/// Tells which edges are lines in this view: contours, borders that are no seams, and edges with another
/// class asked for.
class LayerEdgeFinder {
  public:
    /// `has_both_of_seam`: where two borders run along each other, both are found, not the longer one only.
    LayerEdgeFinder(const Frame& frame, const ScreenSurfaces& screen, PixelRect region, bool has_both_of_seam = false);
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
