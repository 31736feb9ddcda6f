#include "abuffer/samples/surface_beyond.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "abuffer/samples/fast_walk.h"

namespace burin {
namespace {

constexpr double kBesidePx = 0.5;

/// The id at the sample on the wanted side of a line through `middle` that is nearest to the place beside it.
std::uint32_t id_beside(const SampleTile& samples, glm::dvec2 middle, glm::dvec2 aside) {
    const double per_px = samples.samples_per_pixel;
    const glm::dvec2 place = middle + aside * kBesidePx;
    const auto nearest = [&](double at, double trifle, int first, int count) {
        const double index = std::round((at - trifle) * per_px - 0.5) - first;
        return static_cast<int>(std::clamp(index, 0.0, static_cast<double>(count - 1)));
    };
    const int column = nearest(place.x, kSampleTrifleX, samples.first_column, samples.columns),
              row = nearest(place.y, kSampleTrifleY, samples.first_row, samples.rows);
    std::uint32_t found = SampleTile::kBackground;
    double least = std::numeric_limits<double>::infinity();
    // A tile's rim cuts off what would be nearest: its neighbours may be on the line's other side.
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, samples.rows - 1); ++r) {
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, samples.columns - 1); ++c) {
            const glm::dvec2 at((samples.first_column + c + 0.5) / per_px + kSampleTrifleX,
                                (samples.first_row + r + 0.5) / per_px + kSampleTrifleY);
            if (glm::dot(at - middle, aside) <= 0 || glm::distance(at, place) >= least) continue;
            least = glm::distance(at, place);
            found = samples.ids[samples.index(samples.first_column + c, samples.first_row + r)];
        }
    }
    return found;
}

}  // namespace

void find_surfaces_beyond(const SampleTile& samples, std::span<LinePiece> pieces) {
    for (LinePiece& piece : pieces) {
        if (!piece.occludes) continue;
        const glm::dvec2 along = piece.to - piece.from;
        const double length = glm::length(along);
        if (length == 0) continue;
        // y runs down: what is to the left of the way (x, y) lies in direction (y, -x).
        const glm::dvec2 left(along.y / length, -along.x / length);
        const std::uint32_t id = id_beside(samples, 0.5 * (piece.from + piece.to), piece.front_on_left ? -left : left);
        piece.beyond = id == SampleTile::kBackground ? LinePiece::kNoSurface : id >> 1;
    }
}

}  // namespace burin
