#include "methods/reference/boundary_curves.h"

#include <algorithm>
#include <cmath>

#include "mesh/vectors.h"

namespace burin {
namespace {

glm::dvec2 closest_on(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 d = b - a;
    const double length2 = glm::dot(d, d);
    return length2 > 0 ? a + d * std::clamp(glm::dot(p - a, d) / length2, 0.0, 1.0) : a;
}

bool same_depth(double depth_a, double depth_b) {
    return std::abs(depth_a - depth_b) <= 2;  // conventions: a farther surface
}

}  // namespace

BoundaryCurves::Node BoundaryCurves::add_crossing(const SideCrossing& crossing) {
    NodeData node;
    node.crossing = crossing;
    nodes_.push_back(node);
    return static_cast<Node>(nodes_.size() - 1);
}

BoundaryCurves::Node BoundaryCurves::add_junction(glm::dvec2 at, double depth_px) {
    const Node node = add_crossing({});
    nodes_[node].crossing.at = at;
    nodes_[node].crossing.depth_px = depth_px;
    nodes_[node].is_junction = true;
    return node;
}

/// An edge that is what the line is at node `like`.
void BoundaryCurves::add_edge(Node from, Node to, Node like) {
    const SideCrossing& line = nodes_[like].crossing;
    Edge edge;
    edge.from = from;
    edge.to = to;
    const auto depth_px = [&](Node n) { return nodes_[n].is_junction ? line.depth_px : nodes_[n].crossing.depth_px; };
    edge.depth_from = depth_px(from);
    edge.depth_to = depth_px(to);
    edge.line_class = line.line_class;
    if (line.occludes) {
        const glm::dvec2 a = nodes_[from].crossing.at, b = nodes_[to].crossing.at;
        edge.front_side = cross(b - a, line.front - a) >= 0 ? 1 : -1;
    }
    const auto number = static_cast<std::uint32_t>(edges_.size());
    edges_.push_back(edge);
    for (const Node n : {from, to}) {
        if (nodes_[n].degree < 2) nodes_[n].edges[nodes_[n].degree] = number;
        ++nodes_[n].degree;
    }
}

void BoundaryCurves::connect(Node a, Node b) {
    const SideCrossing &x = nodes_[a].crossing, &y = nodes_[b].crossing;
    if (x.line_class == y.line_class && x.occludes == y.occludes) {
        add_edge(a, b, a);
        return;
    }
    const Node middle = add_junction(0.5 * (x.at + y.at), x.depth_px);
    add_edge(a, middle, a);
    add_edge(middle, b, b);
}

/// Three lines meet. If one of them goes on behind the surface that the two others bound, it ends at
/// their line; else all end in one point.
void BoundaryCurves::add_tee(const std::array<Node, 3>& nodes, glm::dvec2 middle) {
    for (std::size_t k = 0; k < 3; ++k) {
        const Node stem = nodes[k], left = nodes[(k + 1) % 3], right = nodes[(k + 2) % 3];
        const SideCrossing s = nodes_[stem].crossing, l = nodes_[left].crossing, r = nodes_[right].crossing;
        const bool bar = l.occludes && r.occludes && same_depth(l.depth_px, r.depth_px) && l.line_class == r.line_class;
        if (!bar || same_depth(s.depth_px, l.depth_px) || s.depth_px < l.depth_px) continue;
        add_edge(left, right, left);
        add_edge(stem, add_junction(closest_on(s.at, l.at, r.at), s.depth_px), stem);
        return;
    }
    const Node junction = add_junction(middle, nodes_[nodes[0]].crossing.depth_px);
    for (const Node n : nodes) add_edge(n, junction, n);
}

void BoundaryCurves::add_cell(const std::array<Node, 4>& sides, glm::dvec2 middle, bool falling_joined,
                              bool rising_joined) {
    std::array<Node, 4> found{};
    std::size_t count = 0;
    glm::dvec2 sum(0.0);
    for (const Node n : sides) {
        if (n == kNone) continue;
        found[count++] = n;
        sum += nodes_[n].crossing.at;
    }
    switch (count) {
        case 0:
            return;
        case 1:  // a line ends, somewhere here
            add_edge(found[0], add_junction(middle, nodes_[found[0]].crossing.depth_px), found[0]);
            return;
        case 2:
            connect(found[0], found[1]);
            return;
        case 3:
            add_tee({found[0], found[1], found[2]}, sum / 3.0);
            return;
        default:
            break;
    }
    const auto& [top, right, bottom, left] = sides;
    if (falling_joined != rising_joined) {
        connect(top, falling_joined ? right : left);
        connect(bottom, falling_joined ? left : right);
        return;
    }
    // Two straight lines cross.
    const glm::dvec2 a = nodes_[top].crossing.at, b = nodes_[bottom].crossing.at;
    const glm::dvec2 c = nodes_[left].crossing.at, d = nodes_[right].crossing.at;
    const double along = cross(b - a, d - c);
    glm::dvec2 at = sum / 4.0;
    if (along != 0) at = a + (b - a) * std::clamp(cross(c - a, d - c) / along, 0.0, 1.0);
    const Node junction = add_junction(at, nodes_[top].crossing.depth_px);
    for (const Node n : sides) add_edge(n, junction, n);
}

/// Whether a curve may go straight on through a node.
bool BoundaryCurves::can_pass(Node node) const {
    const NodeData& n = nodes_[node];
    if (n.is_junction || n.degree != 2) return false;
    const Edge &a = edges_[n.edges[0]], &b = edges_[n.edges[1]];
    // Walked through, one of the two is turned round if both start or both end here.
    const bool turned = (a.from == node) == (b.from == node);
    return a.line_class == b.line_class && a.front_side == (turned ? -b.front_side : b.front_side);
}

std::vector<BoundarySegment> BoundaryCurves::segments(double tolerance_px, double cell_px) const {
    struct Point {
        glm::dvec2 at;
        double depth_px;
    };
    std::vector<BoundarySegment> result;
    std::vector<bool> done(edges_.size(), false);
    std::vector<Point> chain;
    std::int8_t front_side = 0;

    /// Whether all points between two of the chain lie on the straight piece between them.
    const auto is_straight = [&](std::size_t first, std::size_t last) {
        const Point &a = chain[first], &b = chain[last];
        const glm::dvec2 d = b.at - a.at;
        const double length = glm::length(d);
        if (!(length > 0)) return false;
        double previous = 0;
        for (std::size_t i = first + 1; i < last; ++i) {
            const double s = glm::dot(chain[i].at - a.at, d) / (length * length);
            if (s < previous || s > 1) return false;
            previous = s;
            if (std::abs(cross(d, chain[i].at - a.at)) > tolerance_px * length) return false;
            if (!same_depth(chain[i].depth_px, a.depth_px + (b.depth_px - a.depth_px) * s)) return false;
        }
        return true;
    };
    /// Cells cut corners. Where a short piece lies between two longer ones that meet when extended by
    /// less than a cell, their meeting point is the corner.
    std::vector<Point> simple;
    const auto restore_corners = [&] {
        for (std::size_t i = 1; i + 2 < simple.size(); ++i) {
            const glm::dvec2 a = simple[i - 1].at, b = simple[i].at, c = simple[i + 1].at, d = simple[i + 2].at;
            const double cut = glm::distance(b, c);
            if (cut > 1.5 * cell_px || glm::distance(a, b) < 2 * cut || glm::distance(c, d) < 2 * cut) continue;
            const double turn = cross(b - a, d - c);
            if (turn == 0) continue;
            const double ahead = cross(c - b, d - c) / turn, back = cross(c - b, b - a) / turn;
            const glm::dvec2 corner = b + (b - a) * ahead;
            // The corner lies ahead of the first piece's end and before the second one's start.
            if (ahead < 0 || back > 0 || glm::distance(corner, 0.5 * (b + c)) > cell_px) continue;
            simple[i].at = corner;
            simple.erase(simple.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        }
    };
    const auto emit_chain = [&](std::uint8_t line_class) {
        simple.assign(1, chain.front());
        constexpr std::size_t kLongest = 1024;  // bounds the work
        std::size_t first = 0;
        while (first + 1 < chain.size()) {
            // The length is doubled, then halved: the straight piece is found in logarithmic time.
            std::size_t good = first + 1, step = 1;
            const auto ok = [&](std::size_t i) {
                return i < chain.size() && i - first <= kLongest && is_straight(first, i);
            };
            while (ok(good + step)) {
                good += step;
                step *= 2;
            }
            for (; step > 0; step /= 2) {
                if (ok(good + step)) good += step;
            }
            simple.push_back(chain[good]);
            first = good;
        }
        restore_corners();
        for (std::size_t i = 0; i + 1 < simple.size(); ++i) {
            const Point &a = simple[i], &b = simple[i + 1];
            result.push_back({a.at, b.at, a.depth_px, b.depth_px, line_class, front_side});
        }
    };
    const auto walk = [&](std::uint32_t edge, Node start) {
        chain.clear();
        const std::uint8_t line_class = edges_[edge].line_class;
        Node node = start;
        front_side =
            static_cast<std::int8_t>(edges_[edge].from == start ? edges_[edge].front_side : -edges_[edge].front_side);
        while (true) {
            const Edge& e = edges_[edge];
            const bool forward = e.from == node;
            if (chain.empty()) chain.push_back({nodes_[node].crossing.at, forward ? e.depth_from : e.depth_to});
            done[edge] = true;
            node = forward ? e.to : e.from;
            chain.push_back({nodes_[node].crossing.at, forward ? e.depth_to : e.depth_from});
            if (!can_pass(node)) break;
            const NodeData& n = nodes_[node];
            const std::uint32_t next = n.edges[0] == edge ? n.edges[1] : n.edges[0];
            if (done[next]) break;
            edge = next;
        }
        if (chain.size() > 3 && node == start) {
            // A closed curve found from its topmost point, which is often a corner: start elsewhere.
            chain.pop_back();
            std::rotate(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(chain.size() * 3 / 8), chain.end());
            chain.push_back(chain.front());
        }
        emit_chain(line_class);
    };
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
        for (const Node n : {edges_[e].from, edges_[e].to}) {
            if (!done[e] && !can_pass(n)) walk(e, n);
        }
    }
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
        if (!done[e]) walk(e, edges_[e].from);  // closed curves
    }
    return result;
}

}  // namespace burin
