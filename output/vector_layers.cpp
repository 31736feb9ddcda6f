#include "output/vector_layers.h"

#include <algorithm>
#include <cmath>

#include "image/image_io.h"
#include "output/paths/arc.h"

namespace burin {

bool is_one_layer(const VectorGroup& a, const VectorGroup& b) {
    return a.is_surface == b.is_surface && a.is_hidden == b.is_hidden && a.invisibility == b.invisibility;
}

std::string label_of_layer(const VectorGroup& group) {
    if (group.is_surface) return "surfaces";
    if (!group.is_hidden) return "1 visible";
    if (group.invisibility == 0) return "2 hidden";
    return std::to_string(1 + group.invisibility) + " hidden " + std::to_string(group.invisibility);
}

std::string label_of_group(const VectorDrawing& drawing, const VectorGroup& group) {
    std::string label = group.view > 0 ? drawing.views[group.view - 1] + ": " : "";
    if (group.is_surface || drawing.grouping == VectorGrouping::object)
        return label + (group.object > 0 ? drawing.objects[group.object - 1] : "no object");
    label += std::string(name_of(group.line_class));
    if (group.set < drawing.sets.size() && !drawing.sets[group.set].empty()) label += ", " + drawing.sets[group.set];
    return label;
}

ShownArea shown_area(const VectorDrawing& drawing) {
    const PixelRect& crop = drawing.crop;
    ShownArea area{{crop.x0, crop.y0}, {crop.width(), crop.height()}, 25.4 / drawing.dpi};
    const bool is_whole = crop.width() == drawing.width_px && crop.height() == drawing.height_px;
    if (is_whole && drawing.paper_mm.x > 0) area.size_px = drawing.paper_mm / area.mm_per_px;
    return area;
}

glm::ivec3 srgb_codes(glm::vec3 linear) {
    glm::ivec3 codes;
    for (int k = 0; k < 3; ++k) {
        const float code = srgb_from_linear(std::clamp(linear[k], 0.0f, 1.0f));
        codes[k] = std::clamp(static_cast<int>(code * 255.0f + 0.5f), 0, 255);
    }
    return codes;
}

std::vector<glm::dvec2> flattened(const VectorPath& path, std::span<const PathStep> steps, double tolerance_px) {
    constexpr double kMost = 10000;
    std::vector<glm::dvec2> points = {path.start};
    for (const PathStep& step : steps) {
        const glm::dvec2 from = points.back();
        if (step.kind == PathStep::Kind::cubic) {
            const glm::dvec2 bend =
                glm::max(glm::abs(from - 2.0 * step.a + step.b), glm::abs(step.a - 2.0 * step.b + step.to));
            const double count = std::ceil(std::sqrt(0.75 * glm::length(bend) / tolerance_px));
            const int parts = static_cast<int>(std::clamp(count, 1.0, kMost));
            for (int i = 1; i < parts; ++i) {
                const double t = static_cast<double>(i) / parts, u = 1 - t;
                points.push_back(u * u * u * from + 3 * u * u * t * step.a + 3 * u * t * t * step.b +
                                 t * t * t * step.to);
            }
        } else if (step.kind == PathStep::Kind::arc) {
            const EllipseArc ellipse = ellipse_of_arc(from, step);
            const double radius = std::max(glm::length(ellipse.first_axis), glm::length(ellipse.second_axis));
            const double turn = 2 * std::acos(std::clamp(1 - tolerance_px / radius, 0.0, 1.0));
            const int parts = static_cast<int>(std::clamp(std::ceil(std::abs(ellipse.sweep) / turn), 1.0, kMost));
            for (int i = 1; i < parts; ++i) points.push_back(ellipse.at(static_cast<double>(i) / parts));
        }
        points.push_back(step.to);
    }
    return points;
}

}  // namespace burin
