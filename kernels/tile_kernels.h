#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "kernels/hiding_views.h"
#include "kernels/scan_edge.h"
#include "kernels/screen_triangle.h"
#include "kernels/stroke_samples.h"
#include "kernels/tile_views.h"

namespace burin {

struct MeshWalks;
struct WalkOutlines;
struct WalkLimits;

/// A round pen's stroke along a straight piece, in pixels: all that is closer than `radius`.
struct PenStroke {
    double from[2], to[2];
    double radius;
};

/// The places p with dot(normal, p) <= most.
struct PenCut {
    double normal[2];
    double most;
};

/// A round pen's stroke along a straight piece on which the pen's radius changes linearly: the convex hull of the discs
/// at its ends. Where one of them lies in the other, that is the larger disc.
struct PenCone {
    double from[2], to[2];
    double radius_from, radius_to;
    /// What lies between the common tangents of both discs, without the rest of these.
    bool body_only = false;
    int cut_count = 0;
    PenCut cuts[2] = {};  ///< nothing lies beyond these; what lies on the first one, if it is level, is left out, too
};

/// Coverage masks of a rectangle of pixels, as StrokeMask has them, row by row.
struct StrokeView {
    std::uint32_t* masks;   ///< kStrokeRows for each pixel, and room for kRoomBehindMasks more
    std::uint8_t* touched;  ///< per pixel, and room as for masks: whether it has any bits
    std::int32_t x0, y0, width, height;
    std::int32_t stride;  ///< pixels from one row to the next
};

/// What takes the positions of a mesh to the screen: SurfaceSet::view_position() and Projection.
struct ScreenTransform {
    double to_view[4][3];  ///< columns
    bool orthographic;
    double focal_px, x_scale, center_x, center_y, near_distance, guard_band_px, farthest_nearness;
    double view_to_world[3][3];  ///< columns
};

/// What all pixels of a triangle have in common.
struct TriangleGeometry {
    double normal[3];          ///< unit length, in view space, towards the eye
    double offset;             ///< of its plane: the product of its normal and a point of it
    double nearest, farthest;  ///< distances
    float world_normal[3];
    std::uint32_t object_id, material_id, polygon_id;
};

/// The view rays (Projection::view_ray()) of pixels side by side: the first one's centre, from the centre of the
/// projection.
struct RowRays {
    bool orthographic;
    double first_x_px, y_px, focal_x_px, focal_y_px;
};

/// Depth, normals and ids of pixels side by side, each with room for a multiple of four of them.
struct GeometryRow {
    float* distance;  ///< along the view axis
    float* normal[3];
    std::uint32_t* ids[3];  ///< object, material, polygon
};

/// TileKernels has the inner loops of the production A-buffer: they take arrays of vertices, triangles, samples or
/// pieces, and fill in other arrays. There is one set per instruction set; all give equal results to the bit: they are
/// one source, but for what is one instruction in some of them, and floating point is not contracted. Kernels are
/// grouped by the stage of a frame that calls them. They are references, so that a set without one of them does not
/// compile.
struct TileKernels {
    /// Takes a mesh to the screen.
    struct Project {
        /// Projects and snaps vertices; `positions` are three numbers each.
        void (&vertices)(const ScreenTransform& transform, const float* positions, std::size_t count,
                         ScreenVertex* vertices);
    };

    /// Finds which triangles count in a picture, in which tiles, and which of their edges may be lines.
    struct Cull {
        /// Sets the facing of triangles [begin, end) of a mesh (`facing`: that of the mesh's first one) and lists those
        /// that may touch samples of the grid, once for each tile. Those that may be too large for
        /// Draw::small_triangles(), are not all on the screen or lie in more tiles are listed as `others`. Needs room
        /// for 4 * (end - begin) + kRoomBehindCulled and for end - begin + kRoomBehindCulled others.
        void (&triangles)(const ScreenMesh& mesh, std::uint32_t begin, std::uint32_t end, const TileGrid& grid,
                          std::uint8_t* facing, CulledTriangles& found);
        /// Sets ScreenMesh::line_edges for triangles [begin, end) of a mesh, once the facing of all its triangles is
        /// known (`line_edges`: that of the mesh's first one). Other bits of `sharp` are kept there.
        void (&find_line_edges)(const ScreenMesh& mesh, std::uint32_t begin, std::uint32_t end,
                                std::uint8_t* line_edges);
    };

