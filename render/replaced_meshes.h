#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "scene/scene.h"

namespace burin {

/// Meshes as they were before a scene was made ready for one picture, with their numbers: who draws a scene several
/// times puts them back, the last one first.
using ReplacedMeshes = std::vector<std::pair<std::size_t, Mesh>>;

/// Puts a mesh in the place of one of a scene's, which goes to `replaced`, if that is not nullptr.
inline void replace_mesh(Scene& scene, std::size_t number, Mesh mesh, ReplacedMeshes* replaced) {
    if (replaced == nullptr) {
        scene.meshes[number] = std::move(mesh);
    } else {
        replaced->emplace_back(number, std::move(mesh));
        std::swap(scene.meshes[number], replaced->back().second);
    }
}

}  // namespace burin
