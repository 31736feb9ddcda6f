#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/unfilled_vector.h"

// Meshes that were put in spatial order still tell the number that each polygon has in its file.

namespace burin {

/// Where a mesh's polygons stood in the input, if they are in another order now.
class InputOrder {
  public:
    InputOrder() = default;
    /// `numbers`: for each polygon its number in the input. `dropped`: the numbers of those that were left out, in
    /// ascending order.
    InputOrder(UnfilledVector<std::uint32_t> numbers, std::vector<std::uint32_t> dropped)
        : numbers_(std::move(numbers)), dropped_(std::move(dropped)) {}

    /// The place of a polygon among those that were not left out.
    std::uint32_t place_of(std::uint32_t polygon) const {
        if (numbers_.empty()) return polygon;
        const std::uint32_t number = numbers_[polygon];
        return number - static_cast<std::uint32_t>(std::lower_bound(dropped_.begin(), dropped_.end(), number) -
                                                   dropped_.begin());
    }

    /// Leaves out more polygons: their numbers in the mesh, in ascending order. Later ones move up.
    void drop(const std::vector<std::uint32_t>& polygons) {
        if (numbers_.empty()) return;
        auto next = polygons.begin();
        std::size_t left = 0;
        for (std::size_t i = 0; i < numbers_.size(); ++i) {
            if (next != polygons.end() && *next == i) {
                dropped_.push_back(numbers_[i]);
                ++next;
            } else {
                numbers_[left++] = numbers_[i];
            }
        }
        numbers_.resize(left);
        std::sort(dropped_.begin(), dropped_.end());
    }

  private:
    UnfilledVector<std::uint32_t> numbers_;  // empty: all are where they were
    std::vector<std::uint32_t> dropped_;
};

}  // namespace burin
