#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>

#include "mesh/mesh.h"

namespace burin {

/// Names a line of a picture: an edge of one instance's mesh, or the place where two surfaces meet. Pieces and
/// crossings with equal ids are of one line. This is the only place that packs and unpacks the number.
///
/// Bits: of an edge, the instance (31 bits) above the edge's half-edge (32); where surfaces meet, a 1, the lower one of
/// the triangles' numbers (31), the higher one (32). Numbers of triangles count through all instances.
struct LineId {
    static constexpr std::uint64_t kNone = ~std::uint64_t{0};
    std::uint64_t bits = kNone;

    /// `least`: the lowest of the half-edges that lie on the edge, so that all of them give one id. Of a loose edge,
    /// its number as the mesh counts it.
    static constexpr LineId of_edge(std::uint32_t instance, HalfEdge least) {
        return {std::uint64_t{instance} << 32 | least};
    }
    /// `a` and `b` in any order.
    static constexpr LineId of_surfaces(std::uint32_t a, std::uint32_t b) {
        return {std::uint64_t{1} << 63 | std::uint64_t{std::min(a, b)} << 32 | std::max(a, b)};
    }

    constexpr bool is_none() const { return bits == kNone; }
    constexpr bool is_edge() const { return bits >> 63 == 0; }
    /// The instance and the half-edge of an edge.
    constexpr std::uint32_t instance() const { return group(); }
    constexpr HalfEdge half_edge() const { return member(); }
    /// Where surfaces meet: the lower one of their triangles' numbers.
    constexpr std::uint32_t lower_surface() const { return group() & 0x7FFFFFFFu; }
    /// The upper and the lower half: lines are told apart by the lower one alone where the upper ones are equal.
    constexpr std::uint32_t group() const { return static_cast<std::uint32_t>(bits >> 32); }
    constexpr std::uint32_t member() const { return static_cast<std::uint32_t>(bits); }

    constexpr auto operator<=>(const LineId&) const = default;
};

}  // namespace burin
