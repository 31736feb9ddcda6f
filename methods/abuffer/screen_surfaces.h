#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "abuffer/tile_kernels.h"
#include "lines/sharp_edges.h"
#include "lines/surface_set.h"
#include "lines/surface_walk.h"

namespace burin {

/// The vertices of a frame on the screen, projected and snapped once, and numbers for its triangles.
class ScreenSurfaces {
  public:
    ScreenSurfaces(const SurfaceSet& surfaces, const LineCriteria& criteria, const TileKernels& kernels,
                   int threads);

    std::uint32_t triangle_count() const { return first_triangle_.back(); }
    /// Triangles of the whole frame are numbered through, instance by instance.
    std::uint32_t number_of(SurfaceId s) const { return first_triangle_[s.instance] + s.triangle; }
    SurfaceId surface_of(std::uint32_t number) const;

    const ScreenVertex* vertices(std::uint32_t instance) const {
        return vertices_.get() + first_vertex_[instance];
    }
    ScreenTriangle triangle(SurfaceId s) const {
        const auto& t = surfaces_.mesh_of(s).triangles[s.triangle];
        const ScreenVertex* const v = vertices(s.instance);
        return {{v[t[0]], v[t[1]], v[t[2]]}};
    }
    /// An instance as the kernels see it.
    ScreenMesh mesh(std::uint32_t instance) const;
    const ScreenTransform& transform(std::uint32_t instance) const { return transforms_[instance]; }

    Facing facing(std::uint32_t number) const { return static_cast<Facing>(facing_[number]); }
    void set_facing(std::uint32_t number, Facing f) { facing_[number] = f; }
    /// Those of an instance.
    std::uint8_t* facings(std::uint32_t instance) { return facing_.get() + first_triangle_[instance]; }
    /// Once the facing of all triangles is known: whether no edge of a triangle can be a line.
    bool is_plain(std::uint32_t number) const;

    const SurfaceSet& surfaces() const { return surfaces_; }

    /// find_sharp_edges() of the instance's mesh; nullptr where its transform changes angles.
    const std::uint8_t* sharp_edges(std::uint32_t instance) const { return sharp_[instance]; }

  private:
    const std::uint8_t* sharp_edges_of(const SurfaceInstance& instance);

    const SurfaceSet& surfaces_;
    const LineCriteria& criteria_;
    std::vector<std::size_t> first_vertex_;
    std::vector<std::uint32_t> first_triangle_;  // one more than instances
    std::vector<ScreenTransform> transforms_;  // per instance
    std::unique_ptr<ScreenVertex[]> vertices_;
    std::unique_ptr<std::uint8_t[]> facing_;
    std::vector<const std::uint8_t*> sharp_;  // per instance
    std::map<const Mesh*, std::vector<std::uint8_t>> made_here_;
};

}  // namespace burin
