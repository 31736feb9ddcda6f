#include "abuffer/fine/drawn_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/vectors.h"

namespace burin {
namespace {

/// Where very many lines have different places, none stands for another one.
constexpr std::size_t kMostParts = 64;

int axis_of(glm::dvec2 way) { return std::abs(way.x) >= std::abs(way.y) ? 0 : 1; }

}  // namespace

DrawnParts::Part DrawnParts::part_of(const WholeLine& line, double begin, double end, Kind kind) {
    const int axis = axis_of(line.to - line.from);
    Part part{
        line.from, line.to, line.at(begin)[axis], line.at(end)[axis], line.nearness_at(begin), line.nearness_at(end),
        kind};
    if (part.end < part.begin) {
        std::swap(part.begin, part.end);
        std::swap(part.nearness_begin, part.nearness_end);
        part.kind.front_on_left = !kind.front_on_left;
    }
    return part;
}

void DrawnParts::add(const WholeLine& line, double begin, double end, Kind kind) {
    if (parts_.size() < kMostParts) parts_.push_back(part_of(line, begin, end, kind));
}

/// Whether a part is behind another one where both are.
bool DrawnParts::is_behind(const Part& part, const Part& other, double level) {
    const auto nearness_at = [](const Part& p, double place) {
        const double share = p.end > p.begin ? (place - p.begin) / (p.end - p.begin) : 0;
        return p.nearness_begin + (p.nearness_end - p.nearness_begin) * share;
    };
    const auto is_behind_at = [&](double place) {
        return nearness_at(part, place) <= nearness_at(other, place) + level;
    };
    return is_behind_at(std::max(part.begin, other.begin)) && is_behind_at(std::min(part.end, other.end));
}

bool DrawnParts::cover(const WholeLine& line, double begin, double end, Kind kind, double level) const {
    if (parts_.empty()) return false;
    const Part part = part_of(line, begin, end, kind);
    const glm::dvec2 along = part.to - part.from;
    const auto goes_on = [&](const Part& other, double reached) {
        return other.begin <= reached && other.end > reached && other.kind == part.kind &&
               cross(along, other.from - part.from) == 0 && cross(along, other.to - part.from) == 0 &&
               axis_of(other.to - other.from) == axis_of(along) && is_behind(part, other, level);
    };
    for (double reached = part.begin;;) {
        const auto next =
            std::find_if(parts_.begin(), parts_.end(), [&](const Part& p) { return goes_on(p, reached); });
        if (next == parts_.end()) return false;
        reached = next->end;
        if (reached >= part.end) return true;
    }
}

}  // namespace burin
