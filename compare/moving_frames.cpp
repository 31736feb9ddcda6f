#include "compare/moving_frames.h"

#include <algorithm>
#include <limits>

namespace burin {
namespace {

constexpr int kPartStep = 16;
constexpr glm::dvec2 kStep_px{1.0 / 32, .618 / 32};

/// Distance of the scene's middle along the view axis.
double middle_distance(const Scene& scene, const Camera& camera) {
    const glm::dmat4 to_view = camera.to_view();
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for_each_point(scene_points(scene), [&](const glm::dvec3& p) {
        const double distance = -(to_view * glm::dvec4(p, 1.0)).z;
        low = std::min(low, distance);
        high = std::max(high, distance);
    });
    return high > 0 ? 0.5 * (std::max(low, 0.0) + high) : 1;
}

}  // namespace

ComparedView moved_view(const Scene& scene, const ComparedView& view, int j) {
    if (j == 0) return view;
    ComparedView moved = view;
    const Projection projection = view.camera.projection(view.width, view.height, 0);
    const double pixel = projection.pixel_size(middle_distance(scene, view.camera));
    const glm::dvec2 shift = kStep_px * (pixel * j);
    glm::dmat4& to_world = moved.camera.to_world;
    to_world[3] += to_world[0] * shift.x + to_world[1] * shift.y;
    return moved;
}

PixelRect busiest_part(const Plane& coverage, PixelRect crop, int width, int height) {
    width = std::min(width, crop.width());
    height = std::min(height, crop.height());
    // Sums over all rectangles from the corner.
    std::vector<double> sums(static_cast<std::size_t>(coverage.width + 1) *
                             static_cast<std::size_t>(coverage.height + 1));
    const auto sum = [&](int x, int y) -> double& {
        return sums[static_cast<std::size_t>(y) * static_cast<std::size_t>(coverage.width + 1) +
                    static_cast<std::size_t>(x)];
    };
    for (int y = 0; y < coverage.height; ++y) {
        for (int x = 0; x < coverage.width; ++x) {
            sum(x + 1, y + 1) = sum(x, y + 1) + sum(x + 1, y) - sum(x, y) + static_cast<double>(coverage.at(x, y));
        }
    }
    PixelRect best{crop.x0, crop.y0, crop.x0 + width, crop.y0 + height};
    double most = -1;
    for (int y = 0; y + height <= coverage.height; y += kPartStep) {
        for (int x = 0; x + width <= coverage.width; x += kPartStep) {
            const double mass = sum(x + width, y + height) - sum(x, y + height) - sum(x + width, y) + sum(x, y);
            if (mass <= most) continue;
            most = mass;
            best = {crop.x0 + x, crop.y0 + y, crop.x0 + x + width, crop.y0 + y + height};
        }
    }
    return best;
}

}  // namespace burin
