#include "strokes/tile_mattes.h"

#include <algorithm>
#include <cmath>

#include "strokes/line_shares.h"

namespace burin {
namespace {

constexpr double kExactUnit = static_cast<double>(std::int64_t{1} << 40);
constexpr float kMaskSamples = StrokeMask::kRows * StrokeMask::kColumns;

}  // namespace

TileMattes::TileMattes(const Frame& frame, Mattes& mattes, const FilterTable* filter, const TileKernels& kernels)
    : mattes_(mattes),
      filter_(filter),
      reach_(filter != nullptr ? FilterTable::kReach : 0),
      kernels_(kernels),
      projection_(frame.surfaces.projection),
      line_owners_(frame),
      owners_(kernels) {}

void TileMattes::begin(PixelRect tile) {
    tile_ = tile;
    owners_.reset({tile.x0 - reach_, tile.y0 - reach_, tile.x1 + reach_, tile.y1 + reach_});
    for (const std::uint32_t i : used_) {
        pixels_[i].kinds.clear();
        pixels_[i].opaque = 0;
    }
    used_.clear();
    const auto count = static_cast<std::size_t>(tile.width()) * static_cast<std::size_t>(tile.height());
    if (pixels_.size() < count) pixels_.resize(count);
    if (mattes_.wants_deep()) deep_.begin(tile);
}

void TileMattes::add_piece(const LinePiece& piece, double radius_px, double width_px, std::uint32_t group) {
    OwnerMasks::Line line;
    line.group = group;
    line.drawn_as = piece.drawn_as;
    line.invisibility = piece.invisibility;
    line.owner = line_owners_.of(piece);
    line.width_px = static_cast<float>(width_px);
    owners_.add({{piece.from.x, piece.from.y}, {piece.to.x, piece.to.y}, radius_px, radius_px}, piece.nearness_from,
                piece.nearness_to, line);
}

void TileMattes::add_to(int x, int y, const OwnerMasks::Line& line, const Kind& kind, float share) {
    if (x < tile_.x0 || y < tile_.y0 || x >= tile_.x1 || y >= tile_.y1) return;
    const auto i = static_cast<std::uint32_t>((y - tile_.y0) * tile_.width() + (x - tile_.x0));
    PixelShares& pixel = pixels_[i];
    if (pixel.kinds.empty()) used_.push_back(i);
    const auto exact = static_cast<ExactShare>(std::llround(static_cast<double>(share) * kExactUnit));
    if (kind.is_opaque) pixel.opaque += exact;
    for (auto& [known, sum] : pixel.kinds) {
        if (known.drawn_as != line.drawn_as || known.is_hidden != kind.is_hidden || known.is_below != kind.is_below ||
            known.set != kind.set || known.owner != line.owner)
            continue;
        sum += exact;
        return;
    }
    pixel.kinds.push_back(
        {{mattes_.place_of(x, y), line.drawn_as, kind.is_hidden, kind.is_below, kind.set, line.owner, 0}, exact});
}

template <typename Use>
void TileMattes::spread(int column, int row, const StrokeMask& samples, const Use& use) const {
    const int x = owners_.rect().x0 + column, y = owners_.rect().y0 + row;
    if (filter_ == nullptr) return use(x, y, static_cast<float>(count(samples)) / kMaskSamples);
    const FilterTable::Shares shares = filter_->shares_of(samples);
    for (int dy = 0; dy < FilterTable::kSide; ++dy) {
        for (int dx = 0; dx < FilterTable::kSide; ++dx) {
            use(x + dx - FilterTable::kReach, y + dy - FilterTable::kReach,
                shares[static_cast<std::size_t>(dy)][static_cast<std::size_t>(dx)]);
        }
    }
}

void TileMattes::add_share(int column, int row, const StrokeMask& samples, const OwnerMasks::Line& line,
                           const Kind& kind) {
    spread(column, row, samples, [&](int x, int y, float share) { add_to(x, y, line, kind, kind.strength * share); });
}

void TileMattes::add_deep(int column, int row, const StrokeMask& samples, const OwnerMasks::Line& line,
                          const Kind& kind, const DeepInk& ink) {
    const DeepShares::Place place{kind.is_hidden, kind.is_below, kind.is_behind,
                                  static_cast<float>(projection_.distance(static_cast<double>(line.nearness)))};
    spread(column, row, samples, [&](int x, int y, float share) {
        if (share == 0) return;
        deep_.add(x, y, line, place, ink.scaled(share));
        if (kind.is_opaque) deep_.add_opaque(x, y, ink.share * share);
    });
}

void TileMattes::add_spot(int column, int row, const OwnerMasks::Line& line, float coverage) {
    const int x = owners_.rect().x0 + column, y = owners_.rect().y0 + row;
    constexpr float kSpotSteps = 1 << 10;
    coverage = std::round(coverage * kSpotSteps) / kSpotSteps;  // what covers the same is told by its class
    if (!(coverage > 0) || x < tile_.x0 || y < tile_.y0 || x >= tile_.x1 || y >= tile_.y1) return;
    batch_.spots.push_back({mattes_.place_of(x, y), line.drawn_as, line.invisibility, line.owner,
                            static_cast<float>(projection_.distance(static_cast<double>(line.nearness))), line.width_px,
                            coverage});
}

void TileMattes::add(int column, int row, const StrokeMask& seen, const Kind& kind) {
    const bool is_flat = kind.use != MatteUse::deep, is_deep = kind.use != MatteUse::flat && mattes_.wants_deep();
    if (!is_deep && !(is_flat && (mattes_.wants_shares() || mattes_.wants_spots()))) return;
    owners_.split(column, row, kind.group, seen, [&](const OwnerMasks::Line& line, const StrokeMask& samples) {
        if (is_flat && mattes_.wants_shares()) add_share(column, row, samples, line, kind);
        if (is_flat && mattes_.wants_spots())
            add_spot(column, row, line, kind.strength * (static_cast<float>(count(samples)) / kMaskSamples));
        if (is_deep) add_deep(column, row, samples, line, kind, {kind.strength, kind.color * kind.strength, {}, {}});
    });
}

void TileMattes::finish() {
    std::sort(used_.begin(), used_.end());
    for (const std::uint32_t i : used_) {
        const auto to_float = [](ExactShare sum) { return static_cast<float>(static_cast<double>(sum) / kExactUnit); };
        lines_.clear();
        for (const KindShare& kind : pixels_[i].kinds) {
            lines_.push_back(kind.kind);
            lines_.back().share = to_float(kind.sum);
        }
        std::sort(lines_.begin(), lines_.end(),
                  [](const LineShare& a, const LineShare& b) { return key_of(a) < key_of(b); });
        bring_into_range(lines_, to_float(pixels_[i].opaque), filter_ != nullptr);
        for (LineShare& line : lines_) {
            line.share = in_share_steps(line.share);
            if (line.share > 0) batch_.lines.push_back(line);
        }
    }
    if (mattes_.wants_deep()) deep_.finish(mattes_, filter_ != nullptr, batch_);
    mattes_.add(batch_);
}

}  // namespace burin
