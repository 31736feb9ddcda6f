#pragma once

#include <vector>

#include "base/model_budget.h"
#include "mesh/mesh.h"
#include "mesh/polygon_soup.h"
#include "mesh/subdivide.h"

namespace burin {

struct MeshOptions {
    int subdivision_levels = 0;
    SubdivisionScheme scheme = SubdivisionScheme::automatic;
    ModelBudget* budget = nullptr;  ///< counts what a model takes beyond its file; nullptr: as by default
    int threads = 1;  ///< for reading a file; 0 = all cores. Changes no result.
};

/// Turns the polygons of a file into one Mesh per object that has polygons left.
///
/// In this order: coordinates are rounded to single precision (relative to a common origin where
/// the model lies far from 0), vertices with equal coordinates of one object are welded, repeated
/// corners in a row and spikes (from a corner and straight back to it) collapse, polygons without three distinct corners or without area are dropped,
/// duplicates of an earlier polygon (the same edges, in any direction) are dropped, the rest is
/// subdivided if asked for, triangulated, and linked along its edges. Large objects of one
/// material without marks are put in spatial order (`mesh/spatial_order.h`), if not subdivided. Everything else is kept:
/// open, non-manifold, self-crossing and inconsistently wound surfaces.
///
/// Each object that has polygons in the soup gives a mesh of its name, in order; a mesh whose
/// polygons were all dropped is empty.
std::vector<Mesh> build_meshes(PolygonSoup soup, const MeshOptions& options);

}  // namespace burin
