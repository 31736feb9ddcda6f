#pragma once

#include <compare>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "image/image.h"
#include "lines/line_class.h"
#include "shading/ink/inked_lines.h"

// A picture's lines as paths: what the writers of vector files read.

namespace burin {

/// How paths look.
struct VectorStyle {
    /// The full width of the pen, in pixels; 0: the path is the outline of its ink, and is filled.
    float width_px = 1;
    bool is_region = false;  ///< filled, whether it has a stroke or not, which has the same colour
    glm::vec3 color{0.0f};   ///< linear RGB
    float opacity = 1;
    InkBlend blend = InkBlend::over;
    StrokeCaps caps = StrokeCaps::round;  ///< joins are always round
    std::vector<float> dash_px;           ///< on, off, on, off ...: an even number; empty: solid

    bool is_outline() const { return width_px == 0; }
    bool operator==(const VectorStyle&) const = default;
};

/// One step of a path, to where the next one begins.
struct PathStep {
    /// `move`: of a filled path, closes the part before and begins another one.
    enum class Kind : std::uint8_t { line, cubic, arc, move };
    Kind kind = Kind::line;
    bool is_large = false, is_clockwise = false;  ///< of an arc, as SVG has them, y downwards
    glm::dvec2 to{0.0};
    /// Of a cubic, its inner control points. Of an arc of an ellipse the radii, and {angle of the first axis, 0} in
    /// degrees.
    glm::dvec2 a{0.0}, b{0.0};
};

/// A path that lies on more edges names this many.
constexpr std::size_t kMostEdgeNames = 16;

/// Some programs take no longer paths.
constexpr std::size_t kMostPathSteps = 31999;

/// A path, and which line it is.
struct VectorPath {
    glm::dvec2 start{0.0};  ///< in pixels of the whole picture
    std::size_t first_step = 0, step_count = 0;
    bool is_closed = false;                      ///< its last step ends where it starts
    std::uint32_t style = 0;                     ///< in VectorDrawing::styles
    float dash_phase_px = 0;                     ///< where in its pattern it begins
    std::uint32_t object = 0;                    ///< in VectorDrawing::objects, from 1; 0: none
    std::uint8_t invisibility = 0;               ///< how many opaque surfaces are in front, at least
    std::size_t first_edge = 0, edge_count = 0;  ///< in VectorDrawing::edges
    std::size_t unnamed_edges = 0;               ///< how many more edges it lies on
};

/// Paths that lie above or below those of other groups, one after the other.
struct VectorGroup {
    bool is_surface = false;  ///< regions of one object; else lines
    bool is_hidden = false;
    std::uint8_t invisibility = 0;  ///< of all its paths if the drawing is grouped by that
    std::uint32_t set = 0;          ///< in VectorDrawing::sets
    std::uint32_t view = 0;         ///< in VectorDrawing::views, from 1; 0: the only one
    LineClass line_class = LineClass::silhouette;
    std::uint32_t object = 0;  ///< of all its paths if the drawing is grouped by objects
    std::size_t first_path = 0, path_count = 0;
};

/// What groups have in common, within visible and within hidden lines.
enum class VectorGrouping : std::uint8_t { line_class, object, invisibility };

/// The lines of a picture as paths, and its surfaces as filled ones, in the order in which they are drawn: what comes
/// later lies above.
struct VectorDrawing {
    int width_px = 0, height_px = 0;  ///< of the whole picture
    PixelRect crop;                   ///< what is shown of it
    double dpi = 96;
    glm::dvec2 paper_mm{0.0};        ///< exact size of the sheet, of which the pixels are rounded; 0: as dpi says
    std::optional<glm::vec3> paper;  ///< linear RGB; none: transparent
    VectorGrouping grouping = VectorGrouping::line_class;

    std::vector<PathStep> steps;
    /// Names of edges that paths lie on: hashes of objects' names and of places in objects, the same in all pictures.
    /// Parts of one edge before and behind a surface have one name. Contours have one name per object and class.
    std::vector<std::uint64_t> edges;
    std::vector<VectorPath> paths;
    std::vector<VectorGroup> groups;
    std::vector<VectorStyle> styles;
    std::vector<std::string> objects;  ///< names by number, from 1
    std::vector<std::string> sets;     ///< names of line sets
    std::vector<std::string> views;    ///< names of views on one sheet, from 1

    std::span<const PathStep> steps_of(const VectorPath& path) const {
        return std::span(steps).subspan(path.first_step, path.step_count);
    }
    std::span<const std::uint64_t> edges_of(const VectorPath& path) const {
        return std::span(edges).subspan(path.first_edge, path.edge_count);
    }
    std::span<const VectorPath> paths_of(const VectorGroup& group) const {
        return std::span(paths).subspan(group.first_path, group.path_count);
    }
};

}  // namespace burin
