#include "render/line_shading.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "lines/smooth_contours.h"
#include "render/surface_shading.h"
#include "shading/ink/found_needs.h"
#include "shading/sheet/compiled_sheet.h"
#include "shading/sheet/style_sheet.h"

namespace burin {
namespace {

LineDrawing with_smooth_contours(LineDrawing found, const Frame& frame, int threads) {
    const SmoothContours contours(frame.surfaces, frame.criteria.cos_crease_angle, threads);
    LineDrawing moved;
    std::vector<LinePiece> behind;
    for (const std::span<const LinePiece> list : found.behind()) behind.insert(behind.end(), list.begin(), list.end());
    std::vector<std::vector<LinePiece>> visible = found.take_visible();
    contours.move(visible, threads);
    contours.move(behind);
    for (std::vector<LinePiece>& list : visible) moved.add_visible(std::move(list));
    moved.add_behind(std::move(behind));
    const auto lines = found.whole_lines();
    moved.add_whole_lines({lines.begin(), lines.end()});
    return moved;
}

std::vector<ObjectOfLines> objects_of(const Frame& frame) {
    std::vector<ObjectOfLines> objects;
    std::map<std::string_view, std::uint32_t> seen;
    const std::vector<SceneObject>& of_scene = frame.scene->objects;
    for (std::size_t i = 0; i < of_scene.size(); ++i) {
        const SurfaceInstance& instance = frame.surfaces.instances[i];
        ObjectOfLines object;
        object.name = of_scene[i].name;
        object.same_name_before = seen[of_scene[i].name]++;
        const glm::dmat3 linear(instance.to_view), back = glm::inverse(linear);
        object.from_view = glm::dmat4(back);
        object.from_view[3] = glm::dvec4(instance.mesh->origin - back * glm::dvec3(instance.to_view[3]), 1.0);
        object.units_per_view = 1 / std::max(std::cbrt(std::abs(glm::determinant(linear))), 1e-300);
        objects.push_back(std::move(object));
    }
    return objects;
}

}  // namespace

FoundLines found_lines(LineDrawing drawing, const Frame& frame, int threads) {
    if (frame.scene->lines.contours == Contours::smooth)
        drawing = with_smooth_contours(std::move(drawing), frame, threads);
    FoundLines lines;
    lines.classes = frame.needs.classes;
    lines.most_invisibility = frame.needs.most_invisibility;
    lines.tells_invisibility = frame.needs.tells_invisibility;
    lines.has_beyond = frame.needs.surfaces_beyond;
    lines.projection = frame.surfaces.projection;
    lines.camera_to_world = frame.camera.to_world;
    lines.width_px = frame.width;
    lines.height_px = frame.height;
    lines.objects = objects_of(frame);
    for (const Material& material : frame.scene->materials) {
        lines.materials.push_back(material.name);
        lines.material_colors.push_back(material.color);
    }
    lines.light = frame.scene->sheet->light;
    if (!frame.scene->lights.empty()) lines.scene_light = in_view(frame.scene->lights.front(), frame.camera.to_view());
    if (frame.sheet->needs().variables.has(Variable::lit)) lines.casters = shadow_casters_of(frame);
    lines.frame = frame.scene->frame.number;
    lines.fps = frame.scene->frame.fps;
    lines.dpi = frame.scene->picture.dpi;
    lines.paper_mm = frame.scene->picture.paper.size_mm.value_or(glm::dvec2(0.0));
    const LineSettings& settings = frame.scene->lines;
    lines.crease_angle_deg = {settings.crease_fade().from_deg, settings.crease_fade().to_deg};
    lines.has_smooth_contours = settings.contours == Contours::smooth;
    lines.filter = settings.style.filter;
    FoundLinesNeeds needs = found_needs_of(frame.sheet->needs());
    needs.ends = frame.sheet->needs().ends || !frame.scene->draws_one_sheet;
    if (frame.scene->finds_all) needs.normals = needs.chains = true;
    needs.chains = needs.chains || frame.scene->names_lines;
    if (lines.has_smooth_contours) needs.apart_px = SmoothContours::kApartPx;
    SceneCurvatures of_frame;
    std::vector<const MeshCurvature*> curvatures;
    if (needs.surface.kr)
        curvatures = curvatures_of(frame, frame.prepared != nullptr ? *frame.prepared->curvatures : of_frame, threads);
    find_sides_and_runs(drawing, frame.surfaces, frame.criteria.cos_crease_angle, needs, curvatures, threads, lines);
    return lines;
}

}  // namespace burin
