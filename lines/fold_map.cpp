#include "lines/fold_map.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lines/contour_grid.h"

namespace burin {
namespace {

/// An edge is looked at in steps of kStepPx, or in kMostStepsOfEdge steps if these are longer.
constexpr double kStepPx = 0.25, kMostStepsOfEdge = 2048;
/// A contour is followed from one foot to the next one unless that is more than this many times as long as the
/// straight way, and longer than this: then it goes elsewhere, and comes back.
constexpr double kLongestDetour = 4, kShortDetourPx = 3;
/// Where a contour ends beside an edge, the edge goes on: straight to its own end, if that is no
/// farther than this many times the way over to it.
constexpr double kShortRest = 3;
/// How long a way from a contour over to where an edge ends is on the contour, in lengths of the
/// step that it replaces.
constexpr double kSlant = 2;

}  // namespace

FoldMap::Foot FoldMap::nearest(std::span<const ContourChain> chains, glm::dvec2 place) {
    Foot best{place};
    double least = 1e300;
    for (std::size_t c = 0; c < chains.size(); ++c) {
        const ContourChain& chain = chains[c];
        const std::size_t last = chain.points.size() - 1;
        for (std::size_t i = 0; i < last; ++i) {
            const glm::dvec2 a = chain.points[i], along = chain.points[i + 1] - a;
            const double share = std::clamp(glm::dot(place - a, along) / glm::dot(along, along), 0.0, 1.0);
            const glm::dvec2 foot = on_contour_grid(a + along * share);
            const double square = glm::dot(place - foot, place - foot);
            if (!(square < least)) continue;
            least = square;
            const bool is_beyond_end = !chain.is_closed() && ((i == 0 && share == 0) || (i + 1 == last && share == 1));
            best =
                is_beyond_end ? Foot{place} : Foot{foot, c, i, glm::mix(chain.lengths[i], chain.lengths[i + 1], share)};
        }
    }
    return best;
}

/// Adds the points of a chain on the way from one foot to another.
void FoldMap::follow(const ContourChain& chain, const Foot& a, double share_a, const Foot& b, double share_b) {
    const double straight = glm::distance(a.place, b.place), whole = chain.length();
    double way = b.length - a.length;
    if (chain.is_closed() && std::abs(way) > 0.5 * whole) way -= std::copysign(whole, way);
    if (std::abs(way) > std::max(kLongestDetour * straight, kShortDetourPx)) return;
    const std::size_t count = chain.points.size() - 1;  // of segments
    const auto add = [&](std::size_t point, double length) {
        stops_.push_back(
            {glm::mix(share_a, share_b, std::clamp(length / std::abs(way), 0.0, 1.0)), chain.points[point], false});
    };
    double passed = 0;
    glm::dvec2 at = a.place;
    if (way > 0) {
        for (std::size_t i = a.after; i != b.after;) {
            i = i + 1 == count && chain.is_closed() ? 0 : i + 1;
            const glm::dvec2 point = chain.points[i];
            passed += glm::distance(at, point);
            add(i, passed);
            at = point;
        }
    } else if (way < 0) {
        for (std::size_t i = a.after; i != b.after; i = i == 0 ? count - 1 : i - 1) {
            const glm::dvec2 point = chain.points[i];
            passed += glm::distance(at, point);
            add(i, passed);
            at = point;
        }
    }
}

FoldMap::FoldMap(glm::dvec2 from, glm::dvec2 to, std::span<const ContourChain> chains, double farthest_px)
    : from_(from), to_(to) {
    const double length = glm::distance(from, to);
    if (chains.empty() || !(length > 0)) return;
    const double steps = std::clamp(std::ceil(length / kStepPx), 1.0, kMostStepsOfEdge);
    std::vector<Foot> feet;
    for (double i = 0; i <= steps; ++i) feet.push_back(nearest(chains, glm::mix(from, to, i / steps)));
    const auto is_off = [](const Foot& foot) { return foot.chain == Foot::kNoChain; };
    const auto share = [&](std::size_t i) { return static_cast<double>(i) / steps; };
    const auto place = [&](std::size_t i) { return glm::mix(from, to, share(i)); };
    bool is_near = false;
    for (std::size_t i = 0; i < feet.size(); ++i)
        is_near = is_near || (!is_off(feet[i]) && glm::distance(feet[i].place, place(i)) < farthest_px);
    if (!is_near) return;
    for (std::size_t i = 0; i < feet.size();) {
        std::size_t end = i + 1;  // of feet on one chain, or of places beside none
        while (end < feet.size() && feet[end].chain == feet[i].chain) ++end;
        if (!is_off(feet[i])) {
            const ContourChain& chain = chains[feet[i].chain];
            stops_.push_back({share(i), feet[i].place, false});
            for (std::size_t k = i; k + 1 < end; ++k) {
                follow(chain, feet[k], share(k), feet[k + 1], share(k + 1));
                stops_.push_back({share(k + 1), feet[k + 1].place, false});
            }
        } else {
            const double rest = glm::distance(place(i), place(end - 1));
            double over = 0;
            if (i > 0) over = std::max(over, glm::distance(feet[i - 1].place, place(i)));
            if (end < feet.size()) over = std::max(over, glm::distance(feet[end].place, place(end - 1)));
            const bool is_short = rest <= kShortRest * over;
            // A short edge beside contours on both sides leaves nothing over.
            if (i == 0 || !is_short) stops_.push_back({share(i), place(i), true});
            if (end == feet.size() || !is_short) stops_.push_back({share(end - 1), place(end - 1), true});
        }
        i = end;
    }
    straighten();
}

/// Leaves out what lies on the straight way between others.
void FoldMap::straighten() {
    constexpr double kOffPx = 1.0 / 1024;
    std::vector<Stop> kept;
    for (std::size_t i = 0; i < stops_.size(); ++i) {
        const Stop& s = stops_[i];
        if (!kept.empty() && i + 1 < stops_.size() && kept.back().is_on_edge == s.is_on_edge &&
            stops_[i + 1].is_on_edge == s.is_on_edge) {
            // Stops between that are gone already are no farther from it than by as much again.
            const Stop &a = kept.back(), &b = stops_[i + 1];
            const double range = b.share - a.share;
            if (range > 0 && glm::distance(s.place, glm::mix(a.place, b.place, (s.share - a.share) / range)) <= kOffPx)
                continue;
        }
        kept.push_back(s);
    }
    stops_ = std::move(kept);
}

void FoldMap::lead_to_end(glm::dvec2 place) {
    const bool is_first = glm::distance(place, from_) < glm::distance(place, to_);
    constexpr double kAtEndPx = 0.5;
    if (stops_.empty() || glm::distance(place, is_first ? from_ : to_) > kAtEndPx) return;
    if (is_first) std::reverse(stops_.begin(), stops_.end());
    const Stop end{is_first ? 0.0 : 1.0, is_first ? from_ : to_, true};
    double whole = 0;
    for (std::size_t i = 1; i < stops_.size(); ++i) whole += glm::distance(stops_[i - 1].place, stops_[i].place);
    double rest = std::min(kSlant * glm::distance(stops_.back().place, end.place), 0.5 * whole);
    while (stops_.size() > 1) {
        const Stop last = stops_.back(), &before = stops_[stops_.size() - 2];
        const double length = glm::distance(before.place, last.place);
        if (length >= rest) {
            const double part = length > 0 ? rest / length : 0;
            stops_.back() = {glm::mix(last.share, before.share, part),
                             on_contour_grid(glm::mix(last.place, before.place, part)), false};
            break;
        }
        rest -= length;
        stops_.pop_back();
    }
    stops_.push_back(end);
    if (is_first) std::reverse(stops_.begin(), stops_.end());
}

double FoldMap::share_of(glm::dvec2 place) const {
    const glm::dvec2 along = to_ - from_;
    return std::clamp(glm::dot(place - from_, along) / glm::dot(along, along), 0.0, 1.0);
}

std::vector<glm::dvec2> FoldMap::moved(glm::dvec2 from, glm::dvec2 to) const {
    double first = share_of(from), last = share_of(to);
    const bool is_backwards = last < first;
    if (is_backwards) {
        std::swap(first, last);
        std::swap(from, to);
    }
    // The place to which a share of the edge is moved: if there are two, the one that comes first or last.
    const auto between = [&](const Stop& a, const Stop& b, double share, glm::dvec2 given) {
        if (a.is_on_edge && b.is_on_edge) return given;
        const double range = b.share - a.share;
        return on_contour_grid(range > 0 ? glm::mix(a.place, b.place, (share - a.share) / range) : a.place);
    };
    const auto is_after = [](double share, const Stop& s) { return share < s.share; };
    const auto is_before = [](const Stop& s, double share) { return s.share < share; };
    const auto begin = std::upper_bound(stops_.begin(), stops_.end(), first, is_after);  // behind it
    const auto end = std::max(begin, std::lower_bound(stops_.begin(), stops_.end(), last,
                                                      is_before));  // at it or behind it
    std::vector<glm::dvec2> points;
    const auto place_of = [&](auto behind, double share, glm::dvec2 given) {
        if (behind == stops_.begin()) return stops_.front().is_on_edge ? given : stops_.front().place;
        if (behind == stops_.end()) return stops_.back().is_on_edge ? given : stops_.back().place;
        return between(*(behind - 1), *behind, share, given);
    };
    points.push_back(place_of(begin, first, from));
    for (auto it = begin; it != end; ++it) points.push_back(it->place);
    points.push_back(place_of(end, last, to));
    if (is_backwards) std::reverse(points.begin(), points.end());
    return points;
}

}  // namespace burin
