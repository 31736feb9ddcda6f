#pragma once

#include <cstddef>
#include <cstdint>

// What may hide lines, and the lines, as the kernels of TileKernels see them.

namespace burin {

/// A rectangle on the screen in 1/256 pixel, its sides included, and a range of nearness.
struct ScreenBox {
    float x0, y0, x1, y1, low, high;
};

/// Boxes, an array per number.
struct BoxView {
    const float *x0, *y0, *x1, *y1, *low, *high;
};

/// Boxes of triangles on the screen, their sides included, in 1/256 pixel, and the nearness of their nearest corners:
/// an array per number.
struct FrontBoxes {
    const float *x0, *y0, *x1, *y1, *highest;
};

/// A straight part of a line on the screen, in 1/256 pixel, and the nearness of its farther end.
struct ScreenLine {
    float ax, ay, bx, by, low;
    bool is_exact = false;  ///< it is no longer than kLongestExact, and its ends are whole numbers
    float reach = 0;        ///< how far beside it counts, too, in 1/256 pixel; it is not exact then
};
/// Along both axes together.
constexpr float kLongestExact = 2048;

/// A triangle that may hide lines: corners, clockwise as seen, in 1/256 pixel from some place, and the nearness of the
/// nearest one.
struct CrossedTriangle {
    float x[3], y[3], highest;
    std::uint32_t number;
};

/// The blocks of a tile for what may hide lines there. Each is cut into two by two cells.
struct HidingGrid {
    static constexpr std::int32_t kShift = 11, kCellShift = kShift - 1;  ///< log2 of widths in 1/256 pixel
    std::int32_t first_x, first_y;                                       ///< of the upper left block, in 1/256 pixel
    std::int32_t columns, rows;
    std::int32_t reach;  ///< triangles this far from a block touch it, too; they lie beside the cells at its end then
    /// Blocks row by row, for each the least nearness in any rectangle of its cells.
    const float* farthest;
    static constexpr std::size_t kPlaces = 16;
    static constexpr std::size_t place(int x0, int x1, int y0, int y1) {
        return static_cast<std::size_t>(x0 | x1 << 1 | y0 << 2 | y1 << 3);
    }
};

/// A triangle in one of the blocks it touches. Corners from the picture's.
struct HidingInBlock {
    CrossedTriangle triangle;
    std::uint32_t block;
};

/// A triangle on the screen and the plane of its nearness.
struct TrianglePlane {
    double x[3], y[3];              ///< corners in 1/256 pixel, clockwise as seen
    double nearness, per_x, per_y;  ///< at corner 0, and change per 1/256 pixel
    double slack;                   ///< what snapping may do to nearness
    bool owns_edge[3];              ///< whether points on the edge after a corner belong to it
};

/// A line, and the part [begin, end] of it that is looked at.
struct PlaneLine {
    double x[4], y[4], nearness[4];  ///< of the line's ends and of the part's
    double begin, end;
    double slack;  ///< what is in front by more, and a triangle's own slack, is so for certain
};

/// Where in a part of a line a triangle is in front of it for certain.
struct HiddenPart {
    std::uint32_t triangle;
    bool is_any;    ///< else the part is empty
    bool is_level;  ///< it is in front, or may be as near as the line, in [level_begin, level_end]
    double begin, end, level_begin, level_end;
};

/// The parts of a line that a triangle is in front of, by more than one slack or another.
struct HiddenParts {
    bool is_any_most, is_any;
    double most_begin, most_end;  ///< by more than the first one, with the triangle's edges
    double begin, end;            ///< by more than the second one
};

/// A box on the screen, in steps of the axes of StepBoxes.
struct StepBox {
    std::uint8_t x0, y0, x1, y1, low;
};

/// Boxes of triangles on the screen, and the nearness of their nearest corners, cut into steps of a byte: an array per
/// number. So as many are compared with a box at once as vectors have bytes. Boxes around each 64 of them are compared
/// first: neighbours in a mesh are neighbours in its list.
struct StepBoxes {
    enum Number { begins_x, begins_y, ends_x, ends_y, nearest };
    static constexpr std::size_t kNumbers = 5, kLows = 2, kSteps = 256;  // the first ones are least values
    static constexpr std::size_t kAtOnce = 64;                           ///< arrays have room for a multiple of this
    static constexpr std::size_t rounded_up(std::size_t count) { return (count + kAtOnce - 1) / kAtOnce * kAtOnce; }
    struct Axis {
        float from = 0, steps_per_unit = 0;
    };
    Axis x, y, nearness;
    std::size_t count = 0;
    std::uint8_t* steps[kNumbers] = {};
    std::uint8_t* around[kNumbers] = {};  ///< each kAtOnce of them
};

/// DepthGrid says how far away lines are in a picture: square blocks, row by row.
struct DepthGrid {
    /// Four pages, each with all blocks: the least nearness in a block; in it and the one to the right; in it and the
    /// one below; and in all four.
    const float* least;
    std::int32_t first_x, first_y, last_x, last_y;  ///< of the picture, in 1/256 pixel
    std::int32_t block_shift;                       ///< log2 of a block's width in 1/256 pixel
    std::int32_t columns, first_row, rows;          ///< of blocks; rows from the first one on
    std::int32_t tile_shift;  ///< log2 of a tile's width in blocks; columns and rows fill whole tiles
};

}  // namespace burin
