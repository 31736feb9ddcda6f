#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "abuffer/screen/edge_rings.h"
#include "abuffer/screen/screen_surfaces.h"
#include "image/image.h"
#include "lines/whole_line.h"
#include "render/frame.h"

// Edges of meshes become whole lines if they are lines in this view, whatever is in front of them.

namespace burin {

/// The edges of the instances shown that may be lines in this view, in chunks of triangles. Edges of two triangles are
/// there once, as the smaller of their half-edges. The facing of all triangles must be known.
struct PossibleLines {
    PossibleLines(const ScreenSurfaces& screen, int threads);

    std::vector<TriangleChunk> chunks;
    std::vector<std::vector<HalfEdge>> edges;  ///< of each
};

/// Tells which edges are lines in this view: contours, borders that are no seams, and edges with another
/// class asked for.
class EdgeLineFinder {
  public:
    /// `has_both_of_seam`: where two borders run along each other, both are found, not the longer one only.
    EdgeLineFinder(const Frame& frame, const ScreenSurfaces& screen, PixelRect region, bool has_both_of_seam = false);
    ~EdgeLineFinder();

    /// Adds an edge of triangle `s` if it is a line and touches the region; of a border, the parts that are no seams.
    /// Without `walls`, which take longest to tell, contours in front of walls seen edge-on are not found.
    void find(SurfaceId s, HalfEdge h, std::vector<WholeLine>& lines, bool walls = true) const;
    /// Adds a loose edge of an instance, by its number (Mesh::loose_number()), if it touches the region.
    void find_loose(std::uint32_t instance, HalfEdge number, std::vector<WholeLine>& lines) const;

    /// What counts where a border of triangle `s` is in contact with another surface: the triangle, or behind a sliver
    /// the next one. Nothing if it is a needle.
    std::optional<SurfaceId> solid_at_border(SurfaceId s, HalfEdge h) const;

  private:
    class Rules;
    std::unique_ptr<const Rules> rules_;
};

/// The region in which edges can be on the screen at all: dashes must not begin at the rim of the picture.
constexpr PixelRect anywhere_on_screen() {
    constexpr int kFarPx = 1 << 20;
    return {-kFarPx, -kFarPx, kFarPx, kFarPx};
}

/// The loose edges [begin, end) of the mesh of an instance, by their numbers.
struct LooseChunk {
    std::uint32_t instance;
    HalfEdge begin, end;
};
/// All loose edges of the instances shown, in chunks; none if marks are not asked for.
std::vector<LooseChunk> chunks_of_loose_edges(const ScreenSurfaces& screen, LineClassSet classes);

/// All lines among the edges of the instances shown, be they seen or not.
std::vector<WholeLine> find_edge_lines(const Frame& frame, const ScreenSurfaces& screen, const PossibleLines& possible,
                                       PixelRect region, int threads);

}  // namespace burin
