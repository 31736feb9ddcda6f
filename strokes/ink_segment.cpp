#include "strokes/ink_segment.h"

#include <algorithm>

#include "kernels/stroke_samples.h"
#include "shading/pen.h"

namespace burin {

float InkSegment::finest_px(StrokeSide side) {
    return static_cast<float>(Pen::kFinestWidthPx * (side == StrokeSide::both ? 1 : 2));
}

InkSegment::InkSegment(const InkPoint& from, const InkPoint& to, StrokeSide side)
    : from_(&from), to_(&to), along_(to.place - from.place) {
    const double square = glm::dot(along_, along_);
    per_square_ = square > 0 ? 1 / square : 0;
    finest_px_ = finest_px(side);
    if (std::max(from.opacity, to.opacity) <= 0 || std::max(from.width_px, to.width_px) <= 0) return;
    const auto add = [&](double first, double last, double radius_from, double radius_to, bool is_thin) {
        const glm::dvec2 a = first == 0 ? from.place : from.place + first * along_,
                         b = last == 1 ? to.place : from.place + last * along_;
        Part& part = parts_[part_count_++];
        part.cone = {{a.x, a.y}, {b.x, b.y}, radius_from, radius_to};
        part.is_thin = is_thin;
        radius_px_ = std::max({radius_px_, radius_from, radius_to});
    };
    if (from.width_px == to.width_px) {
        const Pen pen(from.width_px, side);
        strength_ = pen.strength;
        add(0, 1, pen.radius_px, pen.radius_px, from.width_px < finest_px_);
        return;
    }
    const double finest = 0.5 * static_cast<double>(finest_px_), a = 0.5 * static_cast<double>(from.width_px),
                 b = 0.5 * static_cast<double>(to.width_px);
    if ((a < finest) == (b < finest)) {
        add(0, 1, std::max(a, finest), std::max(b, finest), a < finest);
        return;
    }
    const double share = (finest - a) / (b - a);
    if (share > 0) add(0, share, std::max(a, finest), finest, a < finest);
    if (share < 1) add(share, 1, finest, std::max(b, finest), b < finest);
}

void InkSegment::cut(glm::dvec2 place, glm::dvec2 outward) {
    for (std::size_t i = 0; i < part_count_; ++i) {
        PenCone& cone = parts_[i].cone;
        if (cone.cut_count == 2) continue;
        cone.cuts[cone.cut_count++] = {{outward.x, outward.y}, glm::dot(outward, place)};
    }
}

PenCone InkSegment::Part::body() const {
    PenCone longer = cone;
    longer.body_only = true;
    const glm::dvec2 from(cone.from[0], cone.from[1]), to(cone.to[0], cone.to[1]);
    const double length = glm::distance(from, to);
    if (!(length > 0)) return longer;
    const glm::dvec2 along = (to - from) / length;
    const double wider = (cone.radius_from - cone.radius_to) / length;  // for each pixel towards its first end
    if (const double first = longer_px[0].value_or(0.0f); first > 0) {
        longer.from[0] -= first * along.x;
        longer.from[1] -= first * along.y;
        longer.radius_from += first * wider;
    }
    if (const double last = longer_px[1].value_or(0.0f); last > 0) {
        longer.to[0] += last * along.x;
        longer.to[1] += last * along.y;
        longer.radius_to -= last * wider;
    }
    return longer;
}

void InkSegment::join(Part& before, Part& after) {
    const auto way_of = [](const PenCone& c) { return glm::dvec2(c.to[0] - c.from[0], c.to[1] - c.from[1]); };
    const auto is_level_way = [](glm::dvec2 way) { return is_level(way.x, way.y); };
    const glm::dvec2 way_before = way_of(before.cone), way_after = way_of(after.cone);
    const double length_before = glm::length(way_before), length_after = glm::length(way_after);
    if (!(std::min(length_before, length_after) > 0) || is_level_way(way_before) != is_level_way(way_after) ||
        before.cone.cut_count + after.cone.cut_count > 0)
        return;
    const double slope_before = (before.cone.radius_from - before.cone.radius_to) / length_before,
                 slope_after = (after.cone.radius_from - after.cone.radius_to) / length_after;
    const double product = length_before * length_after;
    const double sine = std::abs(way_before.x * way_after.y - way_before.y * way_after.x) / product;
    // Between where both bodies touch the disc lies an angle of what the stroke turns, and of asin(slope_after) -
    // asin(slope_before). This is at least as large for slopes of at most 1/2 and angles of at most 1/4.
    const double angle = 1.02 * sine + 1.16 * std::max(slope_after - slope_before, 0.0);
    const double radius = before.cone.radius_to;
    // The sides of both bodies, made longer until they meet, lie outside of the disc by radius angle^2 / 8; their
    // corners, which go on a little, by at most 1/64.
    constexpr double kMostBeyondPx = 1.0 / 128, kMostAngle = 0.25, kMostSlope = 0.5;
    const double steeper = std::max(std::abs(slope_before), std::abs(slope_after));
    if (glm::dot(way_before, way_after) <= 0 || steeper > kMostSlope || angle > kMostAngle ||
        radius * angle * angle > 8 * kMostBeyondPx)
        return;
    constexpr double kOverlapPx = 1.0 / 64;  // for what rounding may leave between them
    // tan(angle / 2) along the sides, which are not along the way.
    const double longer = 0.503 * radius * angle / std::sqrt(1 - steeper * steeper) + kOverlapPx;
    if (longer > std::min(length_before, length_after)) return;
    before.longer_px[1] = after.longer_px[0] = static_cast<float>(longer);
}

bool InkSegment::changes_ink(const Part& part) const {
    if (from_->opacity != to_->opacity || from_->color != to_->color) return true;
    return part.is_thin && from_->width_px != to_->width_px;
}

float InkSegment::share_nearest(glm::dvec2 place) const {
    return static_cast<float>(std::clamp(glm::dot(place - from_->place, along_) * per_square_, 0.0, 1.0));
}

float InkSegment::alpha_at(float share) const {
    if (from_->width_px == to_->width_px) return strength_ * glm::mix(from_->opacity, to_->opacity, share);
    const float opacity = glm::mix(from_->opacity, to_->opacity, share);
    if (std::min(from_->width_px, to_->width_px) >= finest_px_) return opacity;
    return opacity * std::min(glm::mix(from_->width_px, to_->width_px, share) / finest_px_, 1.0f);
}

}  // namespace burin
