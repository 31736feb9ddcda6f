#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "kernels/tile_kernels.h"
#include "lines/line_class.h"
#include "lines/line_id.h"

// Hidden lines and dashes need lines as wholes, whatever is seen of them.

namespace burin {

/// WholeLine is a straight line on the screen, seen or not: an edge of a mesh, or where two triangles pass through each
/// other.
struct WholeLine {
    /// An end that no other line has in common.
    static constexpr std::uint64_t kNoNode = ~std::uint64_t{0};

    glm::dvec2 from{0.0}, to{0.0};  ///< in 1/256 pixel
    /// Nearness at either end, less SurfaceSet::farthest_nearness.
    double nearness_from = 0, nearness_to = 0;
    /// Numbers of the triangles that the line lies on; they do not hide it. A loose edge has none.
    std::array<std::uint32_t, 2> owners{};
    static constexpr std::uint32_t kNoOwner = 0xFFFFFFFFu;
    bool is_loose() const { return owners[0] == kNoOwner; }
    bool is_wire = false;  ///< the edge in front of a wire, or of a strip as narrow, whose triangles say nothing about
                           ///< what is in front
    /// Whether surfaces hide it only where they are in front for certain, and not where they touch it, unless it is
    /// flush with them.
    bool is_by_itself() const { return is_wire || is_loose(); }
    /// Others have the edge's two vertices in common, too.
    bool has_more_owners = false;
    /// On which side of a contour the surface in front is, as side_of_edge() counts. 0: the line is no contour.
    std::int8_t front_side = 0;
    /// The part of edge_on_screen() that the line is, as shares: less than all of it where a border is a seam
    /// elsewhere.
    double edge_begin = 0, edge_end = 1;
    LineId id;
    bool is_edge() const { return id.is_edge(); }
    LineClassSet classes;  ///< all that apply, among those asked for
    LineClass drawn_as = LineClass::silhouette;
    std::uint8_t opacity = 255;  ///< 255 = full; less where the line fades
    /// Lines that meet at an end have equal nodes there. The ends of edges are vertices.
    std::array<std::uint64_t, 2> nodes{kNoNode, kNoNode};
    static constexpr std::uint64_t node_of_vertex(std::uint32_t instance, std::uint32_t vertex) {
        return std::uint64_t{instance} << 32 | vertex;
    }

    /// Opacity of the line behind surfaces that let `transmission` through, 255 = all.
    std::uint8_t opacity_behind(std::uint8_t transmission) const {
        return static_cast<std::uint8_t>((opacity * transmission + 127) / 255);
    }
    /// A place of the line, by its share of the way. Places of a horizontal line are exactly on it, and those of a line
    /// that runs the other way are the same.
    glm::dvec2 at(double t) const { return t < 0.5 ? from + (to - from) * t : to - (to - from) * (1 - t); }
    double nearness_at(double t) const { return nearness_from + (nearness_to - nearness_from) * t; }
    /// The least nearness in a part of it.
    double lowest_in(double begin, double end) const { return std::min(nearness_at(begin), nearness_at(end)); }
    double length_px() const { return to_pixels(glm::distance(from, to)); }
    /// Whether kernels may take all of it as ScreenLine::is_exact.
    bool is_exact() const {
        const glm::dvec2 along = glm::abs(to - from);
        return along.x + along.y <= double{kLongestExact} && glm::floor(from) == from && glm::floor(to) == to;
    }
};

/// LinePart is a part of a line with the same surfaces in front of it all along.
struct LinePart {
    std::uint32_t line = 0;     ///< number of the line
    double begin = 0, end = 1;  ///< as shares of the way from `from` to `to`
    /// Quantitative invisibility (Appel 1967): how many opaque surfaces are in front. 255: 255 or more.
    std::uint8_t invisibility = 0;
    /// What transparent surfaces in front let through, 255 = all.
    std::uint8_t transmission = 255;
};

}  // namespace burin
