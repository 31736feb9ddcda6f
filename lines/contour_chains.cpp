#include "lines/contour_chains.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lines/contour_grid.h"
#include "view/screen_polygon.h"

namespace burin {
namespace {

/// Curves are drawn as straight pieces that are off by no more, unless they would be too many.
constexpr double kOffPx = 1.0 / 64;
constexpr double kMostPieces = 24;
/// What turns more between two edges is no curve: its tangents may be on the wrong side.
constexpr double kCosLargestTurn = 0.5;

bool is_less(const glm::dvec3& a, const glm::dvec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }
bool comes_before(glm::dvec2 a, glm::dvec2 b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); }

/// The cubic of two ends and their handles.
glm::dvec3 on_cubic(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d, double t) {
    const double s = 1 - t;
    return a * (s * s * s) + b * (3 * s * s * t) + c * (3 * s * t * t) + d * (t * t * t);
}

/// A point of the cubic that stands for the edge between two vertices with unit normals.
glm::dvec3 on_edge(const glm::dvec3& a, const glm::dvec3& normal_a, const glm::dvec3& b, const glm::dvec3& normal_b,
                   double share) {
    const glm::dvec3 way = b - a;
    const glm::dvec3 from_a = a + (way - glm::dot(way, normal_a) * normal_a) / 3.0;
    const glm::dvec3 from_b = b - (way - glm::dot(way, normal_b) * normal_b) / 3.0;
    return on_cubic(a, from_a, from_b, b, share);
}

/// The handle that lets a cubic leave an end along the tangent there.
glm::dvec2 handle(glm::dvec2 along, glm::dvec2 chord) {
    const double length = glm::length(chord), cosine = glm::dot(along, chord) / length;
    if (!(std::abs(cosine) >= kCosLargestTurn)) return chord / 3.0;
    return along * (std::copysign(2.0 / 3, cosine) * length / (1 + std::abs(cosine)));
}

struct End {
    glm::dvec2 place;
    std::size_t piece;
    bool operator<(const End& o) const {
        return std::tie(place.x, place.y, piece) < std::tie(o.place.x, o.place.y, o.piece);
    }
};

/// Links pieces at the places that two of them have in common.
std::vector<ContourChain> linked(std::vector<std::vector<glm::dvec2>> pieces) {
    std::sort(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), comes_before);
    });
    pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
    std::vector<End> ends;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        ends.push_back({pieces[i].front(), i});
        ends.push_back({pieces[i].back(), i});
    }
    std::sort(ends.begin(), ends.end());
    std::vector<bool> is_used(pieces.size(), false);
    const auto next_at = [&](glm::dvec2 place) {
        const auto first = std::lower_bound(ends.begin(), ends.end(), End{place, 0});
        for (auto it = first; it != ends.end() && it->place == place; ++it) {
            if (!is_used[it->piece]) return it->piece;
        }
        return pieces.size();
    };
    std::vector<ContourChain> chains;
    const auto add_chain = [&](std::size_t piece, glm::dvec2 from) {
        ContourChain chain;
        chain.points.push_back(from);
        for (; piece < pieces.size(); piece = next_at(chain.points.back())) {
            is_used[piece] = true;
            std::vector<glm::dvec2>& points = pieces[piece];
            if (points.front() != chain.points.back()) std::reverse(points.begin(), points.end());
            chain.points.insert(chain.points.end(), points.begin() + 1, points.end());
        }
        chain.lengths.push_back(0);
        for (std::size_t i = 1; i < chain.points.size(); ++i) {
            chain.lengths.push_back(chain.lengths.back() + glm::distance(chain.points[i - 1], chain.points[i]));
        }
        chains.push_back(std::move(chain));
    };
    for (std::size_t i = 0; i < ends.size(); ++i) {  // from loose ends first
        const bool is_shared = (i > 0 && ends[i - 1].place == ends[i].place) ||
                               (i + 1 < ends.size() && ends[i + 1].place == ends[i].place);
        if (!is_shared && !is_used[ends[i].piece]) add_chain(ends[i].piece, ends[i].place);
    }
    for (const End& end : ends) {
        if (!is_used[end.piece]) add_chain(end.piece, end.place);
    }
    return chains;
}

}  // namespace

