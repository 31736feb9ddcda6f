#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "abuffer/hiding/occluder_cells.h"
#include "abuffer/screen/screen_surfaces.h"
#include "kernels/screen_boxes.h"

// Under a cap for memory, each tile looks for triangles that may pass through each other.

namespace burin {

/// Pairs of a tile's triangles that may pass through each other. Buffers are used again.
class OccluderPairs {
  public:
    /// Vertices, numbered through over all instances.
    using Corners = std::array<std::uint32_t, 3>;
    /// Two entries of the tile's cells.
    using Pair = std::array<std::uint32_t, 2>;

    OccluderPairs(const ScreenSurfaces& screen, const TileKernels& kernels)
        : screen_(screen), kernels_(kernels), cells_(kernels) {}

    void clear() { entries_.clear(); }
    /// Adds what is known of the next entry of the tile's cells. `lowest`: the nearness of its farthest corner.
    void add(float lowest, const Corners& vertices) { entries_.push_back({lowest, vertices}); }
    std::span<const Pair> find(const OccluderCells& triangles, PixelRect rect);

  private:
    /// The plane of a triangle, with all changes multiplied by twice the triangle's area on the screen.
    struct SidePlane {
        double x = 0, y = 0, nearness = 0, per_x = 0, per_y = 0, per_nearness = 0;
        double slack = 0;  ///< what snapping does, multiplied likewise
        bool is_on_screen = false;
    };
    struct Entry {
        float lowest;
        Corners vertices;
    };
    std::span<const std::uint32_t> touching(std::size_t begin, std::size_t end, const ScreenBox& box, float least_x0,
                                            float least_y0);
    void find_in_cell(int column, int row);
    SidePlane side_plane(const Corners& corners) const;
    bool is_on_one_side(const SidePlane& plane, const SidePlane& own, const Corners& corners) const;

    const ScreenSurfaces& screen_;
    const TileKernels& kernels_;
    OccluderCells cells_;  // of the same triangles, with fewer in each
    std::vector<Entry> entries_;
    ScreenBoxes boxes_;                 // of the cells' triangles
    std::vector<Corners> vertices_;     // likewise
    std::vector<std::uint32_t> found_;  // by a kernel
    std::vector<Pair> pairs_;
};

}  // namespace burin
