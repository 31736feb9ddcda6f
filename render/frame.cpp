#include "render/frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/interrupt.h"
#include "mesh/box.h"
#include "mesh/text_scan.h"
#include "render/drawing_needs.h"
#include "render/frame_reach.h"
#include "render/sheet_context.h"
#include "shading/sheet/compiled_sheet.h"
#include "shading/sheet/style_sheet.h"
#include "shading/surface/surface_look.h"
#include "view/screen_polygon.h"

namespace burin {
namespace {

/// The matrix that takes area vectors along: cofactors of the linear part.
glm::dmat3 cofactors(const glm::dmat4& m) {
    const glm::dvec3 a(m[0]), b(m[1]), c(m[2]);
    return {glm::cross(b, c), glm::cross(c, a), glm::cross(a, b)};
}

}  // namespace

LineCriteria criteria_of(const LineSettings& lines) {
    LineCriteria criteria;
    criteria.classes = lines.classes;
    criteria.cos_crease_angle = std::cos(glm::radians(lines.crease_angle_deg));
    return criteria;
}

std::vector<ViewLight> lights_of(const Frame& frame) {
    const glm::dmat4 to_view = frame.camera.to_view();
    std::vector<ViewLight> lights;
    for (const SceneLight& light : frame.scene->lights) lights.push_back(in_view(light, to_view));
    if (lights.empty()) lights.push_back(light_at_eye(frame.surfaces.projection));
    if (frame.scene->sheet && frame.scene->sheet->light)
        lights.front() = {false, glm::normalize(*frame.scene->sheet->light)};
    return lights;
}

Frame make_frame(const Scene& scene, const Camera& camera, int width, int height, PixelRect crop,
                 const PreparedScene* prepared) {
    Frame frame;
    frame.prepared = prepared;
    frame.scene = &scene;
    frame.camera = camera;
    frame.width = width;
    frame.height = height;
    frame.crop = crop;
    if (scene.sheet) frame.sheet = std::make_shared<CompiledSheet>(*scene.sheet, sheet_context_of(frame));
    if (scene.surfaces.recipe) {
        frame.surface_look =
            std::make_shared<SurfaceLook>(scene.surfaces.shading, *scene.surfaces.recipe, sheet_context_of(frame));
    }
    frame.needs = frame.sheet ? needs_of(scene, frame.sheet->needs()) : needs_of(scene);
    frame.criteria = criteria_of(scene.lines);

    std::vector<Box> mesh_boxes;
    std::vector<std::shared_ptr<const BodySides>> body_sides;
    for (const Mesh& mesh : scene.meshes) {
        mesh_boxes.push_back(box_of(mesh));
        body_sides.push_back(std::make_shared<BodySides>(mesh));
    }

    SurfaceSet& surfaces = frame.surfaces;
    surfaces.view_to_world = glm::dmat3(camera.to_world);
    const glm::dmat4 world_to_view = camera.to_view();
    Box view_box;
    std::vector<Box> view_boxes;
    std::uint64_t next_polygon_id = 1;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        throw_if_interrupted();
        const SceneObject& object = scene.objects[i];
        const Mesh& mesh = scene.meshes[object.mesh];
        SurfaceInstance instance;
        instance.mesh = &mesh;
        instance.to_view = world_to_view * object.to_world;
        instance.to_view[3] = instance.to_view * glm::dvec4(mesh.origin, 1.0);
        instance.normal_to_view = cofactors(instance.to_view);
        if (prepared != nullptr && object.mesh < prepared->sharp_edges.size() && !mesh.triangles.empty()) {
            instance.sharp_edges = prepared->sharp_edges[object.mesh].data();
        }
        instance.body_sides = body_sides[object.mesh];
        instance.object_id = i + 1;
        instance.first_polygon_id = static_cast<std::uint32_t>(next_polygon_id);
        next_polygon_id += mesh.polygon_count;
        instance.materials = object.materials;
        Box own;
        if (!mesh.positions.empty()) {
            mesh_boxes[object.mesh].for_each_corner(
                [&](const glm::dvec3& corner) { own.add(glm::dvec3(instance.to_view * glm::dvec4(corner, 1.0))); });
            view_box.add(own.low);
            view_box.add(own.high);
        }
        view_boxes.push_back(own);
        surfaces.instances.push_back(std::move(instance));
    }
    if (next_polygon_id > std::numeric_limits<std::uint32_t>::max()) {
        throw InputError("the scene has more than 4 billion polygons; split it");
    }

    if (!view_box.is_empty()) {
        const glm::dvec3 reach = glm::max(glm::abs(view_box.low), glm::abs(view_box.high));
        if (!(std::max({reach.x, reach.y, reach.z}) <= kLargestCoordinate)) {
            throw InputError("the scene reaches beyond 1e30 units from the camera; scale it down");
        }
    }
    surfaces.projection = camera.projection(width, height, 0);
    const glm::dvec2 center = surfaces.projection.center_px;
    if (!(std::max({std::abs(center.x), std::abs(center.y), std::abs(width - center.x), std::abs(height - center.y)}) <=
          kGuardBandPx)) {
        throw InputError("the camera's shift moves the picture beyond " +
                         std::to_string(static_cast<int>(kGuardBandPx)) +
                         " pixels from its axis; make the shift or the picture smaller");
    }
    set_reach(surfaces, view_boxes, glm::length(camera.eye()), {width, height});
    return frame;
}

}  // namespace burin
