#pragma once

#include <span>
#include <vector>

#include "abuffer/edges/occluder.h"
#include "abuffer/screen/screen_surfaces.h"
#include "render/frame.h"

namespace burin {

/// Finds the lines in which triangles pass through each other on the screen, be they seen or not.
class IntersectionLines {
  public:
    /// `region`: lines beside it are left out.
    IntersectionLines(const Frame& frame, const ScreenSurfaces& screen, PixelRect region);

    /// Whether one of the classes is one that such a line may have.
    static bool are_wanted(const LineClassSet& classes);

    /// Adds the line of two triangles, the one with the smaller number first, if there is one.
    void add(const Occluder& a, const Occluder& b, std::vector<WholeLine>& lines) const;
    /// The lines of many pairs, in order, each once. All instances must be shown and the facing of their triangles
    /// known.
    std::vector<WholeLine> of_pairs(std::span<const SurfacePair> pairs, int threads) const;

    /// Orders lines by their triangles and ends.
    static bool is_before(const WholeLine& a, const WholeLine& b);

  private:
    struct Passage;
    Passage passage(const Occluder& plane, const Occluder& corners) const;
    void add_pair(const SurfacePair& pair, std::vector<WholeLine>& lines) const;
    static bool cut(const Occluder& a, const Occluder& b, WholeLine& line);
    static bool cut_edge(const Occluder& owner, std::size_t corner, const Occluder& other, WholeLine& line);

    const Frame& frame_;
    const ScreenSurfaces& screen_;
    glm::dvec2 low_, high_;  // of the region, in 1/256 pixel
};

}  // namespace burin
