#pragma once

#include "methods/wire/edge_distance.h"
#include "methods/wire/id_buffer.h"
#include "methods/wire/single_pass.h"
#include "tests/support/drawing.h"
#include "tests/support/minimal_scenes.h"

namespace burin::test {

inline Drawing draw(const MinimalScene& s, RenderFunction render, int threads = 2) {
    return Drawing(s.scene, s.camera, s.size_px, s.size_px, {0, 0, s.size_px, s.size_px}, threads, render);
}

/// With the profile and size of the method's paper.
inline MinimalScene as_published(MinimalScene s, std::optional<double> thickness_px = {}) {
    s.scene.wire.width = WireWidth::published;
    s.scene.wire.thickness_px = thickness_px;
    return s;
}

inline MinimalScene with_classes(MinimalScene s, LineClassSet classes) {
    s.scene.lines.classes = classes;
    return s;
}

/// Seen as minimal scenes are: positions in pixels, y down, and z from 0 (near) to 1.
inline glm::dvec3 at_pixel(double x, double y, double z) { return {x, 256 - y, (0.5 - z) * 256}; }

inline MinimalScene scene_from(std::vector<PolygonSoup> objects) {
    MinimalScene s;
    s.scene = scene_of(std::move(objects));
    s.scene.lines.classes = LineClassSet::all();
    s.camera = pixel_camera(256, 256, 1000);
    return s;
}

/// The weight of the line along a segment: what lies within 6 px of it, over the segment's length
/// but for its outer tenths, per pixel of length.
inline double integrated_width(const Drawing& d, glm::dvec2 a, glm::dvec2 b) {
    const double length = glm::distance(a, b);
    const glm::dvec2 along = (b - a) / length;
    double mass = 0;
    for (int y = 0; y < d.height(); ++y) {
        for (int x = 0; x < d.width(); ++x) {
            const glm::dvec2 way = glm::dvec2(x + 0.5, y + 0.5) - a;
            const double s = glm::dot(way, along) / length;
            if (s >= 0.1 && s < 0.9 && std::abs(cross(along, way)) < 6) mass += d.line(x, y);
        }
    }
    return mass / (0.8 * length);
}

inline double distance_to(const std::vector<ScreenSegment>& lines, glm::dvec2 at) {
    double least = kNoEdge;
    for (const ScreenSegment& s : lines) least = std::min(least, segment_distance(s.a, s.b, at).distance);
    return least;
}

/// The largest coverage among the pixels whose centres fulfil a condition.
template <typename Condition>
double darkest(const Drawing& d, const Condition& condition) {
    double result = 0;
    for (int y = 0; y < d.height(); ++y) {
        for (int x = 0; x < d.width(); ++x) {
            if (condition(glm::dvec2(x + 0.5, y + 0.5))) result = std::max(result, d.line(x, y));
        }
    }
    return result;
}

}  // namespace burin::test
