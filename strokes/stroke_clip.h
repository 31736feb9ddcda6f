#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "lines/boundary_cells.h"
#include "shading/line_style.h"
#include "strokes/stroke_mask.h"

namespace burin {

/// A straight piece of a line or of a surface's boundary, on the screen, in pixels.
struct ClipPiece {
    glm::dvec2 from{0.0}, to{0.0};
    double depth_from_px = 0, depth_to_px = 0;  ///< in pixels' widths; only differences mean anything
    bool occludes = false;                      ///< a surface in front ends here
    bool front_on_left = false;                 ///< of the way, as seen on the screen: where that surface is
    /// Of a boundary: of strokes on both sides it cuts those of ranks below this one, and those that are wider than
    /// what is drawn along it. Others are covered by that.
    std::uint32_t cuts_below = std::numeric_limits<std::uint32_t>::max();
    float drawn_width_px = std::numeric_limits<float>::infinity();
    /// Of a stroke.
    std::uint32_t rank = 0;
    float width_px = 0;
    bool is_cut_by_all = false;  ///< also by boundaries that would not cut it by its rank and width
};

/// StrokeClipper draws strokes on one side of a line only, and cuts off what would lie over nearer surfaces.
///
/// A place belongs to a stroke if the straight way to it, from the nearest point of the line, does not
/// lead onto a surface in front of the line. Boundaries on the way are passed one after the other, as in
/// Appel's quantitative invisibility (1967): over an edge onto its surface, one is behind one more, over
/// the next edge out of it, one less. So depths are compared at boundaries only, and a surface that
/// curves towards the eye does not hide the strokes on it.
class StrokeClipper {
  public:
    explicit StrokeClipper(const TileKernels& kernels = best_kernels()) : canvas_(kernels) {}
    void reset(int x0, int y0, int width, int height);
    /// Sets what may hide strokes from now on, in the rectangle of the last reset(). The boundaries must outlive that.
    void set_boundaries(std::span<const ClipPiece* const> boundaries);

    /// Whether any boundary may cut the stroke along `piece`: draw() draws it whole if none may.
    bool may_cut(const ClipPiece& piece, double radius_px, StrokeSide side);

    /// Adds the stroke along `piece` to a canvas of the same rectangle. Boundaries that are farther away than
    /// the radius, or `piece` itself, change nothing.
    void draw(const ClipPiece& piece, double radius_px, StrokeSide side, StrokeCanvas& onto);

    /// The same for a pen whose radius changes along `piece`, or along a part of it.
    void draw(const ClipPiece& piece, const PenCone& cone, StrokeSide side, StrokeCanvas& onto);

    /// What is left of a stroke in one pixel, counted from the rectangle's first.
    struct CutPixel {
        int column, row;
        StrokeMask mask;
    };
    /// The same, but lists what is left, row by row.
    void list(const ClipPiece& piece, const PenCone& cone, StrokeSide side, std::vector<CutPixel>& pixels);

    /// How many times a boundary was compared with a stroke.
    std::uint64_t comparison_count() const { return comparison_count_; }

  private:
    /// Points p with dot(normal, p) >= offset.
    struct HalfPlane {
        glm::dvec2 normal{0.0};
        double offset = 0;
    };
    /// What lies beyond a boundary, as seen from the line.
    struct Shadow {
        std::array<HalfPlane, 4> sides;
        double distance_px = 0;  ///< of the boundary
        bool enters = false;     ///< a surface, there; else leaves one
    };
    /// Samples of a row of a pixel: behind one and two surfaces, and off the line's own surface.
    struct Behind {
        std::uint32_t one = 0, two = 0, off = 0;
    };
    /// Where a boundary is, side by side for all of them, since most of them hide nothing. Of one that never does:
    /// nowhere.
    struct Extent {
        glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
        double depth_px = 0;  ///< of its nearest end
        std::uint32_t cuts_below = 0;
        float drawn_width_px = 0;
    };
    /// What of the screen, and how deep, boundaries must have to hide a part of a stroke.
    struct Reach {
        glm::dvec2 low, high;
        double depth_px;
        std::uint32_t rank;
        float width_px;
        bool has_side, is_cut_by_all;
        Reach(const ClipPiece& piece, double radius_px, StrokeSide side);
        bool has(const Extent& e) const {
            return e.low.x <= high.x && e.low.y <= high.y && e.high.x >= low.x && e.high.y >= low.y &&
                   // On one side its own neighbours bound it, too.
                   (has_side ||
                    (e.depth_px < depth_px && (is_cut_by_all || rank < e.cuts_below || e.drawn_width_px < width_px)));
        }
    };
    class Frame;

    static Extent extent_of(const ClipPiece& boundary);
    /// What cut() has found.
    enum class Cut { nothing_is_left, is_whole, is_cut };
    template <typename DrawPen>
    Cut cut(const ClipPiece& piece, double radius_px, StrokeSide side, StrokeCanvas* onto, const DrawPen& draw_pen);
    template <typename Use>
    void for_left(const Use& use) const;
    template <typename DrawPen>
    void draw_with(const ClipPiece& piece, double radius_px, StrokeSide side, StrokeCanvas& onto,
                   const DrawPen& draw_pen);
    void add_shadows(const ClipPiece& boundary, const ClipPiece& piece, const Frame& frame, double radius_px,
                     StrokeSide side);
    template <typename Visit>
    void for_spans(std::span<const HalfPlane> sides, const Visit& visit) const;
    template <typename Visit>
    void for_spans_of(std::span<const HalfPlane> sides, double down, std::uint32_t columns, const Visit& visit) const;
    void apply(const Shadow& shadow, bool blocks_outside);
    /// The pixels of the stroke's rows and columns.
    StrokeCanvas::Box pixels() const;
    /// Cuts the stroke's rows and columns to a box of pixels. False if nothing is left.
    bool cut_to(const StrokeCanvas::Box& box);
    /// The smallest box of pixels in which the stroke has anything to add that is not cut off for good.
    StrokeCanvas::Box pixels_to_add(const StrokeCanvas* onto, bool knows_behind) const;
    bool is_between(const ClipPiece& boundary, const Frame& frame) const;
    void find_shadows(int ring, const ClipPiece& piece, const Frame& frame, double radius_px, StrokeSide side);
    bool pass_boundaries(const ClipPiece& piece, const Frame& frame, double radius_px, StrokeSide side,
                         const StrokeCanvas* onto);

    StrokeCanvas canvas_;
    int x0_ = 0, y0_ = 0, width_ = 0, height_ = 0;
    bool in_sets_ = false;                                                 // is_level(), as its canvas samples it
    int first_row_ = 0, end_row_ = 0, first_column_ = 0, end_column_ = 0;  // of the stroke, in samples
    std::vector<Shadow> shadows_;
    std::vector<std::array<Behind, StrokeMask::kRows>> behind_;
    std::span<const ClipPiece* const> boundaries_;
    BoundaryCells cells_;  // of the boundaries
    std::vector<PieceEnds> ends_;
    std::vector<Extent> extents_;
    std::vector<std::uint32_t> asked_;  // by which stroke each boundary was looked at
    std::uint32_t stroke_count_ = 0;
    std::uint64_t comparison_count_ = 0;
};

}  // namespace burin
