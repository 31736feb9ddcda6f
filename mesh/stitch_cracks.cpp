#include "mesh/stitch_cracks.h"

#include "mesh/collapse_needles.h"
#include "mesh/join_borders.h"
#include "mesh/split_borders.h"

namespace burin {

std::optional<Mesh> stitch_cracks(const Mesh& mesh, const CrackReach& reach) {
    std::optional<Mesh> result;
    // Each step may find nothing to do. What can be joined at once is: of corners in one place then one is left, where
    // borders are cut.
    for (const auto step : {join_borders, split_borders, join_borders, collapse_needles, join_borders}) {
        if (std::optional<Mesh> next = step(result ? *result : mesh, reach)) result = std::move(next);
    }
    return result;
}

}  // namespace burin
