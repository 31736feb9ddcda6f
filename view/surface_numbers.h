#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "view/surface_set.h"

namespace burin {

/// SurfaceNumbers finds triangles by their numbers, which count through all instances of a frame.
class SurfaceNumbers {
  public:
    explicit SurfaceNumbers(const SurfaceSet& surfaces) {
        for (const SurfaceInstance& instance : surfaces.instances) {
            first_.push_back(count_);
            count_ += instance.mesh->triangles.size();
        }
    }

    /// kBackground if there is no such triangle.
    SurfaceId of(std::uint64_t number) const {
        if (number >= count_) return kBackground;
        const auto next = std::upper_bound(first_.begin(), first_.end(), number);
        const auto instance = static_cast<std::size_t>(next - first_.begin()) - 1;
        return {static_cast<std::uint32_t>(instance), static_cast<std::uint32_t>(number - first_[instance])};
    }

  private:
    std::vector<std::uint64_t> first_;  // of each instance
    std::uint64_t count_ = 0;
};

}  // namespace burin
