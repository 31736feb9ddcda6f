#pragma once

#include <glm/glm.hpp>

namespace burin {

/// Maps view space to the screen.
///
/// View space is right-handed: x to the right, y up, and the camera looks down -z, so a point's
/// distance along the view axis is -z. On the screen, x runs to the right and y down, in pixels.
///
/// *Nearness* is the depth measure of the A-buffer: larger is nearer, and over a plane it is affine
/// on the screen. It is 1 / distance in perspective and -distance in an orthographic view.
struct Projection {
    bool orthographic = false;
    /// Perspective: pixels per unit of y / distance. Orthographic: pixels per world unit, upwards.
    double focal_px = 1;
    glm::dvec2 center_px{0.0};  ///< where the view axis meets the screen
    /// What is nearer than this (or behind the eye) is cut away. World units.
    double near_distance = 0;
    /// By how much center_px is off the middle of the picture, or of the part of it that the view fills.
    glm::dvec2 shift_px{0.0};
    double pixel_aspect = 1;  ///< a pixel's width / its height
    double x_scale = 1;       ///< 1 / pixel_aspect: what it multiplies x by

    void set_pixel_aspect(double aspect) {
        pixel_aspect = aspect;
        x_scale = 1 / aspect;
    }
    /// Pixels per unit as focal_px, to the right and upwards.
    glm::dvec2 focal_xy_px() const { return {focal_px * x_scale, focal_px}; }
    glm::dvec2 to_pixel(const glm::dvec3& view) const {
        const double scale = orthographic ? focal_px : focal_px / -view.z;
        return {center_px.x + view.x * x_scale * scale, center_px.y - view.y * scale};
    }
    /// A screen position (x, y) as (x w, y w, w); w is the distance along the view axis, or 1 in an orthographic view.
    /// It is linear in view space, also behind the eye.
    glm::dvec3 homogeneous(const glm::dvec3& view) const {
        const double w = orthographic ? 1.0 : -view.z;
        return {center_px.x * w + focal_px * x_scale * view.x, center_px.y * w - focal_px * view.y, w};
    }
    double nearness(const glm::dvec3& view) const { return orthographic ? view.z : -1 / view.z; }
    double distance(double nearness_value) const { return orthographic ? -nearness_value : 1 / nearness_value; }
    /// The height of a pixel at a distance from the eye, in world units.
    double pixel_size(double distance_value) const { return orthographic ? 1 / focal_px : distance_value / focal_px; }
    /// The view ray through a pixel position: points on it are origin + t * direction, with
    /// direction.z = -1, so that t is the distance along the view axis.
    void view_ray(glm::dvec2 pixel, glm::dvec3& origin, glm::dvec3& direction) const {
        glm::dvec2 at = (pixel - center_px) / focal_px;
        at.x *= pixel_aspect;
        origin = orthographic ? glm::dvec3(at.x, -at.y, 0) : glm::dvec3(0.0);
        direction = orthographic ? glm::dvec3(0, 0, -1) : glm::dvec3(at.x, -at.y, -1);
    }
};

}  // namespace burin
