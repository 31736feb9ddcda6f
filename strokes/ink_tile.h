#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <glm/glm.hpp>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "render/frame.h"
#include "shading/ink/inked_lines.h"
#include "strokes/ink_regions.h"
#include "strokes/ink_segment.h"
#include "strokes/stroke_clip.h"
#include "strokes/stroke_mask.h"

namespace burin {

/// What drawing must know of all strokes before it cuts the picture into tiles.
struct InkPlan {
    /// Opaque strokes of one ink, one look for all of them.
    struct Look {
        std::uint32_t rank = 0;  ///< of the order, 0 lies on top
        bool is_plain = false;   ///< constant, opaque, and covers
        glm::vec3 color{0.0f};
        float strength = 1;  ///< of a plain one: the share of each sample
        bool operator==(const Look&) const = default;
    };
    std::vector<InkOrder> orders;      ///< by rank
    std::vector<Look> looks;           ///< of each stroke
    std::vector<float> pen_radius_px;  ///< of each stroke, of plain ones
    /// Of each boundary: strokes of lower ranks are hidden by it.
    std::vector<std::uint32_t> hides_below;
    double most_radius_px = 0;  ///< of all strokes
    float most_halo_px = 0;
    bool may_hide = false;          ///< boundaries may hide a part of some stroke
    bool has_drawn_widths = false;  ///< some boundaries hide strokes that are wider than what is drawn along them
};

/// The side of a line on which its stroke is drawn: what is behind surfaces has none.
StrokeSide drawn_side(const InkStroke& stroke);
/// The depth of a place in pixels' widths: a difference of 1 is a pixel's width at that distance.
double depth_px(const Projection& projection, float nearness);

InkPlan plan_of(const InkedLines& lines);

/// A segment of a stroke: points[point] to points[point + 1].
struct InkSegmentRef {
    std::uint32_t stroke;
    std::uint32_t point;
    std::uint32_t rank;
};

/// The samples of one pixel that a chain has, and the sum of their ink.
struct InkRecord {
    std::uint32_t pixel = 0;
    std::uint32_t stroke = 0;  ///< the first one of its chain here
    std::uint32_t rank = 0;
    std::uint64_t chain = 0;
    bool multiplies = false;
    bool is_plain = true;  ///< all of it is opaque ink of the first one's look
    StrokeMask mask;
    int samples = 0;
    float alpha = 0, nearness = 0, width = 0;  ///< sums over the samples
    glm::vec3 color{0.0f};                     ///< times alpha
};

class OwnerMasks;

/// PieceMasks draws one cone into masks of the pixels around it. Buffers are used again.
class PieceMasks {
  public:
    /// Calls use(column, row, mask) for the pixels of a rectangle that it touches, counted from the rectangle's first.
    template <typename Use>
    void draw(const TileKernels& kernels, const PenCone& cone, PixelRect rect, const Use& use) {
        const double reach = std::max(cone.radius_from, cone.radius_to) + kMarginPx;
        const auto within = [](double v, int low, int high) {
            return static_cast<int>(std::clamp(v, static_cast<double>(low), static_cast<double>(high)));
        };
        const int x0 = within(std::floor(std::min(cone.from[0], cone.to[0]) - reach), rect.x0, rect.x1),
                  x1 = within(std::ceil(std::max(cone.from[0], cone.to[0]) + reach), rect.x0, rect.x1),
                  y0 = within(std::floor(std::min(cone.from[1], cone.to[1]) - reach), rect.y0, rect.y1),
                  y1 = within(std::ceil(std::max(cone.from[1], cone.to[1]) + reach), rect.y0, rect.y1);
        if (x0 >= x1 || y0 >= y1) return;
        const std::size_t room = static_cast<std::size_t>((x1 - x0) * (y1 - y0)) + kRoomBehindMasks;
        if (masks_.size() < room) {
            masks_.resize(room);
            touched_.resize(room);
        }
        kernels.stroke.draw_cone(cone,
                                 {masks_.data()->rows.data(), touched_.data(), x0, y0, x1 - x0, y1 - y0, x1 - x0});
        std::size_t i = 0;
        for (int y = y0; y < y1; ++y) {
            for (int x = x0; x < x1; ++x, ++i) {
                if (touched_[i] == 0) continue;
                use(x - rect.x0, y - rect.y0, masks_[i]);
                masks_[i] = StrokeMask{};
                touched_[i] = 0;
            }
        }
    }

    /// draw(), but only the pixels near its ends: in others it is nothing but its body.
    template <typename Use>
    void draw_ends(const TileKernels& kernels, const PenCone& cone, PixelRect rect, const Use& use) {
        const EndsOfCone ends(cone);
        draw(kernels, cone, rect, [&](int column, int row, const StrokeMask& mask) {
            if (ends.may_reach(rect.x0 + column + 0.5, rect.y0 + row + 0.5)) use(column, row, mask);
        });
    }

  private:
    /// Tells where discs have samples beyond the body: not where its sides touch both of them.
    class EndsOfCone {
      public:
        explicit EndsOfCone(const PenCone& c) : from_{c.from[0], c.from[1]} {
            along_ = glm::dvec2(c.to[0], c.to[1]) - from_;
            const double length = glm::length(along_);
            if (!(length > 0)) return;
            along_ /= length;
            const double slope = (c.radius_from - c.radius_to) / length, half_px = std::numbers::sqrt2 / 2 + kMarginPx;
            first_ = std::max(c.radius_from * slope, 0.0) + half_px;
            last_ = length + std::min(c.radius_to * slope, 0.0) - half_px;
        }
        bool may_reach(double x, double y) const {
            const double at = glm::dot(glm::dvec2(x, y) - from_, along_);
            return !(at > first_ && at < last_);
        }

