#include "abuffer/screen/screen_surfaces.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <numeric>

#include "base/error.h"
#include "base/parallel.h"
#include "view/screen_polygon.h"

namespace burin {
namespace {

constexpr std::size_t kChunk = 1 << 14;

template <typename Work>
void for_chunks(std::size_t count, int threads, const Work& work) {
    parallel_for_parts((count + kChunk - 1) / kChunk, threads,
                       [&](std::size_t chunk, int) { work(chunk * kChunk, std::min(count, (chunk + 1) * kChunk)); });
}

ScreenTransform transform_of(const SurfaceSet& surfaces, const SurfaceInstance& instance) {
    ScreenTransform t{};
    for (int column = 0; column < 4; ++column) {
        for (int c = 0; c < 3; ++c) t.to_view[column][c] = instance.to_view[column][c];
    }
    for (int column = 0; column < 3; ++column) {
        for (int c = 0; c < 3; ++c) t.view_to_world[column][c] = surfaces.view_to_world[column][c];
    }
    const Projection& p = surfaces.projection;
    t.orthographic = p.orthographic;
    t.focal_px = p.focal_px;
    t.x_scale = p.x_scale;
    t.center_x = p.center_px.x;
    t.center_y = p.center_px.y;
    t.near_distance = p.near_distance;
    t.guard_band_px = kGuardBandPx;
    t.farthest_nearness = surfaces.farthest_nearness;
    return t;
}

/// What TileKernels::Project::vertices() does, for a mesh with residuals.
ScreenVertex projected(const SurfaceSet& surfaces, std::uint32_t instance, std::uint32_t vertex) {
    const Projection& p = surfaces.projection;
    const glm::dvec3 view = surfaces.view_position(instance, vertex);
    if (!needs_no_clipping(p, view)) return {ScreenVertex::kOffScreen, 0, 0};
    const glm::dvec2 pixel = p.to_pixel(view);
    return {static_cast<std::int32_t>(snap_to_subpixels(pixel.x)),
            static_cast<std::int32_t>(snap_to_subpixels(pixel.y)),
            static_cast<float>(p.nearness(view) - surfaces.farthest_nearness)};
}

/// The instance that has the triangle with a number of the frame.
std::uint32_t instance_with(const std::vector<std::uint32_t>& first_triangle, std::uint64_t number) {
    return static_cast<std::uint32_t>(std::upper_bound(first_triangle.begin(), first_triangle.end(), number) -
                                      first_triangle.begin()) -
           1;
}

}  // namespace

ScreenSurfaces::ScreenSurfaces(const SurfaceSet& surfaces, const LineCriteria& criteria, const TileKernels& kernels,
                               int threads, bool shows_all)
    : surfaces_(surfaces),
      criteria_(criteria),
      kernels_(kernels),
      shows_all_(shows_all),
      is_shown_(surfaces.instances.size(), 0),
      first_vertex_(surfaces.instances.size(), 0) {
    std::uint64_t triangle_count = 0;
    for (const SurfaceInstance& instance : surfaces.instances) {
        first_triangle_.push_back(static_cast<std::uint32_t>(triangle_count));
        triangle_count += instance.mesh->triangles.size();
        if (triangle_count >= (std::uint64_t{1} << 31) - 1) {
            throw InputError("the scene has more than 2 billion triangles; split it");
        }
    }
    first_triangle_.push_back(static_cast<std::uint32_t>(triangle_count));
    for (std::uint64_t number = 0; number < triangle_count; number += std::uint64_t{1} << kNumberBlockShift) {
        instance_at_.push_back(instance_with(first_triangle_, number));
    }
    instance_at_.push_back(triangle_count == 0 ? 0 : instance_with(first_triangle_, triangle_count - 1));
    facing_ = std::make_unique_for_overwrite<std::uint8_t[]>(triangle_count + ScreenMesh::kPadding);
    line_edges_ = std::make_unique_for_overwrite<std::uint8_t[]>(triangle_count + ScreenMesh::kPadding);
    for (const SurfaceInstance& instance : surfaces.instances) {
        transforms_.push_back(transform_of(surfaces, instance));
        sharp_.push_back(keeps_angles(instance.to_view) ? sharp_edges_of(instance) : nullptr);
    }
    if (!shows_all) return;
    std::vector<std::uint32_t> all(surfaces.instances.size());
    std::iota(all.begin(), all.end(), 0u);
    show(all, threads);
}

void ScreenSurfaces::show(std::span<const std::uint32_t> instances, int threads) {
    std::fill(is_shown_.begin(), is_shown_.end(), std::uint8_t{0});
    std::fill(first_vertex_.begin(), first_vertex_.end(), std::size_t{0});
    std::size_t count = 0;
    for (const std::uint32_t i : instances) {
        is_shown_[i] = 1;
        first_vertex_[i] = count;
        count += surfaces_.instances[i].mesh->positions.size();
    }
    if (count > room_ || vertices_ == nullptr) {
        vertices_.reset();  // before there are new ones
        vertices_ = std::make_unique_for_overwrite<ScreenVertex[]>(count);
        room_ = count;
    }
    meshes_.resize(is_shown_.size());
    for (const std::uint32_t i : instances) meshes_[i] = make_mesh(i);
    for (const std::uint32_t i : instances) {
        const Mesh& mesh = *surfaces_.instances[i].mesh;
        const std::vector<glm::vec3>& positions = mesh.positions;
        for_chunks(positions.size(), threads, [&](std::size_t begin, std::size_t end) {
            ScreenVertex* const own = vertices_.get() + first_vertex_[i];
            if (mesh.has_residuals()) {
                for (std::size_t v = begin; v < end; ++v)
                    own[v] = projected(surfaces_, i, static_cast<std::uint32_t>(v));
                return;
            }
            kernels_.project.vertices(transforms_[i], glm::value_ptr(positions[begin]), end - begin, own + begin);
        });
    }
}

std::vector<TriangleChunk> ScreenSurfaces::chunks_of_triangles(std::uint32_t largest) const {
    std::vector<TriangleChunk> chunks;
    for (std::uint32_t i = 0; i < surfaces_.instances.size(); ++i) {
        if (!is_shown(i)) continue;
        const auto count = static_cast<std::uint32_t>(surfaces_.instances[i].mesh->triangles.size());
        for (std::uint32_t t = 0; t < count; t += largest) chunks.push_back({i, t, std::min(count, t + largest)});
    }
    return chunks;
}

const std::uint8_t* ScreenSurfaces::sharp_edges_of(const SurfaceInstance& instance) {
    if (instance.sharp_edges != nullptr) return instance.sharp_edges;
    std::vector<std::uint8_t>& table = made_here_[instance.mesh];
    if (table.empty()) table = find_sharp_edges(*instance.mesh, criteria_);
    return table.data();
}

ScreenMesh ScreenSurfaces::make_mesh(std::uint32_t instance) const {
    const Mesh& mesh = *surfaces_.instances[instance].mesh;
    ScreenMesh result;
    result.vertices = vertices(instance);
    result.corners = mesh.triangles.empty() ? nullptr : mesh.triangles.front().data();
    result.first_number = first_triangle_[instance];
    result.triangle_count = triangle_count(instance);
    result.sharp = sharp_[instance];
    result.partners = mesh.next_on_edge.data();
    result.facing = facing_.get() + first_triangle_[instance];
    result.line_edges = line_edges_.get() + first_triangle_[instance];
    return result;
}

double ScreenSurfaces::nearness_of(std::uint32_t number, glm::dvec2 subpixel) const {
    const SurfaceId s = surface_of(number);
    if (facing(number) != off_screen) return extended_nearness(triangle(s), subpixel.x, subpixel.y);
    return surfaces_.plane(s).extended_to(to_pixels(subpixel)) - surfaces_.farthest_nearness;
}

void ScreenSurfaces::find_line_edges(const TriangleChunk& chunk) {
    constexpr std::uint8_t kAll = 7;
    std::uint8_t* const line_edges = line_edges_.get() + first_triangle_[chunk.instance];
    if (sharp_[chunk.instance] == nullptr) {
        std::fill(line_edges + chunk.begin, line_edges + chunk.end, kAll);
    } else {
        kernels_.cull.find_line_edges(mesh(chunk.instance), chunk.begin, chunk.end, line_edges);
    }
}

}  // namespace burin
