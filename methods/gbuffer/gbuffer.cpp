#include "methods/gbuffer/gbuffer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "methods/background_pixel.h"
#include "methods/gbuffer/contours.h"
#include "methods/gbuffer/line_images.h"
#include "methods/surface_bins.h"
#include "methods/thread_times.h"

namespace burin {
namespace {

constexpr int kGbufferTilePx = 32;

/// One tile: draw the G-buffer, find lines, filter down to pixels.
class GBufferTile {
  public:
    GBufferTile(const DetectionContext& context, PixelRect pixels, std::span<const SurfaceId> surfaces,
                ThreadTimes& times)
        : context_(context), scene_(*context.frame.scene), settings_(scene_.gbuffer), s_(context.samples_per_pixel) {
        const PixelRect samples{pixels.x0 * s_, pixels.y0 * s_, pixels.x1 * s_, pixels.y1 * s_};
        Stopwatch watch;
        g_ = draw_gbuffer(context.frame, surfaces, grown(samples, detection_margin(context.frame, s_)), s_,
                          context.scale);
        times.raster += watch.lap();
        lines_ = detect_lines(g_, context, samples);
        contours_ = contour_field(settings_.contours, samples);
        cross_ = contour_field(settings_.cross_hatching, samples);
        times.lines += watch.lap();
    }

    /// Box filter over the pixel's samples.
    PixelResult pixel(int x, int y) const;

  private:
    glm::dvec3 to_eye(int sample_x, int sample_y) const {
        glm::dvec3 origin, ray;
        context_.frame.surfaces.projection.view_ray(sample_position(sample_x, sample_y, s_), origin, ray);
        return -glm::normalize(ray);
    }
    Raster<double> contour_field(ContourField field, PixelRect samples) const;
    glm::vec4 sample_color(int x, int y) const;
    float hatched(int x, int y) const;

    const DetectionContext& context_;
    const Scene& scene_;
    const GBufferSettings& settings_;
    int s_;
    GBuffer g_;
    LineImages lines_;
    Raster<double> contours_, cross_;  // empty where there are none
};

/// The scalar field of contour lines, with a ring of one sample for its gradient.
Raster<double> GBufferTile::contour_field(ContourField field, PixelRect samples) const {
    if (field == ContourField::none) return {};
    const Projection& projection = context_.frame.surfaces.projection;
    return raster_of(grown(samples, 1), [&](int x, int y) {
        if (g_.object.at(x, y) == 0) return 0.0;
        const glm::dvec2 position = sample_position(x, y, s_);
        const double distance = projection.distance(g_.surfaces[g_.surface.at(x, y)].plane.nearness(position));
        if (field == ContourField::distance) return distance;
        glm::dvec3 origin, ray;
        projection.view_ray(position, origin, ray);
        const glm::dvec4 world = context_.frame.camera.to_world * glm::dvec4(origin + distance * ray, 1.0);
        return world[static_cast<int>(field) - static_cast<int>(ContourField::x)];
    });
}

/// How much of a sample contour lines or hatching cover. There are none beside other objects and jumps, where the
/// field's gradient means nothing.
float GBufferTile::hatched(int x, int y) const {
    const std::uint32_t object = g_.object.at(x, y);
    for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        if (g_.object.at(x + dx, y + dy) != object) return 0;
    }
    const Raster<float>& jumps = lines_[static_cast<std::size_t>(LineClass::silhouette)];
    if (!jumps.empty() && jumps.at(x, y) > 0.5f) return 0;
    const double darkness = 1 - std::abs(glm::dot(g_.normal.at(x, y), to_eye(x, y)));
    double width = settings_.contour_width_px * s_, cross_width = width;
    if (settings_.hatching) {
        cross_width = width * std::max(0.0, darkness - settings_.cross_darkness);
        width *= darkness;
    } else if (darkness <= settings_.cross_darkness) {
        cross_width = 0;
    }
    double covered = 0;
    if (!contours_.empty()) covered = contour_coverage(contours_, x, y, settings_.contour_step, width);
    if (!cross_.empty()) {
        covered = std::max(covered, contour_coverage(cross_, x, y, settings_.contour_step, cross_width));
    }
    return static_cast<float>(covered);
}

glm::vec4 GBufferTile::sample_color(int x, int y) const {
    const std::uint32_t surface = g_.surface.at(x, y);
    if (surface == GBuffer::kNoSurface) return glm::vec4(0.0f);
    const GBufferSurface& seen = g_.surfaces[surface];
    glm::vec4 color = surface_color(scene_.surfaces, context_.frame.material_of(seen.id), seen.normal, to_eye(x, y));
    if (contours_.empty() && cross_.empty()) return color;
    const float ink = hatched(x, y);
    return color * (1 - ink) + glm::vec4(0, 0, 0, 1) * ink;
}

PixelResult GBufferTile::pixel(int x, int y) const {
    PixelResult result;
    const float per_sample = 1.0f / static_cast<float>(s_ * s_);
    for (int sy = y * s_; sy < (y + 1) * s_; ++sy) {
        for (int sx = x * s_; sx < (x + 1) * s_; ++sx) {
            glm::vec4 lines(0.0f);
            for (std::size_t c = 0; c < kLineClassCount; ++c) {  // in order of priority
                if (lines_[c].empty()) continue;
                const float strength = lines_[c].at(sx, sy);
                const float added = settings_.composition == LineComposition::multiply
                                        ? strength * (1 - lines.a)
                                        : std::max(0.0f, strength - lines.a);
                if (added <= 0) continue;
                result.coverage[c] += added * per_sample;
                lines += glm::vec4(scene_.lines.style.colors[c], 1.0f) * added;
            }
            const glm::vec4 color = sample_color(sx, sy);
            result.lines += lines * per_sample;
            result.surface += color * per_sample;
            result.beauty += (lines + color * (1 - lines.a)) * per_sample;
        }
    }
    // The sample next to the pixel's centre stands for the pixel in depth, normal and numbers.
    const int cx = x * s_ + s_ / 2, cy = y * s_ + s_ / 2;
    result.distance = std::numeric_limits<float>::infinity();
    const std::uint32_t central = g_.surface.at(cx, cy);
    if (central == GBuffer::kNoSurface) return result;
    const GBufferSurface& seen = g_.surfaces[central];
    const SurfaceSet& surfaces = context_.frame.surfaces;
    result.distance = static_cast<float>(surfaces.projection.distance(seen.plane.nearness({x + 0.5, y + 0.5})));
    result.normal = glm::vec3(surfaces.view_to_world * seen.normal);
    result.object_id = g_.object.at(cx, cy);
    result.material_id = g_.material.at(cx, cy);
    result.polygon_id = g_.polygon.at(cx, cy);
    return result;
}

}  // namespace

