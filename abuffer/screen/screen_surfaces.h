#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "abuffer/screen/known_seams.h"
#include "kernels/tile_kernels.h"
#include "lines/sharp_edges.h"
#include "lines/surface_walk.h"
#include "view/surface_set.h"

// Vertices are projected and snapped once per frame; facings and possible line edges of triangles are kept beside them.

namespace burin {

/// Threads share triangles in chunks of at most this many.
constexpr std::uint32_t kChunkTriangles = 1 << 14;
/// Triangles [begin, end) of the mesh of an instance.
struct TriangleChunk {
    std::uint32_t instance, begin, end;
};

/// The vertices of a frame on the screen, projected and snapped once, and numbers for its triangles.
/// To save memory, vertices can be there for some instances at a time: for those that are shown.
class ScreenSurfaces {
  public:
    /// Shows all instances, or none yet.
    ScreenSurfaces(const SurfaceSet& surfaces, const LineCriteria& criteria, const TileKernels& kernels, int threads,
                   bool shows_all = true);

    /// Shows these instances, in ascending order, and no others.
    void show(std::span<const std::uint32_t> instances, int threads);
    bool is_shown(std::uint32_t instance) const { return is_shown_[instance] != 0; }
    /// Whether all are shown, always.
    bool shows_all() const { return shows_all_; }

    /// All triangles of the instances that are shown, in ascending order, cut into chunks.
    std::vector<TriangleChunk> chunks_of_triangles(std::uint32_t largest) const;

    std::uint32_t triangle_count() const { return first_triangle_.back(); }
    /// Triangles of the whole frame are numbered through, instance by instance.
    std::uint32_t number_of(SurfaceId s) const { return first_triangle_[s.instance] + s.triangle; }
    SurfaceId surface_of(std::uint32_t number) const {
        const std::uint32_t* const block = &instance_at_[number >> kNumberBlockShift];
        std::uint32_t instance = block[0];
        if (instance != block[1]) {
            const auto first = first_triangle_.begin() + instance + 1, last = first_triangle_.begin() + block[1] + 1;
            instance = static_cast<std::uint32_t>(std::upper_bound(first, last, number) - first_triangle_.begin()) - 1;
        }
        return {instance, number - first_triangle_[instance]};
    }

    const ScreenVertex* vertices(std::uint32_t instance) const { return vertices_.get() + first_vertex_[instance]; }
    ScreenTriangle triangle(SurfaceId s) const {
        const auto& t = surfaces_.mesh_of(s).triangles[s.triangle];
        const ScreenVertex* const v = vertices(s.instance);
        return {{v[t[0]], v[t[1]], v[t[2]]}};
    }
    /// The nearness of a triangle's plane, extended to a place in 1/256 pixel, less farthest_nearness. The triangle
    /// must not be edge-on.
    double nearness_of(std::uint32_t number, glm::dvec2 subpixel) const;
    /// An instance that is shown, as the kernels see it.
    const ScreenMesh& mesh(std::uint32_t instance) const { return meshes_[instance]; }
    std::uint32_t triangle_count(std::uint32_t instance) const {
        return first_triangle_[instance + 1] - first_triangle_[instance];
    }
    const ScreenTransform& transform(std::uint32_t instance) const { return transforms_[instance]; }

    Facing facing(std::uint32_t number) const { return static_cast<Facing>(facing_[number]); }
    void set_facing(std::uint32_t number, Facing f) { facing_[number] = f; }
    /// The facings of the triangles of an instance.
    std::uint8_t* facings(std::uint32_t instance) { return facing_.get() + first_triangle_[instance]; }
    /// Finds which edges may be lines, once the facing of all triangles of the instance is known.
    void find_line_edges(const TriangleChunk& chunk);
    /// Whether no edge of a triangle can be a line.
    bool is_plain(std::uint32_t number) const { return line_edges_[number] == 0; }

    const SurfaceSet& surfaces() const { return surfaces_; }
    /// What runs along borders of the meshes, remembered for all threads.
    KnownSeams& known_seams() const { return *known_seams_; }

    /// find_sharp_edges() of the instance's mesh; nullptr where its transform changes angles.
    const std::uint8_t* sharp_edges(std::uint32_t instance) const { return sharp_[instance]; }

  private:
    static constexpr int kNumberBlockShift = 8;

    const std::uint8_t* sharp_edges_of(const SurfaceInstance& instance);
    ScreenMesh make_mesh(std::uint32_t instance) const;

    const SurfaceSet& surfaces_;
    const LineCriteria& criteria_;
    const TileKernels& kernels_;
    bool shows_all_;
    std::vector<std::uint8_t> is_shown_;
    std::vector<std::size_t> first_vertex_;      // in vertices_, of instances that are shown
    std::size_t room_ = 0;                       // in vertices_
    std::vector<std::uint32_t> first_triangle_;  // one more than instances
    std::vector<std::uint32_t> instance_at_;     // of the first number of each block of numbers, and of the last one
    std::vector<ScreenTransform> transforms_;    // per instance
    std::unique_ptr<ScreenVertex[]> vertices_;
    std::unique_ptr<std::uint8_t[]> facing_, line_edges_;
    std::vector<const std::uint8_t*> sharp_;  // per instance
    std::vector<ScreenMesh> meshes_;          // per instance
    std::map<const Mesh*, std::vector<std::uint8_t>> made_here_;
    std::unique_ptr<KnownSeams> known_seams_ = std::make_unique<KnownSeams>();
};

}  // namespace burin
