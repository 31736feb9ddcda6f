#include "methods/reference/reference_loose.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace burin {
namespace {

constexpr double kExactPx = 1.0 / 4096;
/// What is in front by less is level (docs/conventions.md).
constexpr double kInFrontPx = 1.0 / 1024;
/// How many errors of coordinates count: those of a line and of a surface.
constexpr double kErrors = 4;

/// Keeps the part of [begin, end] where a value that runs from `at_0` at 0 to `at_1` at 1 is not negative.
void keep(double at_0, double at_1, double& begin, double& end) {
    if (at_0 < 0 && at_1 < 0) {
        end = begin;
    } else if (at_0 < 0) {
        begin = std::max(begin, at_0 / (at_0 - at_1));
    } else if (at_1 < 0) {
        end = std::min(end, at_0 / (at_0 - at_1));
    }
}

}  // namespace

ReferenceLooseEdges::ReferenceLooseEdges(const RayGeometry& geometry, const EmbreeScene& rays, LineClassSet wanted)
    : geometry_(geometry), rays_(rays) {
    if (!wanted.has(LineClass::mark)) return;
    const Projection& projection = geometry.projection();
    for (std::uint32_t object = 0; object < geometry.object_count(); ++object) {
        for (const auto& [a, b] : geometry.mesh(object).loose_edges) {
            const glm::dvec3 p = geometry.position(object, a), q = geometry.position(object, b);
            double begin = 0, end = 1;
            keep(-p.z - projection.near_distance, -q.z - projection.near_distance, begin, end);
            if (!(begin < end)) continue;
            const glm::dvec3 from = glm::mix(p, q, begin), to = glm::mix(p, q, end);
            lines_.push_back({projection.to_pixel(from), projection.to_pixel(to), projection.nearness(from),
                              projection.nearness(to)});
        }
    }
}

double ReferenceLooseEdges::distance_at(const Line& line, double share) const {
    return geometry_.projection().distance(glm::mix(line.nearness_a, line.nearness_b, share));
}

bool ReferenceLooseEdges::is_visible(const Line& line, double share) const {
    const glm::dvec2 pixel = glm::mix(line.a, line.b, share);
    const Facet facet = rays_.cast(pixel);
    if (facet.is_background()) return true;
    const double own = distance_at(line, share);
    const double level = kErrors * geometry_.coordinate_error() + kInFrontPx * geometry_.projection().pixel_size(own);
    return geometry_.distance(facet, pixel) >= own - level;
}

void ReferenceLooseEdges::add_visible(glm::dvec2 low, glm::dvec2 high, double step_px,
                                      std::vector<BoundarySegment>& segments) const {
    for (const Line& line : lines_) {
        double begin = 0, end = 1;
        for (int axis = 0; axis < 2; ++axis) {
            keep(line.a[axis] - low[axis], line.b[axis] - low[axis], begin, end);
            keep(high[axis] - line.a[axis], high[axis] - line.b[axis], begin, end);
        }
        const double length = glm::distance(line.a, line.b);
        if (!(begin < end) || !(length > 0)) continue;
        const auto add = [&](double from, double to) {
            BoundarySegment s;
            s.a = glm::mix(line.a, line.b, from);
            s.b = glm::mix(line.a, line.b, to);
            s.depth_a = geometry_.depth_px(distance_at(line, from));
            s.depth_b = geometry_.depth_px(distance_at(line, to));
            s.line_class = static_cast<std::uint8_t>(LineClass::mark);
            if (from < to) segments.push_back(s);
        };
        const int steps = static_cast<int>(std::ceil((end - begin) * length / step_px));
        double visible_from = begin, before = begin;
        bool was_visible = is_visible(line, begin);
        for (int i = 1; i <= steps; ++i) {
            const double here = glm::mix(begin, end, static_cast<double>(i) / steps);
            const bool is_visible_here = is_visible(line, here);
            if (is_visible_here != was_visible) {
                double same = before, other = here;
                while ((other - same) * length > kExactPx) {
                    const double middle = 0.5 * (same + other);
                    (is_visible(line, middle) == was_visible ? same : other) = middle;
                }
                if (was_visible) add(visible_from, same);
                visible_from = other;
            }
            was_visible = is_visible_here;
            before = here;
        }
        if (was_visible) add(visible_from, end);
    }
}

}  // namespace burin
