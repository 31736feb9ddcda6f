#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lines/mesh_curvature.h"
#include "render/frame.h"
#include "shading/surface/shaded_surfaces.h"

namespace burin {

/// What shading the surfaces of a frame reads; nullptr where their shading does not vary over them. The frame must
/// outlive it.
std::unique_ptr<const ShadedSurfaces> shaded_surfaces_of(const Frame& frame, int threads);

/// The curvature of each object's mesh.
std::vector<const MeshCurvature*> curvatures_of(const Frame& frame, SceneCurvatures& curvatures, int threads);

/// What casts shadows in the light of a frame's key light.
std::shared_ptr<const ShadowCasters> shadow_casters_of(const Frame& frame);

/// What users should know of how surfaces are shaded: at how many places expressions gave no numbers, and what in them
/// is probably a mistake.
void add_notes_on(const ShadedSurfaces& surfaces, std::vector<std::string>& notes);

}  // namespace burin
