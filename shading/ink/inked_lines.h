#pragma once

#include <compare>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "lines/line_class.h"
#include "shading/line_style.h"

// Lines with their looks: what line shading leaves, and what drawing, vector files and pipelines read.

namespace burin {

/// A place on a stroke and the ink there. Between two points of a stroke width, ink and nearness change linearly.
struct InkPoint {
    glm::dvec2 place{0.0};  ///< in pixels of the whole picture
    float nearness = 0;     ///< of the surface that the line lies on, as LinePiece has it
    float width_px = 1;     ///< full width, 0 to 4096
    float opacity = 1;      ///< 0 to 1, with all that weakens the ink there
    glm::vec3 color{0.0f};  ///< linear RGB
    /// Of the way to the next point: whether a surface in front ends there, and on which side it lies, seen on the
    /// screen.
    bool occludes = false;
    bool front_on_left = false;
    /// Of the way to the next point: the boundary in InkedLines::boundaries that it lies on, which does not cut it.
    std::uint32_t boundary = kNoBoundary;
    static constexpr std::uint32_t kNoBoundary = ~0u;
};

/// Whether two points have one width, opacity and colour.
inline bool has_one_ink(const InkPoint& a, const InkPoint& b) {
    static_assert(sizeof(InkPoint) == 48, "what a stroke of constant ink has once is compared here");
    return a.width_px == b.width_px && a.opacity == b.opacity && a.color == b.color;
}

/// Where a stroke lies among the others of a pixel. What is less lies above what is greater.
struct InkOrder {
    std::int32_t below = 0;  ///< minus the style's priority
    bool is_hidden = false;  ///< some opaque surface is in front of the line: it lies below all visible ones
    std::uint32_t set = 0;   ///< number of the line set
    LineClass drawn_as = LineClass::silhouette;
    auto operator<=>(const InkOrder&) const = default;
};

enum class InkBlend : std::uint8_t {
    over,      ///< ink covers what is below
    multiply,  ///< what is below is multiplied by 1 - opacity * (1 - colour), and nothing is added
};
enum class StrokeCaps : std::uint8_t { round, butt };

/// One stroke: a part of a chain that is drawn in one go, such as a dash.
struct InkStroke {
    std::size_t first_point = 0, point_count = 0;  ///< in InkedLines::points; at least two, a dot has two equal places
    InkOrder order;
    /// Strokes of equal order and equal chain count once where they overlap: a line never darkens itself. Of strokes of
    /// equal order the nearer one lies above, then the one with the lower chain. It is made of the
    /// numbers of a run and of the copy.
    std::uint64_t chain = 0;
    static std::uint64_t chain_of(std::uint32_t run, std::uint64_t copy) { return std::uint64_t{run} << 3 | copy; }
    static std::uint32_t run_of(std::uint64_t chain) { return static_cast<std::uint32_t>(chain >> 3); }
    static std::uint32_t copy_of(std::uint64_t chain) { return static_cast<std::uint32_t>(chain & 7); }
    StrokeCaps caps = StrokeCaps::round;  ///< of its two ends; joins are always round
    InkBlend blend = InkBlend::over;
    StrokeSide side = StrokeSide::both;
    bool is_closed = false;   ///< its last point is its first one
    bool is_constant = true;  ///< all its points have one width, opacity and colour
    /// A surface is in front of it, opaque or transparent: nearer surfaces do not cut it off, and it has no sides.
    bool is_behind = false;
    /// How far around it strokes behind are erased, in pixels, where they are at least halo_depth_px[1] pixels' widths
    /// farther; from halo_depth_px[0] on this grows linearly.
    float halo_px = 0;
    glm::vec2 halo_depth_px{2.0f, 50.0f};
};

/// A boundary of a surface that hides the strokes of what is behind it, drawn or not.
struct InkBoundary {
    glm::dvec2 from{0.0}, to{0.0};
    float nearness_from = 0, nearness_to = 0;
    bool front_on_left = false;
    /// The order of the opaque strokes that are drawn along it, if is_drawn. They cover strokes that lie below them, so
    /// the boundary need not hide these.
    InkOrder order;
    bool is_drawn = false;
    /// The full width of the opaque ink that is drawn along it. Wider strokes are not covered by that: it hides them.
    float drawn_width_px = std::numeric_limits<float>::infinity();
};

/// What vector files and mattes say of a stroke beside its ink.
struct StrokeOrigin {
    std::uint32_t object = 0;       ///< in front, from 1; 0: none
    std::uint32_t material = 0;     ///< of that
    std::uint8_t invisibility = 0;  ///< how many opaque surfaces are in front of it, at least
    /// A name of its line: a hash of the object's name, and of the place in the object where the line's chain begins.
    /// Contours, and lines whose chains are not known, have one name per object and class.
    std::uint64_t edge = 0;
    /// Of a stroke whose dashes are not cut: on, off, on, off ... in pixels, and where in it the stroke begins; empty:
    /// it is solid.
    std::vector<float> dash_px;
    float dash_phase_px = 0;
};

/// The lines of a picture with their looks.
struct InkedLines {
    std::vector<InkPoint> points;
    std::vector<InkStroke> strokes;     ///< chain by chain, in an order that does not depend on threads
    std::vector<StrokeOrigin> origins;  ///< of each stroke, if they were asked for
    std::vector<InkBoundary> boundaries;
    PixelFilter filter = PixelFilter::box;
    /// For each set (InkOrder::set): the name of a layer of its own in the files, or nothing.
    std::vector<std::string> layers;
    std::vector<std::string> sets;  ///< names of all sets, by InkOrder::set

    std::span<const InkPoint> points_of(const InkStroke& stroke) const {
        return std::span(points).subspan(stroke.first_point, stroke.point_count);
    }
};

}  // namespace burin
