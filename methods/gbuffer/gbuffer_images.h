#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/gbuffer/raster.h"
#include "render/frame.h"

// The operators of method `gbuffer` work on images of depth, normals and ids, which are made here.

namespace burin {

/// How depth is measured so that the operators' limits have a meaning (Saito & Takahashi 1990
/// normalise to the same end): D = -K / Z in perspective with K = H Zref / (2 tan(fov / 2)), H in
/// samples, and D = Z in samples in an orthographic view. Either way D is affine on the screen over
/// a plane, and a face turned by an angle has the slope tan(angle) per sample (at Zref).
struct DepthScale {
    double per_nearness = 1;  ///< K: D = -K * nearness
    double background = 0;    ///< D where nothing is: 0 in perspective (Z infinite), else behind all
    double lowest = 0;        ///< range of D over the scene, background included
};

/// `samples_per_pixel` along each axis; settings of the scene's [gbuffer].
DepthScale depth_scale(const Frame& frame, int samples_per_pixel);

/// A visible surface of a tile.
struct GBufferSurface {
    SurfaceId id;
    DepthPlane plane;
    glm::dvec3 normal;  ///< unit, view space, on the side towards the eye
};

/// What is visible at each sample of a rectangle, one image per quantity. Numbers are from 1; the
/// background has number 0 and normal 0.
struct GBuffer {
    static constexpr std::uint32_t kNoSurface = 0xFFFFFFFFu;
    std::vector<GBufferSurface> surfaces;
    Raster<std::uint32_t> surface;  ///< which of them, or kNoSurface
    Raster<double> depth;           ///< D, see DepthScale
    Raster<glm::dvec3> normal;
    Raster<std::uint32_t> object, material, polygon;
};

/// The middle of a sample, in pixels.
inline glm::dvec2 sample_position(int x, int y, int samples_per_pixel) {
    return glm::dvec2(x + 0.5, y + 0.5) / static_cast<double>(samples_per_pixel);
}

/// Draws surfaces into the images with a z-buffer: one sample per cell, the nearest plane wins, of
/// equal ones the first. `samples` is in units of samples.
GBuffer draw_gbuffer(const Frame& frame, std::span<const SurfaceId> surfaces, PixelRect samples, int samples_per_pixel,
                     const DepthScale& scale);

}  // namespace burin
