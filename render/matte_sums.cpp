#include "render/matte_sums.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "render/seen_parts.h"

namespace burin {
namespace {

/// Where lines leave nothing of a surface, it is as if they left so much: its colour and distance are wanted. What is
/// seen of its share is more.
constexpr double kFaint = 1e-9, kSeen = 1e-6;

}  // namespace

MatteSums::MatteSums(PixelRect crop, const Mattes& mean)
    : crop_(crop),
      wants_shares_(mean.wants_shares()),
      wants_deep_(mean.wants_deep()),
      bands_(static_cast<std::size_t>((crop.height() + Mattes::kBlockPx - 1) / Mattes::kBlockPx)) {}

PixelRect MatteSums::rows_of(std::size_t band) const {
    PixelRect rows = crop_;
    rows.y0 += static_cast<int>(band) * Mattes::kBlockPx;
    rows.y1 = std::min(rows.y0 + Mattes::kBlockPx, crop_.y1);
    return rows;
}

/// Adds sums of one picture, in any order, to those of the ones before.
void MatteSums::merge(Sums& more, Sums& sums) {
    const auto is_before = [](const Sum& a, const Sum& b) { return a.key.rank() < b.key.rank(); };
    std::stable_sort(more.begin(), more.end(), is_before);
    Sums merged;
    merged.reserve(sums.size() + more.size());
    std::merge(sums.begin(), sums.end(), more.begin(), more.end(), std::back_inserter(merged), is_before);
    sums.clear();
    for (const Sum& sum : merged) {
        if (sums.empty() || sums.back().key.rank() != sum.key.rank()) {
            sums.push_back(sum);
            continue;
        }
        sums.back().share += sum.share;
        sums.back().distance += sum.distance;
        sums.back().color += sum.color;
        sums.back().alone += sum.alone;
    }
}

void MatteSums::add_flat(const Mattes& picture, PixelRect rows, Sums& sums) const {
    Sums own;
    picture.for_pixels(rows, [&](const Mattes::Pixel& pixel) {
        Key key;
        key.pixel = static_cast<std::uint32_t>((pixel.y - rows.y0) * rows.width() + (pixel.x - rows.x0));
        for (const SurfaceShare& s : pixel.surfaces) {
            key.owner = s.owner;
            own.push_back({key, static_cast<double>(s.share)});
        }
        key.is_line = true;
        for (const LineShare& s : pixel.lines) {
            key.owner = s.owner;
            key.is_hidden = s.is_hidden;
            key.drawn_as = s.drawn_as;
            key.set = s.set;
            own.push_back({key, static_cast<double>(s.share)});
        }
    });
    merge(own, sums);
}

void MatteSums::add_deep(const Mattes& picture, PixelRect rows, Sums& sums) const {
    Sums own;
    picture.for_deep_pixels(rows, [&](const Mattes::DeepPixel& pixel) {
        const LeftByLines left(pixel);
        Key key;
        key.pixel = static_cast<std::uint32_t>((pixel.y - rows.y0) * rows.width() + (pixel.x - rows.x0));
        glm::dvec3 color(0.0);
        double covered = 0;
        for (const DeepSurface& s : pixel.surfaces) {
            color += glm::dvec3(s.color);
            covered += static_cast<double>(s.share);
            key.owner = s.owner;
            key.is_opaque = s.is_opaque;
            const double seen = left.all > 0 ? left.all : kFaint, alone = static_cast<double>(s.share);
            own.push_back(
                {key, alone * seen, static_cast<double>(s.distance) * alone * seen, glm::dvec3(s.color) * seen, alone});
        }
        key.is_line = true;
        key.is_opaque = false;
        for (const DeepLine& s : pixel.lines) {
            key.owner = s.line.owner;
            key.is_hidden = s.line.is_hidden;
            key.is_behind = s.is_behind;
            key.drawn_as = s.line.drawn_as;
            key.invisibility = s.invisibility;
            const double share = s.line.is_hidden ? static_cast<double>(s.line.share) : left.seen_of(s);
            own.push_back({key, share, static_cast<double>(s.distance) * share, color_over(s, color, covered) * share});
        }
    });
    merge(own, sums);
}

void MatteSums::add(const Mattes& picture, std::size_t band) {
    const PixelRect rows = rows_of(band);
    if (wants_shares_) add_flat(picture, rows, bands_[band].flat);
    if (wants_deep_) add_deep(picture, rows, bands_[band].deep);
}

void MatteSums::add_all(const Mattes& picture, int threads) {
    parallel_for(bands_.size(), threads, [&](std::size_t band, int) { add(picture, band); });
}

void MatteSums::put_flat(const Sums& sums, PixelRect rows, double count, const Mattes& mean, MatteBatch& batch) const {
    for (const Sum& sum : sums) {
        const Key& key = sum.key;
        const int x = rows.x0 + static_cast<int>(key.pixel) % rows.width(),
                  y = rows.y0 + static_cast<int>(key.pixel) / rows.width();
        const auto share = static_cast<float>(sum.share / count);
        if (!key.is_line) {
            mean.put_surface(x, x + 1, y, key.owner, share, false, batch);
        } else {
            batch.lines.push_back({mean.place_of(x, y), key.drawn_as, key.is_hidden, false, key.set, key.owner, share});
        }
    }
}

void MatteSums::put_deep(const Sums& sums, PixelRect rows, double count, const Mattes& mean, MatteBatch& batch) const {
    for (const Sum& sum : sums) {
        if (!(sum.share > 0)) continue;
        const Key& key = sum.key;
        const MattePlace place = mean.place_of(rows.x0 + static_cast<int>(key.pixel) % rows.width(),
                                               rows.y0 + static_cast<int>(key.pixel) / rows.width());
        const auto share = static_cast<float>(sum.share / count),
                   distance = static_cast<float>(sum.distance / sum.share);
        if (!key.is_line) {
            const bool is_seen = sum.share > kSeen * sum.alone;
            batch.deep_surfaces.push_back({place, false, key.is_opaque, key.owner, is_seen ? share : 0.0f, distance,
                                           glm::vec3(sum.color / count * (is_seen ? 1.0 : sum.alone / sum.share)),
                                           static_cast<float>(sum.alone / count)});
            continue;
        }
        batch.deep_lines.push_back({{place, key.drawn_as, key.is_hidden, false, 0, key.owner, share},
                                    key.is_behind,
                                    key.invisibility,
                                    distance,
                                    glm::vec3(sum.color / sum.share),
                                    glm::vec3(0.0f),
                                    glm::vec3(0.0f)});
    }
}

void MatteSums::put_mean(int count, Mattes& mean, int threads) {
    parallel_for(bands_.size(), threads, [&](std::size_t band, int) {
        MatteBatch batch;
        put_flat(bands_[band].flat, rows_of(band), count, mean, batch);
        put_deep(bands_[band].deep, rows_of(band), count, mean, batch);
        mean.add(batch);
        bands_[band] = {};
    });
}

}  // namespace burin
