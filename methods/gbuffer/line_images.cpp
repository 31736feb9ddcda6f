#include "methods/gbuffer/line_images.h"

#include <algorithm>
#include <cmath>

#include "methods/gbuffer/differentials.h"
#include "methods/gbuffer/filters.h"
#include "methods/gbuffer/gradients.h"
#include "methods/gbuffer/id_edges.h"
#include "methods/gbuffer/profile.h"
#include "methods/gbuffer/roberts.h"

namespace burin {
namespace {

/// Distance of the background for Roberts' cross, which compares distances.
constexpr double kFarAway = 1e30;

/// By how many samples a line `width` samples wide is widened on every side.
double dilation_radius(const Frame& frame, int samples_per_pixel, int width) {
    if (!frame.scene->gbuffer.dilate) return 0;
    return std::max(0.0, 0.5 * (frame.scene->lines.style.width_px * samples_per_pixel - width));
}

Raster<float> above(const Raster<double>& image, double limit) {
    return raster_of(image.rect(), [&](int x, int y) { return image.at(x, y) > limit ? 1.0f : 0.0f; });
}

Raster<float> relative_to(const Raster<double>& image, double limit) {
    return raster_of(image.rect(),
                     [&](int x, int y) { return static_cast<float>(std::min(std::abs(image.at(x, y)) / limit, 1.0)); });
}

class LineDetector {
  public:
    LineDetector(const GBuffer& g, const DetectionContext& context, PixelRect samples)
        : g_(g),
          context_(context),
          settings_(context.frame.scene->gbuffer),
          classes_(context.frame.criteria.classes),
          cos_crease_(context.frame.criteria.cos_crease_angle),
          samples_(settings_.smooth ? grown(samples, kSmoothReach) : samples) {
        near_background_ = raster_of(grown(g.object.rect(), -1), [&](int x, int y) -> char {
            const Block<std::uint32_t> n = block_at(g.object, x, y);
            return n.a == 0 || n.b == 0 || n.c == 0 || n.d == 0 || n.x == 0 || n.e == 0 || n.f == 0 || n.g == 0 ||
                   n.h == 0;
        });
    }

    LineImages detect() {
        const Raster<double> g = first_order(g_.depth), l = second_order(g_.depth);
        const ProfileParameters profile{settings_.profile_limit, settings_.profile_power, settings_.gate};
        const int profile_width = settings_.gate ? 2 : 4;
        // Half the length of the difference between two unit normals.
        const double normal_limit = std::sqrt(0.5 * (1 - cos_crease_));
        if (has(GBufferOperator::first)) add_jumps(relative_to(g, settings_.jump_limit), 2);
        if (has(GBufferOperator::second)) add_bends(relative_to(l, settings_.crease_limit), 2);
        if (has(GBufferOperator::profile)) add_jumps(depth_profile(g, profile), profile_width);
        if (has(GBufferOperator::internal)) {
            add_bends(internal_edge_image(g, l, settings_.jump_limit, settings_.crease_limit), 2);
        }
        if (has(GBufferOperator::sobel) || has(GBufferOperator::hertzmann)) {
            add_jumps(above(sobel_magnitude(g_.depth), settings_.jump_limit), 2);
            add_bends(above(sobel_magnitude(g_.normal), normal_limit), 2);
        }
        if (has(GBufferOperator::sobel)) {
            add_ids([](const auto& ids) { return id_edges(ids, IdComparison::differs, 8); }, 2);
        }
        if (has(GBufferOperator::roberts)) add_roberts();
        if (has(GBufferOperator::id)) {
            const int width = settings_.id_comparison == IdComparison::differs ? 2 : 1;
            add_ids([&](const auto& ids) { return id_edges(ids, settings_.id_comparison, settings_.id_neighbours); },
                    width);
        }
        if (has(GBufferOperator::normal)) {
            add_bends(above(normal_difference(g_.normal), 2 - 2 * cos_crease_), 2);
        }
        if (has(GBufferOperator::decaudin)) {
            ProfileParameters squared = profile;
            squared.power = 2;
            add_jumps(depth_profile(g, squared), profile_width);
            squared.limit = normal_limit;
            add_bends(normal_profile_image(g_.normal, squared), profile_width);
        }
        if (settings_.smooth) {
            for (Raster<float>& image : images_) {
                if (!image.empty()) image = smooth_along_lines(image);
            }
        }
        return std::move(images_);
    }

