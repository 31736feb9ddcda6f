#include "output/paths/clip_line.h"

#include <algorithm>

namespace burin {

std::vector<ClippedPart> clipped_line(std::span<const glm::dvec2> line, glm::dvec2 low, glm::dvec2 high) {
    std::vector<ClippedPart> parts;
    double at_px = 0;
    bool goes_on = false;  // the last part ends where the next straight piece begins
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const glm::dvec2 from = line[i], way = line[i + 1] - from;
        const double length = glm::length(way);
        double begin = 0, end = 1;
        for (int k = 0; k < 2; ++k) {
            if (way[k] == 0) {
                if (from[k] < low[k] || from[k] > high[k]) end = -1;
                continue;
            }
            const double a = (low[k] - from[k]) / way[k], b = (high[k] - from[k]) / way[k];
            begin = std::max(begin, std::min(a, b));
            end = std::min(end, std::max(a, b));
        }
        if (begin <= end) {
            if (!goes_on || begin > 0)
                parts.push_back({{begin > 0 ? from + way * begin : from}, at_px + begin * length});
            parts.back().points.push_back(end < 1 ? from + way * end : line[i + 1]);
        }
        goes_on = begin <= end && end >= 1;
        at_px += length;
    }
    return parts;
}

}  // namespace burin
