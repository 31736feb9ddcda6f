#pragma once

#include <cstddef>

#include "render/replaced_meshes.h"
#include "scene/scene.h"

namespace burin {

/// Takes away the surfaces of objects that are exact copies of an earlier one in the same place:
/// with the same coordinates, polygons, marks and materials, all of them opaque. Of coincident
/// surfaces the first one is seen, so a copy adds nothing to a picture, but time and memory:
/// programs export some parts thousands of times. Objects, and the ids of polygons, stay as they
/// are. Nothing is done in scenes that highlight objects by name. Returns how many copies there
/// were. `replaced`: gets what the scene's meshes were before.
std::size_t empty_copied_objects(Scene& scene, ReplacedMeshes* replaced = nullptr);

}  // namespace burin