  private:
    bool has(GBufferOperator o) const { return settings_.operators.has(o); }

    Raster<float> depth_profile(const Raster<double>& g, const ProfileParameters& parameters) {
        const Raster<float> profile = profile_image(g, parameters);
        return parameters.gate ? without_creases(profile, g_.depth, parameters) : profile;
    }

    void add_roberts() {
        const bool orthographic = context_.frame.surfaces.projection.orthographic;
        const int s = context_.samples_per_pixel;
        const auto distance = raster_of(g_.depth.rect(), [&](int x, int y) {
            if (g_.object.at(x, y) == 0) return kFarAway;
            return context_.frame.surfaces.projection.distance(-g_.depth.at(x, y) / context_.scale.per_nearness);
        });
        const auto facing = raster_of(g_.normal.rect(), [&](int x, int y) {
            glm::dvec3 origin, ray;
            context_.frame.surfaces.projection.view_ray(sample_position(x, y, s), origin, ray);
            return g_.object.at(x, y) == 0 ? 1.0 : -glm::dot(g_.normal.at(x, y), glm::normalize(ray));
        });
        RobertsDepth parameters{settings_.relative_jump, settings_.relative_jump_slope, 0};
        if (orthographic) parameters.fixed_distance = context_.frame.camera.height;
        add_jumps(roberts_depth(distance, facing, parameters), 1);
        add_bends(roberts_normal(g_.normal, 1 - cos_crease_), 1);
        add_ids([](const auto& ids) { return roberts_id(ids); }, 1);
    }

    void add_jumps(const Raster<float>& strength, int width) { add(LineClass::silhouette, strength, width); }

    /// Creases, but beside the background silhouettes.
    void add_bends(const Raster<float>& strength, int width) {
        add_split(strength, LineClass::silhouette, LineClass::crease, width);
    }

    template <typename Edges>
    void add_ids(const Edges& edges, int width) {
        add_split(edges(g_.object), LineClass::silhouette, LineClass::object, width);
        if (classes_.has(LineClass::material)) {
            add_split(edges(g_.material), LineClass::silhouette, LineClass::material, width);
        }
        if (classes_.has(LineClass::polygon)) add(LineClass::polygon, edges(g_.polygon), width);
    }

    void add_split(const Raster<float>& strength, LineClass at_background, LineClass elsewhere, int width) {
        const auto part = [&](bool background) {
            return raster_of(common(strength.rect(), near_background_.rect()), [&](int x, int y) {
                return (near_background_.at(x, y) != 0) == background ? strength.at(x, y) : 0.0f;
            });
        };
        if (classes_.has(at_background)) add(at_background, part(true), width);
        if (classes_.has(elsewhere)) add(elsewhere, part(false), width);
    }

    /// `width` is how many samples wide the operator's lines are.
    void add(LineClass c, const Raster<float>& strength, int width) {
        if (!classes_.has(c)) return;
        const Raster<float> wide = dilate(strength, dilation_radius(context_.frame, context_.samples_per_pixel, width));
        Raster<float>& image = images_[static_cast<std::size_t>(c)];
        if (image.empty()) image = Raster<float>(samples_);
        for (int y = samples_.y0; y < samples_.y1; ++y) {
            for (int x = samples_.x0; x < samples_.x1; ++x) {
                image.at(x, y) = std::max(image.at(x, y), wide.at(x, y));
            }
        }
    }

    const GBuffer& g_;
    const DetectionContext& context_;
    const GBufferSettings& settings_;
    LineClassSet classes_;
    double cos_crease_;
    PixelRect samples_;
    Raster<char> near_background_;
    LineImages images_;
};

}  // namespace

int detection_margin(const Frame& frame, int samples_per_pixel) {
    constexpr int kOperators = 2;  // the profile looks at differentials of neighbours
    const int widened = static_cast<int>(dilation_radius(frame, samples_per_pixel, 1));
    return kOperators + widened + (frame.scene->gbuffer.smooth ? kSmoothReach : 0);
}

LineImages detect_lines(const GBuffer& g, const DetectionContext& context, PixelRect samples) {
    return LineDetector(g, context, samples).detect();
}

}  // namespace burin
