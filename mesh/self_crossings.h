#pragma once

#include <string>

#include "mesh/polygon_soup.h"

namespace burin {

/// Cuts flat polygons that cross themselves, such as a bow tie, into pieces that do not: what they cover by the
/// even-odd rule, where a point is inside if a ray from it passes an odd number of sides. Pieces have the polygon's
/// sides, cut where they cross, and no others, so they touch each other at corners alone.
///
/// Polygons of more than 256 corners or crossings, or with sides that lie on each other, stay as they are and are noted
/// if they cross themselves. So do polygons that are not flat, which may cross in some views and not in others. `path`
/// is for messages.
void cut_at_self_crossings(const std::string& path, PolygonSoup& soup);

}  // namespace burin
