#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "lines/whole_line.h"
#include "view/surface_set.h"

namespace burin {

/// Whole lines as chains: which lines follow each other, and where they stand along their chain.
struct LineChains {
    /// The places of the two ends of each line along its chain, in pixels on the screen.
    std::vector<std::array<double, 2>> positions;
    /// The numbers of the lines, chain by chain, and how many there are up to the end of each chain. The longest chains
    /// come first, as long as they are in their mesh; of equal ones, those that begin at the vertex that comes first by
    /// its coordinates.
    std::vector<std::uint32_t> lines;
    std::vector<std::size_t> chain_ends;
    std::vector<bool> is_loop;      ///< of each chain
    std::vector<double> length_px;  ///< of each chain, as positions count
};

/// Lines that alone have a node in common follow each other in a chain; of more, those of one class if they are two,
/// where a class does not depend on the view. So dashes run on around the corners of a polyline, and start anew where
/// lines branch.
///
/// A chain begins at its end, or on a loop at its vertex, that comes first by its coordinates in the mesh: where dashes
/// begin depends on neither the view nor the order of triangles. Positions on a loop are scaled so that a whole number
/// of periods fits, if there is a period.
LineChains chains_of(std::span<const WholeLine> lines, const SurfaceSet& surfaces,
                     std::optional<double> period_px = std::nullopt);

}  // namespace burin
