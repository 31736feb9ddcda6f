#pragma once

#include <array>
#include <optional>

#include "abuffer/samples/seam_memory.h"
#include "abuffer/samples/unsnapped_places.h"
#include "abuffer/screen/screen_surfaces.h"
#include "kernels/mesh_walks.h"
#include "lines/line_decision.h"

// A walk from one sample to its neighbour goes over snapped vertices, along a row or a column.

namespace burin {

/// A sample exactly on an edge belongs to the polygon below or to the right, so its place is taken a trifle further
/// there. Pixels.
constexpr double kSampleTrifleX = 0x1p-14, kSampleTrifleY = 0x1p-20;

/// Two samples next to each other, in 1/256 pixel, and what is visible there.
struct NeighbourSamples {
    std::int32_t x, y;  ///< the left or upper one
    std::int32_t pitch;
    bool down;              ///< the second one lies below, else to the right
    SurfaceId surfaces[2];  ///< kBackground where nothing is

    /// Position between the two, in 1/256 pixel.
    glm::dvec2 place(double fraction) const {
        const double along = fraction * pitch;
        return down ? glm::dvec2(x, y + along) : glm::dvec2(x + along, y);
    }
};

/// Where corners run clockwise, a walk to the right leaves across the edge that goes down; a walk down, across the
/// one that goes left. So: whether that edge begins on the side with the higher coordinates across the walk.
inline bool exit_begins_beyond(std::uint8_t facing, bool down) { return (facing == clockwise) == down; }

/// The edge that begins on one side and ends on the other, given the sides of a triangle's corners; 3: none.
inline std::uint32_t exit_edge(const bool (&side)[3], bool from_side) {
    constexpr std::uint8_t kEdge[8] = {3, 0, 1, 1, 2, 0, 2, 3};  // by the set of corners on the side where it begins
    const unsigned on_side = (side[0] ? 1u : 0u) | (side[1] ? 2u : 0u) | (side[2] ? 4u : 0u);
    return kEdge[from_side ? on_side : 7 - on_side];
}

/// SurfaceWalk between two neighbours, in one instance.
struct FastWalk {
    enum End : std::uint8_t { arrived, fold, border, crack, unsure };
    static constexpr int kMaxSteps = 1 << 10;
    static constexpr double kBefore = -1e300;  ///< where its first triangle is entered
    /// A triangle on the way. Fractions: 0 = the sample where the walk began, 1 = the other one.
    struct Step {
        std::uint32_t triangle;
        HalfEdge exit;
        double entered, left;
    };

    End end;
    std::uint32_t triangle;  ///< where it ended
    HalfEdge half_edge;      ///< of the fold, border or crack
    std::uint32_t beyond;    ///< crack: the triangle on its other side
    double fraction;
    LineClassSet crossed;      ///< of those asked for, where it gets to the other sample's triangle
    SurfaceEdge crossed_edge;  ///< the first one
    double crossed_fraction;
    double crease_cosine;
    int step_count;
    const Step* steps;  ///< the first one

    bool is_end_of_surface() const { return end == fold || end == border || end == crack; }
    /// Where the walk was when it came to `goal`; if it did not come so far, where it ended.
    struct Stop {
        bool has_arrived;
        std::uint32_t triangle;
        double fraction;
    };
    Stop stop_at(double goal) const;
};

/// Walks from either sample of a pair that were made already, or nullptr.
using KnownWalks = std::array<const FastWalk*, 2>;

/// walk_surface() along a row or column of samples, from one of two neighbours towards the other. Vertices are
/// projected and snapped already, so that sides are integer comparisons.
class FastWalker {
  public:
    FastWalker(const ScreenSurfaces& screen, const LineCriteria& criteria)
        : screen_(screen), surfaces_(screen.surfaces()), criteria_(criteria) {}

    /// Walks from the first sample to the second, or `backwards`. Unsure where triangles reach off the screen, more
    /// than two meet at an edge, or there are very many. The steps are good until the next walk in the same direction.
    /// `passes_goal`: a walk arrives only beyond the other sample, not at it.
    void walk(const NeighbourSamples& pair, bool backwards, FastWalk& result, bool passes_goal = false);

    /// The limits for many walks at once, TileKernels::Walk::over_mesh().
    WalkLimits limits(std::int32_t pitch) const;
    /// Notes the lines that a walk crossed that arrived, by its steps.
    void note_lines(const NeighbourSamples& pair, bool backwards, FastWalk& result);

    /// Whether a triangle is no sliver in any view.
    static bool is_surely_solid(const ScreenMesh& mesh, std::uint32_t triangle) {
        return mesh.sharp != nullptr && (mesh.sharp[triangle] & kThinTriangle) == 0;
    }
    /// Nearness as a function of the position in pixels.
    DepthPlane plane(SurfaceId s) const;
    /// burin::edge_classes(); an edge is asked for where it lies between many pairs of samples.
    LineClassSet edge_classes(SurfaceEdge edge, double* crease_cosine);

  private:
    class Way;
    /// Slivers on the way, as if they were not there.
    struct Slivers {
        std::uint32_t last_solid;  ///< triangle
        int count = 0;             ///< since then

        void enter(std::uint32_t triangle, bool is_sliver) {
            count = is_sliver ? count + 1 : 0;
            if (!is_sliver) last_solid = triangle;
        }
    };
    bool is_sliver_on_way(SurfaceId s, const Slivers& before) const;
    FastWalk::End step_over_seam(const Way& way, std::uint32_t instance, const FastWalk::Step& from, Way& beyond,
                                 FastWalk::Step& next);
    void note_edge(std::uint32_t instance, const FastWalk::Step& left, FastWalk& result);
    void note_contact(std::uint32_t instance, std::uint32_t a, std::uint32_t b, glm::dvec2 subpixel, double fraction,
                      FastWalk& result) const;
    void note(LineClassSet classes, SurfaceEdge edge, double fraction, FastWalk& result) const;
    std::optional<HalfEdge> seam_beyond(std::uint32_t instance, HalfEdge border, double along);
    std::optional<double> unsnapped_part(std::uint32_t instance, HalfEdge edge, glm::dvec2 from, glm::dvec2 along);
    bool are_apart(double nearness_a, double nearness_b) const;
    bool is_level(double nearness_a, double nearness_b, SurfaceId steep) const;

    const ScreenSurfaces& screen_;
    const SurfaceSet& surfaces_;
    const LineCriteria& criteria_;
    SeamMemory seams_{screen_.known_seams()};
    UnsnappedPlaces places_;
    FastWalk::Step steps_[2][FastWalk::kMaxSteps];
    struct KnownEdge {
        SurfaceEdge edge;
        LineClassSet classes;
        double crease_cosine;
    };
    std::vector<KnownEdge> known_edges_;
};

}  // namespace burin
