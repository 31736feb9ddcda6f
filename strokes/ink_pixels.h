#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "render/film.h"
#include "strokes/ink_regions.h"
#include "strokes/ink_tile.h"
#include "strokes/pixel_filter.h"

namespace burin {

/// InkPixels puts the masks of an InkTile on a film as ink: in each pixel strokes are sorted and laid over each other.
class InkPixels {
  public:
    /// All must outlive it. `filter`: nullptr where each pixel sees its own square.
    InkPixels(const InkedLines& lines, const InkPlan& plan, const FilterTable* filter, const TileKernels& kernels,
              Film& film);

    /// Puts the pixels of `rect`. The tile's rectangle is larger by the reach of the filter.
    void put(const InkTile& tile, PixelRect rect);

  private:
    /// A spot with what decides where it lies.
    struct Placed {
        std::uint32_t rank;
        float nearness;
        std::uint64_t chain;
        InkSpot spot;
    };
    /// What a pixel with strokes of one plain look gets, by how many samples they cover.
    struct Inks {
        std::optional<InkPlan::Look> look;
        std::vector<LineInk> visible;
        std::vector<HiddenInk> hidden;
    };
    /// What a pixel sees of the strokes around it through a filter.
    struct Seen {
        std::array<float, kLineClassCount> coverage{};
        glm::vec3 visible{0.0f};
        glm::vec4 hidden{0.0f};
        glm::vec3 color{0.0f}, lost{0.0f}, tint{0.0f};  ///< of all; what InkStack::through has less than 1
        float lost_left = 0;
        bool has_visible = false, has_hidden = false, multiplies = false;
    };
    /// A set with a layer: its number, and that of the layer in the film.
    struct SetLayer {
        std::uint32_t set;
        std::size_t layer;
    };

    void put_own_squares(const InkTile& tile, PixelRect rect);
    void put_filtered(const InkTile& tile, PixelRect rect);
    void put_look(const InkTile::Layer& layer, int column, int row, int x, int y);
    /// Finds the spots of a pixel, in their order.
    void find_spots(const InkTile& tile, int column, int row);
    /// Makes one of those that follow each other and are alike.
    void join_spots();
    bool are_plain() const;
    void put_plain(int x, int y);
    bool put_record(const InkRecord& record, int x, int y);
    void put_any(int x, int y);
    template <typename Choose>
    const InkRegions& lay(const Choose& choose);
    template <typename Choose>
    bool has_any(const Choose& choose) const;
    Inks& inks_of(const InkPlan::Look& look);
    int count(const StrokeMask& mask, const StrokeMask& taken = {}) const {
        return kernels_.stroke.count_bits(mask.rows.data(), taken.rows.data());
    }

    const InkedLines& lines_;
    const InkPlan& plan_;
    const FilterTable* filter_;
    const TileKernels& kernels_;
    Film& film_;
    std::vector<SetLayer> set_layers_;
    std::vector<Inks> inks_;  // by rank
    std::vector<Placed> spots_;
    std::deque<StrokeMask> joined_;
    InkRegions regions_;
    struct Touched {
        int column, row;
    };
    std::vector<Touched> touched_;
    std::vector<Seen> seen_;
    std::vector<std::vector<glm::vec4>> seen_sets_;  // of each set with a layer, by pixel
};

}  // namespace burin
