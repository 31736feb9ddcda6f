#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "abuffer/edges/occluder.h"
#include "abuffer/screen/screen_surfaces.h"
#include "lines/narrow_lap.h"
#include "lines/whole_line.h"

// Where a line lies in the plane of a surface, the order of both decides which is seen.

namespace burin {

/// How far to one side of a line a place lies at which something covers what ends at the line. 1/64 pixel.
constexpr double kToOneSideSubpixels = 4;

/// What is seen where a line lies in the plane of a surface that it is no edge of, as the foot of a wall does on a
/// floor. Of surfaces in one plane the first one is seen (docs/decisions/0009-one-plane-one-answer.md). All questions
/// are about a part [begin, end] of a line, as shares; `level` is how near things at one depth are, in nearness.
class Contacts {
  public:
    explicit Contacts(const ScreenSurfaces& screen) : screen_(screen) {}

    /// Whether `t` is seen instead of the triangles at a line: none rises in front of it beside the line, or comes
    /// before it.
    bool is_seen_instead(const WholeLine& line, double begin, double end, const Occluder& t, double level) const;
    /// Whether the surface of `t` is in front of all triangles at a line beside it: they are behind it, or in its plane
    /// and come after it. Surfaces that end side by side hide nothing of each other.
    bool is_in_front(const WholeLine& line, double begin, double end, const Occluder& t, double level) const;

    /// Whether the line is none, for the surface of `t` goes on without a line on both sides of it, in the plane of a
    /// triangle at the line, and nothing at the line is in front of it: flush faces of bodies in one another. With
    /// `on_one_side`, only where both bodies are on one side of the plane; those in contact are on either side.
    bool is_flush(const WholeLine& line, double begin, double end, const Occluder& t, double level,
                  const LineCriteria& criteria, bool on_one_side) const;

    /// Whether `t` lies in the plane of a triangle at a line, and is in front of a part of the line by less than
    /// `certain` everywhere, in nearness: then it is level with the line, but for rounding.
    bool is_in_plane(const WholeLine& line, double begin, double end, const Occluder& t, double certain) const;

    /// What the contact with `t`, where that goes on beyond a border at its depth or a little behind, makes of the
    /// border, among classes asked for; where, [begin, end] says then. nullopt: nowhere.
    std::optional<LineClassSet> classes_of_contact(const WholeLine& line, const Occluder& t,
                                                   const LineCriteria& criteria, double& begin, double& end) const;

  private:
    std::optional<glm::dvec2> touching_place(const WholeLine& line, double begin, double end, const Occluder& t,
                                             double level) const;
    std::optional<glm::dvec2> place_beside(SurfaceId s, std::uint32_t owner, glm::dvec2 at) const;
    bool laps_narrowly(const WholeLine& line, SurfaceId own, const FacePlace& other, glm::dvec2 middle) const;
    bool have_bodies_on_one_side(SurfaceId a, SurfaceId b) const;
    enum class Over { any_edge, plain_edges };
    std::optional<Occluder> what_covers(glm::dvec2 place, const Occluder& t, Over over,
                                        const LineCriteria* criteria = nullptr) const;
    std::optional<Occluder> what_covers_in_plane(glm::dvec2 place, SurfaceId own, HalfEdge h,
                                                 const LineCriteria& criteria) const;
    std::optional<Occluder> part_at(glm::dvec2 place, SurfaceId s) const;
    bool have_vertex_in_common(SurfaceId s, const Occluder& t) const;
    bool is_seen_first(std::uint32_t one, std::uint32_t other, double gap) const;
    std::optional<glm::dvec2> centre_of(SurfaceId s, std::uint32_t number) const;

    const ScreenSurfaces& screen_;
};

}  // namespace burin
