#include "render/line_shading.h"

#include <utility>

#include "lines/line_dashes.h"
#include "lines/run_ends.h"
#include "lines/smooth_contours.h"
#include "shading/ink/ink_lines.h"

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

LineSurroundings surroundings_of(const Frame& frame) {
    const Scene& scene = *frame.scene;
    LineSurroundings around;
    around.surfaces = &frame.surfaces;
    around.camera_to_world = frame.camera.to_world;
    around.materials = scene.materials;
    for (const SceneObject& object : scene.objects) around.objects.push_back(object.name);
    around.light = scene.sheet->light;
    around.cos_crease_angle = frame.criteria.cos_crease_angle;
    around.width_px = frame.width;
    around.height_px = frame.height;
    around.classes = frame.needs.classes;
    return around;
}

}  // namespace

InkedLines shaded_lines(LineDrawing found, const Frame& frame, int threads, std::vector<std::string>& warnings) {
    if (frame.scene->lines.contours == Contours::smooth) found = with_smooth_contours(std::move(found), frame, threads);
    const std::vector<WholeLine> features = features_of(found.whole_lines());
    const LineDrawing::Lists visible = found.visible();
    LineRuns runs = runs_of(visible, found.behind(), features, frame.surfaces);
    if (frame.sheet->needs().chains)
        find_run_ends(runs, visible, frame.surfaces.projection, {0, 0, frame.width, frame.height});
    InkedLines inked = ink_lines(runs, visible, *frame.sheet, surroundings_of(frame), threads, warnings);
    inked.filter = frame.scene->lines.style.filter;
    return inked;
}

}  // namespace burin
