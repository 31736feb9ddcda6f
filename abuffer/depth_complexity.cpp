#include "abuffer/depth_complexity.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"

namespace burin {
namespace {

/// The area of a polygon on the screen, as far as it is in a region: it counts as spread evenly over its box.
template <typename Corners>
double area_px(const Corners& corners, std::size_t count, PixelRect region) {
    glm::dvec2 low(to_pixels(glm::dvec2(corners[0].x, corners[0].y))), high = low, before = low;
    double doubled = 0;
    for (std::size_t k = count; k-- > 0;) {
        const glm::dvec2 at = to_pixels(glm::dvec2(corners[k].x, corners[k].y));
        doubled += before.x * at.y - before.y * at.x;
        before = at;
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const auto part = [](double from, double to, double begin, double end) {
        return to > from ? std::max(std::min(to, end) - std::max(from, begin), 0.0) / (to - from) : 0.0;
    };
    return 0.5 * std::abs(doubled) * part(low.x, high.x, region.x0, region.x1) *
           part(low.y, high.y, region.y0, region.y1);
}

/// The area of all triangles that are not large. Chunks are added up in order: the same for any number of threads.
double small_area_px(const ScreenSurfaces& screen, PixelRect region, int threads) {
    const std::vector<TriangleChunk> chunks = screen.chunks_of_triangles(kChunkTriangles);
    std::vector<double> areas(chunks.size());
    parallel_for_parts(chunks.size(), threads, [&](std::size_t c, int) {
        for (std::uint32_t i = chunks[c].begin; i < chunks[c].end; ++i) {
            const SurfaceId s{chunks[c].instance, i};
            if (screen.facing(screen.number_of(s)) == off_screen) continue;
            const ScreenTriangle t = screen.triangle(s);
            const auto [x0, x1] = std::minmax({t.corners[0].x, t.corners[1].x, t.corners[2].x});
            const auto [y0, y1] = std::minmax({t.corners[0].y, t.corners[1].y, t.corners[2].y});
            if (x1 - x0 < kLargestSmallTriangle && y1 - y0 < kLargestSmallTriangle)
                areas[c] += area_px(t.corners, 3, region);
        }
    });
    double sum = 0;
    for (const double area : areas) sum += area;
    return sum;
}

/// More than all triangles that are not large can cover, counted by what no one of them exceeds.
double most_of_small_px(const ScreenSurfaces& screen) {
    constexpr double kLargestPx = static_cast<double>(kLargestSmallTriangle) / kSubpixelsPerPixel;
    return 0.5 * kLargestPx * kLargestPx * screen.triangle_count();
}

}  // namespace

void DepthComplexity::add(const ScreenSurfaces& screen, const TriangleBins& bins, PixelRect region, int threads) {
    if (!(limit_.surfaces_per_px > 0)) return;
    const PixelRect seen{std::max(region.x0, picture_.x0), std::max(region.y0, picture_.y0),
                         std::min(region.x1, picture_.x1), std::min(region.y1, picture_.y1)};
    const double picture_px = static_cast<double>(picture_.width()) * picture_.height();
    for (std::uint32_t i = 0; i < bins.large_count(); ++i) {
        const ScreenPolygon& polygon = bins.large(i).polygon;
        covered_px_ += area_px(polygon.corners, static_cast<std::size_t>(polygon.count), seen);
    }
    const double most_px = limit_.surfaces_per_px * picture_px;
    if (covered_px_ + most_of_small_px(screen) > most_px) covered_px_ += small_area_px(screen, seen, threads);
    if (covered_px_ <= most_px) return;
    const auto text = [](double count) { return std::to_string(static_cast<long long>(std::ceil(count))); };
    std::string message = text(covered_px_ / picture_px) + " surfaces lie over each pixel, on average, more than the " +
                          text(limit_.surfaces_per_px) + " that ";
    message += limit_.option.empty() ? "are allowed" : std::string(limit_.option) + " allows";
    message += ", and would take very long to draw; look for parts that are there many times, or give ";
    message += std::string(limit_.option) + " " + text(1.05 * covered_px_ / picture_px);
    throw InputError(message);
}

}  // namespace burin
