#include "methods/abuffer/screen_surfaces.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/parallel.h"

namespace burin {
namespace {

constexpr std::size_t kChunk = 1 << 14;

template <typename Work>
void for_chunks(std::size_t count, int threads, const Work& work) {
    parallel_for((count + kChunk - 1) / kChunk, threads, [&](std::size_t chunk, int) {
        work(chunk * kChunk, std::min(count, (chunk + 1) * kChunk));
    });
}

ScreenVertex project(const SurfaceSet& surfaces, std::uint32_t instance, std::uint32_t vertex) {
    const glm::dvec3 view = surfaces.view_position(instance, vertex);
    ScreenVertex result;
    if (!needs_no_clipping(surfaces.projection, view)) {
        result.x = ScreenVertex::kOffScreen;
        return result;
    }
    const glm::dvec2 pixel = surfaces.projection.to_pixel(view);
    result.x = static_cast<std::int32_t>(snap_to_subpixels(pixel.x));
    result.y = static_cast<std::int32_t>(snap_to_subpixels(pixel.y));
    result.nearness = static_cast<float>(surfaces.projection.nearness(view) - surfaces.farthest_nearness);
    return result;
}

/// Whether the transform keeps angles, so that creases are the same in the mesh and in the view.
bool keeps_angles(const glm::dmat4& m) {
    const glm::dvec3 a(m[0]), b(m[1]), c(m[2]);
    const double size = glm::dot(a, a), slack = 1e-9 * size;
    return std::abs(glm::dot(a, b)) < slack && std::abs(glm::dot(b, c)) < slack &&
           std::abs(glm::dot(a, c)) < slack && std::abs(glm::dot(b, b) - size) < slack &&
           std::abs(glm::dot(c, c) - size) < slack;
}

/// Per triangle, whether all its edges have exactly one partner, wound the other way, and none has a
/// class asked for.
std::vector<std::uint8_t> smooth_triangles(const Mesh& mesh, const LineCriteria& criteria, int threads) {
    std::vector<std::uint8_t> smooth(mesh.triangles.size());
    const bool by_polygon = criteria.classes.has(LineClass::polygon);
    const bool by_material = criteria.classes.has(LineClass::material);
    const bool by_crease = criteria.classes.has(LineClass::crease);
    const double cos_crease = criteria.cos_crease_angle + 1e-6;
    for_chunks(mesh.triangles.size(), threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto t = static_cast<std::uint32_t>(i);
            bool is_smooth = true;
            glm::dvec3 normal = mesh.polygon_area_vector(t);
            normal /= std::max(glm::length(normal), 1e-300);
            for (HalfEdge h = 3 * t; h < 3 * t + 3 && is_smooth; ++h) {
                const HalfEdge g = mesh.next_on_edge[h];
                const std::uint32_t u = g / 3;
                is_smooth = g != h && mesh.next_on_edge[g] == h && !mesh.is_marked(h) &&
                            mesh.triangles[t][h % 3] != mesh.triangles[u][g % 3];
                if (!is_smooth || mesh.polygon_of(t) == mesh.polygon_of(u)) continue;
                if (by_polygon || (by_material && mesh.material_of(t) != mesh.material_of(u))) is_smooth = false;
                if (!by_crease || !is_smooth) continue;
                const glm::dvec3 other = mesh.polygon_area_vector(u);
                is_smooth = glm::dot(normal, other) > cos_crease * glm::length(other);
            }
            smooth[i] = is_smooth;
        }
    });
    return smooth;
}

}  // namespace

ScreenSurfaces::ScreenSurfaces(const SurfaceSet& surfaces, const LineCriteria& criteria, int threads)
    : surfaces_(surfaces) {
    std::size_t vertex_count = 0;
    std::uint64_t triangle_count = 0;
    for (const SurfaceInstance& instance : surfaces.instances) {
        first_vertex_.push_back(vertex_count);
        first_triangle_.push_back(static_cast<std::uint32_t>(triangle_count));
        vertex_count += instance.mesh->positions.size();
        triangle_count += instance.mesh->triangles.size();
        if (triangle_count >= (std::uint64_t{1} << 31) - 1) {
            throw InputError("the scene has more than 2 billion triangles; split it");
        }
    }
    first_triangle_.push_back(static_cast<std::uint32_t>(triangle_count));
    vertices_.resize(vertex_count);
    facing_.resize(triangle_count);
    std::map<const Mesh*, std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < surfaces.instances.size(); ++i) {
        const SurfaceInstance& instance = surfaces.instances[i];
        for_chunks(instance.mesh->positions.size(), threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t v = begin; v < end; ++v) {
                vertices_[first_vertex_[i] + v] = project(surfaces, i, static_cast<std::uint32_t>(v));
            }
        });
        const Mesh* const key = keeps_angles(instance.to_view) ? instance.mesh : nullptr;
        const auto [it, is_new] = numbers.try_emplace(key, static_cast<std::uint32_t>(smooth_.size()));
        if (is_new) {
            smooth_.emplace_back();
            if (key != nullptr) smooth_.back() = smooth_triangles(*key, criteria, threads);
        }
        smooth_of_.push_back(it->second);
    }
}

SurfaceId ScreenSurfaces::surface_of(std::uint32_t number) const {
    const auto it = std::upper_bound(first_triangle_.begin(), first_triangle_.end(), number) - 1;
    return {static_cast<std::uint32_t>(it - first_triangle_.begin()), number - *it};
}

bool ScreenSurfaces::is_plain(std::uint32_t number) const {
    const Facing own = facing(number);
    if (own == edge_on || own == off_screen) return false;
    const SurfaceId s = surface_of(number);
    const std::vector<std::uint8_t>& smooth = smooth_[smooth_of_[s.instance]];
    if (smooth.empty() || smooth[s.triangle] == 0) return false;
    const std::uint32_t first = number - s.triangle;
    const HalfEdge* const partner = &surfaces_.mesh_of(s).next_on_edge[3 * s.triangle];
    return facing(first + partner[0] / 3) == own && facing(first + partner[1] / 3) == own &&
           facing(first + partner[2] / 3) == own;
}

}  // namespace burin
