#include "methods/wire/id_buffer.h"

#include "base/error.h"
#include "methods/projected_polygon.h"
#include "methods/wire/edge_distance.h"
#include "methods/wire/wire_pixels.h"
#include "methods/wire/wire_stroke.h"
#include "methods/wire/wire_tiles.h"

namespace burin {
namespace {

/// How far snapped ends may lie beside their line.
constexpr double kSnapPx = 0.01;
constexpr std::uint64_t kIdCount = std::uint64_t{1} << 24;

class IdBufferTile {
  public:
    IdBufferTile(const Frame& frame, const FeatureEdges& features, const WireStroke& stroke, const DepthRange& depth)
        : frame_(frame), settings_(frame.scene->wire), features_(features), stroke_(stroke), depth_(depth) {}

    void render(PixelRect rect, std::span<const SurfaceId> surfaces, Film& film) {
        pixels_.clear(rect);
        for (const SurfaceId s : surfaces) fill(s);
        for (const SurfaceId s : surfaces) draw_edges(s);
        pixels_.put_into(film, frame_);
    }

  private:
    /// Pass 1: numbers and depths.
    void fill(SurfaceId s) {
        const DepthPlane plane = frame_.surfaces.plane(s);
        const std::uint32_t slot = pixels_.next_slot();
        pixels_.keep(plane);
        for_each_pixel(frame_.surfaces.screen_polygon(s), pixels_.rect(), [&](int x, int y) {
            const double nearness = plane.nearness({x + 0.5, y + 0.5});
            WirePixel& pixel = pixels_.at(x, y);
            // Where surfaces are equally near, the first one stays.
            if (nearness > pixel.nearness) {
                pixel.surface = s;
                pixel.slot = slot;
                pixel.nearness = nearness;
            }
        });
    }

    /// Pass 2, for the edges of the triangle's polygon that are the triangle's.
    void draw_edges(SurfaceId s) {
        for (HalfEdge k = 0; k < 3; ++k) {
            const auto line_class = features_.drawn(s, k);
            if (!line_class) continue;
            const auto edge = wire_edge(frame_.surfaces, s.instance, 3 * s.triangle + k, *line_class);
            if (edge) draw_stroke(*edge, frame_.surfaces.polygon_id(s));
        }
    }

    /// A rectangle around the segment that reaches as far as the profile on all sides.
    void draw_stroke(const WireEdge& edge, std::uint32_t polygon) {
        const double reach = stroke_.reach_px();
        const auto rows =
            centers_within(std::min(edge.from.y, edge.to.y) - reach, std::max(edge.from.y, edge.to.y) + reach,
                           pixels_.rect().y0, pixels_.rect().y1);
        for (int y = rows.begin; y < rows.end; ++y) {
            const SampleSpan columns = columns_near(edge, y + 0.5, reach);
            for (int x = columns.begin; x < columns.end; ++x) draw_pixel(edge, polygon, x, y);
        }
    }

    /// The pixels of a range whose centres lie in [low, high].
    static SampleSpan centers_within(double low, double high, int first, int end) {
        const double clamped_low = std::clamp(low - 0.5, first - 1.0, end + 1.0);
        const double clamped_high = std::clamp(high - 0.5, first - 1.0, end + 1.0);
        return {std::max(static_cast<int>(std::ceil(clamped_low)), first),
                std::min(static_cast<int>(std::floor(clamped_high)) + 1, end)};
    }

    /// The pixels of a row that may be within reach of the segment.
    SampleSpan columns_near(const WireEdge& edge, double y, double reach) const {
        double low = std::min(edge.from.x, edge.to.x) - reach, high = std::max(edge.from.x, edge.to.x) + reach;
        if (std::abs(edge.line.x) > 1e-6) {  // between the two parallels of the line
            const double middle = -(edge.line.y * y + edge.line.z) / edge.line.x;
            const double half = (reach + kSnapPx) / std::abs(edge.line.x);
            low = std::max(low, middle - half);
            high = std::min(high, middle + half);
        }
        return centers_within(low, high, pixels_.rect().x0, pixels_.rect().x1);
    }

    void draw_pixel(const WireEdge& edge, std::uint32_t polygon, int x, int y) {
        const glm::dvec2 at(x + 0.5, y + 0.5);
        WirePixel& pixel = pixels_.at(x, y);
        const SegmentDistance segment = segment_distance(edge.from, edge.to, at);
        const double nearness = edge.nearness(segment.along);
        const bool owns = !pixel.surface.is_background() && frame_.surfaces.polygon_id(pixel.surface) == polygon;
        if (!owns && !(nearness + slope_of(pixel) > pixel.nearness)) return;
        const double distance = frame_.surfaces.projection.distance(nearness);
        const double fade = settings_.fade_distance > 0 ? std::min(settings_.fade_distance / distance, 1.0) : 1.0;
        pixel.draw(fade * stroke_.intensity(edge, segment.distance, segment.along, depth_.z(distance)),
                   edge.line_class);
    }

    /// What the variant +slope allows: the change of depth of the pixel's surface from its centre
    /// to its corners.
    double slope_of(const WirePixel& pixel) const {
        if (!settings_.slope || pixel.surface.is_background()) return 0;
        const DepthPlane plane = pixels_.plane_of(pixel);
        return 0.5 * (std::abs(plane.per_x) + std::abs(plane.per_y));
    }

    const Frame& frame_;
    const WireSettings& settings_;
    const FeatureEdges& features_;
    const WireStroke& stroke_;
    const DepthRange depth_;
    WirePixels pixels_;
};

void check_ids(const Frame& frame) {
    std::uint64_t polygons = 0;
    for (const SurfaceInstance& i : frame.surfaces.instances) polygons += i.mesh->polygon_count;
    if (polygons >= kIdCount) {
        throw InputError("method id-buffer tells apart 16777215 polygons, the scene has " + std::to_string(polygons) +
                         "; split it, or use another method");
    }
}

}  // namespace

RenderStats render_id_buffer(const Frame& frame, const RunOptions& options, Film& film) {
    check_ids(frame);
    const WireSettings& s = frame.scene->wire;
    const WireStroke stroke(s, frame.scene->lines.style.width_px, WireProfileKind::gauss, 0, s.transition_px);
    const int margin_px = static_cast<int>(std::ceil(stroke.reach_px())) + 1;
    return render_wire_tiles(frame, options, film, margin_px, [&](const FeatureEdges& features) {
        return IdBufferTile(frame, features, stroke, DepthRange::fitted(frame));
    });
}

}  // namespace burin
