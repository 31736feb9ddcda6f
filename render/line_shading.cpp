#include "render/line_shading.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "lines/smooth_contours.h"
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

bool reads_normals(const SheetNeeds& needs) {
    using enum Variable;
    const auto is_read = [&](Variable v) { return needs.variables.has(v); };
    return is_read(N) || is_read(N2) || is_read(facing) || is_read(facing2) || is_read(light) || is_read(light2);
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
    lines.frame = frame.scene->frame.number;
    lines.fps = frame.scene->frame.fps;
    lines.dpi = frame.scene->picture.dpi;
    const LineSettings& settings = frame.scene->lines;
    lines.crease_angle_deg = {settings.crease_fade().from_deg, settings.crease_fade().to_deg};
    lines.has_smooth_contours = settings.contours == Contours::smooth;
    lines.filter = settings.style.filter;
    FoundLinesNeeds needs;
    needs.chains = frame.needs.whole_lines;
    needs.normals = frame.scene->finds_all || reads_normals(frame.sheet->needs());
    if (lines.has_smooth_contours) needs.apart_px = SmoothContours::kApartPx;
    find_sides_and_runs(drawing, frame.surfaces, frame.criteria.cos_crease_angle, needs, threads, lines);
    return lines;
}

void require_lines_for(const StyleSheet& sheet, const CompiledSheet& compiled, const FoundLines& lines) {
    const SheetNeeds& needs = compiled.needs();
    const auto fail = [](const std::string& what) {
        throw InputError("the style sheet needs " + what +
                         "; render again with this sheet, or with --find all, and --save-lines");
    };
    if ((needs.classes & lines.classes) != needs.classes) {
        fail("lines of the classes " + to_string(needs.classes) + ", and only " + to_string(lines.classes) +
             " were looked for");
    }
    if (needs.most_invisibility > lines.most_invisibility) {
        fail("lines behind up to " + std::to_string(needs.most_invisibility) + " surfaces, and only those behind " +
             std::to_string(lines.most_invisibility) + " were looked for");
    }
    if (needs.tells_invisibility && !lines.tells_invisibility)
        fail("to know how many surfaces are in front of lines, which was not asked for");
    if (needs.chains && !lines.has_chains) fail("lines as chains, which were not asked for");
    if ((needs.sides && !lines.has_beyond) || (reads_normals(needs) && !lines.has_normals))
        fail("the surfaces beside and behind lines, which were not asked for");
    if (sheet.crease_angle_deg && *sheet.crease_angle_deg != lines.crease_angle_deg)
        fail("creases by another crease_angle");
    if (sheet.smooth_contours && *sheet.smooth_contours != lines.has_smooth_contours) fail("other contours");
}

}  // namespace burin
