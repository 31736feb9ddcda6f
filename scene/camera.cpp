#include "scene/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace burin {
namespace {

constexpr double kMostCoordinate = 1e30;  // as for models: squares and products must stay finite
constexpr double kMostShift = 100;

bool is_reasonable(const glm::dvec3& v) {
    return std::abs(v.x) <= kMostCoordinate && std::abs(v.y) <= kMostCoordinate && std::abs(v.z) <= kMostCoordinate;
}

glm::dvec3 center_of(const Box& box) { return box.is_empty() ? glm::dvec3(0.0) : 0.5 * (box.low + box.high); }
double radius_of(const Box& box) { return box.is_empty() ? 0.0 : 0.5 * glm::distance(box.low, box.high); }

/// The farthest that a point of a box can be along an axis. Neither this nor the point is rounded here.
double farthest_along(const glm::dvec3& axis, const Box& box) {
    const glm::dvec3 reach = glm::max(axis * box.low, axis * box.high);
    return reach.x + reach.y + reach.z;
}
/// The largest coordinates within a box, without sign.
glm::dvec3 largest_in(const Box& box) { return glm::max(glm::abs(box.low), glm::abs(box.high)); }
/// What rounding may add to sums of products as large as these.
constexpr double kRoundingOfBoxes = 1e-12;

/// Where the front of a model usually is: +Z if it stands along Y, -Y if it stands along Z.
glm::dvec3 front_of(const glm::dvec3& up) {
    const glm::dvec3 size = glm::abs(up);
    return size.z > std::max(size.x, size.y) ? glm::dvec3(0, -1, 0) : glm::dvec3(0, 0, 1);
}

/// The direction to a camera that looks from three quarters to the right, a little from above, which shows most of an
/// unknown model.
glm::dvec3 default_direction(const glm::dvec3& up) {
    glm::dvec3 front = front_of(up);
    front = glm::normalize(front - up * glm::dot(front, up));
    const glm::dvec3 right = glm::cross(up, front);
    return glm::normalize(0.55 * right + 0.4 * up + 0.9 * front);
}

/// Turns a camera so that it looks along -`back`, with `up` above.
glm::dmat3 orientation(const glm::dvec3& back, const glm::dvec3& up) {
    const glm::dvec3 right = glm::normalize(glm::cross(up, back));
    return {right, glm::cross(back, right), back};
}

/// What a perspective camera that is fitted sees at distance 1: half the size of the picture, less what is left free at
/// its sides, and where its middle is.
struct FittedView {
    double kx, ky;
    glm::dvec2 middle;
};

/// Places a perspective camera with orientation `axes` so that all points just fit, centred.
///
/// In camera axes, a point p is inside if |p.x - e.x| <= kx (e.z - p.z), and the same in y. Each of
/// these is linear in the eye e, so only four maxima over the points matter. Where the lens is shifted, this holds of x
/// and y after a shear along z. No point comes nearer
/// than `nearest`: with a wide angle the eye would otherwise sit on the model's foremost corner.
glm::dvec3 fitted_eye(const PointSource& points, const glm::dmat3& axes, const FittedView& view, double nearest) {
    const glm::dmat3 to_axes = glm::transpose(axes);
    std::array<double, 5> most;  // the last one tells how far in front they are
    most.fill(-std::numeric_limits<double>::infinity());
    const double kx = view.kx, ky = view.ky;
    const glm::dvec2 middle = view.middle;
    const glm::dvec3 z = axes[2], x = axes[0] + middle.x * z, y = axes[1] + middle.y * z;
    const std::array<glm::dvec3, 5> along = {x + kx * z, -x + kx * z, y + ky * z, -y + ky * z, z};
    const auto needs = [&](const Box& box, bool) {
        const double slack =
            kRoundingOfBoxes * glm::dot(glm::abs(x) + glm::abs(y) + (1 + kx + ky) * glm::abs(z), largest_in(box));
        for (std::size_t i = 0; i < most.size(); ++i) {
            if (!(farthest_along(along[i], box) + slack <= most[i])) return true;
        }
        return false;
    };
    points({needs, [&](std::span<const glm::dvec3> some) {
                std::array<double, 5> m = most;  // in registers
                for (const glm::dvec3& p : some) {
                    glm::dvec3 q = to_axes * p;
                    q.x += middle.x * q.z;
                    q.y += middle.y * q.z;
                    m = {std::max(m[0], q.x + kx * q.z), std::max(m[1], -q.x + kx * q.z),
                         std::max(m[2], q.y + ky * q.z), std::max(m[3], -q.y + ky * q.z), std::max(m[4], q.z)};
                }
                most = m;
            }});
    const double eye_z = std::max({(most[0] + most[1]) / (2 * kx), (most[2] + most[3]) / (2 * ky), most[4] + nearest});
    return axes *
           glm::dvec3((most[0] - most[1]) / 2 - middle.x * eye_z, (most[2] - most[3]) / 2 - middle.y * eye_z, eye_z);
}

/// The distance from a target, along a direction, from which all points fit, none of them nearer
/// than `nearest`.
double fitted_distance(const PointSource& points, const glm::dvec3& target, const glm::dmat3& axes,
                       const FittedView& view, double nearest) {
    const double right = view.kx + view.middle.x, left = view.kx - view.middle.x;
    const double top = view.ky + view.middle.y, bottom = view.ky - view.middle.y;
    if (!(right > 0 && left > 0 && top > 0 && bottom > 0)) {
        throw InputError("the camera's shift moves its target out of the picture; give an eye, or no target");
    }
    const glm::dmat3 to_axes = glm::transpose(axes);
    const glm::dvec3 z = axes[2];
    const glm::dvec3 along[4] = {axes[0] / right + z, z - axes[0] / left, axes[1] / top + z, z - axes[1] / bottom};
    const glm::dvec3 sides =
        glm::abs(axes[0]) / std::min(right, left) + glm::abs(axes[1]) / std::min(top, bottom) + glm::abs(z);
    double distance = 0;
    const auto needs = [&](const Box& box, bool) {
        const Box seen{box.low - target, box.high - target};
        const glm::dvec3 size = largest_in(box) + glm::abs(target);
        const double slack = kRoundingOfBoxes * (glm::dot(sides, size) + nearest);
        const double most =
            std::max({farthest_along(along[0], seen), farthest_along(along[1], seen), farthest_along(along[2], seen),
                      farthest_along(along[3], seen), farthest_along(z, seen) + nearest});
        return !(most + slack <= distance);
    };
    points({needs, [&](std::span<const glm::dvec3> some) {
                for (const glm::dvec3& p : some) {
                    const glm::dvec3 q = to_axes * (p - target);
                    distance = std::max({distance, (q.x < 0 ? -q.x / left : q.x / right) + q.z,
                                         (q.y < 0 ? -q.y / bottom : q.y / top) + q.z, q.z + nearest});
                }
            }});
    return distance;
}

/// The visible height of an orthographic camera that all points fit to, which lie from `low` to `high` of its axis and
/// need not be in the middle of the picture.
double fitted_height(const glm::dvec2& low, const glm::dvec2& high, const CameraSettings& s, double aspect) {
    const glm::dvec2 half = 0.5 * s.fit * glm::dvec2(aspect, 1);
    if (!(glm::all(glm::greaterThan(half, glm::abs(s.shift))))) {
        throw InputError("the camera's shift moves its target out of the picture; give a height, or no target");
    }
    const glm::dvec2 least = glm::max(high / (half + s.shift), -low / (half - s.shift));
    return std::max(least.x, least.y);
}

void check(const CameraSettings& s) {
    for (const auto& v : {s.eye, s.target, s.up, s.direction}) {
        if (v && !is_reasonable(*v)) {
            throw InputError(
                "the camera has a coordinate that is not finite or beyond 1e30; use smaller "
                "numbers");
        }
    }
    if (!s.orthographic && !(s.fov_deg > 0 && s.fov_deg < 180)) {
        throw InputError("the camera's field of view must lie between 0 and 180 degrees");
    }
    if (s.height && !(*s.height > 0 && std::isfinite(*s.height))) {
        throw InputError("the camera's visible height must be positive");
    }
    if (!(s.fit > 0 && s.fit <= 1)) {
        throw InputError("the camera's fit must be greater than 0 and at most 1");
    }
    if (s.up && glm::length(*s.up) == 0) {
        throw InputError("the camera's up vector is zero; give a direction");
    }
    if (s.direction && glm::length(*s.direction) == 0) {
        throw InputError("the camera's direction is zero; give a vector towards the eye");
    }
    if (!(std::abs(s.shift.x) <= kMostShift && std::abs(s.shift.y) <= kMostShift)) {
        throw InputError("the camera's shift must be from -100 to 100 heights of the picture");
    }
    if (!(s.pixel_aspect >= kLeastPixelAspect && s.pixel_aspect <= kMostPixelAspect)) {
        throw InputError("the camera's pixel aspect must be from 0.1 to 10");
    }
    if (!(s.lens_radius >= 0 && s.lens_radius <= kMostCoordinate)) {
        throw InputError("the radius of the camera's lens must be from 0 to 1e30");
    }
    if (s.focus && !(*s.focus > 0 && *s.focus <= kMostCoordinate)) {
        throw InputError("the distance that the camera has in focus must be positive");
    }
    if (s.lens_radius > 0 && s.orthographic) throw InputError("an orthographic camera has no lens");
}

glm::dmat4 rigid(const glm::dmat3& axes, const glm::dvec3& eye) {
    glm::dmat4 matrix(axes);
    matrix[3] = glm::dvec4(eye, 1.0);
    return matrix;
}

/// Has the camera see through its lens, onto its pixels. `target`: what is in focus if the settings do not say it.
template <typename Target>
void add_lens(const CameraSettings& s, const Target& target, Camera& camera) {
    camera.shift = s.shift;
    camera.pixel_aspect = s.pixel_aspect;
    if (s.lens_radius == 0) return;
    camera.lens_radius = s.lens_radius;
    camera.focus = s.focus ? *s.focus : glm::dot(camera.eye() - target(), glm::dvec3(camera.to_world[2]));
    if (!(camera.focus > 0)) {
        throw InputError("the camera's lens has nothing in front of it that could be in focus; give the focus");
    }
}

/// A camera given by a matrix: its scale is dropped.
Camera from_matrix(const CameraSettings& s) {
    const glm::dmat4& m = *s.to_world;
    const glm::dvec3 back = glm::normalize(glm::dvec3(m[2]));
    const glm::dvec3 up = glm::normalize(glm::dvec3(m[1]));
    // Written so that NaN, from axes of length 0 or infinity, fails too.
    if (!(glm::length(glm::cross(up, back)) > 1e-9) || !is_reasonable(glm::dvec3(m[3]))) {
        throw InputError("camera '" + s.name + "' has a matrix that defines no view");
    }
    Camera camera;
    camera.orthographic = s.orthographic;
    camera.to_world = rigid(orientation(back, up), glm::dvec3(m[3]));
    camera.fov_deg = s.fov_deg;
    camera.height = s.height.value_or(1);
    camera.area = s.area;
    return camera;
}

}  // namespace

