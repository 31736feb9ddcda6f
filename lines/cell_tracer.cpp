#include "lines/cell_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "mesh/vectors.h"

namespace burin {
namespace {

bool is_inside(glm::dvec2 p, glm::dvec2 low, glm::dvec2 high) {
    constexpr double kSlack = 1e-3;
    return p.x >= low.x - kSlack && p.y >= low.y - kSlack && p.x <= high.x + kSlack && p.y <= high.y + kSlack;
}

std::optional<glm::dvec2> meeting_point(glm::dvec2 a, glm::dvec2 along_a, glm::dvec2 b, glm::dvec2 along_b) {
    const double area = cross(along_a, along_b);
    if (std::abs(area) <= 1e-6 * glm::length(along_a) * glm::length(along_b)) return std::nullopt;
    return a + along_a * (cross(b - a, along_b) / area);
}

/// The direction into the cell, from the side on which a crossing lies. Pieces may be too short to tell front from
/// back.
glm::dvec2 inwards(const LineCrossing& c, glm::dvec2 center) {
    const glm::dvec2 way = center - c.pixel;
    return c.towards_front.x != 0 ? glm::dvec2(0, way.y) : glm::dvec2(way.x, 0);
}

/// A piece that starts or ends at the crossing whose line it is.
void add(const LineCrossing& style, glm::dvec2 from, glm::dvec2 to, glm::dvec2 center, std::vector<LinePiece>& pieces,
         const LineCrossing* other_end = nullptr) {
    if (from == to) return;
    LinePiece& piece = pieces.emplace_back();  // in place: copying would wait for what was just stored
    piece.from = from;
    piece.to = to;
    piece.is_drawn = !style.classes.empty();
    piece.drawn_as = style.classes.first().value_or(LineClass::silhouette);
    piece.occludes = style.occludes;
    piece.nearness_from = static_cast<float>(style.nearness);
    piece.nearness_to = other_end == nullptr ? piece.nearness_from : static_cast<float>(other_end->nearness);
    // y runs down: what is to the left of the way has a negative cross product.
    const glm::dvec2 in = inwards(style, center);
    const double side = cross(in, style.towards_front);
    // The corner lies beyond the cell: the piece runs back to it.
    constexpr double kBack = 1e-6;
    const bool runs_back = glm::dot((to == style.pixel ? from : to) - style.pixel, in) < -kBack * glm::length(in);
    piece.front_on_left = ((to == style.pixel) != runs_back ? -side : side) < 0;
    piece.line = style.line;
    piece.classes = style.classes;
    piece.opacity = style.opacity;
}

bool has_edge(const LineCrossing& c) { return c.edge_ends[0] != c.edge_ends[1]; }
/// Whether the lines of two edges cannot be told apart between two crossings: neighbours on a finely rounded surface.
bool are_one(const LineCrossing& a, const LineCrossing& b) {
    constexpr double kApartPx = 1.0 / 32;
    const auto is_on = [&](const LineCrossing& line, glm::dvec2 p) {
        return std::abs(cross(line.along, p - line.pixel)) < kApartPx * glm::length(line.along);
    };
    return is_on(a, b.pixel) && is_on(b, a.pixel);
}
bool has_direction(const LineCrossing& c) { return c.along != glm::dvec2(0.0); }

}  // namespace

void trace_cell(std::span<const LineCrossing* const> crossings, glm::dvec2 low, glm::dvec2 high, bool has_bridges,
                std::vector<LinePiece>& pieces) {
    const glm::dvec2 center = 0.5 * (low + high);
    const auto runs_through = [&](const LineCrossing& c) {
        return has_edge(c) && !c.classes.empty() && !is_inside(c.edge_ends[0], low, high) &&
               !is_inside(c.edge_ends[1], low, high);
    };
    const auto join = [&](const LineCrossing& a, const LineCrossing& b) {
        if (a.line != b.line) {
            if (has_direction(a) && has_direction(b)) {
                std::optional<glm::dvec2> corner;
                for (const glm::dvec2& p : a.edge_ends) {
                    if (has_edge(a) && (p == b.edge_ends[0] || p == b.edge_ends[1])) corner = p;
                }
                if (!corner) corner = meeting_point(a.pixel, a.along, b.pixel, b.along);
                // The corner of an intersection may lie beyond a side whose samples do not see it.
                const glm::dvec2 beyond = has_edge(a) == has_edge(b) ? glm::dvec2(0.0) : 0.25 * (high - low);
                if (corner && is_inside(*corner, low - beyond, high + beyond)) {
                    add(a, a.pixel, *corner, center, pieces);
                    add(b, *corner, b.pixel, center, pieces);
                    return;
                }
            }
            if (!has_bridges && (a.occludes || b.occludes) && runs_through(a) && runs_through(b) && !are_one(a, b))
                return;
            // There is no corner: half of the way looks like one line, half like the other.
            const glm::dvec2 middle = 0.5 * (a.pixel + b.pixel);
            add(a, a.pixel, middle, center, pieces);
            add(b, middle, b.pixel, center, pieces);
            return;
        }
        add(a, a.pixel, b.pixel, center, pieces, &b);
    };
    const auto ends_in = [](const LineCrossing& c, glm::dvec2 p) {
        return has_edge(c) && (p == c.edge_ends[0] || p == c.edge_ends[1]);
    };
    /// The corner in the cell at which a crossing's edge meets that of another one.
    const auto corner_of = [&](const LineCrossing& c) -> std::optional<glm::dvec2> {
        if (!has_edge(c)) return std::nullopt;
        for (const glm::dvec2& p : c.edge_ends) {
            if (!is_inside(p, low, high)) continue;
            for (const LineCrossing* const other : crossings) {
                if (other->line != c.line && ends_in(*other, p)) return p;
            }
        }
        return std::nullopt;
    };
    /// Ends a crossing's line at its corner, or at the line between the crossings of the nearest line, behind which a
    /// corner is hidden unless that line comes from it.
    const auto end_at = [&](const LineCrossing& c, const LineCrossing& first, const LineCrossing& second) {
        const glm::dvec2 from = first.pixel, to = second.pixel, along = to - from;
        if (const auto corner = corner_of(c)) {
            const bool is_beyond = cross(along, c.pixel - from) * cross(along, *corner - from) < 0;
            if (!is_beyond || (ends_in(first, *corner) && ends_in(second, *corner)))
                return add(c, c.pixel, *corner, center, pieces);
        }
        const double length = glm::dot(along, along);
        const double t = length > 0 ? std::clamp(glm::dot(c.pixel - from, along) / length, 0.0, 1.0) : 0.0;
        glm::dvec2 end = from + along * t;
        if (has_direction(c)) {
            const auto met = meeting_point(c.pixel, c.along, from, along);
            const bool is_met = met && is_inside(*met, low, high);
            if (!is_met && !has_bridges && runs_through(c)) return;
            if (is_met) end = *met;
        }
        add(c, c.pixel, end, center, pieces);
    };

    switch (crossings.size()) {
        case 0:
            return;
        case 1: {
            const LineCrossing& c = *crossings[0];
            if (!has_edge(c)) return;
            for (const glm::dvec2& p : c.edge_ends) {
                if (is_inside(p, low, high)) return add(c, c.pixel, p, center, pieces);
            }
            add(c, c.pixel, c.pixel + c.along * (glm::dot(center - c.pixel, c.along) / glm::dot(c.along, c.along)),
                center, pieces);
            return;
        }
        case 2:
            return join(*crossings[0], *crossings[1]);
        default:
            break;
    }
    // Crossings are sorted: the nearest first, those of one line together.
    std::array<const LineCrossing*, 4> sorted{};
    std::copy(crossings.begin(), crossings.end(), sorted.begin());
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(crossings.size());
    for (auto next = sorted.begin() + 1; next != end; ++next) {
        for (auto at = next; at != sorted.begin() && at[0]->nearness > at[-1]->nearness; --at) std::swap(at[-1], at[0]);
    }
    std::size_t partner = 0;
    for (std::size_t i = 0; i < crossings.size() && partner == 0; ++i) {
        for (std::size_t j = i + 1; j < crossings.size() && partner == 0; ++j) {
            if (sorted[i]->line != sorted[j]->line) continue;
            std::swap(sorted[0], sorted[i]);
            std::swap(sorted[1], sorted[j]);
            partner = 1;
        }
    }
    join(*sorted[0], *sorted[1]);
    if (crossings.size() == 4 && sorted[2]->line == sorted[3]->line) {
        join(*sorted[2], *sorted[3]);
        return;
    }
    for (std::size_t i = 2; i < crossings.size(); ++i) end_at(*sorted[i], *sorted[0], *sorted[1]);
}

}  // namespace burin
