#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "lines/corner_normals.h"
#include "view/surface_set.h"

// The contour of a smooth surface is found on the triangles around a fold, as chains of points.

namespace burin {

/// A part of a smooth contour on the screen, in pixels. Its first point is its last one again if it
/// is closed.
struct ContourChain {
    std::vector<glm::dvec2> points;
    std::vector<double> lengths;  ///< from the first point to each

    bool is_closed() const { return points.front() == points.back(); }
    double length() const { return lengths.back(); }
};

/// Finds smooth contours on the triangles of an instance: where normals, interpolated between
/// vertices, are across the line of sight (Hertzmann and Zorin 2000).
///
/// Such a place on a triangle lies within the surface that the mesh stands for, by up to the
/// sagitta of its facets, and so would a line there. So points are found on the mesh's edges, and
/// lie on the curve that both vertices' normals give the edge (the cubic of PN triangles, Vlachos
/// et al. 2001); and what runs over a triangle from one to the other is a cubic, too: on the screen
/// a contour is at right angles to the normal.
class ContourFinder {
  public:
    ContourFinder(const SurfaceSet& surfaces, std::uint32_t instance, const SmoothMesh& smooth)
        : surfaces_(surfaces), mesh_(*surfaces.instances[instance].mesh), instance_(instance), smooth_(smooth) {}

    /// The chains on the triangles around a smooth edge: those that have a vertex in common with one at the edge's
    /// ends.
    std::vector<ContourChain> chains_around(HalfEdge h) const;

  private:
    using Piece = std::vector<glm::dvec2>;
    struct Crossing {  // of a contour and an edge, on the screen
        glm::dvec2 pixel, along;
    };
    struct Corner {
        glm::dvec3 view, normal;
        double facing;
    };

    std::vector<std::uint32_t> triangles_around(HalfEdge h) const;
    Crossing crossing(std::uint32_t a, const Corner& at_a, std::uint32_t b, const Corner& at_b) const;
    bool add_piece(std::uint32_t triangle, std::vector<Piece>& pieces) const;

    const SurfaceSet& surfaces_;
    const Mesh& mesh_;
    std::uint32_t instance_;
    const SmoothMesh& smooth_;
};

}  // namespace burin
