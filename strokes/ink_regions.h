#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "shading/ink/inked_lines.h"
#include "strokes/stroke_mask.h"

namespace burin {

/// Ink of one stroke, or of several alike, at one pixel.
struct InkSpot {
    const StrokeMask* mask;  ///< the samples that have it
    glm::vec3 color;
    float alpha;
    /// How `alpha` is meant: a share of each sample, the same one for all spots of this kind, as thin opaque strokes
    /// have it; else what the ink does not let through.
    bool is_share = false;
    bool multiplies = false;
    bool is_hidden = false;
    LineClass drawn_as = LineClass::silhouette;
    std::uint32_t set = 0;
};

/// What spots make of the samples of a pixel together: a colour c with alpha a below them becomes color + through * c +
/// (1 - a) * tint, and of 1 - a as much is left as `left` says. `tint` comes of ink that multiplies: where nothing is
/// below it shows itself, so that on white paper the picture is the same, whether the paper is there already or not.
struct InkStack {
    glm::vec3 color{0.0f}, through{1.0f}, tint{0.0f};
    float left = 1;
    std::array<float, kLineClassCount> coverage{};  ///< what is seen of each class

    /// Lays a spot's ink below all that is there.
    void lay_below(const InkSpot& spot);
    /// Numbers that are all 0, to add others to.
    static InkStack nothing();
    void scale(float factor);
    void add(const InkStack& other, float weight);

    /// The colour over nothing, premultiplied.
    glm::vec4 alone() const { return {color + tint, 1.0f - left}; }

  private:
    float shared_ = 0;  // the share of thin opaque strokes; it is in the other numbers, too
};

/// InkRegions lays spots upon each other, front to back, in one pixel: samples with the same spots so far are a region.
/// There are at most kMost, or kMostInPlace; then the two most alike become one.
class InkRegions {
  public:
    static constexpr std::size_t kMost = 8, kMostInPlace = 64;
    static constexpr int kSamples = StrokeMask::kRows * StrokeMask::kColumns;

    /// `in_place`: where in the pixel each region lies is asked for, as filters do, so that fewer become one.
    InkRegions(const TileKernels& kernels, bool in_place)
        : kernels_(&kernels), in_place_(in_place), regions_(2 * (in_place ? kMostInPlace : kMost)) {
        losses_.resize(regions_.size() * regions_.size());
    }
    void reset();
    void lay_below(const InkSpot& spot);
    /// Calls use(mask, samples, stack) for each region; all together are the pixel.
    template <typename Use>
    void for_regions(const Use& use) const {
        for (std::size_t i = 0; i < count_; ++i) use(regions_[i].mask, regions_[i].samples, regions_[i].stack);
    }
    /// The mean of the pixel.
    InkStack mean() const;

  private:
    struct Region {
        StrokeMask mask;
        int samples = 0;
        InkStack stack;
    };
    void join_opaque();
    static float loss(const Region& a, const Region& b);
    void merge_most_alike();
    void merge(std::size_t first, std::size_t second);

    const TileKernels* kernels_;
    bool in_place_;
    std::vector<Region> regions_;  // each may split before some become one
    std::size_t count_ = 0;
    std::vector<float> losses_;  // of each pair, while some become one
};

}  // namespace burin
