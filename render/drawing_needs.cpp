#include "render/drawing_needs.h"

#include "shading/dash_style.h"

namespace burin {

DrawingNeeds needs_of(const Scene& scene) {
    const LineSettings& lines = scene.lines;
    const bool has_hidden = lines.style.hidden.style != HiddenStyle::none;
    const bool is_dashed = visible_dashes(lines.style).dash_px.has_value();
    const bool is_dashed_behind = hidden_dashes(lines.style).dash_px.has_value();
    DrawingNeeds needs;
    needs.classes = lines.classes;
    needs.most_invisibility = has_hidden ? DrawingNeeds::kAnyInvisibility : 0;
    needs.is_transparent = has_transparent_surfaces(scene);
    needs.whole_picture = is_dashed || lines.contours == Contours::smooth;
    needs.whole_picture_behind = needs.behind() && (is_dashed_behind || needs.whole_picture);
    needs.whole_lines = is_dashed || is_dashed_behind;
    needs.one_sided = lines.style.side != StrokeSide::both;
    needs.reach_px = lines.style.reach_px();
    return needs;
}

}  // namespace burin
