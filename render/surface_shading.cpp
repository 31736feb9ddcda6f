#include "render/surface_shading.h"

namespace burin {

std::unique_ptr<const ShadedSurfaces> shaded_surfaces_of(const Frame& frame, int threads) {
    if (!frame.surface_look) return nullptr;
    ShadedView view;
    view.surfaces = &frame.surfaces;
    view.materials = frame.scene->materials;
    view.camera_to_world = frame.camera.to_world;
    view.lights = lights_of(frame);
    view.cos_crease_angle = frame.criteria.cos_crease_angle;
    if (frame.surface_look->variables[number_of(SurfaceVariable::kr)]) {
        view.curvature_store =
            frame.prepared != nullptr ? frame.prepared->curvatures : std::make_shared<SceneCurvatures>();
        view.curvatures = curvatures_of(frame, *view.curvature_store, threads);
    }
    return std::make_unique<ShadedSurfaces>(*frame.surface_look, std::move(view), threads);
}

std::vector<const MeshCurvature*> curvatures_of(const Frame& frame, SceneCurvatures& curvatures, int threads) {
    std::vector<const MeshCurvature*> of_objects;
    for (const SceneObject& object : frame.scene->objects) {
        of_objects.push_back(&curvatures.of(frame.scene->meshes[object.mesh], object.mesh, frame.scene->meshes.size(),
                                            frame.criteria.cos_crease_angle, threads));
    }
    return of_objects;
}

std::shared_ptr<const ShadowCasters> shadow_casters_of(const Frame& frame) {
    return std::make_shared<ShadowCasters>(frame.surfaces, lights_of(frame).front(),
                                           which_cast_shadows(frame.scene->materials));
}

void add_notes_on(const ShadedSurfaces& surfaces, std::vector<std::string>& notes) {
    notes.insert(notes.end(), surfaces.look().notes.begin(), surfaces.look().notes.end());
    const std::uint64_t count = surfaces.not_numbers();
    if (count == 0) return;
    notes.push_back("[surfaces]: a value is not a number at " + std::to_string(count) +
                    " places on surfaces; there it is 0");
}

}  // namespace burin