glm::dmat4 Camera::to_view() const {
    const glm::dmat3 axes(to_world);
    const glm::dmat3 inverse = glm::transpose(axes);
    return rigid(inverse, -(inverse * eye()));
}

Projection Camera::projection(int width, int height_px, double near_distance) const {
    Projection p;
    p.orthographic = orthographic;
    const double own_px = height_px * (area.high.y - area.low.y);
    p.set_pixel_aspect(pixel_aspect);
    p.shift_px = own_px * glm::dvec2(-shift.x * p.x_scale, shift.y);
    p.center_px = 0.5 * (area.low + area.high) * glm::dvec2(width, height_px) + p.shift_px;
    p.focal_px = orthographic ? own_px / height : 0.5 * own_px / std::tan(glm::radians(fov_deg) / 2);
    p.near_distance = near_distance;
    return p;
}

Camera from_lens_point(const Camera& camera, const glm::dvec2& point) {
    Camera moved = camera;
    const glm::dvec2 way = camera.lens_radius * point;
    const glm::dmat3 axes(camera.to_world);
    moved.to_world[3] = glm::dvec4(camera.eye() + way.x * axes[0] + way.y * axes[1], 1.0);
    // In focus, a picture's height is 2 tan(fov / 2) focus long.
    moved.shift -= way / (2 * std::tan(glm::radians(camera.fov_deg) / 2) * camera.focus);
    return moved;
}

