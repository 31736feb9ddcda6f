#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "abuffer/samples/fast_walk.h"
#include "abuffer/screen/triangle_bins.h"
#include "lines/line_decision.h"

// Lines between samples of one plane are dropped where flush faces cover the way from one to the other.

namespace burin {

/// Whether faces in one plane, without a line between them, cover the way between two neighbouring samples
/// (docs/decisions/0013-flush-faces.md). Two samples on a letter may have its notch between them: the letter's surface
/// ends on the way, but where it lies flush in a plate, the plate fills the notch. For one tile after the other;
/// buffers are used again.
class FlushCover {
  public:
    FlushCover(const ScreenSurfaces& screen, const TriangleBins& bins, const LineCriteria& criteria)
        : screen_(screen), bins_(bins), criteria_(criteria) {}

    /// Pairs are of this tile from now on.
    void set_tile(std::size_t tile) {
        tile_ = tile;
        filled_.clear();
    }
    /// Whether flush faces cover the way between a pair of samples with a line between them, at an edge of their mesh
    /// (kNoHalfEdge: none). Few pairs lie in one plane, and only those take time. `sample`: the first one's column and
    /// row in the tile; `nearness`: at both.
    bool covers(const NeighbourSamples& pair, glm::ivec2 sample, const float (&nearness)[2], HalfEdge edge) {
        const SurfaceId first = pair.surfaces[0], second = pair.surfaces[1];
        if (first.instance != second.instance || first.is_background() || meet_at(first, second, edge)) return false;
        return may_be_level(pair, nearness) && !stands_in_front(edge, first) &&
               is_covered(pair, sample >> kBlockShift) && !laps_narrowly(edge, pair, sample >> kBlockShift);
    }

  private:
    /// A triangle and its box on the screen, in 1/256 pixel.
    struct Face {
        SurfaceId surface;
        glm::ivec2 low, high;
    };
    /// A part of the way between the samples, as shares.
    struct Interval {
        double begin, end;
    };

    /// Where two triangles meet at the line, nothing lies between them.
    bool meet_at(SurfaceId a, SurfaceId b, HalfEdge edge) const {
        if (edge == kNoHalfEdge) return false;
        const std::uint32_t one = edge / 3, other = screen_.mesh(a.instance).partners[edge] / 3;
        return (one == a.triangle && other == b.triangle) || (one == b.triangle && other == a.triangle);
    }
    /// Whether a surface at the line rises in front of a face's plane, as a fin does that stands on it between the
    /// samples.
    bool stands_in_front(HalfEdge edge, SurfaceId face) const;
    bool laps_narrowly(HalfEdge edge, const NeighbourSamples& pair, glm::ivec2 block);
    /// False for nearly all pairs that are not of one plane.
    bool may_be_level(const NeighbourSamples& pair, const float (&nearness)[2]) const;
    bool is_covered(const NeighbourSamples& pair, glm::ivec2 block);
    bool are_flush(SurfaceId a, SurfaceId b, glm::dvec2 subpixel) const;
    const std::vector<Face>& faces_from(glm::ivec2 block);
    void add(SurfaceId s, std::vector<Face>& faces) const;
    Interval part_within(const NeighbourSamples& pair, SurfaceId s) const;

    const ScreenSurfaces& screen_;
    const TriangleBins& bins_;
    const LineCriteria& criteria_;
    std::size_t tile_ = 0;
    std::vector<std::vector<Face>> faces_;  // per block of samples
    std::vector<std::size_t> filled_;       // the blocks whose faces are known
    std::vector<Interval> covered_;
};

}  // namespace burin
