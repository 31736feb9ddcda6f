#include "output/paths/simplify.h"

#include <algorithm>
#include <utility>

namespace burin {

double distance_to_part(glm::dvec2 p, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 way = to - from;
    const double square = glm::dot(way, way);
    const double share = square > 0 ? std::clamp(glm::dot(p - from, way) / square, 0.0, 1.0) : 0.0;
    return glm::distance(p, from + way * share);
}

void simplify(std::span<const glm::dvec2> line, double bound_px, std::vector<glm::dvec2>& out) {
    // Parts of at most this many points are looked at as a whole, so that the work grows with the number of points.
    constexpr std::size_t kMostPoints = 256;
    if (line.empty()) return;
    const std::size_t before = out.size();
    out.push_back(line.front());
    std::vector<std::pair<std::size_t, std::size_t>> parts;  // the next one last
    for (std::size_t begin = 0; begin + 1 < line.size(); begin += kMostPoints) {
        parts.assign(1, {begin, std::min(begin + kMostPoints, line.size() - 1)});
        while (!parts.empty()) {
            const auto [first, last] = parts.back();
            parts.pop_back();
            double worst = bound_px;
            std::size_t at = first;
            for (std::size_t i = first + 1; i < last; ++i) {
                const double distance = distance_to_part(line[i], line[first], line[last]);
                if (distance <= worst) continue;
                worst = distance;
                at = i;
            }
            if (at != first) {
                parts.emplace_back(at, last);
                parts.emplace_back(first, at);
            } else if (line[last] != out.back()) {
                out.push_back(line[last]);
            }
        }
    }
    if (line.size() > 1 && out.size() == before + 1) out.push_back(line.back());
}

}  // namespace burin
