#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "shading/surface/light.h"
#include "view/surface_set.h"

namespace burin {

/// ShadowCasters says whether the way from a place to a light is free.
///
/// Triangles are sorted to the cells of a grid as the light sees them; cells of many triangles have a grid of their
/// own. Of a cell's triangles, each one that is nearer to the light is intersected with the ray itself. So there is no
/// resolution: no texels and no bias, and what is found depends on the place alone. It takes at most 300 bytes for
/// a triangle. The same for all threads.
class ShadowCasters {
  public:
    /// `is_caster`, per material of the scene: whether surfaces of it cast shadows.
    ShadowCasters(const SurfaceSet& surfaces, const ViewLight& light, const std::vector<bool>& is_caster);

    /// A triangle that hides the light: a corner, the ways from it to the two others, and how near to the light it
    /// comes.
    struct Caster {
        SurfaceId id;
        glm::dvec3 corner, edges[2];
        double nearness;  // no place of it is nearer to the light
    };
    /// The same of casters that another one had: of its light, and `least_distance` of it.
    ShadowCasters(std::vector<Caster> casters, const ViewLight& light, double least_distance);

    const ViewLight& light() const { return light_; }
    double least_distance() const { return least_distance_; }
    std::span<const Caster> casters() const { return casters_; }

    /// Whether the light is free at a place on, or just in front of, a triangle's surface; the triangle itself never
    /// hides it.
    bool is_lit(const glm::dvec3& place, SurfaceId own) const;

  private:
    /// A square part of a view from the light, divided into side x side cells. Cells follow each other row by row.
    struct Grid {
        glm::dvec2 corner{0.0};
        double cells_per_unit = 1;
        std::uint32_t side = 1, first_cell = 0;
    };
    struct Cell {
        std::uint32_t first = 0;  // in order_; of a grid of its own: its number
        std::uint32_t count = 0;
        static constexpr std::uint32_t kIsGrid = 0xFFFFFFFFu;
    };
    /// Views from the light: one of a light far away, six of a light at a point.
    struct View {
        glm::dvec3 right, up, forward;
        std::int64_t grid = -1;  // none: nothing is seen
    };
    /// A triangle in a view, clipped: at most four corners more.
    struct Outline {
        glm::dvec2 corners[8];
        int count = 0;
    };

    void sort();
    glm::dvec2 in_view(const View& view, const glm::dvec3& place) const;
    std::size_t view_of(const glm::dvec3& place) const;
    Outline outline_in(const View& view, const Caster& caster) const;
    double nearness_of(const glm::dvec3& place) const;
    void add_grid(std::uint32_t number, const View& view, glm::dvec2 corner, double size,
                  std::span<const std::uint32_t> casters, int depth);
    bool hides(const Caster& caster, const glm::dvec3& place, const glm::dvec3& way) const;

    ViewLight light_;
    std::size_t left_entries_ = 0;  // of casters in cells, while grids are made
    double least_distance_ = 0;     // what is as near as this to a place is at it
    std::vector<Caster> casters_;
    std::vector<View> views_;
    std::vector<Grid> grids_;
    std::vector<Cell> cells_;
    std::vector<std::uint32_t> order_;  // casters, cell by cell, those that are nearest to the light first
};

}  // namespace burin
