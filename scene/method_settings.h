#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lines/line_class.h"
#include "scene/gbuffer_settings.h"
#include "scene/wire_settings.h"

// Single methods read these settings of a scene.

namespace burin {

/// Which samples are a step away. Patel's halo takes the four to the sides, which makes strokes
/// 0.71 times as wide at 45 degrees; eight make them up to 1.41 times as wide; taking four and eight
/// in turn makes a near-octagon.
enum class HaloShape : std::uint8_t { four, eight, octagon };

/// What only the method `abuffer` looks at.
struct AbufferSettings {
    /// 2, 4 or 8 along each axis: where masks decide. 2 asks for a preview. Not given: the method chooses.
    std::optional<int> samples;
    /// Whether lines that samples miss are drawn from the mesh's edges. Not given: but for the preview.
    std::optional<bool> fine_lines;
    bool draws_fine_lines() const { return fine_lines.value_or(samples != 2); }
};

/// What only the method `patel` looks at.
struct PatelSettings {
    int mask_bits = 64;  ///< 16, 64 or 256
    HaloShape halo = HaloShape::four;
};

/// What only the method `reference` looks at.
struct ReferenceSettings {
    int samples = 16;  ///< rays per pixel and axis, 4 to 64
};

/// What moves when edges are to win against their own polygon's fill.
enum class DepthAdjust : std::uint8_t {
    edges,  ///< edges are pulled towards the eye
    fills,  ///< fills are pushed away
};

/// What the z-buffer methods look at: simple, offset, slope-offset, decal, edging-plane, virgin-plane,
/// stencil. Depth z runs from 0 to 1 over the depth range.
struct ZBufferSettings {
    int depth_bits = 24;  ///< of the z-buffer: 16 or 24 (integers), 32 (float), 64 (double)
    /// Distances from the eye where z is 0 and 1; fitted to the scene if it is not given.
    std::optional<std::array<double, 2>> depth_range;
    double eps = 1e-3;                  ///< offset: how much nearer edges are, in z
    double factor = 1;                  ///< slope-offset: pixels' worth of the polygon's slope
    double units = 1;                   ///< slope-offset: smallest steps of the z-buffer
    std::optional<double> clamp;        ///< slope-offset: the most that is added, in z
    std::optional<DepthAdjust> adjust;  ///< default: offset moves edges, slope-offset fills
    bool canonical_edges = true;        ///< draw edges from the smaller vertex number to the larger
    /// Edges drawn once more in another colour when the picture is done: classes, and names of
    /// objects all of whose drawn edges are meant.
    LineClassSet highlight_classes;
    std::vector<std::string> highlight_objects;
    glm::vec3 highlight_color{1.0f, 0.0f, 0.0f};  ///< linear RGB
};

}  // namespace burin