Box box_of(const PointSource& points) {
    Box all;
    points({[&](const Box& box, bool is_smallest) {
                if (!is_smallest) {
                    return !(glm::all(glm::lessThanEqual(all.low, box.low)) &&
                             glm::all(glm::lessThanEqual(box.high, all.high)));
                }
                all.add(box.low);
                all.add(box.high);
                return false;
            },
            [&](std::span<const glm::dvec3> some) {
                for (const glm::dvec3& p : some) all.add(p);
            }});
    return all;
}

Camera resolve_camera(const CameraSettings& settings, const PointSource& points, double aspect) {
    check(settings);
    const glm::dvec2 share = settings.area.high - settings.area.low;
    aspect *= share.x / share.y * settings.pixel_aspect;
    if (settings.to_world) {
        Camera camera = from_matrix(settings);
        add_lens(
            settings, [&] { return settings.target ? *settings.target : center_of(box_of(points)); }, camera);
        return camera;
    }

    const bool fits = !settings.eye || (settings.orthographic && !settings.height);
    const bool needs_bounds = fits || !settings.target;
    const Box bounds = needs_bounds ? box_of(points) : Box{};
    const double radius = radius_of(bounds);
    if (!(radius <= kMostCoordinate)) {
        throw InputError("the scene is larger than 1e30 units; scale it down");
    }
    const glm::dvec3 up = glm::normalize(settings.up.value_or(glm::dvec3(0, 1, 0)));
    const glm::dvec3 target = settings.target.value_or(center_of(bounds));

    glm::dvec3 back = settings.direction ? *settings.direction : default_direction(up);
    if (settings.eye) {
        back = *settings.eye - target;
        if (!(glm::length(back) > 0)) {
            throw InputError("the camera's eye and target are the same place; move one of them");
        }
    }
    back = glm::normalize(back);
    if (!(glm::length(glm::cross(up, back)) > 1e-9)) {
        throw InputError("the camera's up vector points along the view; choose another one");
    }
    const glm::dmat3 axes = orientation(back, up);
    if (fits && !(radius > 0)) {
        throw InputError(
            "the scene has no extent that a camera could be fitted to; "
            "give eye and target");
    }

    Camera camera;
    camera.orthographic = settings.orthographic;
    camera.fov_deg = settings.fov_deg;
    camera.area = settings.area;
    const double nearest = 0.05 * radius;
    const double half_fov = std::tan(glm::radians(settings.fov_deg) / 2), half_y = settings.fit * half_fov;
    const FittedView view{half_y * aspect, half_y, 2 * half_fov * settings.shift};
    if (settings.orthographic) {
        const glm::dmat3 to_axes = glm::transpose(axes);
        glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
        if (!settings.height || !settings.eye) {
            const auto needs = [&](const Box& box, bool) {
                for (int k = 0; k < 2; ++k) {
                    const double slack = kRoundingOfBoxes * glm::dot(glm::abs(axes[k]), largest_in(box));
                    if (!(farthest_along(axes[k], box) + slack <= high[k])) return true;
                    if (!(-farthest_along(-axes[k], box) - slack >= low[k])) return true;
                }
                return false;
            };
            points({needs, [&](std::span<const glm::dvec3> some) {
                        for (const glm::dvec3& p : some) {
                            low = glm::min(low, glm::dvec2(to_axes * p));
                            high = glm::max(high, glm::dvec2(to_axes * p));
                        }
                    }});
        }
        const bool is_placed = settings.target || settings.eye;
        glm::dvec2 center = is_placed ? glm::dvec2(to_axes * settings.eye.value_or(target)) : 0.5 * (low + high);
        if (is_placed && !settings.height && settings.shift != glm::dvec2(0.0)) {
            camera.height = fitted_height(low - center, high - center, settings, aspect);
        } else {
            const glm::dvec2 reach = glm::max(high - center, center - low);
            camera.height = settings.height.value_or(2 * std::max(reach.y, reach.x / aspect) / settings.fit);
        }
        if (!is_placed) center -= camera.height * settings.shift;
        const double depth = (to_axes * center_of(bounds)).z + 2 * radius;
        const glm::dvec3 eye = settings.eye.value_or(axes * glm::dvec3(center, depth));
        camera.to_world = rigid(axes, eye);
    } else if (settings.eye) {
        camera.to_world = rigid(axes, *settings.eye);
    } else if (settings.target) {
        const double distance = fitted_distance(points, target, axes, view, nearest);
        camera.to_world = rigid(axes, target + back * distance);
    } else {
        camera.to_world = rigid(axes, fitted_eye(points, axes, view, nearest));
    }
    if (!is_reasonable(camera.eye()) || !(camera.height > 0)) {
        throw InputError("the camera cannot be fitted to the scene; give eye and target");
    }
    add_lens(
        settings, [&] { return target; }, camera);
    return camera;
}

}  // namespace burin
