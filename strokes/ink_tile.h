#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <deque>
#include <glm/glm.hpp>
#include <numbers>
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
        bool is_plain = false;   ///< opaque, of one colour, and covers
        glm::vec3 color{0.0f};
        float strength = 1;  ///< of a plain one: the share of each sample
        bool operator==(const Look&) const = default;
    };
    std::vector<InkOrder> orders;      ///< by rank
    std::vector<Look> looks;           ///< of each stroke
    std::vector<float> pen_radius_px;  ///< of each stroke of constant width
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
    InkRecord(std::uint32_t pixel_number, std::uint32_t first_stroke, std::uint32_t its_rank, const InkStroke& look)
        : pixel(pixel_number),
          stroke(first_stroke),
          rank(its_rank),
          chain(look.chain),
          multiplies(look.blend == InkBlend::multiply) {}

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
        const PixelRect box =
            box_around({std::min(cone.from[0], cone.to[0]), std::min(cone.from[1], cone.to[1])},
                       {std::max(cone.from[0], cone.to[0]), std::max(cone.from[1], cone.to[1])}, reach, rect);
        draw_in(kernels, cone, box, [&](int x, int y, const StrokeMask& mask) { use(x - rect.x0, y - rect.y0, mask); });
    }

    /// draw(), but only the pixels near the ends that are asked for: elsewhere it is nothing but its body.
    template <typename Use>
    void draw_ends(const TileKernels& kernels, const PenCone& cone, bool has_first, bool has_last, PixelRect rect,
                   const Use& use) {
        const EndsOfCone ends(cone);
        const auto draw_near = [&](PixelRect box) {
            draw_in(kernels, cone, box, [&](int x, int y, const StrokeMask& mask) {
                if (ends.may_reach(x + 0.5, y + 0.5)) use(x - rect.x0, y - rect.y0, mask);
            });
        };
        const PixelRect first = ends.box(cone.from, cone.radius_from, rect),
                        last = ends.box(cone.to, cone.radius_to, rect);
        if (!has_first && !has_last) return;
        if (!has_first) return draw_near(last);
        if (!has_last) return draw_near(first);
        const bool are_apart = first.x1 <= last.x0 || last.x1 <= first.x0 || first.y1 <= last.y0 || last.y1 <= first.y0;
        if (are_apart) {
            draw_near(first);
            draw_near(last);
        } else {
            draw_near({std::min(first.x0, last.x0), std::min(first.y0, last.y0), std::max(first.x1, last.x1),
                       std::max(first.y1, last.y1)});
        }
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
        /// The pixels around one end that it may reach there: no sample of the disc beyond the body lies farther from
        /// its middle than the radius.
        static PixelRect box(const double (&place)[2], double radius, PixelRect rect) {
            const glm::dvec2 at(place[0], place[1]);
            return box_around(at, at, radius + kMarginPx, rect);
        }

      private:
        glm::dvec2 from_, along_;
        double first_ = 0, last_ = 0;
    };
    static constexpr double kMarginPx = 1.0 / 8;  // for shifted samples, and rounding

    static PixelRect box_around(glm::dvec2 low, glm::dvec2 high, double reach, PixelRect rect) {
        // Whole numbers without calls: what is cut to the rectangle and counted from its corner is not negative.
        const auto down = [](double v, int from, int to) {
            return from + static_cast<int>(std::clamp(v - from, 0.0, static_cast<double>(to - from)));
        };
        const auto up = [](double v, int from, int to) {
            return to - static_cast<int>(std::clamp(to - v, 0.0, static_cast<double>(to - from)));
        };
        return {down(low.x - reach, rect.x0, rect.x1), down(low.y - reach, rect.y0, rect.y1),
                up(high.x + reach, rect.x0, rect.x1), up(high.y + reach, rect.y0, rect.y1)};
    }

    /// Calls use(x, y, mask) for the pixels of a box that it touches.
    template <typename Use>
    void draw_in(const TileKernels& kernels, const PenCone& cone, PixelRect box, const Use& use) {
        if (box.x0 >= box.x1 || box.y0 >= box.y1) return;
        const int stride = (box.width() + 7) / 8 * 8;
        const std::size_t room = static_cast<std::size_t>(stride * box.height()) + kRoomBehindMasks;
        if (masks_.size() < room) {
            masks_.resize(room);
            touched_.resize(room);
        }
        kernels.stroke.draw_cone(
            cone, {masks_.data()->rows.data(), touched_.data(), box.x0, box.y0, box.width(), box.height(), stride});
        std::size_t first = 0;
        for (int y = box.y0; y < box.y1; ++y) {
            for (int x = box.x0; x < box.x1; x += 8, first += 8) {
                std::uint64_t eight = StrokeCanvas::eight_bytes(&touched_[first]);
                if (eight == 0) continue;
                std::fill_n(&touched_[first], 8, std::uint8_t{0});
                for (; eight != 0; eight &= eight - 1) {
                    const int i = std::countr_zero(eight) / 8;
                    StrokeMask& mask = masks_[first + static_cast<std::size_t>(i)];
                    use(x + i, y, mask);
                    mask = StrokeMask{};
                }
            }
        }
    }

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
    /// The record of a pixel that has one and no more.
    const InkRecord* only_record(int column, int row) const {
        const std::uint32_t* first = &first_sorted_[index(column, row)];
        return first[1] - first[0] == 1 ? &records_[sorted_[*first]] : nullptr;
    }
    bool has_records(int column, int row) const { return touched_[index(column, row)] != 0; }

  private:
    /// A segment of this tile, made ready.
    struct Placed {
        Placed(const InkTile& tile, const InkSegmentRef& of) : ref(of), segment(tile.segment_of(of)) {}
        InkSegmentRef ref;
        InkSegment segment;
        bool is_cut = false;  ///< some boundary may cut it
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
    bool has_body_first(const Placed& placed, const InkSegment::Part& part) const;
    void join_parts();
    void draw_parts(bool is_thin, bool body_only);
    void draw_cut(const Placed& placed, const InkSegment::Part& part, bool body_only, std::size_t& next_cut);
    bool may_be_clipped(const InkSegmentRef& ref) const;
    bool is_clipped(const Placed& placed);
    ClipPiece clip_piece(const Placed& placed) const;
    const ClipPiece& own_boundary(const Placed& placed, const ClipPiece& piece) const;
    void draw_clipped(const Placed& placed, const PenCone& cone, StrokeCanvas& onto);
    void list_clipped(const Placed& placed, const PenCone& cone, std::vector<StrokeClipper::CutPixel>& pixels);
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
    std::vector<StrokeClipper::CutPixel> cut_pixels_;  // of a chain's parts with discs, part by part
    std::vector<std::size_t> cut_ends_;                // of each part's
    std::vector<StrokeClipper::CutPixel> cut_once_;

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
    StrokeClipper clipper_;
    std::vector<ClipPiece> boundaries_;
    std::vector<std::uint32_t> boundary_numbers_;
    std::vector<const ClipPiece*> clipping_;  // all of them
    std::uint32_t most_cuts_below_ = 0;
    float least_drawn_width_px_ = 0;
};

}  // namespace burin
