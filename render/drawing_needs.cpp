#include "render/drawing_needs.h"

#include <algorithm>

#include "shading/dash_style.h"
#include "shading/sheet/compiled_sheet.h"

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

DrawingNeeds needs_of(const Scene& scene, const SheetNeeds& sheet) {
    // Lines farther beside the picture than this leave no ink in it, however wide a sheet makes them.
    constexpr float kFarthestPx = 64;
    DrawingNeeds needs;
    needs.classes = scene.finds_all ? LineClassSet::all() : sheet.classes;
    needs.most_invisibility = scene.finds_all ? DrawingNeeds::kAnyInvisibility : sheet.most_invisibility;
    needs.tells_invisibility =
        scene.finds_all || sheet.tells_invisibility || (scene.names_lines && needs.most_invisibility > 0);
    needs.is_transparent = has_transparent_surfaces(scene);
    needs.whole_picture = true;
    needs.whole_picture_behind = needs.behind();
    needs.whole_lines = scene.finds_all || scene.names_lines || sheet.chains || sheet.hidden_chains;
    needs.surfaces_beyond = scene.finds_all || sheet.sides;
    needs.one_sided = sheet.one_sided;
    needs.reach_px =
        static_cast<double>(std::min(sheet.most_reach_px, kFarthestPx)) + reach_px(scene.lines.style.filter);
    return needs;
}

}  // namespace burin
