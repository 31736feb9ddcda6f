#include "strokes/pixel_filter.h"

#include <cmath>

namespace burin {
namespace {

/// The weight of a filter at a distance from the pixel's centre, in pixels. It is not normalised.
double value_at(PixelFilter filter, double distance_px) {
    const double x = std::abs(distance_px);
    if (x >= FilterTable::kReach) return 0;
    if (filter == PixelFilter::gaussian) {
        constexpr double kSigmaPx = 0.5;
        return std::exp(-0.5 * x * x / (kSigmaPx * kSigmaPx));
    }
    constexpr double kB = 1.0 / 3, kC = 1.0 / 3;
    if (x < 1) return ((12 - 9 * kB - 6 * kC) * x * x * x + (-18 + 12 * kB + 6 * kC) * x * x + 6 - 2 * kB) / 6;
    return ((-kB - 6 * kC) * x * x * x + (6 * kB + 30 * kC) * x * x + (-12 * kB - 48 * kC) * x + 8 * kB + 24 * kC) / 6;
}

/// What a sample at `position`, 0..1 within its pixel, gives to the pixels around along one axis.
std::array<double, FilterTable::kSide> weights_at(PixelFilter filter, double position) {
    std::array<double, FilterTable::kSide> weights{};
    double sum = 0;
    for (int d = -FilterTable::kReach; d <= FilterTable::kReach; ++d) {
        sum += weights[static_cast<std::size_t>(d + FilterTable::kReach)] = value_at(filter, position - d - 0.5);
    }
    for (double& w : weights) w /= sum;
    return weights;
}

}  // namespace

std::unique_ptr<const FilterTable> FilterTable::make(PixelFilter filter) {
    if (filter == PixelFilter::box) return nullptr;
    return std::unique_ptr<const FilterTable>(new FilterTable(filter));
}

FilterTable::FilterTable(PixelFilter filter) {
    for (std::size_t byte = 0; byte < kBytes; ++byte) {
        for (std::size_t value = 0; value < 256; ++value) {
            std::array<double, kSide> sum{};
            for (std::size_t bit = 0; bit < 8; ++bit) {
                if ((value >> bit & 1) == 0) continue;
                // stroke_row_shift() is left out: it is half a column at most, to either side in turns.
                const auto w = weights_at(filter, (static_cast<double>(8 * byte + bit) + 0.5) / StrokeMask::kColumns);
                for (std::size_t d = 0; d < kSide; ++d) sum[d] += w[d] / StrokeMask::kColumns;
            }
            for (std::size_t d = 0; d < kSide; ++d) columns_[byte][value][d] = static_cast<float>(sum[d]);
        }
    }
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        const auto w = weights_at(filter, (static_cast<double>(row) + 0.5) / StrokeMask::kRows);
        for (std::size_t d = 0; d < kSide; ++d) rows_[row][d] = static_cast<float>(w[d] / StrokeMask::kRows);
    }
}

FilterTable::Shares FilterTable::shares_of(const StrokeMask& mask) const {
    Shares shares{};
    for (std::size_t row = 0; row < mask.rows.size(); ++row) {
        const std::uint32_t bits = mask.rows[row];
        if (bits == 0) continue;
        std::array<float, kSide> along{};
        for (std::size_t byte = 0; byte < kBytes; ++byte) {
            const auto& part = columns_[byte][bits >> 8 * byte & 0xFF];
            for (std::size_t d = 0; d < kSide; ++d) along[d] += part[d];
        }
        for (std::size_t dy = 0; dy < kSide; ++dy) {
            for (std::size_t dx = 0; dx < kSide; ++dx) shares[dy][dx] += rows_[row][dy] * along[dx];
        }
    }
    return shares;
}

}  // namespace burin
