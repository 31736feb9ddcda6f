#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>

#include "base/error.h"
#include "mesh/box.h"
#include "scene/paper.h"
#include "view/projection.h"

// Camera settings become a camera: what they leave open is chosen so that the scene fills the picture.

namespace burin {

inline constexpr double kLeastPixelAspect = 0.1, kMostPixelAspect = 10;

/// What is said about a camera, in a scene or on the command line. What is not said is chosen so
/// that the scene fills the picture.
struct CameraSettings {
    std::string name;
    bool orthographic = false;
    std::optional<glm::dvec3> eye;
    std::optional<glm::dvec3> target;     ///< default: the middle of the scene
    std::optional<glm::dvec3> up;         ///< default: +Y
    std::optional<glm::dvec3> direction;  ///< from the scene towards the eye, if there is no eye
    double fov_deg = 35;                  ///< vertical, perspective only
    std::optional<double> height;         ///< full visible height in world units, orthographic only
    double fit = 0.95;                    ///< part of the picture that the scene fills, if fitted
    SourcePosition where;                 ///< in the scene file, for messages; can be unknown
    std::optional<glm::dmat4> to_world;   ///< instead of eye, target, up (cameras of glTF files)
    ViewArea area;                        ///< of the picture: what fov, height and fit are about
    glm::dvec2 shift{0.0};                ///< of the lens, see Camera
    double pixel_aspect = 1;              ///< a pixel's width / its height
    double lens_radius = 0;               ///< world units; 0: all is in focus
    std::optional<double> focus;          ///< distance in focus along the view axis; default: that of the target
};

/// A camera with nothing left open.
struct Camera {
    bool orthographic = false;
    glm::dmat4 to_world{1.0};  ///< rigid: the columns are right, up, back and the eye's position
    double fov_deg = 35;       ///< perspective only
    double height = 1;         ///< orthographic only
    ViewArea area;             ///< of the picture: fov and height are its, and the view axis meets its middle, unless
    /// the lens is shifted: the picture shows what is so much farther to the right and up, in heights of the area,
    /// while the camera looks where it did.
    glm::dvec2 shift{0.0};
    double pixel_aspect = 1;  ///< a pixel's width / its height, kLeastPixelAspect to kMostPixelAspect
    double lens_radius = 0;   ///< perspective only, world units; 0: all is in focus
    double focus = 1;         ///< distance along the view axis that is in focus, if there is a lens

    glm::dvec3 eye() const { return glm::dvec3(to_world[3]); }
    /// World to view space.
    glm::dmat4 to_view() const;
    /// How view space falls on a picture of width x height pixels. `near_distance` in world units.
    Projection projection(int width, int height, double near_distance) const;
};

/// The view from a point of the lens, given in radii to the right and up, that has what is in focus where the camera
/// has it.
Camera from_lens_point(const Camera& camera, const glm::dvec2& point);

/// Is called with points, some at a time.
struct PointVisitor {
    /// Is asked before, with a box around points to come: false where they need not come. `is_smallest`: around these
    /// points there is no smaller box, so that it tells how far they reach.
    std::function<bool(const Box&, bool is_smallest)> needs;
    std::function<void(std::span<const glm::dvec3>)> visit;

    void operator()(std::span<const glm::dvec3> some) const { visit(some); }
};

/// All points that the camera should see: calls its argument with them. May be run several times.
using PointSource = std::function<void(const PointVisitor&)>;

template <typename Visit>
void for_each_point(const PointSource& points, const Visit& visit) {
    points({[](const Box&, bool) { return true; },
            [&](std::span<const glm::dvec3> some) {
                for (const glm::dvec3& p : some) visit(p);
            }});
}

/// The smallest box around all points.
Box box_of(const PointSource& points);

/// Fills in what the settings leave open. `aspect` is width / height of the whole picture in
/// pixels.
///
/// Throws InputError (message without a place) for settings that define no view: eye = target, up
/// along the view, a field of view outside of (0, 180), a height that is not positive, anything
/// that is not finite, a scene without extent that the camera should be fitted to, and a lens of an orthographic camera
/// or without anything in front of it that could be in focus.
Camera resolve_camera(const CameraSettings& settings, const PointSource& points, double aspect);

}  // namespace burin
