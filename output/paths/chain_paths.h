#pragma once

#include "output/paths/path_lines.h"

namespace burin {

/// Joins lines that go on in each other to the longest lines of one kind and object: two that alone end at a place;
/// where more do, first those of one edge, then the straightest pairs. Lines that come back to where they began are
/// closed. The result is sorted by kind, what lies lower first, and depends on nothing but the lines.
PathLines chained_paths(const PathLines& lines);

}  // namespace burin
