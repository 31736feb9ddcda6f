#pragma once

#include "output/paths/path_lines.h"

namespace burin {

/// Joins lines that go on in each other to the longest lines of one kind and object: two that alone end at a place;
/// where more do, first those of one edge, then the straightest pairs. Lines that come back to where they began are
/// closed. `joins_crumbs`: what is shorter than a pixel also goes on over a small gap. The result is sorted by kind,
/// what lies lower first, and depends on nothing but the lines.
PathLines chained_paths(const PathLines& lines, bool joins_crumbs = false);

}  // namespace burin
