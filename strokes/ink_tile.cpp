#include "strokes/ink_tile.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/interrupt.h"
#include "strokes/owner_masks.h"

namespace burin {
namespace {

/// Strokes of one chain in an order that depends on nothing but themselves.
bool is_before(const InkedLines& lines, const InkStroke& a, const InkStroke& b) {
    static_assert(sizeof(InkPoint) == 48, "all that is drawn of it is in the key");
    const auto key = [](const InkPoint& p) {
        return std::tuple(p.place.x, p.place.y, p.width_px, p.opacity, p.nearness, p.color.r, p.color.g, p.color.b);
    };
    const auto of_a = lines.points_of(a), of_b = lines.points_of(b);
    return std::lexicographical_compare(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                                        [&](const InkPoint& p, const InkPoint& q) { return key(p) < key(q); });
}

}  // namespace

StrokeSide drawn_side(const InkStroke& stroke) {
    return stroke.is_behind || stroke.order.is_hidden ? StrokeSide::both : stroke.side;
}

InkTile::InkTile(const Frame& frame, const InkedLines& lines, const InkPlan& plan, const TileKernels& kernels)
    : lines_(lines), plan_(plan), projection_(frame.surfaces.projection), kernels_(kernels), clipper_(kernels) {}

InkSegment InkTile::segment_of(const InkSegmentRef& ref) const {
    InkSegment segment(lines_.points[ref.point], lines_.points[ref.point + 1], drawn_side(lines_.strokes[ref.stroke]));
    if (lines_.strokes[ref.stroke].caps == StrokeCaps::butt) cut_at_ends(ref, segment);
    return segment;
}

/// Cuts off a stroke's round ends: also what discs of segments near an end have beyond it.
void InkTile::cut_at_ends(const InkSegmentRef& ref, InkSegment& segment) const {
    const InkStroke& stroke = lines_.strokes[ref.stroke];
    if (stroke.is_closed) return;
    const auto points = lines_.points_of(stroke);
    const std::size_t own = ref.point - stroke.first_point, last = points.size() - 1;
    const auto direction = [](glm::dvec2 from, glm::dvec2 to) {
        const double length = glm::distance(from, to);
        return length > 0 ? (to - from) / length : glm::dvec2(1, 0);
    };
    double way = 0;
    std::size_t i = own;
    for (; i > 0 && way <= segment.radius_px(); --i) way += glm::distance(points[i].place, points[i - 1].place);
    if (i == 0 && way <= segment.radius_px())
        segment.cut(points[0].place, -direction(points[0].place, points[1].place));
    way = 0;
    for (i = own + 1; i < last && way <= segment.radius_px(); ++i)
        way += glm::distance(points[i].place, points[i + 1].place);
    if (i == last && way <= segment.radius_px())
        segment.cut(points[last].place, direction(points[last - 1].place, points[last].place));
}

void InkTile::draw(std::span<const InkSegmentRef> segments, std::span<const std::uint32_t> boundaries, PixelRect rect) {
    rect_ = rect;
    stride_ = (rect.width() + 7) / 8 * 8;
    const auto pixels = static_cast<std::size_t>(stride_ * rect.height());
    touched_.assign(pixels, 0);
    record_at_.assign(pixels, 0);
    records_.clear();
    layers_.clear();
    used_canvases_ = 0;
    keys_.clear();
    for (std::size_t i = 0; i < segments.size(); ++i) keys_.push_back(std::uint64_t{segments[i].rank} << 32 | i);
    std::sort(keys_.begin(), keys_.end());
    segments_.clear();
    for (const std::uint64_t key : keys_) segments_.push_back(segments[static_cast<std::uint32_t>(key)]);
    find_boundaries(boundaries);
    const auto chain_of = [&](const InkSegmentRef& ref) {
        const InkStroke& stroke = lines_.strokes[ref.stroke];
        return std::pair(stroke.chain, stroke.blend);
    };
    for (std::size_t begin = 0, end; begin < segments_.size(); begin = end) {
        const InkPlan::Look& look = plan_.looks[segments_[begin].stroke];
        bool is_layer = look.is_plain && plan_.most_halo_px <= 0;
        for (end = begin; end < segments_.size() && segments_[end].rank == look.rank; ++end)
            is_layer = is_layer && plan_.looks[segments_[end].stroke] == look;
        const std::span<InkSegmentRef> own(segments_.data() + begin, end - begin);
        if (is_layer) {
            draw_layer(own);
            continue;
        }
        std::sort(own.begin(), own.end(), [&](const InkSegmentRef& a, const InkSegmentRef& b) {
            if (chain_of(a) != chain_of(b)) return chain_of(a) < chain_of(b);
            if (a.stroke == b.stroke) return a.point < b.point;
            const InkStroke &of_a = lines_.strokes[a.stroke], &of_b = lines_.strokes[b.stroke];
            if (is_before(lines_, of_a, of_b)) return true;
            return !is_before(lines_, of_b, of_a) && a.stroke < b.stroke;
        });
        for (std::size_t first = 0, last; first < own.size(); first = last) {
            for (last = first; last < own.size() && chain_of(own[last]) == chain_of(own[first]);) ++last;
            draw_chain(own.subspan(first, last - first));
        }
    }
    sort_records();
    if (plan_.most_halo_px > 0) erase_behind_halos();
}

/// Finds the boundaries that may hide a part of any segment, if there are any.
void InkTile::find_boundaries(std::span<const std::uint32_t> boundaries) {
    boundaries_.clear();
    boundary_numbers_.clear();
    clipping_.clear();
    most_cuts_below_ = 0;
    least_drawn_width_px_ = std::numeric_limits<float>::infinity();
    bool has_sides = false;
    std::uint32_t least_rank = ~0u;
    for (const InkSegmentRef& ref : segments_) {
        const InkStroke& stroke = lines_.strokes[ref.stroke];
        if (stroke.is_behind || stroke.order.is_hidden) continue;
        has_sides = has_sides || stroke.side != StrokeSide::both;
        least_rank = std::min(least_rank, ref.rank);
    }
    const bool may_hide =
        plan_.has_drawn_widths || std::any_of(boundaries.begin(), boundaries.end(),
                                              [&](std::uint32_t i) { return least_rank < plan_.hides_below[i]; });
    if (!may_hide && !has_sides) return;
    for (const std::uint32_t i : boundaries) {
        const InkBoundary& b = lines_.boundaries[i];
        boundaries_.push_back({b.from, b.to, depth_px(projection_, b.nearness_from),
                               depth_px(projection_, b.nearness_to), true, b.front_on_left, plan_.hides_below[i],
                               b.drawn_width_px});
        boundary_numbers_.push_back(i);
        most_cuts_below_ = std::max(most_cuts_below_, plan_.hides_below[i]);
        least_drawn_width_px_ = std::min(least_drawn_width_px_, b.drawn_width_px);
    }
    for (const ClipPiece& b : boundaries_) clipping_.push_back(&b);
    clipper_.reset(rect_.x0, rect_.y0, rect_.width(), rect_.height());
    clipper_.set_boundaries(clipping_);
}

void InkTile::draw_layer(std::span<const InkSegmentRef> segments) {
    if (used_canvases_ == canvases_.size()) canvases_.emplace_back(kernels_);
    StrokeCanvas& canvas = canvases_[used_canvases_++];
    canvas.reset(rect_.x0, rect_.y0, rect_.width(), rect_.height());
    const std::uint32_t stroke = segments.front().stroke;
    layers_.push_back({&plan_.looks[stroke], stroke, &canvas});
    for (const InkSegmentRef& ref : segments) {
        throw_if_interrupted();
        if (owners_ != nullptr) tell_owner(ref);
        const bool may_be_cut = may_be_clipped(ref);
        const InkStroke& own = lines_.strokes[ref.stroke];
        if (!may_be_cut && own.is_constant && own.caps == StrokeCaps::round) {  // mostly
            canvas.draw(lines_.points[ref.point].place, lines_.points[ref.point + 1].place,
                        static_cast<double>(plan_.pen_radius_px[ref.stroke]));
            continue;
        }
        const Placed placed(*this, ref);
        const bool is_cut = may_be_cut && is_clipped(placed);
        for (const InkSegment::Part& part : placed.segment.parts()) {
            if (is_cut) {
                draw_clipped(placed, part.cone, canvas);
            } else {
                canvas.draw(part.cone);
            }
        }
    }
}

void InkTile::tell_owner(const InkSegmentRef& ref) {
    const StrokeOrigin& origin = lines_.origins[ref.stroke];
    const InkSegment segment = segment_of(ref);
    OwnerMasks::Line line;
    line.group = ref.rank;
    line.drawn_as = plan_.orders[ref.rank].drawn_as;
    line.invisibility = origin.invisibility;
    line.owner = {origin.object, origin.material};
    line.width_px = segment.from().width_px;
    for (const InkSegment::Part& part : segment.parts())
        owners_->add(part.cone, segment.from().nearness, segment.to().nearness, line);
}

void InkTile::sort_records() {
    first_sorted_.assign(touched_.size() + 1, 0);
    for (const InkRecord& r : records_) ++first_sorted_[r.pixel + 1];
    for (std::size_t i = 1; i < first_sorted_.size(); ++i) first_sorted_[i] += first_sorted_[i - 1];
    sorted_.resize(records_.size());
    next_.assign(first_sorted_.begin(), first_sorted_.end() - 1);
    for (std::uint32_t i = 0; i < records_.size(); ++i) sorted_[next_[records_[i].pixel]++] = i;
}

/// Whether boundaries may cut a segment, or it is drawn on one side only.
bool InkTile::may_be_clipped(const InkSegmentRef& ref) const {
    const InkStroke& stroke = lines_.strokes[ref.stroke];
    if (drawn_side(stroke) != StrokeSide::both) return true;
    if (stroke.is_behind || stroke.order.is_hidden || boundaries_.empty()) return false;
    return ref.rank < most_cuts_below_ ||
           least_drawn_width_px_ < std::max(lines_.points[ref.point].width_px, lines_.points[ref.point + 1].width_px);
}

/// Whether any boundary is near enough to cut a part of it.
bool InkTile::is_clipped(const Placed& placed) {
    return may_be_clipped(placed.ref) && clipper_.may_cut(clip_piece(placed), placed.segment.radius_px(),
                                                          drawn_side(lines_.strokes[placed.ref.stroke]));
}

ClipPiece InkTile::clip_piece(const Placed& placed) const {
    const InkPoint &from = placed.segment.from(), &to = placed.segment.to();
    ClipPiece piece{
        from.place,    to.place,          depth_px(projection_, from.nearness), depth_px(projection_, to.nearness),
        from.occludes, from.front_on_left};
    piece.rank = placed.ref.rank;
    piece.width_px = std::max(from.width_px, to.width_px);
    piece.is_cut_by_all = lines_.strokes[placed.ref.stroke].side != StrokeSide::both;
    return piece;
}

void InkTile::draw_clipped(const Placed& placed, const PenCone& cone, StrokeCanvas& onto) {
    const ClipPiece piece = clip_piece(placed);
    clipper_.draw(own_boundary(placed, piece), cone, drawn_side(lines_.strokes[placed.ref.stroke]), onto);
}

/// draw_clipped(), but lists what is left.
void InkTile::list_clipped(const Placed& placed, const PenCone& cone, std::vector<StrokeClipper::CutPixel>& pixels) {
    const ClipPiece piece = clip_piece(placed);
    clipper_.list(own_boundary(placed, piece), cone, drawn_side(lines_.strokes[placed.ref.stroke]), pixels);
}

/// The boundary along which a stroke on one side is drawn, which does not cut it; otherwise `piece`.
const ClipPiece& InkTile::own_boundary(const Placed& placed, const ClipPiece& piece) const {
    const std::uint32_t own = placed.segment.from().boundary;
    if (drawn_side(lines_.strokes[placed.ref.stroke]) == StrokeSide::both || own == InkPoint::kNoBoundary) return piece;
    const auto at = std::lower_bound(boundary_numbers_.begin(), boundary_numbers_.end(), own);
    return at != boundary_numbers_.end() && *at == own
               ? boundaries_[static_cast<std::size_t>(at - boundary_numbers_.begin())]
               : piece;
}

/// In pixels' widths: a difference of 1 is a pixel's width at that distance.
double depth_px(const Projection& projection, float nearness) {
    return projection.focal_px *
           (projection.orthographic ? -static_cast<double>(nearness) : -std::log(static_cast<double>(nearness)));
}

}  // namespace burin