    /// Puts in order: triangles by the tiles they lie in, and short lists of numbers.
    struct Sort {
        /// Lists where keys differ from those before them, beginning with the first one, and behind them the end.
        /// Returns their number without the end. Needs room for kRoomBehindCulled more than there are keys, and reads
        /// as many keys more.
        std::size_t (&find_runs)(const std::uint32_t* keys, std::size_t count, std::uint32_t* starts);
        /// Puts culled triangles to `to`, each where `next` says for its key, which is the next one's place then.
        /// `starts`: from find_runs(). Behind each list up to kRoomBehindRun places are written to, too.
        void (&put_runs)(const CulledTriangles& from, const std::uint32_t* starts, std::size_t run_count,
                         std::uint32_t* next, TileTriangle* to);
        /// Puts numbers in order: for few of them. Up to three numbers more are read.
        void (&few)(const double* values, std::size_t count, double* sorted);
    };

    /// Draws surfaces into the samples of a tile.
    struct Draw {
        /// Draws triangles of a mesh into a tile: nearest wins, then the smaller id. They must be smaller than
        /// kLargestSmallTriangle in both directions. What is read of the first kTrianglesAhead of them, `corners` and
        /// `line_edges`, is best on its way already.
        void (&small_triangles)(const SampleView& tile, const ScreenMesh& mesh, const std::uint32_t* triangles,
                                std::size_t count);
        /// Draws columns [begin, end) of a row of the tile.
        void (&span)(const SampleView& tile, std::int32_t row, std::int32_t begin, std::int32_t end,
                     const SpanPlane& plane);
        /// Draws the part of a polygon that lies in a rectangle: ScanConverter::edges(), if it fits_doubles(). Returns
        /// how many samples.
        std::int32_t (&polygon)(const SampleView& tile, const ScanEdge* edges, std::size_t edge_count,
                                const SampleRect& rect, const SpanPlane& plane);
    };

    /// Leaves out triangles that lie behind all that is drawn in the blocks of samples they touch.
    struct Blocks {
        /// The least nearness in every block of samples, as a BlockTable.
        void (&find_farthest)(const SampleView& tile, float* farthest);
        /// Makes a BlockTable of the least numbers from its first page.
        void (&combine)(std::int32_t columns, std::int32_t rows, float* least);
        /// Lists the triangles that may be nearer than the least number of the blocks they touch, or level with it (see
        /// SampleView). Returns how many.
        std::size_t (&find_nearer)(const float* least, float level, float level_per_nearness,
                                   const TileTriangle* triangles, std::size_t count, std::uint32_t* found);
    };

    /// Looks for lines between neighbouring samples, by walks over the mesh from one to the other.
    struct Walk {
        /// Finds the pairs of neighbours with different ids, except where both are plain and level. Returns their
        /// number; `pairs` must have room for 2 * columns * rows and kRoomBehindPairs.
        std::size_t (&find_pairs)(const SampleView& tile, SamplePair* pairs);
        /// Whether pairs are samples of one smooth surface: from the first one's triangle, a walk along the row or
        /// column comes to the other one's in few steps, over edges that are not sharp, and between them triangles that
        /// face the same way, are no slivers, and not so deep and narrow that snapping may turn them. Sets `is_smooth`
        /// to 1 or 0. Triangles of other meshes are not smooth; the mesh must have `sharp` and `line_edges`, and at
        /// most kMostToWalk triangles.
        void (&find_smooth)(const SampleView& tile, const ScreenMesh& mesh, const SmoothLimits& limits,
                            const SamplePair* pairs, std::size_t count, std::uint8_t* is_smooth);
        /// FastWalker::walk() for at most MeshWalks::kMost walks at once, where nothing out of the ordinary is met:
        /// seams, triangles off the screen, slivers, and depths that have to be looked at; then it is unsure. The mesh
        /// must have `sharp`.
        void (&over_mesh)(const ScreenMesh& mesh, const WalkLimits& limits, MeshWalks& walks, std::size_t count);
        /// Finds the walks over a mesh that ended at folds that are not sharp, and where that is. `pitch`: from one
        /// sample to the other. `farthest_nearness`: what nearness of vertices is relative to.
        void (&find_outlines)(const ScreenMesh& mesh, const MeshWalks& walks, std::int32_t pitch,
                              double farthest_nearness, WalkOutlines& found);
    };

    /// Fills pixels with the surfaces in them: coverage, depth, normals and ids.
    struct Fill {
        /// Counts, for pixels side by side, how many of their samples are covered. `ids`: of the first sample. Up to
        /// seven counts more than asked for may be written.
        void (&count_covered)(const std::uint32_t* ids, std::int32_t stride, std::int32_t samples_per_pixel,
                              std::int32_t pixels, std::uint8_t* counts);
        /// Fills in all but the ids of triangles that are polygons of their own; none may be off screen.
        void (&geometries)(const ScreenTransform& transform, const float* positions, const ScreenMesh& mesh,
                           const std::uint32_t* triangles, std::size_t count, TriangleGeometry* geometries);
        /// Fills in depth, normals and ids of pixels in the planes of the triangles with numbers `geometry_at`; where a
        /// plane is not met, or beyond its triangle, it is the triangle's nearest or farthest distance.
        void (&geometry)(const RowRays& rays, const TriangleGeometry* geometries, const std::uint16_t* geometry_at,
                         std::size_t count, const GeometryRow& row);
    };

