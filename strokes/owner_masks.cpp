#include "strokes/owner_masks.h"

#include <bit>

namespace burin {

namespace {

/// Lines that meet are equally near: rounding, which may be another in a crop, does not decide which comes first.
float roughly(float nearness) {
    constexpr std::uint32_t kLowBits = (1u << 12) - 1;
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearness) & ~kLowBits);
}

}  // namespace

void OwnerMasks::reset(PixelRect rect) {
    rect_ = rect;
    first_.assign(static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height()), kNone);
    records_.clear();
}

void OwnerMasks::add(const PenCone& cone, float nearness_from, float nearness_to, Line line) {
    const glm::dvec2 from(cone.from[0], cone.from[1]), along = glm::dvec2(cone.to[0], cone.to[1]) - from;
    const double square = glm::dot(along, along);
    one_.draw(kernels_, cone, rect_, [&](int column, int row, const StrokeMask& mask) {
        const glm::dvec2 middle(rect_.x0 + column + 0.5, rect_.y0 + row + 0.5);
        const double share = square > 0 ? std::clamp(glm::dot(middle - from, along) / square, 0.0, 1.0) : 0.0;
        line.nearness = glm::mix(nearness_from, nearness_to, static_cast<float>(share));
        std::uint32_t& first = first_[static_cast<std::size_t>(row * rect_.width() + column)];
        for (std::uint32_t i = first; i != kNone; i = records_[i].next) {
            Record& known = records_[i];
            if (!known.line.is_one_with(line)) continue;
            known.line.nearness = std::max(known.line.nearness, line.nearness);
            unite(known.mask, mask);
            return;
        }
        records_.push_back({line, first, mask});
        first = static_cast<std::uint32_t>(records_.size() - 1);
    });
}

void OwnerMasks::find(int column, int row, std::uint32_t group) {
    found_.clear();
    for (std::uint32_t i = first_[static_cast<std::size_t>(row * rect_.width() + column)]; i != kNone;
         i = records_[i].next) {
        if (records_[i].line.group == group) found_.push_back({&records_[i], {}});
    }
    const auto key = [](const Found& f) {
        const Line& line = f.record->line;
        return std::tuple(-roughly(line.nearness), line.drawn_as, line.owner.object, line.owner.material,
                          line.invisibility, line.width_px);
    };
    std::sort(found_.begin(), found_.end(), [&](const Found& a, const Found& b) { return key(a) < key(b); });
}

}  // namespace burin
