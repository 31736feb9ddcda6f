#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "lines/line_class.h"
#include "methods/reference/embree_scene.h"

// Two visible points are asked whether a line passes between them, by rays and the mesh alone.

namespace burin {

/// What is visible at a position of the picture.
struct SeenPoint {
    glm::dvec2 pixel{0.0};
    Facet facet;
};

/// Where, on the way from one seen point to another, a line is crossed.
struct SeenCrossing {
    double fraction = 0;   ///< of the way, 0..1
    LineClassSet classes;  ///< all that apply
    /// Whether a surface ends here in front of a farther one, and which: 0 the first point's, 1 the
    /// second's. Lines on a surface, or between surfaces in contact, do not occlude.
    bool occludes = false;
    int front = 0;
    double depth_px = 0;  ///< of the line, see RayGeometry::depth_px
};

/// Decides by rays which lines lie between two seen points: the boundary between their facets is
/// narrowed down to 1/4096 pixel, and what meets there gives the class, as docs/conventions.md
/// defines them. Independent of lines/line_decision.
class ReferenceLines {
  public:
    ReferenceLines(const RayGeometry& geometry, const EmbreeScene& rays, LineClassSet wanted, double cos_crease_angle,
                   double largest_side_px);

    /// The most important line between two neighbouring samples: the first in priority among the wanted
    /// classes, else one that occludes. The fraction is exact to 1/4096 pixel.
    std::optional<SeenCrossing> between(const SeenPoint& a, const SeenPoint& b) const;

  private:
    struct Transition;
    struct Way;
    struct Slice;
    struct Follow;
    struct Search;

    std::optional<Transition> shared_edge(const Way& way, Facet a, Facet b) const;
    void search(Search& search, double ta, Facet a, double tb, Facet b) const;
    SeenCrossing decide(const Way& way, const Transition& transition) const;
    SeenCrossing decide_touching(const Way& way, const Transition& t, SeenCrossing crossing) const;
    Slice slice_of(const Way& way, Facet f) const;
    static double place_on(const Way& way, const glm::dvec3& point, const glm::dvec3& other);
    Follow follow(const Way& way, Facet start, double from, Facet goal) const;
    Follow follow(const Way& way, Facet start, double from, Facet goal, double reach_px) const;
    bool run_along(Facet a, Facet b, glm::dvec2 at) const;
    bool seam_goes_on(const Way& way, Facet f, HalfEdge border, double at, Facet& partner) const;
    LineClassSet edge_classes(Facet a, HalfEdge ha, Facet b, HalfEdge hb, glm::dvec2 at) const;
    LineClassSet classes_of_edge(Facet a, HalfEdge h, glm::dvec2 at) const;
    LineClassSet contact_classes(Facet a, Facet b, glm::dvec2 at) const;
    Facet solid_beyond(Facet sliver, Facet not_this) const;

    const RayGeometry& geometry_;
    const EmbreeScene& rays_;
    LineClassSet wanted_;
    double cos_crease_angle_;
    double resolution_px_;
};

}  // namespace burin
