#include "strokes/deep_shares.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include "strokes/line_shares.h"

namespace burin {
namespace {

/// Less is nothing: what sums of a filter's weights leave.
constexpr float kLeastShare = 1.0f / (1 << 21);
constexpr double kExactOfOne = static_cast<double>(std::int64_t{1} << 40);

std::int64_t exact_of(float value) {
    return static_cast<std::int64_t>(std::llround(static_cast<double>(value) * kExactOfOne));
}
/// Cuts off what a filter's negative lobes take away from lines that lie over all others, class by class, as coverages
/// on the film are, and then from those of one class.
void clamp_by_class(std::vector<LineShare>& lines) {
    std::array<float, kLineClassCount> wanted{}, positive{};
    for (const LineShare& line : lines) {
        if (line.is_below) continue;
        const auto c = static_cast<std::size_t>(line.drawn_as);
        wanted[c] += line.share;
        positive[c] += std::max(line.share, 0.0f);
    }
    float sum = 0, sum_of_positive = 0;
    for (float& share : wanted) {
        sum += share;
        share = std::max(share, 0.0f);
        sum_of_positive += share;
    }
    const float scale = sum_of_positive > 0 ? std::clamp(sum, 0.0f, 1.0f) / sum_of_positive : 0.0f;
    for (LineShare& line : lines) {
        if (line.is_below) continue;
        const auto c = static_cast<std::size_t>(line.drawn_as);
        line.share = positive[c] > 0 ? std::max(line.share, 0.0f) * (wanted[c] * scale / positive[c]) : 0.0f;
    }
}

double number_of_exact(std::int64_t sum) { return static_cast<double>(sum) / kExactOfOne; }

}  // namespace

void DeepShares::begin(PixelRect tile) {
    tile_ = tile;
    for (const std::uint32_t i : used_) {
        pixels_[i].kinds.clear();
        pixels_[i].opaque = 0;
    }
    used_.clear();
    const auto count = static_cast<std::size_t>(tile.width()) * static_cast<std::size_t>(tile.height());
    if (pixels_.size() < count) pixels_.resize(count);
}

void DeepShares::add_opaque(int x, int y, float share) {
    if (is_in_tile(x, y)) pixels_[number_of(x, y)].opaque += exact_of(share);
}

void DeepShares::add(int x, int y, const OwnerMasks::Line& line, const Place& place, const DeepInk& ink) {
    if (!is_in_tile(x, y)) return;
    Pixel& pixel = pixels_[number_of(x, y)];
    if (pixel.kinds.empty()) used_.push_back(number_of(x, y));
    const std::uint8_t invisibility = place.is_hidden ? line.invisibility : std::uint8_t{0};
    auto kind = std::find_if(pixel.kinds.begin(), pixel.kinds.end(), [&](const Kind& k) {
        return k.drawn_as == line.drawn_as && k.place.is_hidden == place.is_hidden &&
               k.place.is_below == place.is_below && k.place.is_behind == place.is_behind &&
               k.invisibility == invisibility && k.owner == line.owner;
    });
    if (kind == pixel.kinds.end())
        kind = pixel.kinds.insert(kind, Kind{line.drawn_as, place, invisibility, line.owner, {}});
    kind->place.distance = std::min(kind->place.distance, place.distance);
    kind->sums[0] += exact_of(ink.share);
    for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(c);
        kind->sums[1 + i] += exact_of(ink.color[c]);
        kind->sums[4 + i] += exact_of(ink.passes[c]);
        kind->sums[7 + i] += exact_of(ink.tint[c]);
    }
}

void DeepShares::finish(const Mattes& mattes, bool is_filtered, MatteBatch& batch) {
    std::sort(used_.begin(), used_.end());
    for (const std::uint32_t i : used_) {
        const int x = tile_.x0 + static_cast<int>(i) % tile_.width(),
                  y = tile_.y0 + static_cast<int>(i) / tile_.width();
        finish_pixel(pixels_[i], mattes.place_of(x, y), is_filtered, batch);
    }
}

void DeepShares::finish_pixel(Pixel& pixel, MattePlace place, bool is_filtered, MatteBatch& batch) {
    // Hidden ones come last: what is drawn over visible ones is none of them.
    std::sort(pixel.kinds.begin(), pixel.kinds.end(), [](const Kind& a, const Kind& b) {
        const auto key = [](const Kind& k) {
            return std::tuple(k.place.is_hidden, k.place.is_below, k.place.is_behind, k.drawn_as, k.owner.object,
                              k.owner.material, k.invisibility);
        };
        return key(a) < key(b);
    });
    const auto hidden =
        std::find_if(pixel.kinds.begin(), pixel.kinds.end(), [](const Kind& k) { return k.place.is_hidden; });
    const auto add = [&](std::span<const Kind> kinds, float opaque) {
        shares_.clear();
        for (const Kind& k : kinds) {
            shares_.push_back({place, k.drawn_as, k.place.is_hidden, k.place.is_below, 0, k.owner,
                               static_cast<float>(number_of_exact(k.sums[0]))});
        }
        if (is_filtered) clamp_by_class(shares_);
        bring_into_range(shares_, opaque, is_filtered);
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            const Kind& k = kinds[i];
            DeepLine line{shares_[i], k.place.is_behind, k.invisibility, k.place.distance, {}, {}, {}};
            if (!(line.line.share > kLeastShare) || k.sums[0] <= 0) continue;
            const auto per_share = [&](std::size_t first) {
                glm::vec3 value;
                for (int c = 0; c < 3; ++c) {
                    value[c] = static_cast<float>(static_cast<double>(k.sums[first + static_cast<std::size_t>(c)]) /
                                                  static_cast<double>(k.sums[0]));
                }
                return value;
            };
            line.color = glm::max(per_share(1), 0.0f);
            line.passes = per_share(4);
            line.tint = per_share(7);
            batch.deep_lines.push_back(line);
        }
    };
    add({pixel.kinds.begin(), hidden}, static_cast<float>(number_of_exact(pixel.opaque)));
    add({hidden, pixel.kinds.end()}, 0);
}

}  // namespace burin
