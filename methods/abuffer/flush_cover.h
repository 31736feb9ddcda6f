#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "lines/line_decision.h"
#include "methods/abuffer/fast_walk.h"
#include "methods/abuffer/triangle_bins.h"

namespace burin {

/// Whether faces in one plane, without a line between them, cover the way between two neighbouring samples
/// (docs/decisions/0013-flush-faces.md). Two samples on a letter may have its notch between them: the letter's surface ends
/// on the way, but where it lies flush in a plate, the plate fills the notch. For one tile after the other; buffers are used
/// again.
class FlushCover {
  public:
    FlushCover(const ScreenSurfaces& screen, const TriangleBins& bins, const LineCriteria& criteria)
        : screen_(screen), bins_(bins), criteria_(criteria) {}

    /// Pairs are of this tile from now on.
    void set_tile(std::size_t tile) {
        tile_ = tile;
        is_filled_ = false;
    }
    /// Of a pair with a line between them, at an edge of their mesh (kNoHalfEdge: none). Few of them lie in one plane, and
    /// only those take time. `nearness`: at the samples.
    bool covers(const NeighbourSamples& pair, const float (&nearness)[2], HalfEdge edge);

  private:
    /// A triangle and its box on the screen, in 1/256 pixel.
    struct Face {
        SurfaceId surface;
        glm::ivec2 low, high;
    };
    /// Of the way between the samples, as shares.
    struct Interval {
        double begin, end;
    };

    bool may_be_level(const NeighbourSamples& pair, const float (&nearness)[2]) const;
    bool are_flush(SurfaceId a, SurfaceId b, glm::dvec2 subpixel) const;
    void fill();
    void add(SurfaceId s);
    glm::ivec2 cell_of(glm::ivec2 subpixel) const;
    Interval part_within(const NeighbourSamples& pair, SurfaceId s) const;

    const ScreenSurfaces& screen_;
    const TriangleBins& bins_;
    const LineCriteria& criteria_;
    std::size_t tile_ = 0;
    bool is_filled_ = false;
    PixelRect rect_;
    int columns_ = 0, rows_ = 0;  // cells
    std::vector<std::vector<Face>> cells_;
    std::vector<Interval> covered_;
};

}  // namespace burin
