#include "strokes/ink_regions.h"

#include <algorithm>
#include <limits>

namespace burin {

void InkStack::lay_below(const InkSpot& spot) {
    float alpha = spot.alpha;
    if (spot.is_share) {
        if (alpha <= shared_) return;
        const float before = shared_;
        shared_ = alpha;
        alpha = (alpha - before) / (1.0f - before);
    }
    const float seen = left * alpha;
    coverage[static_cast<std::size_t>(spot.drawn_as)] += seen;
    if (spot.multiplies) {
        tint = through * (alpha * spot.color) + tint * (1.0f - alpha);
        through *= 1.0f - alpha * (1.0f - spot.color);
    } else {
        color += through * (alpha * spot.color);
        through *= 1.0f - alpha;
        tint *= 1.0f - alpha;
    }
    left *= 1.0f - alpha;
}

InkStack InkStack::nothing() {
    InkStack stack;
    stack.scale(0);
    return stack;
}

void InkStack::scale(float factor) {
    for (glm::vec3* const v : {&color, &through, &tint}) *v *= factor;
    left *= factor;
    shared_ *= factor;
    for (float& c : coverage) c *= factor;
}

void InkStack::add(const InkStack& other, float weight) {
    color += weight * other.color;
    through += weight * other.through;
    tint += weight * other.tint;
    left += weight * other.left;
    shared_ += weight * other.shared_;
    for (std::size_t c = 0; c < coverage.size(); ++c) coverage[c] += weight * other.coverage[c];
}

void InkRegions::reset() {
    count_ = 1;
    for (std::uint32_t& row : regions_[0].mask.rows) row = ~0u;
    regions_[0].samples = kSamples;
    regions_[0].stack = {};
}

void InkRegions::lay_below(const InkSpot& spot) {
    constexpr StrokeMask kNothing{};
    for (std::size_t i = 0, end = count_; i < end; ++i) {
        Region& region = regions_[i];
        if (region.stack.left <= 0 && region.stack.through == glm::vec3(0.0f)) continue;
        StrokeMask inside;
        for (std::size_t r = 0; r < inside.rows.size(); ++r) inside.rows[r] = region.mask.rows[r] & spot.mask->rows[r];
        const int samples = kernels_->stroke.count_bits(inside.rows.data(), kNothing.rows.data());
        if (samples == 0) continue;
        if (samples < region.samples) {
            Region& rest = regions_[count_++];
            rest = region;
            rest.samples -= samples;
            for (std::size_t r = 0; r < inside.rows.size(); ++r) rest.mask.rows[r] &= ~inside.rows[r];
            region.mask = inside;
            region.samples = samples;
        }
        region.stack.lay_below(spot);
    }
    if (!in_place_) join_opaque();
    if (count_ > regions_.size() / 2) merge_most_alike();
}

/// Makes one of all regions that nothing is seen through: they will not differ any more.
void InkRegions::join_opaque() {
    const std::size_t none = regions_.size();
    std::size_t opaque = none;
    for (std::size_t i = 0; i < count_;) {
        const InkStack& stack = regions_[i].stack;
        if (stack.left > 0 || stack.through != glm::vec3(0.0f)) {
            ++i;
        } else if (opaque == none) {
            opaque = i++;
        } else {
            merge(opaque, i);
        }
    }
}

/// How much the mean of a pixel may be off if two of its regions become one.
float InkRegions::loss(const Region& a, const Region& b) {
    const glm::vec3 through = a.stack.through - b.stack.through, tint = a.stack.tint - b.stack.tint;
    const float left = a.stack.left - b.stack.left,
                square = glm::dot(through, through) + glm::dot(tint, tint) + left * left;
    const auto n = static_cast<float>(a.samples), m = static_cast<float>(b.samples);
    return square * n * m / (n + m);
}

/// Makes one region of the two most alike until there are no more than there may be. What each pair would lose is kept,
/// and found again only for regions that have changed.
void InkRegions::merge_most_alike() {
    const auto find = [&](std::size_t i) {
        for (std::size_t k = 0; k < i; ++k) losses_[i * regions_.size() + k] = loss(regions_[k], regions_[i]);
    };
    for (std::size_t i = 0; i < count_; ++i) find(i);
    while (count_ > regions_.size() / 2) {
        std::size_t first = 0, second = 1;
        float least = std::numeric_limits<float>::infinity();
        for (std::size_t i = 0; i < count_; ++i) {
            for (std::size_t k = i + 1; k < count_; ++k) {
                const float own = losses_[k * regions_.size() + i];
                if (own < least) least = own, first = i, second = k;
            }
        }
        merge(first, second);
        for (const std::size_t changed : {first, second}) {
            if (changed >= count_) continue;
            find(changed);
            for (std::size_t k = changed + 1; k < count_; ++k)
                losses_[k * regions_.size() + changed] = loss(regions_[changed], regions_[k]);
        }
    }
}

/// The last region takes the place of the second one.
void InkRegions::merge(std::size_t first, std::size_t second) {
    Region &a = regions_[first], &b = regions_[second];
    const auto n = static_cast<float>(a.samples), m = static_cast<float>(b.samples);
    a.stack.scale(n / (n + m));
    a.stack.add(b.stack, m / (n + m));
    for (std::size_t r = 0; r < a.mask.rows.size(); ++r) a.mask.rows[r] |= b.mask.rows[r];
    a.samples += b.samples;
    if (second + 1 < count_) b = regions_[count_ - 1];
    --count_;
}

InkStack InkRegions::mean() const {
    InkStack mean = InkStack::nothing();
    for (std::size_t i = 0; i < count_; ++i)
        mean.add(regions_[i].stack, static_cast<float>(regions_[i].samples) / kSamples);
    return mean;
}

}  // namespace burin