    /// Draws strokes of pens into masks of pixels.
    struct Stroke {
        /// Adds to masks what a stroke covers. In single precision; equal in any canvas.
        void (&draw)(const PenStroke& stroke, const StrokeView& canvas);
        /// The same for a pen whose radius changes. With equal radii and nothing left out the masks are equal, too.
        void (&draw_cone)(const PenCone& cone, const StrokeView& canvas);
        /// How many bits are set in 16 numbers, without those of `hidden`.
        int (&count_bits)(const std::uint32_t* rows, const std::uint32_t* hidden);
        /// Adds the bits of 16 numbers to those of `onto`. Returns how many are new there.
        int (&add_bits)(const std::uint32_t* rows, std::uint32_t* onto);
    };

    /// Finds pairs of triangles that may pass through each other.
    struct Intersect {
        /// Lists those of the boxes [begin, end) that touch a box and have nearness in common with it, the ends of the
        /// ranges aside, and begin at the given coordinates or behind them. Returns their number. Up to seven numbers
        /// more are read of each array.
        std::size_t (&find_touching)(const BoxView& boxes, std::size_t begin, std::size_t end, const ScreenBox& box,
                                     float least_x0, float least_y0, std::uint32_t* found);
        /// Which of at most eight boxes from `a` on overlap which of at most eight from `b` on, touching in x and y
        /// being enough: bit 8 i + k for box a + i and box b + k. Up to seven numbers more are read of each array.
        std::uint64_t (&find_overlaps)(const BoxView& boxes, std::size_t a, std::size_t a_count, std::size_t b,
                                       std::size_t b_count);
        /// Which of the pairs that find_overlaps() returned are of triangles without a corner in common. `corners`: an
        /// array for each corner.
        std::uint64_t (&find_unconnected)(const std::uint32_t* const corners[3], std::size_t a, std::size_t b,
                                          std::uint64_t pairs);
    };

    /// Finds what is in front of lines that samples miss.
    struct Fine {
        /// Finds the triangles of a mesh, which must be small, that are nearer than the farthest thing in the cells
        /// they touch: in up to two by two blocks, once for each, in no particular order. Returns how many; `found`
        /// needs room for four of each. Those that touch more are added to `others`.
        std::size_t (&sort_hiding)(const ScreenMesh& mesh, const std::uint32_t* listed, std::size_t count,
                                   const HidingGrid& grid, HidingInBlock* found, std::uint32_t* others,
                                   std::size_t* other_count);
        /// The boxes of triangles, an array per number of FrontBoxes. Up to seven more may be written of each.
        void (&box_triangles)(const CrossedTriangle* triangles, std::size_t count, float* const numbers[5]);
        /// Lists those of the boxes [begin, end) that touch a box and reach nearer than its `low`. Returns their
        /// number. Up to 15 numbers more are read of each array, and written.
        std::size_t (&find_in_front)(const FrontBoxes& boxes, std::size_t begin, std::size_t end, const ScreenBox& box,
                                     std::uint32_t* found);
        /// Lists those of the triangles `listed` that may hide a part of a line: with a corner nearer than its farther
        /// end, and not beside it by more than 1/256 pixel, or 1/16 where either lies beyond 4096 pixels, or nothing
        /// where the line is exact and the triangle no longer. Returns their number. `found` may be `listed`.
        std::size_t (&find_hiding)(const CrossedTriangle* triangles, const std::uint32_t* listed, std::size_t count,
                                   const ScreenLine& line, std::uint32_t* found);
        /// Says where a triangle is in front of a line, by more than `least` and by more than `slack`, which is no
        /// less.
        void (&clip_twice)(const TrianglePlane& triangle, const PlaneLine& line, double least, double slack,
                           HiddenParts& parts);
    };

