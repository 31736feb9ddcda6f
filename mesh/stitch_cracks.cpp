#include "mesh/stitch_cracks.h"

#include "mesh/collapse_needles.h"
#include "mesh/join_borders.h"
#include "mesh/split_borders.h"

namespace burin {

std::optional<Mesh> stitch_cracks(const Mesh& mesh, const CrackReach& reach, int threads) {
    std::optional<Mesh> result;
    const auto take = [&](std::optional<Mesh> next) {
        if (!next) return false;
        result = std::move(next);
        return true;
    };
    const auto current = [&]() -> const Mesh& { return result ? *result : mesh; };
    const auto join = [&] { return take(join_borders(current(), reach, threads)); };
    // What can be joined at once is: of corners in one place then one is left, where borders are cut.
    join();
    take(split_borders(current(), reach, threads));
    join();
    // Corners that have become one may be all that held other needles.
    constexpr int kMostRounds = 4;
    for (int round = 0; round < kMostRounds && take(collapse_needles(current(), reach)); ++round) join();
    return result;
}

}  // namespace burin
