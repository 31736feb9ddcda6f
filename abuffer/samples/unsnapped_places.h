#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "view/surface_set.h"

// Walks over walls that are seen edge-on need vertices where they are, not where they are snapped to.

namespace burin {

/// Where vertices are on the screen before they are snapped. Walks over a wall that is seen edge-on ask for the same
/// few vertices over and over, so the last ones are remembered.
class UnsnappedPlaces {
  public:
    struct Place {
        bool needs_clipping;  ///< it has no place, then
        glm::dvec2 pixel;
    };
    const Place& of(const SurfaceSet& surfaces, std::uint32_t instance, std::uint32_t vertex) {
        if (entries_.empty()) entries_.resize(kEntries);
        Entry& entry = entries_[(vertex + 7919 * instance) % kEntries];
        if (entry.vertex != vertex || entry.instance != instance) {
            const glm::dvec3 view = surfaces.view_position(instance, vertex);
            const bool needs_clipping = !needs_no_clipping(surfaces.projection, view);
            entry = {instance,
                     vertex,
                     {needs_clipping, needs_clipping ? glm::dvec2(0.0) : surfaces.projection.to_pixel(view)}};
        }
        return entry.place;
    }

  private:
    static constexpr std::size_t kEntries = 1024;
    struct Entry {
        std::uint32_t instance = ~0u, vertex = ~0u;
        Place place{};
    };
    std::vector<Entry> entries_;
};

}  // namespace burin
