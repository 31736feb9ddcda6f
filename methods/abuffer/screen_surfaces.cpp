#include "methods/abuffer/screen_surfaces.h"

#include <algorithm>

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

}  // namespace

ScreenSurfaces::ScreenSurfaces(const SurfaceSet& surfaces, const LineCriteria& criteria, int threads)
    : surfaces_(surfaces), criteria_(criteria) {
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
    for (std::uint32_t i = 0; i < surfaces.instances.size(); ++i) {
        const SurfaceInstance& instance = surfaces.instances[i];
        for_chunks(instance.mesh->positions.size(), threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t v = begin; v < end; ++v) {
                vertices_[first_vertex_[i] + v] = project(surfaces, i, static_cast<std::uint32_t>(v));
            }
        });
        sharp_.push_back(keeps_angles(instance.to_view) ? sharp_edges_of(instance) : nullptr);
    }
}

const std::uint8_t* ScreenSurfaces::sharp_edges_of(const SurfaceInstance& instance) {
    if (instance.sharp_edges != nullptr) return instance.sharp_edges;
    std::vector<std::uint8_t>& table = made_here_[instance.mesh];
    if (table.empty()) table = find_sharp_edges(*instance.mesh, criteria_);
    return table.data();
}

SurfaceId ScreenSurfaces::surface_of(std::uint32_t number) const {
    const auto it = std::upper_bound(first_triangle_.begin(), first_triangle_.end(), number) - 1;
    return {static_cast<std::uint32_t>(it - first_triangle_.begin()), number - *it};
}

bool ScreenSurfaces::is_plain(std::uint32_t number) const {
    const Facing own = facing(number);
    if (own == edge_on || own == off_screen) return false;
    const SurfaceId s = surface_of(number);
    const std::uint8_t* const sharp = sharp_[s.instance];
    if (sharp == nullptr || sharp[s.triangle] != 0) return false;
    const std::uint32_t first = number - s.triangle;
    const HalfEdge* const partner = &surfaces_.mesh_of(s).next_on_edge[3 * s.triangle];
    return facing(first + partner[0] / 3) == own && facing(first + partner[1] / 3) == own &&
           facing(first + partner[2] / 3) == own;
}

}  // namespace burin
