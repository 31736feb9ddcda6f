#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <tuple>
#include <vector>

#include "render/mattes.h"
#include "strokes/ink_tile.h"
#include "strokes/stroke_mask.h"

namespace burin {

/// OwnerMasks tells, of the strokes that were drawn into one mask of a pixel, which line each sample is of. Buffers are
/// used again.
class OwnerMasks {
  public:
    struct Line {
        std::uint32_t group = 0;  ///< what is drawn into one mask
        LineClass drawn_as = LineClass::silhouette;
        std::uint8_t invisibility = 0;
        MatteOwner owner;
        float width_px = 0;
        float nearness = 0;  ///< of the nearest of its pieces in the pixel

        bool is_one_with(const Line& other) const {
            return group == other.group && drawn_as == other.drawn_as && invisibility == other.invisibility &&
                   owner == other.owner && width_px == other.width_px;
        }
    };

    explicit OwnerMasks(const TileKernels& kernels) : kernels_(kernels) {}
    void reset(PixelRect rect);
    PixelRect rect() const { return rect_; }

    /// Adds a straight piece of a line's stroke, with its nearness at both ends.
    void add(const PenCone& cone, float nearness_from, float nearness_to, Line line);

    /// Calls use(line, samples) for the lines of a group in a pixel, of which one mask was made: where they lie on each
    /// other, the nearer one has the samples. All samples of the mask are given to some line, if there is one.
    template <typename Use>
    void split(int column, int row, std::uint32_t group, const StrokeMask& mask, const Use& use) {
        find(column, row, group);
        StrokeMask rest = mask;
        for (Found& f : found_) {
            f.samples = StrokeMask{};
            for (std::size_t r = 0; r < rest.rows.size(); ++r) {
                f.samples.rows[r] = rest.rows[r] & f.record->mask.rows[r];
                rest.rows[r] &= ~f.samples.rows[r];
            }
        }
        if (!found_.empty()) unite(found_.front().samples, rest);
        for (const Found& f : found_) {
            std::uint32_t any = 0;
            for (const std::uint32_t bits : f.samples.rows) any |= bits;
            if (any != 0) use(f.record->line, f.samples);
        }
    }

  private:
    static constexpr std::uint32_t kNone = ~0u;
    struct Record {
        Line line;
        std::uint32_t next = kNone;  // of the same pixel
        StrokeMask mask;
    };
    struct Found {
        const Record* record;
        StrokeMask samples;
    };
    void find(int column, int row, std::uint32_t group);

    const TileKernels& kernels_;
    PixelRect rect_;
    std::vector<std::uint32_t> first_;  // of each pixel
    std::vector<Record> records_;
    std::vector<Found> found_;
    PieceMasks one_;
};

}  // namespace burin
