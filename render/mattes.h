#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <mutex>
#include <span>
#include <tuple>
#include <vector>

#include "image/image.h"
#include "lines/line_class.h"
#include "render/crypto_layers.h"

// Whose each pixel is: the surfaces and the lines in it, with the share that each has in its alpha. From this
// follow the layers of Cryptomatte, the layer of the line that covers most of a pixel, and the samples of deep files.

namespace burin {

/// What a surface or a line belongs to: numbers of the scene, from 1; 0: nothing.
struct MatteOwner {
    std::uint32_t object = 0, material = 0;
    bool operator==(const MatteOwner&) const = default;
};

/// A pixel by its block and its place there.
struct MattePlace {
    std::uint32_t block = 0;
    std::uint16_t pixel = 0;
};

/// Pixels side by side of which a surface has the same share.
struct SurfaceShare {
    MattePlace place;
    std::uint16_t count = 1;
    /// Of pixels in which surfaces are seen through each other, these shares take the place of all others.
    bool is_transparent = false;
    MatteOwner owner;
    float share = 0;  ///< of the pixel, before lines are drawn over it
};

/// The share of a pixel that lines of one kind have.
struct LineShare {
    MattePlace place;
    LineClass drawn_as = LineClass::silhouette;
    bool is_hidden = false;
    bool is_below = false;  ///< others are drawn over it: the share is one of what these leave
    std::uint16_t set = 0;  ///< of a style sheet
    MatteOwner owner;
    float share = 0;
};

/// In which order shares of lines stand, which depends on nothing but themselves.
inline auto key_of(const LineShare& s) {
    return std::tuple(s.place.pixel, s.is_below, s.is_hidden, s.drawn_as, s.set, s.owner.object, s.owner.material,
                      s.share);
}

/// A line in a pixel, as the layer `line` shows one.
struct LineSpot {
    MattePlace place;
    LineClass drawn_as = LineClass::silhouette;
    std::uint8_t invisibility = 0;  ///< opaque surfaces in front of it
    MatteOwner owner;
    float distance = 0;  ///< along the view axis
    float width_px = 0;
    float coverage = 0;  ///< of the pixel's own square, whatever the filter
};

/// What a deep file has of a surface in a pixel.
struct DeepSurface {
    MattePlace place;
    bool is_transparent = false;  ///< as SurfaceShare has it
    bool is_opaque = true;        ///< the surface itself
    MatteOwner owner;
    float share = 0;        ///< before lines are drawn over it; of a mean: that is seen, 0 where lines leave nothing
    float distance = 0;     ///< along the view axis, the mean of its samples
    glm::vec3 color{0.0f};  ///< times the share, or, where that is 0, times `alone`
    float alone = 0;        ///< of a mean: the share before lines are drawn over it
};

/// What a deep file has of a line in a pixel. The share of a hidden one is all that it covers, whatever lies above it.
struct DeepLine {
    LineShare line;
    bool is_behind = false;         ///< it is seen through transparent surfaces
    std::uint8_t invisibility = 0;  ///< opaque surfaces in front of it
    float distance = 0;             ///< along the view axis, of the nearest of its pieces
    /// Per share of the line. Ink that multiplies adds to `color`: `passes` times the surfaces' colour, and `tint`
    /// times what these leave of the pixel.
    glm::vec3 color{0.0f}, passes{0.0f}, tint{0.0f};
};

inline auto key_of(const DeepLine& s) { return std::tuple(key_of(s.line), s.is_behind, s.invisibility, s.distance); }

/// What one thread finds in a part of the picture.
struct MatteBatch {
    std::vector<SurfaceShare> surfaces;
    std::vector<LineShare> lines;
    std::vector<LineSpot> spots;
    std::vector<DeepSurface> deep_surfaces;
    std::vector<DeepLine> deep_lines;

    void clear() { surfaces.clear(), lines.clear(), spots.clear(), deep_surfaces.clear(), deep_lines.clear(); }
};

/// What is asked for.
struct MatteWishes {
    CryptoLayerSet crypto;
    bool spots = false;        ///< for the layer `line`
    bool deep = false;         ///< for a deep file
    bool deep_hidden = false;  ///< hidden lines for it

    bool has_any() const { return crypto.has_any() || spots || deep; }
};

/// Mattes collects them for a picture in blocks of pixels, which are the blocks of a film in bands. Different threads
/// may add at the same time, in any order.
class Mattes {
  public:
    static constexpr int kBlockPx = 32;

    Mattes(PixelRect crop, const MatteWishes& wishes);

    CryptoLayerSet layers() const { return wishes_.crypto; }
    bool wants_surfaces() const { return wishes_.crypto.has_surfaces(); }
    bool wants_shares() const { return wishes_.crypto.has_any(); }
    bool wants_spots() const { return wishes_.spots; }
    bool wants_deep() const { return wishes_.deep; }
    bool wants_deep_hidden() const { return wishes_.deep && wishes_.deep_hidden; }

