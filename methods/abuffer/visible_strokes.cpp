#include "methods/abuffer/visible_strokes.h"

#include <algorithm>
#include <cmath>

namespace burin {

VisibleStrokes::VisibleStrokes(const Frame& frame, const TileKernels& kernels)
    : projection_(frame.surfaces.projection),
      side_(frame.scene->lines.style.side),
      pen_(frame.scene->lines.style.width_px, side_),
      clipper_(kernels) {
    for (StrokeCanvas& canvas : canvases_) canvas = StrokeCanvas(kernels);
}

void VisibleStrokes::draw(std::span<const LineSegment* const> segments, PixelRect rect) {
    rect_ = rect;
    LineClassSet present;
    for (const LineSegment* s : segments) {
        if (s->is_drawn) present |= s->drawn_as;
    }
    classes_.clear();
    for (int c = 0; c < kLineClassCount; ++c) {
        const auto line_class = static_cast<LineClass>(c);
        if (!present.has(line_class)) continue;
        classes_.push_back(line_class);
        canvas_of(line_class).reset(rect.x0, rect.y0, rect.width(), rect.height());
    }
    if (needs_clipping(segments)) return draw_clipped(segments);
    for (const LineSegment* s : segments) canvas_of(s->drawn_as).draw(s->from, s->to, pen_.radius_px);
}

/// The stroke of a boundary that is drawn covers what other strokes cover of the surface in front, unless
/// their class comes first.
bool VisibleStrokes::needs_clipping(std::span<const LineSegment* const> segments) const {
    if (side_ != StrokeSide::both) return true;
    for (const LineSegment* s : segments) {
        if (s->occludes && (!s->is_drawn || s->drawn_as > classes_.front())) return !classes_.empty();
    }
    return false;
}

void VisibleStrokes::draw_clipped(std::span<const LineSegment* const> segments) {
    pieces_.clear();
    for (const LineSegment* s : segments) {
        pieces_.push_back({s->from, s->to, depth_px(s->nearness_from), depth_px(s->nearness_to), s->occludes,
                           s->front_on_left});
    }
    clipper_.reset(rect_.x0, rect_.y0, rect_.width(), rect_.height());
    for (const LineClass c : classes_) {
        boundaries_.clear();
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const LineSegment& s = *segments[i];
            if (s.occludes && (side_ != StrokeSide::both || !s.is_drawn || s.drawn_as > c)) {
                boundaries_.push_back(&pieces_[i]);
            }
        }
        for (std::size_t i = 0; i < segments.size(); ++i) {
            if (!segments[i]->is_drawn || segments[i]->drawn_as != c) continue;
            clipper_.draw(pieces_[i], pen_.radius_px, side_, boundaries_, canvas_of(c));
        }
    }
}

/// In pixels' widths at that distance: a difference of 1 is a pixel's width.
double VisibleStrokes::depth_px(float nearness) const {
    return projection_.focal_px * (projection_.orthographic ? -static_cast<double>(nearness)
                                                            : -std::log(static_cast<double>(nearness)));
}

}  // namespace burin
