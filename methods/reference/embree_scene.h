#pragma once

#include <memory>
#include <span>

#include "methods/reference/ray_geometry.h"

namespace burin {

/// Finds the nearest facet along rays through positions on the picture, by Embree 3 (Wald et al.,
/// "Embree: a kernel framework for efficient CPU ray tracing", 2014) in its watertight mode.
///
/// Embree computes in single precision, so a facet's edges are off by some 1e-7 of the picture's size
/// at most. Distances come from RayGeometry in double precision. May be used from many threads.
class EmbreeScene {
  public:
    explicit EmbreeScene(const RayGeometry& geometry);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    /// The facets at `hits.size()` positions first, first + (step, 0), ...
    void cast_row(glm::dvec2 first, double step, std::span<Facet> hits) const;
    /// The facet at one position. Where several coincide, the first of them: first object, then
    /// first triangle.
    Facet cast(glm::dvec2 pixel) const;

  private:
    struct Handles;
    const RayGeometry& geometry_;
    double scale_;  // from world units to Embree's
    std::unique_ptr<Handles> handles_;
};

}  // namespace burin
