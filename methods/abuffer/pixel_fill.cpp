#include "methods/abuffer/pixel_fill.h"

#include <algorithm>
#include <limits>

#include "shading/surface_shader.h"

namespace burin {
namespace {

/// Shades the surfaces at the samples of a tile; runs of one surface are shaded once.
class Filler {
  public:
    Filler(const Frame& frame, const LineTile& tile) : frame_(frame), tile_(tile) {}

    PixelResult pixel(int x, int y) {
        const SampleTile& samples = tile_.samples();
        const int s = samples.samples_per_pixel;
        const std::size_t first = samples.index(x * s, y * s);
        PixelResult result;
        result.distance = std::numeric_limits<float>::infinity();
        const glm::dvec2 center(x + 0.5, y + 0.5);
        glm::vec4 sum(0.0f);
        std::uint32_t last_id = SampleTile::kBackground;
        glm::vec4 last_color(0.0f);
        for (int row = 0; row < s; ++row) {
            const std::size_t at = first + static_cast<std::size_t>(row) * static_cast<std::size_t>(samples.stride);
            for (int column = 0; column < s; ++column) {
                const std::uint32_t id = samples.ids[at + static_cast<std::size_t>(column)];
                if (id != last_id) {
                    last_id = id;
                    last_color = id == SampleTile::kBackground
                                     ? glm::vec4(0.0f)
                                     : color(tile_.surface_at(at + static_cast<std::size_t>(column)), center);
                }
                sum += last_color;
            }
        }
        result.surface = sum / static_cast<float>(s * s);
        result.beauty = result.surface;
        // The sample next to the pixel's centre stands for the pixel in depth, normal and numbers.
        const std::size_t central = first + static_cast<std::size_t>(s / 2) * static_cast<std::size_t>(samples.stride) +
                                    static_cast<std::size_t>(s / 2);
        const SurfaceId id = tile_.surface_at(central);
        if (id.is_background()) return result;
        const SurfaceSet& surfaces = frame_.surfaces;
        const double nearness = surfaces.plane(id).nearness(center);
        result.distance = static_cast<float>(surfaces.projection.distance(nearness));
        result.normal = glm::vec3(surfaces.view_to_world * surfaces.normal_towards_eye(id, center));
        result.object_id = surfaces.object_id(id);
        result.material_id = surfaces.material_id(id);
        result.polygon_id = surfaces.polygon_id(id);
        return result;
    }

  private:
    glm::vec4 color(SurfaceId id, glm::dvec2 pixel) const {
        const SurfaceSet& surfaces = frame_.surfaces;
        glm::dvec3 origin, ray;
        surfaces.projection.view_ray(pixel, origin, ray);
        return surface_color(frame_.scene->surfaces, frame_.material_of(id), surfaces.normal_towards_eye(id, pixel),
                             -glm::normalize(ray));
    }

    const Frame& frame_;
    const LineTile& tile_;
};

}  // namespace

void fill_pixels(const Frame& frame, const LineTile& tile, Film& film) {
    const PixelRect rect = tile.rect();
    Filler filler(frame, tile);
    for (int y = std::max(rect.y0, frame.crop.y0); y < std::min(rect.y1, frame.crop.y1); ++y) {
        for (int x = std::max(rect.x0, frame.crop.x0); x < std::min(rect.x1, frame.crop.x1); ++x) {
            film.put(x, y, filler.pixel(x, y));
        }
    }
}

}  // namespace burin
