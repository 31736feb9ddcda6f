#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/model_budget.h"
#include "mesh/mesh.h"
#include "mesh/polygon_soup.h"
#include "mesh/subdivide.h"

// Polygons as they stand in a file become meshes, in one order of steps.

namespace burin {

struct MovingVertices;

struct MeshOptions {
    int subdivision_levels = 0;
    SubdivisionScheme scheme = SubdivisionScheme::automatic;
    ModelBudget* budget = nullptr;  ///< counts what a model takes beyond its file; nullptr: as by default
    int threads = 1;                ///< for reading a file; 0 = all cores. Changes no result.
    bool strict = false;            ///< for reading a file: refuses what a reader would leave out with a note
    AttributeWish attributes{};     ///< what to keep of the values at vertices
};

/// Turns the polygons of a file into one Mesh per object that has polygons left.
///
/// In this order: coordinates are rounded to single precision (relative to a common origin where
/// the model lies far from 0, and with residuals where that would blur it:
/// `mesh/round_positions.h`), vertices with equal coordinates of one object are welded, repeated
/// corners in a row and spikes (from a corner and straight back to it) collapse, polygons without
/// three distinct corners or without area are dropped, polygons that pass an edge twice in one
/// direction are cut (`mesh/repeated_edges.h`), duplicates of an earlier polygon (the same edges, in
/// any direction) are dropped, the rest is subdivided if asked for, triangulated, and linked along
/// its edges. Large objects of one material without marks are put in spatial order
/// (`mesh/spatial_order.h`), if not subdivided. Everything else is kept: open, non-manifold,
/// self-crossing and inconsistently wound surfaces.
///
/// A marked edge that no polygon of any object has becomes a loose edge of its own object;
/// subdivision leaves it as it is.
///
/// Attributes of corners go with them; a mesh that is subdivided has none.
///
/// Each object that has polygons or loose edges in the soup gives a mesh of its name, in order; a
/// mesh whose polygons were all dropped may be empty.
///
/// `moving`: of a soup whose vertices will move (`mesh/deforming_mesh.h`); nullptr: they stay.
std::vector<Mesh> build_meshes(PolygonSoup soup, const MeshOptions& options, MovingVertices* moving = nullptr);

/// The unit normal of a polygon of any shape, from its area vector; 0 if all corners lie on one line.
glm::vec3 polygon_normal(std::span<const glm::dvec3> corners);

}  // namespace burin
