#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/line_owner.h"
#include "render/mattes.h"
#include "strokes/deep_shares.h"
#include "strokes/owner_masks.h"
#include "strokes/pixel_filter.h"

namespace burin {

/// What shares of lines are for: channels of flat files, samples of a deep one, or both.
enum class MatteUse : std::uint8_t { both, flat, deep };

/// TileMattes collects whose the strokes of one tile after the other are, as they are put on the film. Used where some
/// layer asks for it, by one thread.
class TileMattes {
  public:
    /// `filter`: nullptr where each pixel sees its own square.
    TileMattes(const Frame& frame, Mattes& mattes, const FilterTable* filter, const TileKernels& kernels);

    /// Begins a tile; masks are drawn as far around it as the filter reaches.
    void begin(PixelRect tile);
    OwnerMasks& owners() { return owners_; }
    /// Adds the strokes of pieces to owners(), those that are in `group_of(piece)`.
    template <typename GroupOf>
    void add_pieces(std::span<const LinePiece* const> pieces, double radius_px, double width_px,
                    const GroupOf& group_of) {
        for (const LinePiece* piece : pieces) {
            if (const auto group = group_of(*piece)) add_piece(*piece, radius_px, width_px, *group);
        }
    }

    /// What strokes of one mask have in common.
    struct Kind {
        std::uint32_t group = 0;
        float strength = 1;
        bool is_hidden = false;
        bool is_below = false;   ///< visible strokes are drawn over it
        bool is_opaque = false;  ///< it leaves nothing of its samples to what is below
        std::uint16_t set = 0;
        glm::vec3 color{0.0f};  ///< for deep files
        MatteUse use = MatteUse::both;
        bool is_behind = false;  ///< visible strokes that are seen through transparent surfaces
    };
    /// Adds samples of a mask that was drawn at a pixel of the rectangle around the tile, and what is seen of it.
    void add(int column, int row, const StrokeMask& seen, const Kind& kind);
    /// Adds a share of samples of one line.
    void add_share(int column, int row, const StrokeMask& samples, const OwnerMasks::Line& line, const Kind& kind);
    /// Adds what a deep file has of samples of one line, per share of a pixel.
    void add_deep(int column, int row, const StrokeMask& samples, const OwnerMasks::Line& line, const Kind& kind,
                  const DeepInk& ink);
    /// Adds the line to the layer `line`, if it lies in the tile.
    void add_spot(int column, int row, const OwnerMasks::Line& line, float coverage);
    bool wants_shares() const { return mattes_.wants_shares(); }
    bool wants_spots() const { return mattes_.wants_spots(); }
    bool wants_deep() const { return mattes_.wants_deep(); }
    bool wants_deep_hidden() const { return mattes_.wants_deep_hidden(); }
    const FilterTable* filter() const { return filter_; }

    /// Hands on what the tile has.
    void finish();

  private:
    /// Sums of these do not depend on their order.
    using ExactShare = std::int64_t;
    struct KindShare {
        LineShare kind;
        ExactShare sum = 0;
    };
    struct PixelShares {
        std::vector<KindShare> kinds;
        ExactShare opaque = 0;
    };
    void add_piece(const LinePiece& piece, double radius_px, double width_px, std::uint32_t group);
    void add_to(int x, int y, const OwnerMasks::Line& line, const Kind& kind, float share);
    /// Calls use(x, y, share) for the pixels that see samples.
    template <typename Use>
    void spread(int column, int row, const StrokeMask& samples, const Use& use) const;
    int count(const StrokeMask& mask) const {
        const StrokeMask nothing;
        return kernels_.stroke.count_bits(mask.rows.data(), nothing.rows.data());
    }

    Mattes& mattes_;
    const FilterTable* filter_;
    int reach_;
    const TileKernels& kernels_;
    const Projection& projection_;
    LineOwners line_owners_;
    OwnerMasks owners_;
    PixelRect tile_;
    std::vector<PixelShares> pixels_;
    std::vector<std::uint32_t> used_;
    std::vector<LineShare> lines_;  // of a pixel
    DeepShares deep_;
    MatteBatch batch_;
};

}  // namespace burin
