#include "mesh/stitch_cracks.h"

#include "mesh/join_borders.h"
#include "mesh/split_borders.h"

namespace burin {

std::optional<Mesh> stitch_cracks(const Mesh& mesh, const CrackReach& reach) {
    // What can be joined at once is: of corners in one place then one is left, where borders are cut.
    std::optional<Mesh> joined = join_borders(mesh, reach);
    std::optional<Mesh> split = split_borders(joined ? *joined : mesh, reach);
    if (!split) return joined;
    if (std::optional<Mesh> last = join_borders(*split, reach)) return last;
    return joined;
}

}  // namespace burin
