#include "scene/animation/fitted_camera.h"

namespace burin {
namespace {

/// Whether two settings are the same view. They are of one camera, of which the rest does not change.
bool are_alike(const CameraSettings& a, const CameraSettings& b) {
    return a.eye == b.eye && a.target == b.target && a.up == b.up && a.fov_deg == b.fov_deg && a.height == b.height &&
           a.to_world == b.to_world;
}

}  // namespace

FittedCamera::FittedCamera(const CameraSettings& first, const PointSource& points, double aspect,
                           const std::optional<Turntable>& turntable)
    : first_(first),
      aspect_(aspect),
      turntable_(turntable),
      camera_(turntable ? resolve_turning_camera(first, points, aspect) : resolve_camera(first, points, aspect)) {
    if (first.target && !first.to_world) {
        target_ = *first.target;
    } else if (turntable) {
        const Box box = box_of(points);
        if (!box.is_empty()) target_ = 0.5 * (box.low + box.high);
    } else {
        target_ = camera_.eye() - glm::dvec3(camera_.to_world[2]);
    }
}

Camera FittedCamera::at(const CameraSettings& settings, double frame) const {
    Camera camera = camera_;
    if (!are_alike(settings, first_)) {
        CameraSettings filled = settings;
        if (!filled.eye) filled.eye = camera_.eye();
        if (!filled.target) filled.target = target_;
        if (filled.orthographic && !filled.height) filled.height = camera_.height;
        // Without a target, what is in focus stays as far away as it was.
        if (!filled.focus && !settings.target && camera_.lens_radius > 0) filled.focus = camera_.focus;
        camera = resolve_camera(
            filled, [](const PointVisitor&) {}, aspect_);
    }
    if (!turntable_) return camera;
    return turned(camera, *turntable_, settings.target.value_or(target_), frame);
}

}  // namespace burin
