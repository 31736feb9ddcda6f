#include "shading/surface/shaded_surfaces.h"

#include <utility>

#include "base/parallel.h"

namespace burin {

std::vector<bool> which_cast_shadows(std::span<const Material> materials) {
    std::vector<bool> cast;
    for (const Material& material : materials) cast.push_back(material.opacity == 1);
    return cast;
}

ShadedSurfaces::ShadedSurfaces(const SurfaceLook& look, ShadedView view, int threads)
    : look_(look), view_(std::move(view)) {
    const std::vector<SurfaceInstance>& instances = view_.surfaces->instances;
    for (const SurfaceInstance& instance : instances) {
        const glm::dmat3 back = glm::inverse(glm::dmat3(instance.to_view));
        glm::dmat4 to_object(back);
        to_object[3] = glm::dvec4(instance.mesh->origin - back * glm::dvec3(instance.to_view[3]), 1.0);
        to_object_.push_back(to_object);
        for (const SurfaceLayer& layer : look.layers)
            layers_.push_back(find_layer(instance.mesh->attributes, layer.kind, layer.name));
    }
    if (look.needs_lit) casters_.emplace(*view_.surfaces, view_.lights.front(), which_cast_shadows(view_.materials));
    if (!look.has_smooth_normals) return;
    std::map<const Mesh*, std::size_t> numbers;
    std::vector<const Mesh*> meshes;
    for (const SurfaceInstance& instance : instances) {
        if (numbers.try_emplace(instance.mesh, meshes.size()).second) meshes.push_back(instance.mesh);
    }
    smooth_meshes_.resize(meshes.size());
    parallel_for(meshes.size(), threads,
                 [&](std::size_t i, int) { smooth_meshes_[i] = make_smooth(*meshes[i], view_.cos_crease_angle); });
    for (const SurfaceInstance& instance : instances) smooth_of_.push_back(&smooth_meshes_[numbers[instance.mesh]]);
}

}  // namespace burin
