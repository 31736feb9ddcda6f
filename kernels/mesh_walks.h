#pragma once

#include <cstddef>
#include <cstdint>

// Kernels take many walks over a mesh together; what they read and write is here.

namespace burin {

/// What Walk::over_mesh() compares with. Lengths are parts of the way from one sample to the other.
struct WalkLimits {
    double per_unit;         ///< 1/256 pixel
    double no_advance;       ///< getting farther by no more than this is none
    double snapping;         ///< what snapping may do to where an edge is
    double negligible_fold;  ///< turning back by less than this is none
    /// Places whose nearness differs by less than `level + level_per_nearness *` the lesser one are equally far away,
    /// to all that asks for it.
    double level, level_per_nearness;
};

/// Walks over one mesh along rows and columns of samples, each from a sample to the one next to it, and how they went:
/// an array per number.
struct MeshWalks {
    static constexpr std::size_t kMost = 256, kRoom = kMost + 8;
    static constexpr std::size_t kMostSteps = 22;

    // Where walks begin, with coordinates in 1/256 pixel.
    std::uint32_t triangle[kRoom];
    std::int32_t across[kRoom];                   ///< of the row or column
    std::int32_t origin[kRoom];                   ///< of the sample, along it
    std::uint32_t down[kRoom], backwards[kRoom];  ///< all bits or none

    // The walks that ended, in no order; nothing is known of others.
    static constexpr std::uint32_t kFolds = 1;          ///< the surface turns away, else the walk arrives
    static constexpr std::uint32_t kMayCrossLines = 2;  ///< it went over a sharp edge, or through what may be a sliver
    std::size_t ended_count;
    std::uint32_t ended[kRoom];      ///< walks
    std::uint32_t how[kRoom];        ///< kFolds and kMayCrossLines
    std::uint32_t end_step[kRoom];   ///< whose exit is where it ends
    std::uint32_t last_step[kRoom];  ///< the last one taken, which may lead behind that

    // Steps of all walks, each through one triangle.
    static constexpr std::size_t kStepRoom = (kMostSteps + 1) * kRoom;
    static constexpr std::uint32_t kNoStep = 0xFFFFFFFFu;
    std::uint32_t exit[kStepRoom];      ///< half-edge over which it leaves
    std::uint32_t previous[kStepRoom];  ///< step of the same walk, or kNoStep
    double left[kStepRoom];             ///< where that is: 0 = where the walk begins, 1 = the other sample
};

/// Where walks to the background came to an outline, an array per number.
struct WalkOutlines {
    std::size_t count;
    std::uint32_t walk[MeshWalks::kRoom];
    std::uint32_t exit[MeshWalks::kRoom], partner[MeshWalks::kRoom];  ///< the edge's half-edge, and the next one there
    std::int32_t from_x[MeshWalks::kRoom], from_y[MeshWalks::kRoom];  ///< its ends, in 1/256 pixel
    std::int32_t to_x[MeshWalks::kRoom], to_y[MeshWalks::kRoom];
    double fraction[MeshWalks::kRoom];  ///< of the way from the left or upper sample to the other one
    double nearness[MeshWalks::kRoom];  ///< of the triangle there, within that of its corners
};

}  // namespace burin
