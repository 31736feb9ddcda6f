#pragma once

#include <optional>

#include "lines/line_decision.h"
#include "methods/abuffer/screen_surfaces.h"
#include "methods/abuffer/seam_memory.h"

namespace burin {

/// Two samples next to each other, in 1/256 pixel, and the numbers of their surfaces.
struct NeighbourSamples {
    std::int32_t x, y;  ///< the left or upper one
    std::int32_t pitch;
    bool down;          ///< the second one lies below, else to the right
    std::uint32_t first, second;

    /// Position between the two, in 1/256 pixel.
    glm::dvec2 place(double fraction) const {
        const double along = fraction * pitch;
        return down ? glm::dvec2(x, y + along) : glm::dvec2(x + along, y);
    }
};

/// SurfaceWalk between two neighbours, in one instance.
struct FastWalk {
    enum End : std::uint8_t { arrived, fold, border, crack, unsure } end = unsure;
    std::uint32_t triangle = 0;        ///< where it ended
    HalfEdge half_edge = kNoHalfEdge;  ///< of the fold, border or crack
    std::uint32_t beyond = 0;          ///< crack: the triangle on its other side
    double fraction = 1;               ///< 0 = the sample where it began, 1 = the other one
    LineClassSet crossed;              ///< of those asked for
    SurfaceEdge crossed_edge;
    double crossed_fraction = 0.5;
    double crease_cosine = 1;

    bool is_end_of_surface() const { return end == fold || end == border || end == crack; }
};

/// walk_surface() along a row or column of samples, from one of two neighbours towards the other. Vertices are
/// projected and snapped already, so that sides are integer comparisons.
class FastWalker {
  public:
    FastWalker(const ScreenSurfaces& screen, const LineCriteria& criteria)
        : screen_(screen), surfaces_(screen.surfaces()), criteria_(criteria) {}

    /// From the first sample, or `backwards` from the second one, on to the fraction `goal` of the way between them.
    /// Unsure where triangles reach off the screen, more than two meet at an edge, or there are very many.
    FastWalk walk(const NeighbourSamples& pair, bool backwards, double goal);

    /// Whether a triangle is no sliver in any view.
    static bool is_surely_solid(const ScreenMesh& mesh, std::uint32_t triangle) {
        return mesh.sharp != nullptr && (mesh.sharp[triangle] & kThinTriangle) == 0;
    }
    /// Nearness as a function of the position in pixels.
    DepthPlane plane(SurfaceId s) const;

  private:
    std::optional<HalfEdge> seam_beyond(std::uint32_t instance, HalfEdge border, double along);
    bool is_level(SurfaceId a, SurfaceId b, glm::dvec2 subpixel) const;

    const ScreenSurfaces& screen_;
    const SurfaceSet& surfaces_;
    const LineCriteria& criteria_;
    SeamMemory seams_;
};

}  // namespace burin