    MattePlace place_of(int x, int y) const {
        const int column = x - crop_.x0, row = y - crop_.y0;
        return {static_cast<std::uint32_t>(row / kBlockPx) * columns_ + static_cast<std::uint32_t>(column / kBlockPx),
                static_cast<std::uint16_t>(row % kBlockPx * kBlockPx + column % kBlockPx)};
    }
    /// Pixels [x0, x1) of a row have the same share of a surface.
    void put_surface(int x0, int x1, int y, MatteOwner owner, float share, bool is_transparent,
                     MatteBatch& batch) const;
    /// Takes what a batch has, and clears it.
    void add(MatteBatch& batch);
    /// Forgets all but the layer `line`. What is added next is of the mean of several pictures: shares, and colours of
    /// surfaces, are those that are seen, with all that lies over them.
    void begin_mean();

    /// What is known of one pixel when the picture is drawn.
    struct Pixel {
        int x, y;
        /// Of surfaces and lines; the shares of all add up to the pixel's alpha.
        std::span<const SurfaceShare> surfaces;
        std::span<const LineShare> lines;
        const LineSpot* line;  ///< that covers most of it; nullptr: there is none
    };
    /// Calls use(pixel) for the pixels of some rows of blocks that have anything, in an order that depends on nothing.
    template <typename Use>
    void for_pixels(PixelRect rows, const Use& use) const {
        for_sorted<Sorted>(rows, use);
    }

    /// What a deep file has of one pixel.
    struct DeepPixel {
        int x, y;
        std::span<const DeepSurface> surfaces;
        std::span<const DeepLine> lines;
        bool is_mean;  ///< begin_mean() was called
    };
    /// The same for those that a deep file has anything of.
    template <typename Use>
    void for_deep_pixels(PixelRect rows, const Use& use) const {
        for_sorted<SortedDeep>(rows, use);
    }
    /// Forgets what a row of blocks has.
    void close(std::size_t row);
    void clear();

  private:
    struct Block {
        std::vector<SurfaceShare> surfaces;
        std::vector<LineShare> lines;
        std::vector<LineSpot> spots;
        std::vector<DeepSurface> deep_surfaces;
        std::vector<DeepLine> deep_lines;
    };
    using FirstOfPixels = std::array<std::uint32_t, kBlockPx * kBlockPx + 1>;
    /// What a block has, sorted: of each pixel, in turns.
    class Sorted;
    class SortedDeep;

    template <typename SortedBlock, typename Use>
    void for_sorted(PixelRect rows, const Use& use) const;

    template <typename Record>
    void move_to_blocks(std::vector<Record>& records, std::vector<Record> Block::*list);

    PixelRect crop_;
    MatteWishes wishes_;
    bool is_mean_ = false;
    std::uint32_t columns_;
    std::vector<std::unique_ptr<Block>> blocks_;
    std::array<std::mutex, 64> mutexes_;  // of each block one, by its number
};

/// What Mattes::for_pixels() makes of a block.
class Mattes::Sorted {
  public:
    Sorted(const Block& block, bool is_mean);
    /// The pixel's shares, which are valid until the next call.
    Pixel pixel(std::uint16_t place);
    bool has_any(std::uint16_t place) const;

  private:
    FirstOfPixels first_surface_{}, first_line_{}, first_spot_{};
    std::vector<SurfaceShare> surfaces_;
    std::vector<LineShare> lines_;
    std::vector<LineSpot> spots_;
    std::vector<SurfaceShare> surfaces_now_;
    std::vector<LineShare> lines_now_;
    bool is_mean_;
};

/// What Mattes::for_deep_pixels() makes of a block.
class Mattes::SortedDeep {
  public:
    SortedDeep(const Block& block, bool is_mean);
    /// The pixel's samples, in an order that depends on nothing but themselves.
    DeepPixel pixel(std::uint16_t place) const;
    bool has_any(std::uint16_t place) const {
        return first_surface_[place] < first_surface_[place + 1u] || first_line_[place] < first_line_[place + 1u];
    }

  private:
    FirstOfPixels first_surface_{}, first_line_{};
    std::vector<DeepSurface> surfaces_;
    std::vector<DeepLine> lines_;
    bool is_mean_;
};

template <typename SortedBlock, typename Use>
void Mattes::for_sorted(PixelRect rows, const Use& use) const {
    for (int y0 = rows.y0; y0 < rows.y1; y0 += kBlockPx) {
        for (std::uint32_t column = 0; column < columns_; ++column) {
            const std::uint32_t number = place_of(crop_.x0, y0).block + column;
            if (blocks_[number] == nullptr) continue;
            SortedBlock sorted(*blocks_[number], is_mean_);
            for (std::uint16_t i = 0; i < kBlockPx * kBlockPx; ++i) {
                if (!sorted.has_any(i)) continue;
                auto pixel = sorted.pixel(i);
                pixel.x = crop_.x0 + static_cast<int>(column) * kBlockPx + i % kBlockPx;
                pixel.y = y0 + i / kBlockPx;
                use(pixel);
            }
        }
    }
}

}  // namespace burin