RenderStats render_gbuffer(const Frame& frame, const RunOptions& options, Film& film) {
    RenderStats stats;
    stats.threads = resolve_thread_count(options.threads);
    stats.triangles = frame.surfaces.triangle_count();
    Stopwatch watch;
    const int s = frame.scene->gbuffer.supersample;
    const DetectionContext context{frame, s, depth_scale(frame, s)};
    const int margin_px = (detection_margin(frame, s) + s - 1) / s + 1;
    const SurfaceBins bins(frame.surfaces, frame.crop, kGbufferTilePx, margin_px, stats.threads);
    stats.prepare_s = watch.lap();

    if (options.progress != nullptr) options.progress->begin("rendering", bins.tile_count());
    std::vector<ThreadTimes> times(static_cast<std::size_t>(stats.threads));
    parallel_for(bins.tile_count(), stats.threads, [&](std::size_t index, int worker) {
        ThreadTimes& t = times[static_cast<std::size_t>(worker)];
        const PixelRect rect = bins.tile(index);
        std::optional<GBufferTile> tile;
        if (!bins.surfaces(index).empty()) tile.emplace(context, rect, bins.surfaces(index), t);
        Stopwatch shading;
        for (int y = rect.y0; y < rect.y1; ++y) {
            for (int x = rect.x0; x < rect.x1; ++x) film.put(x, y, tile ? tile->pixel(x, y) : background_pixel());
        }
        t.shade += shading.lap();
        if (options.progress != nullptr) options.progress->advance();
    });

    share_out(watch.lap(), times, stats);
    return stats;
}

LineClassSet gbuffer_also_finds(LineClassSet asked) {
    LineClassSet found;
    if (asked.has(LineClass::silhouette)) found |= LineClass::border;
    if (asked.has(LineClass::crease) || asked.has(LineClass::object) || asked.has(LineClass::polygon)) {
        found |= LineClass::intersection;
    }
    return found;
}

double gbuffer_line_width_px(const Scene& scene) {
    const GBufferSettings& settings = scene.gbuffer;
    int samples = 2;
    constexpr auto kRoberts = GBufferOperatorSet::of({GBufferOperator::roberts});
    constexpr auto kId = GBufferOperatorSet::of({GBufferOperator::id});
    if (settings.operators == kRoberts ||
        (settings.operators == kId && settings.id_comparison != IdComparison::differs)) {
        samples = 1;
    }
    // Lines are widened by whole samples on either side.
    const double missing = std::max(0.0, scene.lines.style.width_px * settings.supersample - samples);
    const double widened = settings.dilate ? 2 * std::floor(0.5 * missing) : 0;
    return (samples + widened) / settings.supersample;
}

}  // namespace burin
