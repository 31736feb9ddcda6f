#include "methods/zbuffer/render_zbuffer.h"

#include <limits>
#include <memory>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "methods/zbuffer/fill_raster.h"
#include "methods/zbuffer/polygon_bins.h"
#include "methods/zbuffer/vector_generator.h"
#include "shading/surface_shader.h"

namespace burin {
namespace {

constexpr int kZbufferTilePx = 128;

/// What is visible at the centres of the pixels, by an ordinary z-buffer. The first of equals wins.
class CentreSurfaces {
  public:
    void clear(PixelRect rect) {
        rect_ = rect;
        const auto count = static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
        nearest_.assign(count, {});
    }
    void add(const ProjectedPolygon& polygon) {
        for (const ProjectedTriangle& triangle : polygon.triangles) {
            for_each_fragment(triangle, rect_, [&](int x, int y, double z) {
                Nearest& nearest = nearest_[index(x, y)];
                if (z < nearest.z) nearest = {z, triangle.surface};
            });
        }
    }
    struct Nearest {
        double z = std::numeric_limits<double>::infinity();
        SurfaceId surface;
    };
    const Nearest& at(int x, int y) const { return nearest_[index(x, y)]; }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - rect_.y0) * static_cast<std::size_t>(rect_.width()) +
               static_cast<std::size_t>(x - rect_.x0);
    }
    PixelRect rect_;
    std::vector<Nearest> nearest_;
};

/// One thread's machine.
struct Worker {
    ZBuffer zbuffer;
    CentreSurfaces surfaces;
    ProjectedPolygon polygon;
    double raster_s = 0, shade_s = 0;

    explicit Worker(const Frame& frame) : zbuffer(frame) {}
};

class Renderer {
  public:
    Renderer(const Frame& frame, const ZBufferMethod& method, const FeatureEdges& features, const DepthRange& depth,
             Film& film)
        : frame_(frame), method_(method), features_(features), depth_(depth), film_(film) {}

    void render_tile(Worker& worker, PixelRect rect, std::span<const PolygonRef> polygons) const {
        Stopwatch watch;
        const ZBufferSettings& settings = frame_.scene->zbuffer;
        worker.zbuffer.clear(rect, method_.initial_bit);
        for (const ZBufferMethod::Step& sweep : method_.sweeps) {
            for_each(worker, polygons, [&](const auto& polygon) { sweep(worker.zbuffer, polygon); });
        }
        if (!settings.highlight_classes.empty() || !settings.highlight_objects.empty()) {
            for_each(worker, polygons,
                     [&](const auto& polygon) { worker.zbuffer.highlight(polygon, method_.edge_offset); });
        }
        worker.raster_s += watch.lap();

        worker.surfaces.clear(rect);
        for_each(worker, polygons, [&](const auto& polygon) { worker.surfaces.add(polygon); });
        for (int y = rect.y0; y < rect.y1; ++y) {
            for (int x = rect.x0; x < rect.x1; ++x) {
                film_.put(x, y, finished(worker.zbuffer.frame(x, y), worker.surfaces.at(x, y), x, y));
            }
        }
        worker.shade_s += watch.lap();
    }

  private:
    template <typename Work>
    void for_each(Worker& worker, std::span<const PolygonRef> polygons, const Work& work) const {
        for (const PolygonRef& p : polygons) {
            project_polygon(frame_, features_, depth_, p.instance, p.polygon, worker.polygon);
            work(worker.polygon);
        }
    }

    PixelResult finished(const FramePixel& pixel, const CentreSurfaces::Nearest& nearest, int x, int y) const {
        const SurfaceSet& surfaces = frame_.surfaces;
        glm::dvec3 origin, ray;
        surfaces.projection.view_ray({x + 0.5, y + 0.5}, origin, ray);
        const glm::dvec3 to_eye = -glm::normalize(ray);
        const auto color_of = [&](SurfaceId id) {
            if (id.is_background()) return glm::vec4(0.0f);
            return surface_color(frame_.scene->surfaces, frame_.material_of(id), surfaces.view_normal(id), to_eye);
        };

        PixelResult result;
        if (pixel.line != 0) {
            const auto drawn = static_cast<LineClass>(pixel.line - 1);
            const glm::vec3 color =
                pixel.highlighted ? frame_.scene->zbuffer.highlight_color : frame_.scene->lines.style.color_of(drawn);
            result.lines = glm::vec4(color, 1.0f);
            result.beauty = result.lines;
            result.coverage[static_cast<std::size_t>(drawn)] = 1;
        } else {
            result.beauty = color_of(pixel.surface);
        }
        result.distance = std::numeric_limits<float>::infinity();
        if (nearest.surface.is_background()) return result;
        result.surface = color_of(nearest.surface);
        result.distance = static_cast<float>(depth_.distance(nearest.z));
        const glm::dvec3 normal = surfaces.view_normal(nearest.surface);
        result.normal = glm::vec3(surfaces.view_to_world * (glm::dot(normal, to_eye) < 0 ? -normal : normal));
        result.object_id = surfaces.object_id(nearest.surface);
        result.material_id = surfaces.material_id(nearest.surface);
        result.polygon_id = surfaces.polygon_id(nearest.surface);
        return result;
    }

    const Frame& frame_;
    const ZBufferMethod& method_;
    const FeatureEdges& features_;
    const DepthRange& depth_;
    Film& film_;
};

}  // namespace

RenderStats render_zbuffer(const Frame& frame, const RunOptions& options, Film& film, const ZBufferMethod& method) {
    RenderStats stats;
    stats.threads = resolve_thread_count(options.threads);
    Stopwatch watch;
    const auto& range = frame.scene->zbuffer.depth_range;
    const DepthRange depth = range
                                 ? DepthRange::between((*range)[0], (*range)[1], frame.surfaces.projection.orthographic)
                                 : DepthRange::fitted(frame);
    const FeatureEdges features(frame, stats.threads);
    const double reach_px = 1 + aliased_width_px(frame.scene->lines.style.width_px);
    const PolygonBins bins(frame, features, depth, kZbufferTilePx, reach_px, stats.threads);
    stats.prepare_s = watch.lap();

    if (options.progress != nullptr) options.progress->begin("rendering", bins.tile_count());
    const Renderer renderer(frame, method, features, depth, film);
    std::vector<std::unique_ptr<Worker>> workers(static_cast<std::size_t>(stats.threads));
    parallel_for(bins.tile_count(), stats.threads, [&](std::size_t index, int w) {
        auto& worker = workers[static_cast<std::size_t>(w)];
        if (!worker) worker = std::make_unique<Worker>(frame);
        renderer.render_tile(*worker, bins.tile(index), bins.polygons(index));
        if (options.progress != nullptr) options.progress->advance();
    });

    // Tiles run at the same time: their share of the threads' time is their share of the wall time.
    const double wall = watch.lap();
    double raster = 0, shade = 0;
    for (const auto& worker : workers) {
        if (!worker) continue;
        raster += worker->raster_s;
        shade += worker->shade_s;
    }
    const double scale = raster + shade > 0 ? wall / (raster + shade) : 0;
    stats.raster_s = raster * scale;
    stats.shade_s = shade * scale;
    stats.triangles = frame.surfaces.triangle_count();
    return stats;
}

}  // namespace burin
