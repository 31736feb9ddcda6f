#include "strokes/visible_strokes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shading/dash_style.h"

namespace burin {
namespace {

constexpr double kWideRadiusPx = 8;
constexpr std::size_t kLookEvery = 16;
using Near = std::pair<double, std::size_t>;  // how near a stroke is, and its number

double distance_to(glm::dvec2 place, const ClipPiece& piece) {
    const glm::dvec2 along = piece.to - piece.from;
    const double square = glm::dot(along, along), share = square > 0 ? glm::dot(place - piece.from, along) / square : 0;
    return glm::distance(place, piece.from + along * std::clamp(share, 0.0, 1.0));
}

}  // namespace

VisibleStrokes::VisibleStrokes(const Frame& frame, const TileKernels& kernels)
    : projection_(frame.surfaces.projection),
      side_(frame.scene->lines.style.side),
      pen_(frame.scene->lines.style.width_px, side_, visible_dashes(frame.scene->lines.style).opacity),
      faded_(kernels),
      clipper_(kernels) {
    for (StrokeCanvas& canvas : canvases_) canvas = StrokeCanvas(kernels);
}

void VisibleStrokes::draw(std::span<const LinePiece* const> pieces, PixelRect rect) {
    rect_ = rect;
    LineClassSet present;
    for (const LinePiece* s : pieces) {
        if (s->is_drawn && s->opacity == 255) present |= s->drawn_as;
    }
    classes_.clear();
    for (int c = 0; c < kLineClassCount; ++c) {
        const auto line_class = static_cast<LineClass>(c);
        if (!present.has(line_class)) continue;
        classes_.push_back(line_class);
        canvas_of(line_class).reset(rect.x0, rect.y0, rect.width(), rect.height());
    }
    if (needs_clipping(pieces)) return draw_clipped(pieces);
    for (const LinePiece* s : pieces) {
        if (s->is_drawn && s->opacity == 255) canvas_of(s->drawn_as).draw(s->from, s->to, pen_.radius_px);
    }
    faded_.draw(pieces, rect, [&](std::size_t i, StrokeCanvas& canvas) {
        canvas.draw(pieces[i]->from, pieces[i]->to, pen_.radius_px);
    });
}

/// Whether strokes would lie over surfaces in front. They do not where the boundary of such a surface is drawn, too:
/// its stroke covers what others cover of the surface, unless their class comes first. That is so because strokes have
/// one width and round ends: where others reach beyond the boundary's end, its own disc lies there, too.
bool VisibleStrokes::needs_clipping(std::span<const LinePiece* const> pieces) const {
    if (side_ != StrokeSide::both) return true;
    bool has_faded = false, has_undrawn = false;
    for (const LinePiece* s : pieces) {
        has_faded = has_faded || (s->is_drawn && s->opacity < 255);
        has_undrawn = has_undrawn || !s->is_drawn;
        if (s->occludes && s->is_drawn && !classes_.empty() && s->drawn_as > classes_.front()) return true;
    }
    return has_undrawn && (has_faded || !classes_.empty());
}

void VisibleStrokes::draw_clipped(std::span<const LinePiece* const> pieces) {
    pieces_.clear();
    for (const LinePiece* s : pieces) {
        pieces_.push_back(
            {s->from, s->to, depth_px(s->nearness_from), depth_px(s->nearness_to), s->occludes, s->front_on_left});
    }
    clipper_.reset(rect_.x0, rect_.y0, rect_.width(), rect_.height());
    const bool is_wide = pen_.radius_px > kWideRadiusPx;
    const glm::dvec2 middle(0.5 * (rect_.x0 + rect_.x1), 0.5 * (rect_.y0 + rect_.y1));
    const StrokeCanvas::Box all{0, 0, rect_.width(), rect_.height()};
    for (const LineClass c : classes_) {
        find_boundaries(pieces, c);
        std::vector<Near> strokes;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            if (!pieces[i]->is_drawn || pieces[i]->opacity < 255 || pieces[i]->drawn_as != c) continue;
            strokes.push_back({is_wide ? distance_to(middle, pieces_[i]) : 0, i});
        }
        // Strokes make the same masks in any order. The nearest ones come first: where they are wide they fill the
        // tile, and nothing is left to do for the others.
        if (is_wide) std::sort(strokes.begin(), strokes.end());
        for (std::size_t k = 0; k < strokes.size(); ++k) {
            if (is_wide && k % kLookEvery == 0 && canvas_of(c).open_part(all).is_empty()) break;
            clipper_.draw(pieces_[strokes[k].second], pen_.radius_px, side_, canvas_of(c));
        }
    }
    std::optional<LineClass> bounded;
    faded_.draw(pieces, rect_, [&](std::size_t i, StrokeCanvas& canvas) {
        if (bounded != pieces[i]->drawn_as) find_boundaries(pieces, *(bounded = pieces[i]->drawn_as));
        clipper_.draw(pieces_[i], pen_.radius_px, side_, canvas);
    });
}

/// Finds the boundaries that hide strokes of a class.
void VisibleStrokes::find_boundaries(std::span<const LinePiece* const> pieces, LineClass line_class) {
    boundaries_.clear();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const LinePiece& s = *pieces[i];
        if (s.occludes && (side_ != StrokeSide::both || !s.is_drawn || s.drawn_as > line_class)) {
            boundaries_.push_back(&pieces_[i]);
        }
    }
    clipper_.set_boundaries(boundaries_);
}

/// The depth of a place in pixels' widths: a difference of 1 is a pixel's width at that distance.
double VisibleStrokes::depth_px(float nearness) const {
    return projection_.focal_px *
           (projection_.orthographic ? -static_cast<double>(nearness) : -std::log(static_cast<double>(nearness)));
}

}  // namespace burin
