#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "abuffer/masks/fragment_lists.h"
#include "abuffer/masks/pixel_lines.h"
#include "abuffer/masks/visibility.h"
#include "render/film.h"
#include "render/frame.h"
#include "shading/surface_shader.h"

// A tile is drawn by Patel's method, from triangles to pixels.

namespace burin {

/// Patel's method for a rectangle of pixels. Mayur Patel, "Hidden Line Rendering with a Modified
/// A-Buffer", 2000, with the details of docs/methods/patel.md.
///
/// Per pixel:
///  1. Every surface that touches the pixel or its apron leaves a fragment with an extended mask.
///  2. Depth planes decide which fragment is in front at each sample; the visible masks of the
///     fragments are disjoint.
///  3. Fragments that continue each other are one surface. Where the masks of two surfaces meet, and
///     their border deserves a line, edge_between() of the two masks is the stroke.
///  4. The pixel's own samples, those inside of the apron, are counted: the drawn ones have the line's
///     colour, the others their surface's.
template <typename Mask>
class PatelTile {
  public:
    PatelTile(const Frame& frame, const ExtendedGrid& grid)
        : frame_(frame),
          grid_(grid),
          finder_(frame.surfaces, frame.criteria, grid, {frame.scene->patel.halo, frame.scene->lines.style.side}) {}

    /// Step 1, for the pixels of `rect` and the surfaces that may touch them.
    void load(PixelRect rect, std::span<const SurfaceId> surfaces) {
        surfaces_.clear();
        lists_.reset(grid_, rect.x0, rect.y0, rect.x1, rect.y1);
        for (const SurfaceId id : surfaces) {
            glm::dvec3 corners[3];
            frame_.surfaces.view_corners(id, corners);
            const Projection& projection = frame_.surfaces.projection;
            const ScreenPolygon polygon = project_triangle(projection, corners);
            const DepthPlane plane = snapped_depth_plane(projection, corners);
            lists_.add(ScanConverter(polygon, grid_.samples_per_pixel()), static_cast<std::uint32_t>(surfaces_.size()));
            surfaces_.push_back({id, plane});
        }
        lists_.finish();
    }

    std::span<const Fragment<Mask>> fragments(int x, int y) const { return lists_.at(x, y); }
    std::size_t fragment_count() const { return lists_.size(); }
    SurfaceId surface_of(const Fragment<Mask>& f) const { return surfaces_[f.surface].id; }
    const DepthPlane& plane_of(const Fragment<Mask>& f) const { return surfaces_[f.surface].plane; }

    /// Step 2.
    const VisibleSamples<Mask>& resolve(int x, int y) {
        resolve_visibility(
            fragments(x, y), grid_, x, y, [this](const Fragment<Mask>& f) -> const DepthPlane& { return plane_of(f); },
            [this](const Fragment<Mask>& a, const Fragment<Mask>& b) -> const SurfaceOrder& {
                return order(surface_of(a), surface_of(b));
            },
            visible_, &frame_.surfaces.projection);
        return visible_;
    }

    /// Step 3, after resolve() for the same pixel.
    const PixelLines<Mask>& find_lines(int x, int y) {
        finder_.find(
            fragments(x, y), visible_, x, y, [this](const Fragment<Mask>& f) { return surface_of(f); }, lines_);
        return lines_;
    }

    /// Step 4, after find_lines() for the same pixel.
    PixelResult shade(int x, int y) const;

  private:
    struct TileSurface {
        SurfaceId id;
        DepthPlane plane;
    };
    struct KnownOrder {
        SurfaceId first, second;
        SurfaceOrder order;
    };

    /// Mostly asked of the same two for one sample after the other.
    const SurfaceOrder& order(SurfaceId a, SurfaceId b) {
        constexpr std::size_t kMost = 1024;
        if (known_orders_.empty()) known_orders_.resize(kMost);
        const std::size_t mixed =
            (std::size_t{a.triangle} * 31 + b.triangle) * 31 + std::size_t{a.instance} * 7 + b.instance;
        KnownOrder& known = known_orders_[mixed % kMost];
        if (known.first != a || known.second != b) known = {a, b, frame_.surfaces.order(a, b)};
        return known.order;
    }

    const Frame& frame_;
    ExtendedGrid grid_;
    PixelLineFinder<Mask> finder_;
    std::vector<TileSurface> surfaces_;
    FragmentLists<Mask> lists_;
    VisibleSamples<Mask> visible_;
    std::vector<KnownOrder> known_orders_;  // by a hash
    PixelLines<Mask> lines_;
};

template <typename Mask>
PixelResult PatelTile<Mask>::shade(int x, int y) const {
    const Mask inner = inner_samples<Mask>(grid_.apron);
    const float per_sample = 1.0f / static_cast<float>(MaskGrid<Mask>::count(inner));
    const auto fraction_of = [&](const Mask& mask) {
        return static_cast<float>(MaskGrid<Mask>::count(static_cast<Mask>(mask & inner))) * per_sample;
    };
    PixelResult result;
    Mask drawn{};
    for (std::size_t c = 0; c < kLineClassCount; ++c) {
        const float coverage = fraction_of(lines_.masks[c]);
        result.coverage[c] = coverage;
        const glm::vec3 color = frame_.scene->lines.style.color_of(static_cast<LineClass>(c));
        result.lines += glm::vec4(color, 1.0f) * coverage;
        drawn = static_cast<Mask>(drawn | lines_.masks[c]);
    }

    // The sample next to the pixel's centre stands for the pixel in depth, normal and numbers.
    const int middle = mask_side<Mask> / 2;
    const std::uint32_t central = visible_.owner[static_cast<std::size_t>(mask_side<Mask> * middle + middle)];
    const glm::dvec2 center(x + 0.5, y + 0.5);
    result.distance = std::numeric_limits<float>::infinity();
    result.beauty = result.lines;

    const SurfaceSet& surfaces = frame_.surfaces;
    glm::dvec3 origin, ray;
    surfaces.projection.view_ray(center, origin, ray);
    const glm::dvec3 to_eye = -glm::normalize(ray);
    const auto list = fragments(x, y);
    for (std::uint32_t i = 0; i < list.size(); ++i) {
        const Mask visible = visible_.masks[i];
        const float covered = fraction_of(visible);
        if (covered == 0 && i != central) continue;
        const SurfaceId id = surface_of(list[i]);
        const glm::dvec3 normal = surfaces.view_normal(id);
        const glm::vec4 color = surface_color(frame_.scene->surfaces, frame_.material_of(id), normal, to_eye);
        result.surface += color * covered;
        result.beauty += color * fraction_of(static_cast<Mask>(visible & ~drawn));
        if (i != central) continue;
        const double nearness = plane_of(list[i]).nearness(center);
        result.distance = static_cast<float>(surfaces.projection.distance(nearness));
        const glm::dvec3 facing = glm::dot(normal, to_eye) < 0 ? -normal : normal;
        result.normal = glm::vec3(surfaces.view_to_world * facing);
        result.object_id = surfaces.object_id(id);
        result.material_id = surfaces.material_id(id);
        result.polygon_id = surfaces.polygon_id(id);
    }
    return result;
}

}  // namespace burin
