#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

// Metrics work on pictures of one number per pixel.

namespace burin {

/// A picture of one number per pixel, row by row from the top.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<float> values;

    Plane() = default;
    Plane(int w, int h, float value = 0)
        : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
    float& at(int x, int y) { return values[index(x, y)]; }
    float at(int x, int y) const { return values[index(x, y)]; }
    /// Beyond the border the nearest pixel counts.
    float clamped(int x, int y) const { return at(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1)); }
};

/// Linear interpolation between pixel centres (at +0.5); beyond the border the nearest pixel
/// counts.
float sample_bilinear(const Plane& plane, double x, double y);

/// Separable convolution; both kernels have an odd number of values, the border is replicated.
Plane convolve(const Plane& plane, std::span<const float> kernel_x, std::span<const float> kernel_y, int threads);

/// 2 r + 1 values of exp(-x^2 / (2 sigma^2)), with sum 1.
std::vector<float> gaussian_kernel(double sigma, int radius);

/// The larger value of each pixel and its eight neighbours.
Plane dilated(const Plane& plane);

/// Half the size, the mean of 2x2 pixels each; an odd last row or column is left out.
Plane halved(const Plane& plane);

}  // namespace burin
