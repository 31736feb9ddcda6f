#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lines/shared_dashes.h"
#include "lines/whole_line.h"
#include "view/surface_set.h"

// Lines of the mesh get their dashes along whole chains, seen or not.

namespace burin {

/// Whether an edge of the mesh is a line in every view, and no mere contour.
bool is_feature(const WholeLine& line);
/// The edges among whole lines that are features. Intersections are found only where a picture has lines behind
/// surfaces, and what stands along visible lines must not depend on that.
std::vector<WholeLine> features_of(std::span<const WholeLine> lines);

/// LineDashes lays out the dashes of lines of the mesh along their chains, and says which parts of a line are drawn.
class LineDashes {
  public:
    /// Lays out dashes after those that `shared` has laid out already.
    LineDashes(std::span<const WholeLine> lines, const SurfaceSet& surfaces, double period_px, SharedDashes& shared);

    /// Calls visit(part) for the parts of a line.
    template <typename Visit>
    void for_parts(std::size_t line, const Visit& visit) const {
        places_.for_parts(piece_of_line_[line], visit);
    }

  private:
    std::vector<std::uint32_t> piece_of_line_;
    DashPlaces places_;
};

}  // namespace burin