/// Both triangles at an edge ask for its vertices in one order, and so come to the same bits.
ContourFinder::Crossing ContourFinder::crossing(std::uint32_t a, const Corner& at_a, std::uint32_t b,
                                                const Corner& at_b) const {
    if (is_less(mesh_.local_position(b), mesh_.local_position(a))) return crossing(b, at_b, a, at_a);
    const double share = at_a.facing / (at_a.facing - at_b.facing);
    glm::dvec3 place = on_edge(at_a.view, at_a.normal, at_b.view, at_b.normal, share);
    if (!needs_no_clipping(surfaces_.projection, place)) place = glm::mix(at_a.view, at_b.view, share);
    // At a contour the tangent plane passes through the eye, and is seen as a line.
    const glm::dvec3 normal = glm::mix(at_a.normal, at_b.normal, share);
    const glm::dvec2 along(normal.y, normal.x);
    return {on_contour_grid(surfaces_.projection.to_pixel(place)), along / std::max(glm::length(along), 1e-300)};
}

/// Whether a contour passes over the triangle.
bool ContourFinder::add_piece(std::uint32_t triangle, std::vector<Piece>& pieces) const {
    const SurfaceInstance& instance = surfaces_.instances[instance_];
    const auto& t = mesh_.triangles[triangle];
    const Projection& projection = surfaces_.projection;
    std::array<Corner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
        Corner& c = corners[k];
        c.view = surfaces_.view_position(instance_, t[k]);
        const glm::vec3& own = smooth_.normals[3 * triangle + k];
        if (!needs_no_clipping(projection, c.view) || own == glm::vec3(0.0f)) return false;
        c.normal = instance.normal_to_view * glm::dvec3(own);
        c.normal /= std::max(glm::length(c.normal), 1e-300);
        const glm::dvec3 ray = projection.orthographic ? glm::dvec3(0, 0, -1) : c.view / glm::length(c.view);
        c.facing = glm::dot(c.normal, ray);
    }
    std::array<Crossing, 2> ends;
    std::size_t found = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t n = (k + 1) % 3;
        if ((corners[k].facing >= 0) == (corners[n].facing >= 0)) continue;
        ends[found++] = crossing(t[k], corners[k], t[n], corners[n]);
    }
    if (found != 2 || ends[0].pixel == ends[1].pixel) return false;
    if (comes_before(ends[1].pixel, ends[0].pixel)) std::swap(ends[0], ends[1]);
    const glm::dvec2 a = ends[0].pixel, d = ends[1].pixel, b = a + handle(ends[0].along, d - a),
                     c = d - handle(ends[1].along, d - a);
    const double bend = 6 * std::max(glm::length(a - 2.0 * b + c), glm::length(b - 2.0 * c + d));
    const double count = std::clamp(std::ceil(std::sqrt(bend / (8 * kOffPx))), 1.0, kMostPieces);
    Piece piece{a};
    for (double i = 1; i < count; ++i) {
        const glm::dvec2 p = on_contour_grid(glm::dvec2(on_cubic({a, 0}, {b, 0}, {c, 0}, {d, 0}, i / count)));
        if (p != piece.back() && p != d) piece.push_back(p);
    }
    piece.push_back(d);
    pieces.push_back(std::move(piece));
    return true;
}

std::vector<std::uint32_t> ContourFinder::triangles_around(HalfEdge h) const {
    std::vector<std::uint32_t> ring, triangles;
    const auto add_around = [&](HalfEdge corner, std::vector<std::uint32_t>& list) {
        visit_smooth_corners(mesh_, smooth_, corner, [&](HalfEdge at) { list.push_back(at / 3); });
    };
    const auto make_unique = [](std::vector<std::uint32_t>& list) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    };
    add_around(h, ring);
    add_around(h - h % 3 + (h + 1) % 3, ring);
    make_unique(ring);
    for (const std::uint32_t t : ring) {
        for (HalfEdge k = 0; k < 3; ++k) add_around(3 * t + k, triangles);
    }
    make_unique(triangles);
    return triangles;
}

std::vector<ContourChain> ContourFinder::chains_around(HalfEdge h) const {
    std::vector<Piece> pieces;
    for (const std::uint32_t t : triangles_around(h)) add_piece(t, pieces);
    return linked(std::move(pieces));
}

}  // namespace burin
