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
    /// `area`: of the parts; what is beyond it lies in the cells at its border. `reach_px`: how far is looked, often.
    explicit PartGrid(PixelRect area, double reach_px = 0);

    struct Part {
        glm::dvec2 from, way;  ///< to its other end
        double square;         ///< of its length
        std::uint32_t line;    ///< a number of the caller's

        double square_distance(glm::dvec2 p) const {
            const glm::dvec2 off = p - from;
            const double along = glm::dot(off, way);
            if (along <= 0) return glm::dot(off, off);
            if (along >= square) return glm::dot(off - way, off - way);
            const double across = off.x * way.y - off.y * way.x;
            return across * across / square;
        }
    };
    void add(glm::dvec2 from, glm::dvec2 to, std::uint32_t line);

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
    static int clamped(double at, int count) {
        return at <= 0 ? 0 : at >= count - 1 ? count - 1 : static_cast<int>(at);
    }
    int column(double x) const { return clamped((x - area_.x0) * cells_per_px_, columns_); }
    int row(double y) const { return clamped((y - area_.y0) * cells_per_px_, rows_); }
    std::size_t cell(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
    }

    PixelRect area_;
    double cell_px_, cells_per_px_;
    int columns_, rows_;
    std::vector<std::uint32_t> first_;  // of each cell
    std::vector<Entry> entries_;
    std::vector<Part> parts_;
};

}  // namespace burin
