#include <algorithm>
#include <map>

#include "shading/pen.h"
#include "strokes/ink_tile.h"

namespace burin {

InkPlan plan_of(const InkedLines& lines) {
    InkPlan plan;
    std::map<InkOrder, std::uint32_t> ranks;
    for (const InkStroke& stroke : lines.strokes) ranks.emplace(stroke.order, 0);
    for (auto& [order, rank] : ranks) {
        rank = static_cast<std::uint32_t>(plan.orders.size());
        plan.orders.push_back(order);
    }
    plan.looks.reserve(lines.strokes.size());
    float most_width_px = 0;
    const InkOrder* least_order = nullptr;  // of the strokes that boundaries may cut
    for (const InkStroke& stroke : lines.strokes) {
        InkPlan::Look& look = plan.looks.emplace_back();
        look.rank = ranks.find(stroke.order)->second;
        const auto points = lines.points_of(stroke);
        const InkPoint& first = points.front();
        look.is_plain = stroke.is_constant && stroke.blend == InkBlend::over && first.opacity == 1;
        if (look.is_plain) {
            look.color = first.color;
            look.strength = Pen(first.width_px, drawn_side(stroke)).strength;
        }
        float width_px = first.width_px;
        if (!stroke.is_constant) {
            for (const InkPoint& p : points) width_px = std::max(width_px, p.width_px);
        }
        plan.most_radius_px = std::max(plan.most_radius_px, Pen(width_px, drawn_side(stroke)).radius_px);
        plan.most_halo_px = std::max(plan.most_halo_px, stroke.halo_px);
        if (stroke.is_behind || stroke.order.is_hidden) continue;
        most_width_px = std::max(most_width_px, width_px);
        if (least_order == nullptr || stroke.order < *least_order) least_order = &stroke.order;
    }
    plan.may_hide = least_order != nullptr &&
                    std::any_of(lines.boundaries.begin(), lines.boundaries.end(), [&](const InkBoundary& b) {
                        return !b.is_drawn || b.order > *least_order || b.drawn_width_px < most_width_px;
                    });
    return plan;
}

}  // namespace burin
