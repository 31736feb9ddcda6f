#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lines/contour_chains.h"

// An edge at which a smooth surface folds is moved to the contour beside it.

namespace burin {

/// FoldMap says where the places of an edge, at which a smooth surface folds, are moved to: to the nearest points of
/// the smooth contours around, and along these from one to the next. What has none beside it stays. The way is never
/// broken, so what lines enclose they go on to enclose.
class FoldMap {
  public:
    /// An edge that stays where it is.
    FoldMap() = default;
    /// `from`, `to`: the edge on the screen. `farthest_px`: contours that come no nearer are none
    /// of this edge.
    FoldMap(glm::dvec2 from, glm::dvec2 to, std::span<const ContourChain> chains, double farthest_px);

    bool is_moved() const { return !stops_.empty(); }
    /// Leads the way back to the end of the edge that is at `place`, where other lines stay: slantwise, not by a step.
    void lead_to_end(glm::dvec2 place);
    /// The points that a part of the edge, given by its ends, is moved to, at least two.
    std::vector<glm::dvec2> moved(glm::dvec2 from, glm::dvec2 to) const;

  private:
    /// What comes to a place; between two of them straight. Two at one share: from one place to
    /// another.
    struct Stop {
        double share;  // of the edge
        glm::dvec2 place;
        bool is_on_edge;
    };
    struct Foot {
        static constexpr std::size_t kNoChain = ~std::size_t{0};
        glm::dvec2 place{0.0};
        std::size_t chain = kNoChain;
        std::size_t after = 0;  // this point of the chain
        double length = 0;      // along the chain
    };
    static Foot nearest(std::span<const ContourChain> chains, glm::dvec2 place);
    void follow(const ContourChain& chain, const Foot& a, double share_a, const Foot& b, double share_b);
    void straighten();
    double share_of(glm::dvec2 place) const;

    glm::dvec2 from_{0.0}, to_{0.0};
    std::vector<Stop> stops_;
};

}  // namespace burin
