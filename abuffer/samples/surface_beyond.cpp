#include "abuffer/samples/surface_beyond.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "abuffer/samples/fast_walk.h"

namespace burin {
namespace {

constexpr double kBesidePx = 0.5;

/// What is seen beside a line.
struct Beside {
    std::uint32_t id = SampleTile::kBackground;
    double nearness = 0;
};

/// What is at the sample on the wanted side of a line through `middle` that is nearest to the place beside it.
Beside seen_beside(const SampleTile& samples, glm::dvec2 middle, glm::dvec2 aside) {
    const double per_px = samples.samples_per_pixel;
    const glm::dvec2 place = middle + aside * kBesidePx;
    const auto nearest = [&](double at, double trifle, int first, int count) {
        const double index = std::round((at - trifle) * per_px - 0.5) - first;
        return static_cast<int>(std::clamp(index, 0.0, static_cast<double>(count - 1)));
    };
    const int column = nearest(place.x, kSampleTrifleX, samples.first_column, samples.columns),
              row = nearest(place.y, kSampleTrifleY, samples.first_row, samples.rows);
    Beside found;
    double least = std::numeric_limits<double>::infinity();
    // A tile's rim cuts off what would be nearest: its neighbours may be on the line's other side.
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, samples.rows - 1); ++r) {
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, samples.columns - 1); ++c) {
            const glm::dvec2 at((samples.first_column + c + 0.5) / per_px + kSampleTrifleX,
                                (samples.first_row + r + 0.5) / per_px + kSampleTrifleY);
            if (glm::dot(at - middle, aside) <= 0 || glm::distance(at, place) >= least) continue;
            least = glm::distance(at, place);
            const std::size_t index = samples.index(samples.first_column + c, samples.first_row + r);
            found = {samples.ids[index], static_cast<double>(samples.nearness[index])};
        }
    }
    return found;
}

/// Whether one place sees another surface beyond a line than the next: another object, the background, or a place that
/// is much farther away or nearer.
bool differ(const ScreenSurfaces& screen, const Projection& projection, const Beside& a, const Beside& b) {
    constexpr double kStepPx = 8;
    if (a.id == b.id) return false;
    if (a.id == SampleTile::kBackground || b.id == SampleTile::kBackground) return true;
    if (screen.surface_of(a.id >> 1).instance != screen.surface_of(b.id >> 1).instance) return true;
    const double depth_a = projection.distance(a.nearness), depth_b = projection.distance(b.nearness);
    return std::abs(depth_a - depth_b) > kStepPx * projection.pixel_size(std::min(depth_a, depth_b));
}

}  // namespace

void find_surfaces_beyond(const SampleTile& samples, const ScreenSurfaces& screen, const Projection& projection,
                          std::vector<LinePiece>& pieces) {
    const std::size_t count = pieces.size();
    for (std::size_t i = 0; i < count; ++i) {
        const LinePiece whole = pieces[i];
        if (!whole.occludes) continue;
        const glm::dvec2 along = whole.to - whole.from;
        const double length = glm::length(along);
        if (length == 0) continue;
        // y runs down: what is to the left of the way (x, y) lies in direction (y, -x).
        const glm::dvec2 left(along.y / length, -along.x / length), aside = whole.front_on_left ? -left : left;
        const auto seen_at = [&](double share) { return seen_beside(samples, whole.from + along * share, aside); };
        const int steps = std::clamp(static_cast<int>(std::ceil(length * samples.samples_per_pixel)), 1, 64);
        const auto add = [&](int first, int last) {
            const double from = static_cast<double>(first) / steps, to = static_cast<double>(last) / steps;
            LinePiece part = whole;
            const auto nearness = [&](double share) {
                return static_cast<float>(
                    glm::mix(static_cast<double>(whole.nearness_from), static_cast<double>(whole.nearness_to), share));
            };
            if (first > 0) {
                part.from = whole.from + along * from;
                part.nearness_from = nearness(from);
            }
            if (last < steps) {
                part.to = whole.from + along * to;
                part.nearness_to = nearness(to);
            }
            const std::uint32_t id = seen_at(0.5 * (from + to)).id;
            part.beyond = id == SampleTile::kBackground ? LinePiece::kNoSurface : id >> 1;
            if (first == 0) {
                pieces[i] = part;
            } else {
                pieces.push_back(part);
            }
        };
        int first = 0;
        Beside before = seen_at(0.5 / steps);
        for (int k = 1; k < steps; ++k) {
            const Beside next = seen_at((k + 0.5) / steps);
            if (differ(screen, projection, before, next)) {
                add(first, k);
                first = k;
            }
            before = next;
        }
        add(first, steps);
    }
}

}  // namespace burin
