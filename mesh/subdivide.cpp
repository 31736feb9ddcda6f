#include "mesh/subdivide.h"

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <algorithm>
#include <cstdio>
#include <mutex>
#include <span>
#include <type_traits>

#include "base/error.h"
#include "base/interrupt.h"
#include "mesh/residuals.h"

namespace burin {
namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using TriangleMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;
using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;

constexpr std::uint64_t kMaxPolygons = std::uint64_t{1} << 28;

[[noreturn]] void refuse(const std::string& object_name, std::size_t polygon, const char* reason) {
    throw InputError("object '" + object_name + "': polygon " + std::to_string(polygon) + " " + reason +
                     "; a surface must be two-manifold to be subdivided: repair it or set subdivide = 0");
}

bool has_repeated_corner(std::span<const std::uint32_t> corners) {
    std::vector<std::uint32_t> sorted(corners.begin(), corners.end());
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

/// The polygons as an OpenMesh with half-edges.
template <typename OmMesh>
OmMesh to_openmesh(const PolygonMesh& mesh, const std::string& object_name) {
    OmMesh om;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::dvec3 p = mesh.local_position(v);
        om.add_vertex(OpenMesh::Vec3d(p.x, p.y, p.z));
    }
    std::vector<OpenMesh::VertexHandle> handles;
    for (std::size_t i = 0; i < mesh.polygon_count(); ++i) {
        if (has_repeated_corner(mesh.polygon(i))) refuse(object_name, i, "has a corner twice");
        handles.clear();
        for (const std::uint32_t v : mesh.polygon(i)) handles.emplace_back(static_cast<int>(v));
        if (!om.add_face(handles).is_valid()) {
            refuse(object_name, i,
                   "meets two others at an edge or touches them only at a vertex, or is wound "
                   "against its neighbour");
        }
    }
    // OpenMesh lets open fans meet at a vertex, but its rule for border vertices means one fan.
    for (const auto v : om.vertices()) {
        int gaps = 0;
        for (const auto h : om.voh_range(v)) {
            if (!om.is_boundary(h)) continue;
            if (++gaps < 2) continue;
            const auto face = om.face_handle(om.opposite_halfedge_handle(h));
            refuse(object_name, static_cast<std::size_t>(face.idx()), "touches others only at a vertex");
        }
    }
    return om;
}

/// Both subdividers split faces in order and append the new ones, so that the parent of every face
/// is known without asking: face f stays, and its (n - 1 or 3) children follow in sequence.
template <typename OmMesh>
std::vector<std::uint32_t> child_parents(const OmMesh& om) {
    std::vector<std::uint32_t> parents(om.n_faces());
    for (std::uint32_t f = 0; f < parents.size(); ++f) parents[f] = f;
    for (std::uint32_t f = 0; f < om.n_faces(); ++f) {
        const OpenMesh::FaceHandle handle(static_cast<int>(f));
        const unsigned children = std::is_same_v<OmMesh, TriangleMesh> ? 3 : om.valence(handle) - 1;
        parents.insert(parents.end(), children, f);
    }
    return parents;
}

template <typename OmMesh>
void subdivide_once(OmMesh& om) {
    if constexpr (std::is_same_v<OmMesh, TriangleMesh>) {
        OpenMesh::Subdivider::Uniform::LoopT<OmMesh, double> subdivider;
        // OpenMesh's table of weights ends at valence 50 unless told otherwise, and is read beyond.
        std::size_t largest_valence = 0;
        for (const auto v : om.vertices()) {
            largest_valence = std::max<std::size_t>(largest_valence, om.valence(v));
        }
        subdivider.init_weights(largest_valence + 1);
        subdivider.attach(om);
        subdivider(1);
        subdivider.detach();
    } else {
        OpenMesh::Subdivider::Uniform::CatmullClarkT<OmMesh, double> subdivider;
        subdivider.attach(om);
        subdivider(1);
        subdivider.detach();
    }
}

template <typename OmMesh>
PolygonMesh subdivide_as(const PolygonMesh& cage, int levels, const std::string& object_name) {
    auto om = to_openmesh<OmMesh>(cage, object_name);
    std::vector<std::uint32_t> materials = cage.polygon_material;
    std::vector<bool> marked(om.n_edges(), false);
    for (const auto& [a, b] : cage.marked_edges) {
        const auto h =
            om.find_halfedge(OpenMesh::VertexHandle(static_cast<int>(a)), OpenMesh::VertexHandle(static_cast<int>(b)));
        if (h.is_valid()) marked[static_cast<std::size_t>(om.edge_handle(h).idx())] = true;
    }
    for (int level = 0; level < levels; ++level) {
        throw_if_interrupted();
        const std::vector<std::uint32_t> parents = child_parents(om);
        // Edge e keeps one half and number e; its other half is appended in the same order.
        const std::size_t edges = om.n_edges();
        subdivide_once(om);
        marked.resize(om.n_edges(), false);
        for (std::size_t e = 0; e < edges; ++e) marked[edges + e] = marked[e];
        if (!materials.empty()) {
            std::vector<std::uint32_t> child_materials;
            child_materials.reserve(parents.size());
            for (const std::uint32_t p : parents) child_materials.push_back(materials[p]);
            materials = std::move(child_materials);
        }
    }
    PolygonMesh result;
    result.polygon_material = std::move(materials);
    for (const auto v : om.vertices()) {
        const OpenMesh::Vec3d p = om.point(v);
        add_position(result, {p[0], p[1], p[2]}, !cage.residuals.empty());
    }
    std::vector<std::uint32_t> corners;
    for (const auto f : om.faces()) {
        corners.clear();
        for (const auto v : om.fv_range(f)) corners.push_back(static_cast<std::uint32_t>(v.idx()));
        result.add_polygon(corners);
    }
    for (const auto e : om.edges()) {
        if (!marked[static_cast<std::size_t>(e.idx())]) continue;
        const auto h = om.halfedge_handle(e, 0);
        result.marked_edges.push_back({static_cast<std::uint32_t>(om.from_vertex_handle(h).idx()),
                                       static_cast<std::uint32_t>(om.to_vertex_handle(h).idx())});
    }
    return result;
}

}  // namespace

