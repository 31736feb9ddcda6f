#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "image/image.h"

namespace burin {

/// PartGrid finds straight parts of lines near a place. Cells lie in one array, and grow with the picture so that there
/// are at most some millions of them.
class PartGrid {
  public:
    /// `area`: of the parts; what is beyond it lies in the cells at its border.
    explicit PartGrid(PixelRect area);

    struct Part {
        glm::dvec2 from, to;
        std::uint32_t line;  ///< a number of the caller's
    };
    void add(const Part& part);

    /// Calls visit(part) for parts that may come within `reach_px` of a place, at most some cells: some of them twice.
    /// Ends early, and returns true, where visit() returns true.
    template <typename Visit>
    bool any_near(glm::dvec2 place, double reach_px, const Visit& visit) const {
        const int x0 = column(place.x - reach_px), x1 = column(place.x + reach_px);
        const int y0 = row(place.y - reach_px), y1 = row(place.y + reach_px);
        for (int y = y0; y <= y1; ++y) {
            for (int x = x0; x <= x1; ++x) {
                for (std::uint32_t i = first_[cell(x, y)]; i != kNone; i = entries_[i].next) {
                    if (visit(parts_[entries_[i].part])) return true;
                }
            }
        }
        return false;
    }

  private:
    static constexpr std::uint32_t kNone = ~0u;
    struct Entry {
        std::uint32_t part, next;
    };
    int column(double x) const;
    int row(double y) const;
    std::size_t cell(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
    }

    PixelRect area_;
    double cell_px_;
    int columns_, rows_;
    std::vector<std::uint32_t> first_;  // of each cell
    std::vector<Entry> entries_;
    std::vector<Part> parts_;
};

}  // namespace burin
