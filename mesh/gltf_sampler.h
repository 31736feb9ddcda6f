#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

// Values between the keys of a glTF animation.

namespace burin {

/// What a value does between two keys.
enum class GltfInterpolation : std::uint8_t { step, linear, cubic_spline };

/// The keys of an animation, checked: one value of `width` numbers at each time.
struct GltfSampler {
    GltfInterpolation interpolation = GltfInterpolation::linear;
    std::size_t width = 1;
    std::vector<double> times_s;  ///< at least one, each greater than the one before
    /// Per key a value; of a cubic spline in-tangent, value and out-tangent.
    std::vector<double> values;

    /// The numbers at a time; before the first key and after the last one, those of that key.
    void sample(double time_s, std::span<double> numbers) const;
    /// The same for a quaternion (x, y, z, w), at unit length: linear means spherically so.
    glm::dvec4 sample_rotation(double time_s) const;

  private:
    struct Between {
        std::size_t key = 0;  // the last one that is not after the time
        double part = 0;      // of the way to the next one
    };
    Between find(double time_s) const;
    std::span<const double> value(std::size_t key) const;
    std::span<const double> tangent(std::size_t key, bool is_out) const;
    double spline(const Between& at, std::size_t number) const;
};

/// The rotation a part of the shorter way from one to another, all of unit length. It uses no trigonometric functions,
/// whose last bits differ between computers.
glm::dvec4 slerp(const glm::dvec4& from, glm::dvec4 to, double part);

}  // namespace burin
