#include "cli/frames/depth_fit.h"

#include <algorithm>
#include <limits>

namespace burin {

void fit_depth_ranges(const SceneAnimation& animation, const std::vector<double>& frames, const JobCamera& camera,
                      const UnreadableFrame& unreadable, Scene& scene) {
    double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
    bool is_orthographic = false;
    for (const double frame : frames) {
        const std::vector<CameraSettings> cameras = animation.places_at(frame).cameras;
        const Camera seen = camera.at(cameras.empty() ? scene.cameras : cameras, scene.picture, frame);
        is_orthographic = seen.orthographic;
        const glm::dmat4 to_view = seen.to_view();
        for_each_point(points_of_frames(scene, animation, {frame}, unreadable), [&](const glm::dvec3& p) {
            const double distance = -(to_view * glm::dvec4(p, 1.0)).z;
            nearest = std::min(nearest, distance);
            farthest = std::max(farthest, distance);
        });
    }
    // In perspective what is at the eye, or behind it, is cut off; so many steps must do for the rest.
    constexpr double kLeastShare = 1e-3;
    if (!is_orthographic) nearest = std::max(nearest, kLeastShare * farthest);
    if (!(farthest > nearest)) return;
    const double margin = 0x1p-10 * (farthest - nearest);
    const double low = is_orthographic ? nearest - margin : std::max(nearest - margin, 0.999 * nearest);
    if (!scene.zbuffer.depth_range) scene.zbuffer.depth_range = {low, farthest + margin};
    if (!(scene.gbuffer.reference_distance > 0) && !is_orthographic)
        scene.gbuffer.reference_distance = 0.5 * (nearest + farthest);
}

std::vector<double> frames_to_fit(const std::vector<double>& range, const std::optional<Turntable>& turntable) {
    if (!range.empty() || !turntable) return range;
    constexpr int kMost = 720;
    const int count = std::min(turntable->frames, kMost);
    std::vector<double> frames;
    for (int i = 0; i < count; ++i)
        frames.push_back(turntable->first + static_cast<double>(turntable->frames) * i / count);
    return frames;
}

}  // namespace burin
