#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lines/mesh_curvature.h"
#include "view/surface_set.h"

namespace burin {

/// PreparedScene is what all frames of a scene have in common, as long as its meshes, objects and line settings stay.
/// It is made once, so that the method `abuffer` need not make it for every frame. Frames are right without it.
struct PreparedScene {
    /// Which edges are sharp, per mesh (find_sharp_edges()); empty: not made.
    std::vector<std::vector<std::uint8_t>> sharp_edges;
    /// Triangles that may pass through each other: the only ones that are then looked at for hidden intersections. Not
    /// set: each frame searches for them.
    std::optional<std::vector<SurfacePair>> intersecting_pairs;
    /// How smooth surfaces bend: made when a sheet first reads it.
    std::shared_ptr<SceneCurvatures> curvatures = std::make_shared<SceneCurvatures>();
};

}  // namespace burin
