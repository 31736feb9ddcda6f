#include "methods/gbuffer/gbuffer_images.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "view/scan_convert.h"

namespace burin {
namespace {

/// How far behind the farthest surface the background of an orthographic view lies, in pixels.
constexpr double kBackgroundGapPx = 256;

/// Distances of the nearest and the farthest vertex in front of the near plane.
struct DistanceRange {
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = -std::numeric_limits<double>::infinity();
};

DistanceRange distance_range(const SurfaceSet& surfaces) {
    DistanceRange range;
    const double limit =
        surfaces.projection.orthographic ? -std::numeric_limits<double>::infinity() : surfaces.projection.near_distance;
    for (std::uint32_t i = 0; i < surfaces.instances.size(); ++i) {
        const auto count = static_cast<std::uint32_t>(surfaces.instances[i].mesh->positions.size());
        for (std::uint32_t v = 0; v < count; ++v) {
            const double distance = std::max(-surfaces.view_position(i, v).z, limit);
            range.nearest = std::min(range.nearest, distance);
            range.farthest = std::max(range.farthest, distance);
        }
    }
    return range;
}

/// Rounds depth to codes 0 .. 2^bits - 1 of the range [scale.lowest, scale.background].
double quantized(double depth, const DepthScale& scale, int bits) {
    const double codes = std::exp2(bits) - 1, range = scale.background - scale.lowest;
    if (bits == 0 || !(range > 0)) return depth;
    return scale.lowest + std::round((depth - scale.lowest) / range * codes) / codes * range;
}

}  // namespace

DepthScale depth_scale(const Frame& frame, int samples_per_pixel) {
    const Projection& projection = frame.surfaces.projection;
    const GBufferSettings& settings = frame.scene->gbuffer;
    const DistanceRange range = distance_range(frame.surfaces);
    DepthScale scale;
    scale.per_nearness = settings.depth_scale * samples_per_pixel * projection.focal_px;
    if (!(range.nearest <= range.farthest)) return scale;  // nothing there
    if (projection.orthographic) {
        scale.background = scale.per_nearness * range.farthest + kBackgroundGapPx * samples_per_pixel;
    } else {
        scale.per_nearness *=
            settings.reference_distance > 0 ? settings.reference_distance : 0.5 * (range.nearest + range.farthest);
    }
    scale.lowest = -scale.per_nearness * projection.nearness({0, 0, -range.nearest});
    return scale;
}

GBuffer draw_gbuffer(const Frame& frame, std::span<const SurfaceId> surfaces, PixelRect samples, int samples_per_pixel,
                     const DepthScale& scale) {
    const Projection& projection = frame.surfaces.projection;
    GBuffer g;
    g.surface = Raster<std::uint32_t>(samples, GBuffer::kNoSurface);
    Raster<double> nearness(samples, -std::numeric_limits<double>::infinity());
    for (const SurfaceId id : surfaces) {
        glm::dvec3 corners[3];
        frame.surfaces.view_corners(id, corners);
        const ScreenPolygon polygon = project_triangle(projection, corners);
        if (polygon.count == 0) continue;
        const ScanConverter converter(polygon, samples_per_pixel);
        const int end_row = std::min(converter.end_row(), samples.y1);
        const DepthPlane plane = snapped_depth_plane(projection, corners);
        const auto number = static_cast<std::uint32_t>(g.surfaces.size());
        bool is_visible = false;
        for (int y = std::max(converter.first_row(), samples.y0); y < end_row; ++y) {
            const SampleSpan span = converter.span(y);
            const int end = std::min(span.end, samples.x1);
            for (int x = std::max(span.begin, samples.x0); x < end; ++x) {
                const double here = plane.nearness(sample_position(x, y, samples_per_pixel));
                if (here <= nearness.at(x, y)) continue;
                nearness.at(x, y) = here;
                g.surface.at(x, y) = number;
                is_visible = true;
            }
        }
        if (!is_visible) continue;
        const glm::dvec2 corner(static_cast<double>(polygon.corners[0].x) / kSubpixelsPerPixel,
                                static_cast<double>(polygon.corners[0].y) / kSubpixelsPerPixel);
        g.surfaces.push_back({id, plane, frame.surfaces.normal_towards_eye(id, corner)});
    }

    const auto has = [&](int x, int y) { return g.surface.at(x, y) != GBuffer::kNoSurface; };
    const auto at = [&](int x, int y) -> const GBufferSurface& { return g.surfaces[g.surface.at(x, y)]; };
    const int bits = frame.scene->gbuffer.depth_bits;
    g.depth = raster_of(samples, [&](int x, int y) {
        return has(x, y) ? quantized(-scale.per_nearness * nearness.at(x, y), scale, bits) : scale.background;
    });
    g.normal = raster_of(samples, [&](int x, int y) { return has(x, y) ? at(x, y).normal : glm::dvec3(0.0); });
    const auto ids = [&](const auto& id_of) {
        return raster_of(samples, [&](int x, int y) -> std::uint32_t { return has(x, y) ? id_of(at(x, y).id) : 0; });
    };
    g.object = ids([&](SurfaceId s) { return frame.surfaces.object_id(s); });
    g.material = ids([&](SurfaceId s) { return frame.surfaces.material_id(s); });
    g.polygon = ids([&](SurfaceId s) { return frame.surfaces.polygon_id(s); });
    return g;
}

}  // namespace burin
