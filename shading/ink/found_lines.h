#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lines/line_runs.h"
#include "mesh/polygon_soup.h"
#include "shading/ink/line_sides.h"
#include "shading/ink/surface_values.h"
#include "shading/line_style.h"
#include "shading/surface/light.h"

namespace burin {

class ShadowCasters;

/// An object as its lines know it.
struct ObjectOfLines {
    std::string name;
    std::uint32_t same_name_before = 0;  ///< how many objects before it have its name
    glm::dmat4 from_view{1.0};           ///< view space to the object, before its transform
    double units_per_view = 1;           ///< the object's units in one unit of view space, as a mean of the axes
};

/// FoundLines is all that line shading reads: the lines of one picture as runs, and what is known beside them. It needs
/// no mesh, so it can be kept in a file and shaded again.
struct FoundLines {
    LineRuns runs;
    std::vector<LineSides> sides;       ///< of each piece
    SurfaceNeeds surface;               ///< which values of surfaces are known
    std::vector<float> surface_values;  ///< for each piece the columns of `surface` at its begin, then at its end
    std::vector<LinePiece> boundaries;  ///< where surfaces end and nothing is drawn
    LineClassSet classes;               ///< that were looked for
    int most_invisibility = 0;          ///< that was looked for
    bool tells_invisibility = false;    ///< else a hidden piece has only some surface in front of it
    bool has_normals = false, has_beyond = false;
    bool has_chains = false;                         ///< of visible lines, and of hidden ones if these were looked for
    bool has_hidden_chains = false;                  ///< of hidden lines
    std::array<double, 2> crease_angle_deg{40, 40};  ///< from where to where creases faded in
    bool has_smooth_contours = false;
    PixelFilter filter = PixelFilter::box;

    Projection projection;
    glm::dmat4 camera_to_world{1.0};
    int width_px = 0, height_px = 0;         ///< of the whole picture
    std::vector<ObjectOfLines> objects;      ///< by number, from 1
    std::vector<std::string> materials;      ///< names by number, from 1
    std::vector<glm::vec3> material_colors;  ///< linear RGB
    /// Direction to the key light in view space, where the sheet says it.
    std::optional<glm::dvec3> light;
    std::optional<ViewLight> scene_light;  ///< the key light of the scene; none: it is at the eye
    /// What casts shadows in the key light's light; nullptr: nobody reads `lit`.
    std::shared_ptr<const ShadowCasters> casters;
    double frame = 0;
    double fps = 24, dpi = 96;
    glm::dvec2 paper_mm{0.0};  ///< size of the sheet, of which width_px and height_px are rounded; 0: none
};

/// What is to be known of lines.
struct FoundLinesNeeds {
    bool normals = false;
    bool chains = false;         ///< of visible lines and of hidden ones
    bool hidden_chains = false;  ///< of hidden lines
    bool ends = true;            ///< of lines with chains: what stops them
    SurfaceNeeds surface;
    double apart_px = 0;  ///< PieceLinking::apart_px
};

/// Makes runs of the lines of a picture, and finds what is beside them. `objects` and what describes the picture are
/// filled in by the caller. `drawing` has what was asked for. `curvatures`: of each instance's mesh, if `kr` is needed.
void find_sides_and_runs(const LineDrawing& drawing, const SurfaceSet& surfaces, double cos_crease_angle,
                         const FoundLinesNeeds& needs, std::span<const MeshCurvature* const> curvatures, int threads,
                         FoundLines& lines);

}  // namespace burin
