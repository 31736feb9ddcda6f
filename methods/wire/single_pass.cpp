#include "methods/wire/single_pass.h"

#include "methods/projected_polygon.h"
#include "methods/wire/wire_pixels.h"
#include "methods/wire/wire_stroke.h"
#include "methods/wire/wire_tiles.h"
#include "methods/wire/wire_triangle.h"

namespace burin {
namespace {

/// Fills tiles, one after the other.
class FillTile {
  public:
    FillTile(const Frame& frame, const FeatureEdges& features, const EdgeRules& rules, const WireStroke& stroke,
             const DepthRange& depth)
        : frame_(frame),
          settings_(frame.scene->wire),
          features_(features),
          rules_(rules),
          stroke_(stroke),
          depth_(depth) {}

    void render(PixelRect rect, std::span<const SurfaceId> surfaces, Film& film) {
        pixels_.clear(rect);
        WireTriangle triangle(frame_, features_, rules_);
        for (const SurfaceId surface : surfaces) {
            triangle.load(surface, rect, stroke_.reach_px());
            if (triangle.polygon().count > 0) fill(surface, triangle);
        }
        pixels_.put_into(film, frame_, settings_.alpha_test > 0);
    }

  private:
    void fill(SurfaceId surface, const WireTriangle& triangle) {
        const std::uint32_t slot = pixels_.next_slot();
        bool is_seen = false;
        for_each_pixel(triangle.polygon(), pixels_.rect(), [&](int x, int y) {
            const glm::dvec2 at(x + 0.5, y + 0.5);
            WirePixel candidate{surface, slot, triangle.plane().nearness(at)};
            WirePixel& pixel = pixels_.at(x, y);
            // Where surfaces are equally near, the first one stays.
            if (!(candidate.nearness > pixel.nearness)) return;
            if (triangle.has_edges()) draw_line(triangle, at, candidate);
            if (candidate.line < settings_.alpha_test) return;
            pixel = candidate;
            is_seen = true;
        });
        if (is_seen) pixels_.keep(triangle.plane());
    }

    void draw_line(const WireTriangle& triangle, glm::dvec2 at, WirePixel& pixel) const {
        const double distance = frame_.surfaces.projection.distance(pixel.nearness);
        const double z = depth_.z(distance);
        const double fade = settings_.fade_distance > 0 ? std::min(settings_.fade_distance / distance, 1.0) : 1.0;
        const double reach = stroke_.reach_px();
        double nearest = kNoEdge, nearest_diagonal = kNoEdge, diagonal = 0;
        triangle.for_each_distance(at, [&](const WireTriangle::Channel& c, double d) {
            if (!(d <= reach)) return;
            const glm::dvec2 way = c.edge.to - c.edge.from;
            const double along = glm::dot(at - c.edge.from, way) / std::max(glm::length(way), 1e-9);
            if (c.is_dotted) {
                if (d < nearest_diagonal) diagonal = stroke_.dots(d, along);
                nearest_diagonal = std::min(d, nearest_diagonal);
                return;
            }
            nearest = std::min(d, nearest);
            pixel.draw(fade * stroke_.intensity(c.edge, d, along, z), c.edge.line_class);
        });
        // Near a proper edge that edge wins over the dots.
        if (nearest_diagonal < nearest && nearest > stroke_.profile().reach_px()) {
            pixel.draw(fade * diagonal, LineClass::polygon);
        }
    }

    const Frame& frame_;
    const WireSettings& settings_;
    const FeatureEdges& features_;
    const EdgeRules rules_;
    const WireStroke& stroke_;
    const DepthRange depth_;
    WirePixels pixels_;
};

RenderStats render_filled(const Frame& frame, const RunOptions& options, Film& film, const EdgeRules& rules,
                          const WireStroke& stroke) {
    return render_wire_tiles(frame, options, film, 0, [&](const FeatureEdges& features) {
        return FillTile(frame, features, rules, stroke, DepthRange::fitted(frame));
    });
}

}  // namespace

RenderStats render_single_pass(const Frame& frame, const RunOptions& options, Film& film) {
    const WireSettings& s = frame.scene->wire;
    const EdgeRules rules{s.path.value_or(WirePath::linear), s.exclude.value_or(WireExclude::polygon), s.q_px, false};
    const WireStroke stroke(s, frame.scene->lines.style.width_px, WireProfileKind::gauss, 0);
    return render_filled(frame, options, film, rules, stroke);
}

RenderStats render_solid_wireframe(const Frame& frame, const RunOptions& options, Film& film) {
    const WireSettings& s = frame.scene->wire;
    const bool dotted = s.dotted_diagonals && frame.scene->lines.classes.has(LineClass::polygon);
    const EdgeRules rules{s.path.value_or(WirePath::cases), s.exclude.value_or(WireExclude::flags), s.q_px, dotted};
    const WireStroke stroke(s, frame.scene->lines.style.width_px, WireProfileKind::nv, 1.5);
    return render_filled(frame, options, film, rules, stroke);
}

}  // namespace burin
