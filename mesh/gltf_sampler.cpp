#include "mesh/gltf_sampler.h"

#include <algorithm>

namespace burin {
namespace {

/// At unit length; `otherwise` if it has no length.
glm::dvec4 unit_rotation(const glm::dvec4& q, const glm::dvec4& otherwise) {
    const double length = glm::length(q);
    return length > 0 ? q / length : otherwise;
}

glm::dvec4 rotation_of(std::span<const double> numbers) { return {numbers[0], numbers[1], numbers[2], numbers[3]}; }

constexpr glm::dvec4 kNoTurn{0.0, 0.0, 0.0, 1.0};

}  // namespace

glm::dvec4 slerp(const glm::dvec4& from, glm::dvec4 to, double part) {
    if (glm::dot(from, to) < 0) to = -to;  // the same rotation, not as far away
    // The sum of two quaternions points to the middle of the arc between them. An arc that is halved this often is so
    // short that it is straight.
    constexpr int kHalvings = 26;
    glm::dvec4 low = from, high = to;
    for (int i = 0; i < kHalvings; ++i) {
        const glm::dvec4 middle = unit_rotation(low + high, low);
        part *= 2;
        if (part >= 1) {
            part -= 1;
            low = middle;
        } else {
            high = middle;
        }
    }
    return unit_rotation(low + part * (high - low), low);
}

GltfSampler::Between GltfSampler::find(double time_s) const {
    if (!(time_s > times_s.front())) return {0, 0};
    if (time_s >= times_s.back()) return {times_s.size() - 1, 0};
    const auto next = std::upper_bound(times_s.begin(), times_s.end(), time_s);
    const auto key = static_cast<std::size_t>(next - times_s.begin()) - 1;
    return {key, (time_s - times_s[key]) / (times_s[key + 1] - times_s[key])};
}

std::span<const double> GltfSampler::value(std::size_t key) const {
    const bool is_spline = interpolation == GltfInterpolation::cubic_spline;
    return std::span(values).subspan((is_spline ? 3 * key + 1 : key) * width, width);
}

std::span<const double> GltfSampler::tangent(std::size_t key, bool is_out) const {
    return std::span(values).subspan((3 * key + (is_out ? 2 : 0)) * width, width);
}

/// Hermite's cubic between two keys. Tangents are per second.
double GltfSampler::spline(const Between& at, std::size_t number) const {
    const double u = at.part, u2 = u * u, u3 = u2 * u;
    const double seconds = times_s[at.key + 1] - times_s[at.key];
    return (2 * u3 - 3 * u2 + 1) * value(at.key)[number] + (u3 - 2 * u2 + u) * seconds * tangent(at.key, true)[number] +
           (3 * u2 - 2 * u3) * value(at.key + 1)[number] + (u3 - u2) * seconds * tangent(at.key + 1, false)[number];
}

void GltfSampler::sample(double time_s, std::span<double> numbers) const {
    const Between at = find(time_s);
    const std::span<const double> low = value(at.key);
    for (std::size_t i = 0; i < width; ++i) {
        if (at.part == 0 || interpolation == GltfInterpolation::step) {
            numbers[i] = low[i];
        } else if (interpolation == GltfInterpolation::cubic_spline) {
            numbers[i] = spline(at, i);
        } else {
            numbers[i] = (1 - at.part) * low[i] + at.part * value(at.key + 1)[i];
        }
    }
}

glm::dvec4 GltfSampler::sample_rotation(double time_s) const {
    const Between at = find(time_s);
    const glm::dvec4 low = unit_rotation(rotation_of(value(at.key)), kNoTurn);
    if (at.part == 0 || interpolation == GltfInterpolation::step) return low;
    if (interpolation == GltfInterpolation::linear)
        return slerp(low, unit_rotation(rotation_of(value(at.key + 1)), low), at.part);
    return unit_rotation({spline(at, 0), spline(at, 1), spline(at, 2), spline(at, 3)}, low);
}

}  // namespace burin
