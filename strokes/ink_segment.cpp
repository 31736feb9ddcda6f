#include "strokes/ink_segment.h"

#include <algorithm>

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

bool InkSegment::changes_ink(const Part& part) const {
    if (from_->opacity != to_->opacity || from_->color != to_->color) return true;
    return part.is_thin && from_->width_px != to_->width_px;
}

float InkSegment::share_nearest(glm::dvec2 place) const {
    return static_cast<float>(std::clamp(glm::dot(place - from_->place, along_) * per_square_, 0.0, 1.0));
}

float InkSegment::alpha_at(float share) const {
    if (from_->width_px == to_->width_px) return strength_ * glm::mix(from_->opacity, to_->opacity, share);
    const float width = glm::mix(from_->width_px, to_->width_px, share);
    return glm::mix(from_->opacity, to_->opacity, share) * std::min(width / finest_px_, 1.0f);
}

}  // namespace burin
