#pragma once

#include <atomic>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lines/corner_normals.h"
#include "lines/mesh_curvature.h"
#include "mesh/polygon_soup.h"
#include "mesh/vertex_attributes.h"
#include "shading/surface/light.h"
#include "shading/surface/shadow_casters.h"
#include "shading/surface/surface_look.h"
#include "view/surface_set.h"

namespace burin {

/// Where surfaces and lights are in a picture.
struct ShadedView {
    const SurfaceSet* surfaces = nullptr;
    std::span<const Material> materials;
    glm::dmat4 camera_to_world{1.0};
    std::vector<ViewLight> lights;                     ///< the first one is the key light; never empty
    double cos_crease_angle = 0;                       ///< where smooth normals end
    std::vector<const MeshCurvature*> curvatures;      ///< per instance; empty: the look reads none
    std::shared_ptr<SceneCurvatures> curvature_store;  ///< has these
};

/// Of each material: whether its surfaces cast shadows. Transparent ones do not.
std::vector<bool> which_cast_shadows(std::span<const Material> materials);

/// ShadedSurfaces has all that shading a surface reads: how it looks, where it is and what lights it. It borrows what
/// it is made of. The same for all threads.
class ShadedSurfaces {
  public:
    ShadedSurfaces(const SurfaceLook& look, ShadedView view, int threads);

    const SurfaceLook& look() const { return look_; }
    const SurfaceSet& surfaces() const { return *view_.surfaces; }
    const Material& material(std::uint32_t id) const { return view_.materials[id - 1]; }
    const glm::dmat4& camera_to_world() const { return view_.camera_to_world; }
    std::span<const ViewLight> lights() const { return view_.lights; }
    /// Normals at the corners of an instance's mesh; nullptr: its polygons are flat.
    const SmoothMesh* smooth(std::uint32_t instance) const {
        return smooth_of_.empty() ? nullptr : smooth_of_[instance];
    }
    /// What casts shadows in the light of the key light; nullptr: shadows are not asked for.
    const ShadowCasters* casters() const { return casters_ ? &*casters_ : nullptr; }
    /// The values of an instance's file that are in a layer of the look; nullptr: the file has none.
    const AttributeLayer* layer(std::uint32_t instance, std::size_t number) const {
        return layers_[instance * look_.layers.size() + number];
    }
    /// How an instance's mesh bends. The look reads it.
    const MeshCurvature& curvature(std::uint32_t instance) const { return *view_.curvatures[instance]; }
    /// A view-space position in the coordinates of an instance's object, before its transform.
    const glm::dmat4& to_object(std::uint32_t instance) const { return to_object_[instance]; }

    /// Counts places at which an expression gave no number. From any thread.
    void count_not_numbers(std::uint64_t count) const { not_numbers_ += count; }
    std::uint64_t not_numbers() const { return not_numbers_; }

  private:
    const SurfaceLook& look_;
    ShadedView view_;
    std::vector<SmoothMesh> smooth_meshes_;
    std::vector<const SmoothMesh*> smooth_of_;   // per instance
    std::vector<glm::dmat4> to_object_;          // per instance
    std::vector<const AttributeLayer*> layers_;  // per instance and layer of the look
    std::optional<ShadowCasters> casters_;
    mutable std::atomic<std::uint64_t> not_numbers_{0};
};

}  // namespace burin
