#pragma once

#include <cstdint>
#include <vector>

#include "mesh/polygon_soup.h"

// Polygons that pass an edge more than once in one direction are cut into polygons that pass each edge once.

namespace burin {

/// Takes repetitions in a row and spikes (from a corner and straight back to it) out of a polygon's
/// corners.
void remove_spikes(std::vector<std::uint32_t>& corners);

/// What was done to the polygons of an object.
struct CutPolygons {
    std::uint64_t polygons = 0;  ///< that were cut
    std::uint64_t pieces = 0;    ///< that they became
    /// A polygon of n corners counts as n - 2 triangles: how many these polygons were, and how many
    /// the pieces are.
    std::uint64_t triangles = 0, piece_triangles = 0;
};

/// Cuts polygons that pass an edge more than once in one direction, such as 1 2 3 1 2 4 or one that
/// goes round several times, into pieces that pass each edge once: 1 2 3 and 1 2 4. The pieces have
/// the polygon's edges, all together as often as it has, so they cover what it covers. Triangles of
/// one polygon would meet there more than two at an edge, and nothing would be a line between them.
/// A polygon that passes an edge once in either direction, as the bridge to a hole, stays as it is,
/// and so does a figure of eight.
///
/// `welded`: per vertex the number of the first one at its place. Pieces stand where the polygon
/// stood. Returns what was done per object; empty if nothing was.
std::vector<CutPolygons> cut_at_repeated_edges(PolygonSoup& soup, const std::vector<std::uint32_t>& welded);

}  // namespace burin
