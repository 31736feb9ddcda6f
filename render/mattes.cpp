#include "render/mattes.h"

#include <algorithm>
#include <tuple>

namespace burin {
namespace {

auto key_of(const SurfaceShare& s) {
    return std::tuple(s.place.pixel, s.is_transparent, s.owner.object, s.owner.material, s.share);
}
/// The one that covers most comes first; of equal ones, by class.
auto key_of(const LineSpot& s) {
    return std::tuple(s.place.pixel, -s.coverage, s.drawn_as, s.invisibility, s.owner.object, s.owner.material,
                      s.distance, s.width_px);
}

auto key_of(const DeepSurface& s) {
    return std::tuple(s.place.pixel, s.is_transparent, s.distance, s.owner.object, s.owner.material, s.share);
}

const MattePlace& matte_place_of(const DeepLine& line) { return line.line.place; }
template <typename Record>
const MattePlace& matte_place_of(const Record& record) {
    return record.place;
}

/// Pixels have one record mostly: what is sorted is those of each.
template <typename Record, std::size_t kCount>
std::vector<Record> sorted_by_pixel(const std::vector<Record>& records, std::array<std::uint32_t, kCount>& first) {
    for (const Record& r : records) ++first[matte_place_of(r).pixel + 1u];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    std::array<std::uint32_t, kCount> at = first;
    std::vector<Record> sorted(records.size());
    for (const Record& r : records) sorted[at[matte_place_of(r).pixel]++] = r;
    for (std::size_t i = 1; i < first.size(); ++i) {
        if (first[i] - first[i - 1] < 2) continue;
        const auto begin = sorted.begin();
        std::sort(begin + first[i - 1], begin + first[i],
                  [](const Record& a, const Record& b) { return key_of(a) < key_of(b); });
    }
    return sorted;
}

}  // namespace

Mattes::Mattes(PixelRect crop, const MatteWishes& wishes)
    : crop_(crop),
      wishes_(wishes),
      columns_(static_cast<std::uint32_t>((std::max(crop.width(), 0) + kBlockPx - 1) / kBlockPx)),
      blocks_(std::size_t{columns_} *
              static_cast<std::size_t>((std::max(crop.height(), 0) + kBlockPx - 1) / kBlockPx)) {}

void Mattes::put_surface(int x0, int x1, int y, MatteOwner owner, float share, bool is_transparent,
                         MatteBatch& batch) const {
    for (int x = x0; x < x1;) {
        const int end = std::min(x1, crop_.x0 + ((x - crop_.x0) / kBlockPx + 1) * kBlockPx);
        batch.surfaces.push_back({place_of(x, y), static_cast<std::uint16_t>(end - x), is_transparent, owner, share});
        x = end;
    }
}

template <typename Record>
void Mattes::move_to_blocks(std::vector<Record>& records, std::vector<Record> Block::*list) {
    for (std::size_t i = 0; i < records.size();) {
        const std::uint32_t number = matte_place_of(records[i]).block;
        const std::lock_guard lock(mutexes_[number % mutexes_.size()]);
        std::unique_ptr<Block>& block = blocks_[number];
        if (block == nullptr) block = std::make_unique<Block>();
        for (; i < records.size() && matte_place_of(records[i]).block == number; ++i)
            ((*block).*list).push_back(records[i]);
    }
}

void Mattes::add(MatteBatch& batch) {
    move_to_blocks(batch.surfaces, &Block::surfaces);
    move_to_blocks(batch.lines, &Block::lines);
    move_to_blocks(batch.spots, &Block::spots);
    move_to_blocks(batch.deep_surfaces, &Block::deep_surfaces);
    move_to_blocks(batch.deep_lines, &Block::deep_lines);
    batch.clear();
}

void Mattes::close(std::size_t row) {
    for (std::size_t i = row * columns_; i < (row + 1) * columns_ && i < blocks_.size(); ++i) blocks_[i].reset();
}

void Mattes::begin_mean() {
    is_mean_ = true;
    for (std::unique_ptr<Block>& block : blocks_) {
        if (block == nullptr) continue;
        auto rest = std::make_unique<Block>();
        rest->spots = std::move(block->spots);
        block = std::move(rest);
    }
}

void Mattes::clear() {
    is_mean_ = false;
    for (std::unique_ptr<Block>& block : blocks_) block.reset();
}

Mattes::Sorted::Sorted(const Block& block, bool is_mean)
    : lines_(sorted_by_pixel(block.lines, first_line_)),
      spots_(sorted_by_pixel(block.spots, first_spot_)),
      is_mean_(is_mean) {
    std::vector<SurfaceShare> ones;
    for (const SurfaceShare& run : block.surfaces) {
        for (unsigned i = 0; i < run.count; ++i) {
            SurfaceShare& one = ones.emplace_back(run);
            one.place.pixel = static_cast<std::uint16_t>(run.place.pixel + i);
            one.count = 1;
        }
    }
    surfaces_ = sorted_by_pixel(ones, first_surface_);
}

bool Mattes::Sorted::has_any(std::uint16_t place) const {
    const std::size_t i = place;
    return first_surface_[i] < first_surface_[i + 1] || first_line_[i] < first_line_[i + 1] ||
           first_spot_[i] < first_spot_[i + 1];
}

Mattes::SortedDeep::SortedDeep(const Block& block, bool is_mean)
    : surfaces_(sorted_by_pixel(block.deep_surfaces, first_surface_)),
      lines_(sorted_by_pixel(block.deep_lines, first_line_)),
      is_mean_(is_mean) {}

Mattes::DeepPixel Mattes::SortedDeep::pixel(std::uint16_t place) const {
    const std::size_t i = place;
    std::span<const DeepSurface> surfaces(surfaces_.data() + first_surface_[i],
                                          first_surface_[i + 1] - first_surface_[i]);
    if (!is_mean_ && !surfaces.empty() && surfaces.back().is_transparent) {
        while (!surfaces.front().is_transparent) surfaces = surfaces.subspan(1);
    }
    return {0, 0, surfaces, std::span(lines_.data() + first_line_[i], first_line_[i + 1] - first_line_[i]), is_mean_};
}

Mattes::Pixel Mattes::Sorted::pixel(std::uint16_t place) {
    const std::size_t i = place;
    lines_now_.assign(lines_.begin() + first_line_[i], lines_.begin() + first_line_[i + 1]);
    const bool has_spot = first_spot_[i] < first_spot_[i + 1];
    const LineSpot* const spot = has_spot ? &spots_[first_spot_[i]] : nullptr;
    surfaces_now_.assign(surfaces_.begin() + first_surface_[i], surfaces_.begin() + first_surface_[i + 1]);
    if (is_mean_) return {0, 0, surfaces_now_, lines_now_, spot};
    float above = 0, below = 0;
    for (const LineShare& line : lines_now_) (line.is_below ? below : above) += line.share;
    const float left_above = std::max(1.0f - above, 0.0f), left = left_above * std::max(1.0f - below, 0.0f);
    for (LineShare& line : lines_now_) {
        if (line.is_below) line.share *= left_above;
    }
    if (!surfaces_now_.empty() && surfaces_now_.back().is_transparent)
        std::erase_if(surfaces_now_, [](const SurfaceShare& s) { return !s.is_transparent; });
    for (SurfaceShare& surface : surfaces_now_) surface.share *= left;
    return {0, 0, surfaces_now_, lines_now_, spot};
}

}  // namespace burin