      private:
        glm::dvec2 from_, along_;
        double first_ = 0, last_ = 0;
    };
    static constexpr double kMarginPx = 1.0 / 8;  // for shifted samples, and rounding

    std::vector<StrokeMask, CacheLineAllocator<StrokeMask>> masks_;
    std::vector<std::uint8_t> touched_;
};

/// InkTile draws the strokes that reach one tile into masks. Plain strokes of one order and ink share a canvas; all
/// others are drawn chain by chain into a record per pixel. Buffers are used again.
class InkTile {
  public:
    InkTile(const Frame& frame, const InkedLines& lines, const InkPlan& plan, const TileKernels& kernels);

    /// `owners`: is told whose the strokes of layers() are, from now on; the lines have their origins then.
    void tell(OwnerMasks* owners) { owners_ = owners; }
    /// `segments`: all that reach the rectangle; `boundaries`: numbers of those within the largest radius of it.
    void draw(std::span<const InkSegmentRef> segments, std::span<const std::uint32_t> boundaries, PixelRect rect);

    /// Plain strokes of one order that all have one ink.
    struct Layer {
        const InkPlan::Look* look;
        std::uint32_t stroke;  ///< one of them
        StrokeCanvas* canvas;
    };
    /// In their order.
    std::span<const Layer> layers() const { return layers_; }
    /// Calls use(record) for those of a pixel, in the order of their ranks.
    template <typename Use>
    void for_records(int column, int row, const Use& use) const {
        const std::size_t i = index(column, row);
        for (std::uint32_t k = first_sorted_[i]; k < first_sorted_[i + 1]; ++k) use(records_[sorted_[k]]);
    }

    PixelRect rect() const { return rect_; }
    /// Calls visit(column, row) for the pixels that have any strokes, row by row.
    template <typename Visit>
    void for_touched(const Visit& visit) const {
        for (int row = 0; row < rect_.height(); ++row) {
            for (int column = 0; column < rect_.width(); column += 8) {
                std::uint64_t eight = StrokeCanvas::eight_bytes(&touched_[index(column, row)]);
                for (const Layer& layer : layers_) eight |= layer.canvas->eight_touched(column, row);
                StrokeCanvas::visit_touched(eight, column, row, visit);
            }
        }
    }
    bool has_records(int column, int row) const { return touched_[index(column, row)] != 0; }

  private:
    /// A segment of this tile, made ready.
    struct Placed {
        InkSegmentRef ref;
        InkSegment segment;
    };
    /// What boundaries leave of a part of a segment in one pixel.
    struct CutMask {
        int column, row;
        StrokeMask mask;
    };
    /// What decides which boundaries hide a stroke.
    struct Hiding {
        std::uint32_t rank;
        bool has_side;
        float width_px;
        bool operator==(const Hiding&) const = default;
    };
    /// A record of which samples are left for halos to erase, and how near they are.
    struct Behind {
        float nearness;
        std::uint32_t record;
    };
    std::size_t index(int column, int row) const { return static_cast<std::size_t>(row * stride_ + column); }
    InkSegment segment_of(const InkSegmentRef& ref) const;
    void cut_at_ends(const InkSegmentRef& ref, InkSegment& segment) const;
    void find_boundaries(std::span<const std::uint32_t> boundaries);
    void draw_layer(std::span<const InkSegmentRef> segments);
    void tell_owner(const InkSegmentRef& ref);
    void draw_chain(std::span<const InkSegmentRef> segments);
    void draw_parts(bool is_thin, bool body_only);
    bool is_clipped(const InkSegmentRef& ref);
    void draw_clipped(const InkSegmentRef& ref, const InkSegment& segment, const PenCone& cone, StrokeCanvas& onto);
    void take(const Placed& placed, int column, int row, const StrokeMask& mask);
    void sort_records();
    void erase_behind_halos();
    void erase_behind(const InkSegmentRef& ref, const InkSegment& segment);
    StrokeMask halo_mask(const InkSegment& segment, double halo_px, int x, int y);

    const InkedLines& lines_;
    const InkPlan& plan_;
    const Projection& projection_;
    const TileKernels& kernels_;
    OwnerMasks* owners_ = nullptr;
    PixelRect rect_;
    int stride_ = 0;
    std::deque<StrokeCanvas> canvases_;
    std::size_t used_canvases_ = 0;
    std::vector<Layer> layers_;
    std::vector<InkSegmentRef> segments_;  // by rank
    std::vector<std::uint64_t> keys_;
    std::vector<Placed> placed_;
    std::vector<CutMask> cut_masks_;     // of the parts of a chain whose bodies are drawn, part by part
    std::vector<std::size_t> cut_ends_;  // of each part's masks

    std::vector<InkRecord> records_;
    std::vector<std::uint32_t> record_at_;  // of the chain that is drawn, by pixel: number + 1
    std::size_t chain_begin_ = 0;           // its first record
    std::vector<std::uint8_t> touched_;
    std::vector<std::uint32_t> sorted_;        // their numbers, by pixel
    std::vector<std::uint32_t> first_sorted_;  // of each pixel, and behind them the end
    std::vector<std::uint32_t> next_;
    std::vector<Behind> behind_;             // by pixel as sorted_, while halos erase; the farthest ones first
    std::vector<std::uint32_t> behind_end_;  // of each pixel's

    PieceMasks one_;
    StrokeCanvas piece_;  // of one piece that is cut
    StrokeClipper clipper_;
    std::vector<ClipPiece> boundaries_;
    std::vector<std::uint32_t> boundary_numbers_;
    std::vector<const ClipPiece*> hiding_;
    std::optional<Hiding> hiding_for_;
};

}  // namespace burin
