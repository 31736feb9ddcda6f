#pragma once

#include <cstddef>
#include <span>

#include "abuffer/fine/fine_parts.h"
#include "abuffer/screen/triangle_bins.h"

// Where lines lie among too many triangles to be compared one by one, they are left to the samples.

namespace burin {

/// Whether lines in a block are few enough to be compared one by one with this many triangles near each. If they are
/// not, they are not with more lines or triangles either.
bool are_few(std::size_t lines, std::size_t triangles_per_line);

/// Whether some of a tile's blocks may be heaps, with too many triangles for each line however small the triangles are:
/// if these are spread as parts of edges are.
bool may_have_heaps(const TriangleBins& bins, std::size_t tile, std::span<const FinePart> parts);

}  // namespace burin
