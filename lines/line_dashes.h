#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lines/shared_dashes.h"
#include "lines/whole_line.h"
#include "view/surface_set.h"

namespace burin {

/// Whether a line of the mesh is one from anywhere.
bool is_feature(const WholeLine& line);

/// Where the dashes of lines of the mesh are, laid out along their chains.
class LineDashes {
  public:
    /// After those that `shared` has laid out already.
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