PolygonCounts count_subdivided(PolygonCounts mesh, SubdivisionScheme scheme, int levels,
                               const std::string& object_name) {
    const bool all_triangles = mesh.corners == 3 * mesh.polygons;
    const bool is_loop = scheme == SubdivisionScheme::loop || (scheme == SubdivisionScheme::automatic && all_triangles);
    for (int level = 0; level < levels; ++level) {
        // The first step of Catmull-Clark makes a polygon of each corner, all others make four of each.
        mesh.polygons = level == 0 && !is_loop ? mesh.corners : 4 * mesh.polygons;
        if (mesh.polygons > kMaxPolygons) {
            throw InputError("object '" + object_name + "': " + std::to_string(levels) +
                             " subdivisions give more than 268 million polygons; use fewer");
        }
        mesh.corners = (is_loop ? 3 : 4) * mesh.polygons;
    }
    return mesh;
}

void count_mesh(ModelBudget& budget, PolygonCounts mesh, const std::string& object, const std::string& settings) {
    constexpr std::uint64_t kBytesPerCorner = 60;  // while it is built; measured
    char polygons[32];
    if (mesh.polygons < 1000000)
        std::snprintf(polygons, sizeof polygons, "%d", static_cast<int>(mesh.polygons));
    else
        std::snprintf(polygons, sizeof polygons, "%.1f million", 1e-6 * static_cast<double>(mesh.polygons));
    budget.add(saturating_product(kBytesPerCorner, mesh.corners),
               object + " of " + polygons + " polygons (" + settings + ")");
}

PolygonMesh subdivide(const PolygonMesh& mesh, SubdivisionScheme scheme, int levels, const std::string& object_name) {
    static std::once_flag silenced;  // OpenMesh reports every refused face on standard error
    std::call_once(silenced, [] { omerr().disable(); });

    bool all_triangles = true;
    for (std::size_t i = 0; i < mesh.polygon_count() && all_triangles; ++i) {
        all_triangles = mesh.polygon(i).size() == 3;
    }
    if (scheme == SubdivisionScheme::automatic) {
        scheme = all_triangles ? SubdivisionScheme::loop : SubdivisionScheme::catmull_clark;
    }
    count_subdivided({mesh.polygon_count(), mesh.corners.size()}, scheme, levels,
                     object_name);  // refuses what is too large
    if (scheme == SubdivisionScheme::catmull_clark) {
        return subdivide_as<PolyMesh>(mesh, levels, object_name);
    }
    if (!all_triangles) {
        throw InputError("object '" + object_name + "': Loop subdivision needs triangles, but " +
                         "there are other polygons; use scheme = \"catmull-clark\"");
    }
    return subdivide_as<TriangleMesh>(mesh, levels, object_name);
}

}  // namespace burin
