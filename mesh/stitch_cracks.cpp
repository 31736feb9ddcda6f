#include "mesh/stitch_cracks.h"

#include "mesh/collapse_needles.h"
#include "mesh/join_borders.h"
#include "mesh/split_borders.h"

namespace burin {

std::optional<Mesh> stitch_cracks(const Mesh& mesh, const CrackReach& reach) {
    std::optional<Mesh> result;
    const auto take = [&](std::optional<Mesh> (&step)(const Mesh&, const CrackReach&)) {
        std::optional<Mesh> next = step(result ? *result : mesh, reach);
        if (!next) return false;
        result = std::move(next);
        return true;
    };
    // What can be joined at once is: of corners in one place then one is left, where borders are cut.
    take(join_borders);
    take(split_borders);
    take(join_borders);
    // Corners that have become one may be all that held other needles.
    constexpr int kMostRounds = 4;
    for (int round = 0; round < kMostRounds && take(collapse_needles); ++round) take(join_borders);
    return result;
}

}  // namespace burin
