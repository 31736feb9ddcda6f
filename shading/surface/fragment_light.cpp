// What lights and shadows do to the places that a FragmentShader shades.

#include <algorithm>
#include <bit>
#include <cmath>

#include "shading/surface/fragment_shader.h"

namespace burin {
namespace {

/// At a shadow's edge, lit places are counted in so many rows and columns of a pixel.
constexpr int kFineSide = 4;

}  // namespace

double FragmentShader::change_per_px(std::size_t i, const ViewLight& light) const {
    const SurfacePlace place = this->place(i);
    const glm::dvec3 way = light.towards(place.position);
    glm::dvec2 change;
    for (int axis = 0; axis < 2; ++axis) {
        change[axis] = glm::dot(changes_[i].normal[axis], way);
        if (!light.is_at_point) continue;
        const double distance = std::max(glm::length(light.place - place.position), 1e-300);
        const glm::dvec3& moved = changes_[i].position[axis];
        change[axis] -= glm::dot(place.normal, moved - way * glm::dot(way, moved)) / distance;
    }
    return glm::length(change);
}

float FragmentShader::lit_share(std::size_t i) const {
    const ViewLight& light = surfaces_.lights().front();
    const double cosine = light.cosine(place(i).normal, place(i).position);
    // A surface is in its own shadow where it is turned away. Where it begins to be, a pixel has a share of both.
    const double half_change = 0.5 * change_per_px(i, light);
    if (cosine <= -half_change) return 0;
    const double turned_to = cosine < half_change ? std::clamp(0.5 + 0.5 * cosine / half_change, 0.0, 1.0) : 1.0;
    return static_cast<float>(turned_to) * free_share(i);
}

float FragmentShader::free_share(std::size_t i) const {
    const ShadowCasters& casters = *surfaces_.casters();
    const ShadedTriangle& triangle = triangle_of(i);
    const auto is_free = [&](glm::dvec2 at) {
        return casters.is_lit(triangle.shadow_place(at), triangle.id()) ? 1 : 0;
    };
    const PixelSamples& own = samples_[i];
    if (own.bits == 0) {
        const auto count_free = [&](int side) {
            int free = 0;
            for (int k = 0; k < side * side; ++k)
                free += is_free(pixel(i) + glm::dvec2((k % side + 0.5) / side - 0.5, (k / side + 0.5) / side - 0.5));
            return free;
        };
        const int of_four = count_free(2);
        if (of_four == 0 || of_four == 4) return of_four == 0 ? 0.0f : 1.0f;
        return static_cast<float>(count_free(kFineSide)) / (kFineSide * kFineSide);
    }
    if (own.side == 0) return static_cast<float>(is_free(pixel(i)));
    // Beyond its samples the triangle may be below another surface, in whose shadow it is of course.
    const glm::dvec2 corner = glm::floor(pixel(i));
    int free = 0, count = 0;
    for (std::uint64_t bits = own.bits; bits != 0; bits &= bits - 1, ++count) {
        const int sample = std::countr_zero(bits);
        free += is_free(corner +
                        glm::dvec2(sample % own.side + 0.5, sample / own.side + 0.5) / static_cast<double>(own.side));
    }
    return static_cast<float>(free) / static_cast<float>(count);
}

FragmentShader::Light FragmentShader::light_at(std::size_t i, bool in_shadow) const {
    const SurfacePlace place = this->place(i);
    Light brightest{-1, 0};
    bool is_first = true;
    for (const ViewLight& light : surfaces_.lights()) {
        const double value = std::clamp(light.cosine(place.normal, place.position), -1.0, 1.0);
        if (in_shadow && is_first && value > 0) {
            brightest = {0, 0};
            is_first = false;
            continue;
        }
        if (!is_first && value <= brightest.value) continue;
        is_first = false;
        brightest.value = value;
        if (!needs_changes_) continue;
        brightest.change_per_px = change_per_px(i, light);
    }
    return brightest;
}

}  // namespace burin
