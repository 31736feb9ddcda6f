#pragma once

#include <optional>
#include <vector>

#include "abuffer/screen/edge_on_screen.h"
#include "abuffer/screen/screen_surfaces.h"

// A border is cut where other patches begin and end along it: its parts are seams or ends of the surface.

namespace burin {

/// A part of a border, as shares of edge_on_screen() from its start, and what runs along it.
struct BorderPart {
    double begin = 0, end = 1;
    std::optional<HalfEdge> partner;
};

/// Where other patches begin and end beside a border, what runs along it may change.
std::vector<BorderPart> parts_of_border(const ScreenSurfaces& screen, SurfaceId s, HalfEdge h,
                                        const EdgeOnScreen& edge);

}  // namespace burin
