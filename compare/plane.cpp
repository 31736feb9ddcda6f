#include "compare/plane.h"

#include <cmath>

#include "base/parallel.h"

namespace burin {

float sample_bilinear(const Plane& plane, double x, double y) {
    const double fx = std::floor(x - 0.5), fy = std::floor(y - 0.5);
    const int x0 = static_cast<int>(fx), y0 = static_cast<int>(fy);
    const auto tx = static_cast<float>(x - 0.5 - fx), ty = static_cast<float>(y - 0.5 - fy);
    const float top = plane.clamped(x0, y0) * (1 - tx) + plane.clamped(x0 + 1, y0) * tx;
    const float bottom = plane.clamped(x0, y0 + 1) * (1 - tx) + plane.clamped(x0 + 1, y0 + 1) * tx;
    return top * (1 - ty) + bottom * ty;
}

Plane convolve(const Plane& plane, std::span<const float> kernel_x, std::span<const float> kernel_y, int threads) {
    const int rx = static_cast<int>(kernel_x.size() / 2), ry = static_cast<int>(kernel_y.size() / 2);
    const auto width = static_cast<std::size_t>(plane.width);
    Plane rows(plane.width, plane.height);
    const auto height = static_cast<std::size_t>(plane.height);
    // One pass over a row per kernel value keeps the sums in a fixed order and the loops simple.
    parallel_for(height, threads, [&](std::size_t y, int) {
        std::vector<float> padded(width + 2 * static_cast<std::size_t>(rx));
        for (std::size_t i = 0; i < padded.size(); ++i) {
            padded[i] = plane.clamped(static_cast<int>(i) - rx, static_cast<int>(y));
        }
        float* const out = rows.values.data() + y * width;
        for (std::size_t k = 0; k < kernel_x.size(); ++k) {
            const float* const in = padded.data() + k;
            const float weight = kernel_x[k];
            for (std::size_t x = 0; x < width; ++x) out[x] += weight * in[x];
        }
    });
    Plane result(plane.width, plane.height);
    parallel_for(height, threads, [&](std::size_t y, int) {
        float* const out = result.values.data() + y * width;
        for (std::size_t k = 0; k < kernel_y.size(); ++k) {
            const int row = std::clamp(static_cast<int>(y) + static_cast<int>(k) - ry, 0, plane.height - 1);
            const float* const in = rows.values.data() + static_cast<std::size_t>(row) * width;
            const float weight = kernel_y[k];
            for (std::size_t x = 0; x < width; ++x) out[x] += weight * in[x];
        }
    });
    return result;
}

std::vector<float> gaussian_kernel(double sigma, int radius) {
    std::vector<double> weights;
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) {
        weights.push_back(std::exp(-x * x / (2 * sigma * sigma)));
        sum += weights.back();
    }
    std::vector<float> kernel;
    for (const double w : weights) kernel.push_back(static_cast<float>(w / sum));
    return kernel;
}

Plane dilated(const Plane& plane) {
    Plane result(plane.width, plane.height);
    for (int y = 0; y < plane.height; ++y) {
        for (int x = 0; x < plane.width; ++x) {
            float largest = plane.at(x, y);
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    largest = std::max(largest, plane.clamped(x + dx, y + dy));
                }
            }
            result.at(x, y) = largest;
        }
    }
    return result;
}

Plane halved(const Plane& plane) {
    Plane result(plane.width / 2, plane.height / 2);
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            result.at(x, y) = 0.25f * (plane.at(2 * x, 2 * y) + plane.at(2 * x + 1, 2 * y) +
                                       plane.at(2 * x, 2 * y + 1) + plane.at(2 * x + 1, 2 * y + 1));
        }
    }
    return result;
}

}  // namespace burin
