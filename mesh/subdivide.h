#pragma once

#include <cstdint>
#include <string>

#include "base/model_budget.h"
#include "mesh/polygon_mesh.h"

// Subdivision turns a control mesh into the finer mesh of its smooth surface, by Catmull and Clark or by Loop.

namespace burin {

enum class SubdivisionScheme : std::uint8_t {
    automatic,      ///< Loop if all polygons are triangles, else Catmull–Clark
    loop,           ///< Loop 1987: triangles become four
    catmull_clark,  ///< Catmull and Clark 1978: an n-gon becomes n quadrilaterals
};

/// How large a mesh is.
struct PolygonCounts {
    std::uint64_t polygons = 0;
    std::uint64_t corners = 0;  ///< of all polygons
};

/// What subdivide() makes of a mesh, without doing it. Throws InputError if that is more than 2^28 polygons.
PolygonCounts count_subdivided(PolygonCounts mesh, SubdivisionScheme scheme, int levels,
                               const std::string& object_name);

/// Counts what a mesh of this size takes. `object` and `settings` are for the message: "object 'ball'" and "subdivide
/// 8".
void count_mesh(ModelBudget& budget, PolygonCounts mesh, const std::string& object, const std::string& settings);

/// Subdivides the control mesh `levels` times. Materials and edge marks go to the children. The
/// result's polygons are the small ones.
///
/// Throws InputError if the surface is not two-manifold or not wound consistently (subdivision has
/// no meaning there), if Loop is asked for polygons that are not triangles, or if more than
/// 2^28 polygons would result. `object_name` is for messages.
PolygonMesh subdivide(const PolygonMesh& mesh, SubdivisionScheme scheme, int levels, const std::string& object_name);

}  // namespace burin
