#include <algorithm>
#include <map>

#include "shading/pen.h"
#include "strokes/ink_tile.h"

namespace burin {
namespace {

/// Whether a stroke is opaque ink of one colour that covers all that it reaches, whatever its width is on the way:
/// never as thin as masks cannot show, or of a width that they show a little too wide and lighter.
bool covers(std::span<const InkPoint> points, StrokeSide side) {
    const InkPoint* before = nullptr;
    for (const InkPoint& p : points) {
        if (p.opacity != 1 || p.color != points.front().color) return false;
        const bool is_level = before != nullptr && before->width_px == p.width_px;
        if (is_level ? Pen(p.width_px, side).strength != 1 : InkSegment::is_thin(p.width_px, side)) return false;
        before = &p;
    }
    return true;
}

}  // namespace

InkPlan plan_of(const InkedLines& lines) {
    InkPlan plan;
    std::map<InkOrder, std::uint32_t> ranks;
    const InkOrder* last = nullptr;  // strokes that follow each other mostly have one order
    for (const InkStroke& stroke : lines.strokes) {
        if (last == nullptr || stroke.order != *last) ranks.emplace(stroke.order, 0);
        last = &stroke.order;
    }
    for (auto& [order, rank] : ranks) {
        rank = static_cast<std::uint32_t>(plan.orders.size());
        plan.orders.push_back(order);
    }
    plan.looks.reserve(lines.strokes.size());
    plan.pen_radius_px.reserve(lines.strokes.size());
    float most_width_px = 0;
    std::uint32_t least_rank = ~0u;  // of the strokes that boundaries may cut
    for (const InkStroke& stroke : lines.strokes) {
        InkPlan::Look& look = plan.looks.emplace_back();
        const bool is_as_before = plan.looks.size() > 1 && stroke.order == (&stroke - 1)->order;
        look.rank = is_as_before ? plan.looks[plan.looks.size() - 2].rank : ranks.find(stroke.order)->second;
        const auto points = lines.points_of(stroke);
        const InkPoint& first = points.front();
        const Pen pen(first.width_px, drawn_side(stroke));
        look.is_plain = stroke.blend == InkBlend::over &&
                        (stroke.is_constant ? first.opacity == 1 : covers(points, drawn_side(stroke)));
        if (look.is_plain) {
            look.color = first.color;
            if (stroke.is_constant) look.strength = pen.strength;
        }
        plan.pen_radius_px.push_back(static_cast<float>(pen.radius_px));
        float width_px = first.width_px;
        if (!stroke.is_constant) {
            for (const InkPoint& p : points) width_px = std::max(width_px, p.width_px);
        }
        plan.most_radius_px = std::max(plan.most_radius_px, Pen(width_px, drawn_side(stroke)).radius_px);
        plan.most_halo_px = std::max(plan.most_halo_px, stroke.halo_px);
        if (stroke.is_behind || stroke.order.is_hidden) continue;
        most_width_px = std::max(most_width_px, width_px);
        least_rank = std::min(least_rank, look.rank);
    }
    plan.hides_below.reserve(lines.boundaries.size());
    for (const InkBoundary& b : lines.boundaries) {
        const auto above = std::lower_bound(plan.orders.begin(), plan.orders.end(), b.order) - plan.orders.begin();
        plan.hides_below.push_back(b.is_drawn ? static_cast<std::uint32_t>(above) : ~0u);
        plan.has_drawn_widths = plan.has_drawn_widths || b.drawn_width_px < most_width_px;
        plan.may_hide = plan.may_hide || least_rank < plan.hides_below.back();
    }
    plan.may_hide = plan.may_hide || plan.has_drawn_widths;
    return plan;
}

}  // namespace burin