    /// Finds what is in front of any line, where hidden lines are drawn, too.
    struct Hide {
        /// Lists the triangles [begin, end) of a mesh that are nearer than what is noted where they are, once for each
        /// tile in which they are, and some that need be looked at: those that touch more than two by two blocks or are
        /// not all on the screen. For the latter `tiles` is kSeveralTiles. Returns how many; both need room for 4 *
        /// (end - begin) + kRoomBehindCulled.
        std::size_t (&find_in_front)(const ScreenMesh& mesh, std::uint32_t begin, std::uint32_t end,
                                     const DepthGrid& grid, std::uint32_t* found, std::uint32_t* tiles);
        /// Makes triangles that lines may cross from those of a mesh with the `numbers` of their surfaces; places count
        /// from (x, y), and all corners must be on the screen. Up to seven more may be written.
        void (&put_crossed)(const ScreenMesh& mesh, const std::uint32_t* numbers, std::size_t count, std::int32_t x,
                            std::int32_t y, CrossedTriangle* to);
        /// Fills in the boxes of the triangles `listed`, as many as `boxes` says.
        void (&box_in_steps)(const CrossedTriangle* triangles, const std::uint32_t* listed, const StepBoxes& boxes);
        /// Lists the triangles whose boxes touch any of some boxes, and reach its `low`, by their `numbers` and in
        /// their order. Returns how many.
        std::size_t (&list_in_boxes)(const StepBoxes& boxes, const StepBox* any_of, std::size_t any_count,
                                     const std::uint32_t* numbers, std::uint32_t* listed);
        /// Lists those of the triangles `listed` that may hide a part of a line: with a corner nearer than its farther
        /// end, and not beside it, by more than its reach and what rounding does: that is nothing where the line is
        /// exact and a triangle no longer. Returns their number. Up to 15 more are read of `listed`, and written of
        /// `found`.
        std::size_t (&find_crossed)(const CrossedTriangle* triangles, const std::uint32_t* listed, std::size_t count,
                                    const ScreenLine& line, std::uint32_t* found);
        /// Says where triangles are in front of a line: lists those that are, or may be level with it, in their order.
        /// Returns their number.
        std::size_t (&clip)(const TrianglePlane* const* triangles, std::size_t count, const PlaneLine& line,
                            HiddenPart* parts);
    };

    /// Finds the normals and the creases of a mesh, whatever is seen of it.
    struct Mesh {
        /// The normals of triangles, of unit length, four numbers each, the last one 0. `is_thin`, 0 or 1: whether the
        /// square of twice the area is at most `thin_square` of the longest edge's fourth power.
        void (&normals)(const float* positions, const std::uint32_t* corners, std::size_t count, double thin_square,
                        float* normals, std::uint8_t* is_thin);
        /// The normals of triangles in units of 1 / kRoughUnit, off by less than 3 of them in all. `slivers`:
        /// kMayBeSliver where a triangle is thin. Numbers of vertices must be below 2^29.
        void (&rough_normals)(const float* positions, const std::uint32_t* corners, std::size_t count,
                              double thin_square, std::int16_t* normals, std::uint8_t* slivers);
        /// Which edges of triangles from `first` on are not plainly smooth: joined to one other triangle, wound like
        /// it, at an angle whose cosine, by rough normals and in units of 1 / kRoughUnit^2, is greater than `high`.
        /// `found`: for each of them, bit k = edge k, added to what is there. `in_doubt`: half-edges of those whose
        /// only fault is a cosine from `low` to `high`; returned is how many. Half-edge 3 t + k begins at vertex
        /// `begins`; `next_on_edge` has rings of those on one edge. Numbers of half-edges must be below 2^31.
        std::size_t (&find_creases)(const std::uint32_t* begins, const std::uint32_t* next_on_edge,
                                    const std::int16_t* normals, std::size_t first, std::size_t count, std::int32_t low,
                                    std::int32_t high, std::uint8_t* found, std::uint32_t* in_doubt);
    };

    std::string_view name;
    Project project;
    Cull cull;
    Sort sort;
    Draw draw;
    Blocks blocks;
    Walk walk;
    Fill fill;
    Stroke stroke;
    Intersect intersect;
    Fine fine;
    Hide hide;
    Mesh mesh;
};

/// Numbers of vertices, four to each, are signed 32-bit numbers in TileKernels::Walk::find_smooth().
constexpr std::uint32_t kMostToWalk = (1u << 29) / 3;

/// A tile's key for triangles of one kind.
constexpr std::uint32_t tile_key(std::uint32_t tile, TriangleKind kind) { return kTriangleKinds * tile + kind; }
constexpr std::uint32_t kSeveralTiles = 0xFFFFFFFFu;
/// The width and height from which triangles are large, in 1/256 pixel. Products of smaller lengths fit 32 bits.
constexpr std::int32_t kLargestSmallTriangle = 1 << 14;
/// The length of a normal in 16 bits.
constexpr float kRoughUnit = 32767;

const TileKernels& baseline_kernels();
/// nullptr where this build or this machine has none.
const TileKernels* avx2_kernels();
const TileKernels* avx512_kernels();
/// The fastest ones that this machine has and allowed_instruction_set() permits.
const TileKernels& best_kernels();

}  // namespace burin
