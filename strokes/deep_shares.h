#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/mattes.h"
#include "strokes/owner_masks.h"

namespace burin {

/// What samples of a line add to a pixel of a deep file, or take away again.
struct DeepInk {
    float share = 0;
    glm::vec3 color{0.0f}, passes{0.0f}, tint{0.0f};  ///< as DeepLine has them, times the share

    DeepInk scaled(float factor) const { return {share * factor, color * factor, passes * factor, tint * factor}; }
};

/// DeepShares sums up what a deep file has of the lines of one tile after the other. The sums depend on no order.
class DeepShares {
  public:
    void begin(PixelRect tile);
    /// How a line lies among surfaces and other lines, as LineShare and DeepLine have it.
    struct Place {
        bool is_hidden = false, is_below = false, is_behind = false;
        float distance = 0;  ///< along the view axis
    };
    /// What lies beside the tile is left out.
    void add(int x, int y, const OwnerMasks::Line& line, const Place& place, const DeepInk& ink);
    /// Of what is added, how much of a pixel opaque visible strokes take, which leave nothing to what is below.
    void add_opaque(int x, int y, float share);
    /// Hands on what the tile has.
    void finish(const Mattes& mattes, bool is_filtered, MatteBatch& batch);

  private:
    using Exact = std::int64_t;
    struct Kind {
        LineClass drawn_as;
        Place place;
        std::uint8_t invisibility;
        MatteOwner owner;
        std::array<Exact, 10> sums;
    };
    struct Pixel {
        std::vector<Kind> kinds;
        Exact opaque = 0;
    };
    bool is_in_tile(int x, int y) const { return x >= tile_.x0 && y >= tile_.y0 && x < tile_.x1 && y < tile_.y1; }
    std::uint32_t number_of(int x, int y) const {
        return static_cast<std::uint32_t>((y - tile_.y0) * tile_.width() + (x - tile_.x0));
    }
    void finish_pixel(Pixel& pixel, MattePlace place, bool is_filtered, MatteBatch& batch);

    PixelRect tile_;
    std::vector<Pixel> pixels_;
    std::vector<std::uint32_t> used_;
    std::vector<LineShare> shares_;  // of a pixel
};

}  // namespace burin
