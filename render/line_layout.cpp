#include "render/line_layout.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lines/dashes.h"
#include "lines/dashes_behind.h"
#include "lines/line_dashes.h"
#include "lines/smooth_contours.h"
#include "shading/dash_style.h"

namespace burin {
namespace {

/// Pieces behind surfaces, of which those that are one line to the eye become one.
std::vector<LinePiece> joined(const LineDrawing::Lists& lists) {
    std::vector<LinePiece> pieces;
    for (const std::span<const LinePiece> list : lists) {
        for (const LinePiece& piece : list) {
            if (!pieces.empty() && goes_on_alike(pieces.back(), piece)) {
                extend(pieces.back(), piece);
            } else {
                pieces.push_back(piece);
            }
        }
    }
    return pieces;
}

}  // namespace

LineDrawing laid_out(LineDrawing found, const Frame& frame, int threads) {
    const LineSettings& lines = frame.scene->lines;
    const LineStyle& style = lines.style;
    const PixelRect picture = frame.reach();
    const auto dash_px = visible_dashes(style).dash_px, dash_behind_px = hidden_dashes(style).dash_px;
    std::optional<SmoothContours> contours;
    if (lines.contours == Contours::smooth) contours.emplace(frame.surfaces, frame.criteria.cos_crease_angle, threads);

    LineDrawing drawing;
    std::vector<std::vector<LinePiece>> visible = found.take_visible();
    if (contours) contours->move(visible, threads);
    std::optional<CourseIndex> visible_courses;  // before they are dashed
    if (dash_px && dash_behind_px && frame.needs.behind()) {
        const double width_px = std::min(style.width_px, style.hidden_width_px());
        visible_courses = courses_of(visible, picture, SharedDashes::reach_of_pen_px(width_px));
    }
    if (dash_px) {
        visible = dashed(visible, *dash_px, style.width_px, picture, features_of(found.whole_lines()), frame.surfaces);
    }
    for (std::vector<LinePiece>& list : visible) drawing.add_visible(std::move(list));
    if (!frame.needs.behind()) return drawing;

    std::optional<DashesBehind> of_hidden, seen_through;
    if (dash_behind_px) {
        of_hidden.emplace(found.whole_lines(), frame.surfaces, picture, *dash_behind_px, style.hidden_width_px());
    }
    if (dash_px && frame.needs.is_transparent) {
        seen_through.emplace(found.whole_lines(), frame.surfaces, picture, *dash_px, style.width_px);
    }
    std::vector<LinePiece> behind;
    for (const LinePiece& piece : joined(found.behind())) {
        const std::optional<DashesBehind>& dashes = piece.is_hidden() ? of_hidden : seen_through;
        if (dashes) {
            dashes->add(piece, piece.is_hidden() && visible_courses ? &*visible_courses : nullptr, behind);
        } else {
            behind.push_back(piece);
        }
    }
    if (contours) contours->move(behind);
    drawing.add_behind(std::move(behind));
    return drawing;
}

}  // namespace burin
