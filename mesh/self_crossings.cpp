#include "mesh/self_crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/interrupt.h"
#include "mesh/vectors.h"

namespace burin {
namespace {

constexpr std::size_t kMostCorners = 256, kMostCrossings = 256;
constexpr double kFlat = 1e-4;   // how far corners may lie off the polygon's plane, of its extent
constexpr double kClear = 1e-6;  // how far ends of sides that cross lie beyond each other: no rounding does that
constexpr double kSame = 1e-12;  // crossings nearer than that, of the extent, are one

/// Twice the signed area of a triangle; positive when it turns left.
double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) { return cross(b - a, c - a); }

/// Whether a quadrilateral that is flat crosses itself: two corners turn left and two right.
bool may_cross(const std::array<glm::dvec3, 4>& c) {
    std::array<glm::dvec3, 4> normals;
    for (std::size_t i = 0; i < 4; ++i) {
        normals[i] = glm::cross(c[(i + 1) % 4] - c[i], c[(i + 2) % 4] - c[(i + 1) % 4]);
    }
    int other_way = 0;
    for (std::size_t i = 1; i < 4; ++i) other_way += glm::dot(normals[0], normals[i]) < 0;
    return other_way == 2;
}

/// The corners in the plane of the polygon, scaled to an extent of about 1; false where they lie in no plane, or in a
/// line.
bool flatten(std::span<const glm::dvec3> corners, std::vector<glm::dvec2>& flat) {
    glm::dvec3 far(0.0), normal(0.0);
    double extent = 0, farthest = 0, largest = 0;
    for (const glm::dvec3& c : corners) {
        const glm::dvec3 d = glm::abs(c - corners[0]);
        extent = std::max({extent, d.x, d.y, d.z});
    }
    if (!(extent > 0)) return false;
    const double scale = std::ldexp(1.0, -std::max(std::ilogb(extent), -1000));
    const auto scaled = [&](const glm::dvec3& c) { return (c - corners[0]) * scale; };
    for (const glm::dvec3& c : corners) {
        const double distance = glm::dot(scaled(c), scaled(c));
        if (distance > farthest) {
            farthest = distance;
            far = scaled(c);
        }
    }
    for (const glm::dvec3& c : corners) {
        const glm::dvec3 n = glm::cross(far, scaled(c));
        if (glm::dot(n, n) > largest) {
            largest = glm::dot(n, n);
            normal = n;
        }
    }
    if (!(largest > 1e-20)) return false;
    normal = glm::normalize(normal);
    for (const glm::dvec3& c : corners) {
        if (!(std::abs(glm::dot(normal, scaled(c))) <= kFlat)) return false;
    }
    const glm::dvec3 size = glm::abs(normal);
    // Leaving out the axis closest to the normal keeps the coordinates exact.
    const int drop = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    flat.clear();
    for (const glm::dvec3& c : corners) flat.emplace_back(scaled(c)[(drop + 1) % 3], scaled(c)[(drop + 2) % 3]);
    return true;
}

/// A convex polygon turns one way, and goes to the right once and to the left once.
bool is_convex(std::span<const glm::dvec2> p) {
    const std::size_t n = p.size();
    bool left = false, right = false;
    int turns_of_x = 0, last_x = 0, first_x = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec2 a = p[i], b = p[(i + 1) % n], c = p[(i + 2) % n];
        const double t = turn(a, b, c);
        left = left || t > 0;
        right = right || t < 0;
        const int x = b.x > a.x ? 1 : (b.x < a.x ? -1 : 0);
        if (x == 0) continue;
        if (first_x == 0) first_x = x;
        turns_of_x += last_x != 0 && x != last_x;
        last_x = x;
    }
    return !(left && right) && turns_of_x + (last_x != first_x) <= 2;
}

/// Two sides of a polygon that cross each other within both.
struct Crossing {
    double on_first, on_second;  ///< 0 at the side's begin, 1 at its end
    bool is_clear;
};
std::optional<Crossing> crossing_of(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
    if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
        std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y))
        return std::nullopt;
    const double c_side = turn(a, b, c), d_side = turn(a, b, d), a_side = turn(c, d, a), b_side = turn(c, d, b);
    const auto differ = [](double x, double y) { return (x < 0 && y > 0) || (x > 0 && y < 0); };
    if (!differ(c_side, d_side) || !differ(a_side, b_side)) return std::nullopt;
    const double first = kClear * glm::distance(a, b), second = kClear * glm::distance(c, d);
    return Crossing{
        a_side / (a_side - b_side), c_side / (c_side - d_side),
        std::min(std::abs(c_side), std::abs(d_side)) > first && std::min(std::abs(a_side), std::abs(b_side)) > second};
}

/// Whether a large polygon crosses itself, as far as a bounded number of looks tells.
bool large_one_crosses(std::span<const glm::dvec2> p) {
    const std::size_t n = p.size();
    std::vector<std::uint32_t> order(n);
    const auto low = [&](std::uint32_t i) { return std::min(p[i].x, p[(i + 1) % n].x); };
    const auto high = [&](std::uint32_t i) { return std::max(p[i].x, p[(i + 1) % n].x); };
    for (std::uint32_t i = 0; i < n; ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](auto i, auto k) { return std::pair(low(i), i) < std::pair(low(k), k); });
    std::uint64_t looks = 64 * n;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = i + 1; k < n && low(order[k]) <= high(order[i]); ++k) {
            if (looks-- == 0) return false;
            const std::size_t s = order[i], t = order[k];
            if ((s + 1) % n == t || (t + 1) % n == s) continue;
            if (const auto c = crossing_of(p[s], p[(s + 1) % n], p[t], p[(t + 1) % n]); c && c->is_clear) return true;
        }
    }
    return false;
}

/// The sides of a polygon as a graph in its plane, whose faces are inside or outside by turns.
class SideGraph {
  public:
    /// A node that is no corner of the polygon: where it is on which side.
    struct NewNode {
        std::size_t side;
        double place;
    };

    explicit SideGraph(std::span<const glm::dvec2> corners) : corners_(corners), on_side_(corners.size()) {
        for (const glm::dvec2& c : corners_) corner_node_.push_back(node_at(c, 0));
        corner_nodes_ = nodes_.size();
    }

    /// Finds the crossings. Whether there is a clear one.
    bool find_crossings() {
        const std::size_t n = corners_.size();
        bool is_any_clear = false;
        for (std::size_t i = 0; i < n; ++i) {
            const glm::dvec2 a = corners_[i], b = corner(i + 1);
            for (std::size_t k = i + 2; k < n; ++k) {
                if (i == 0 && k + 1 == n) continue;  // neighbours
                const std::optional<Crossing> found = crossing_of(a, b, corners_[k], corner(k + 1));
                if (!found) continue;
                is_any_clear = is_any_clear || found->is_clear;
                ++crossings_;
                if (crossings_ > kMostCrossings) continue;
                const std::uint32_t node = node_at(a + found->on_first * (b - a), kSame);
                if (node >= corner_nodes_ + new_nodes_.size()) new_nodes_.push_back({i, found->on_first});
                on_side_[i].emplace_back(found->on_first, node);
                on_side_[k].emplace_back(found->on_second, node);
            }
            for (std::size_t k = 0; k < n; ++k) is_any_clear = note_touch(i, k) || is_any_clear;
        }
        return is_any_clear;
    }

    /// The faces that the polygon covers, as node numbers; nothing where sides lie on each other, or there are too many
    /// crossings.
    std::optional<std::vector<std::vector<std::uint32_t>>> covered_faces() {
        if (crossings_ > kMostCrossings || !make_edges()) return std::nullopt;
        link();
        return trace();
    }
    bool is_corner(std::uint32_t node) const { return node < corner_nodes_; }
    /// A corner of the polygon that is at the node.
    std::size_t corner_at(std::uint32_t node) const {
        return static_cast<std::size_t>(std::find(corner_node_.begin(), corner_node_.end(), node) -
                                        corner_node_.begin());
    }
    const NewNode& new_node(std::uint32_t node) const { return new_nodes_[node - corner_nodes_]; }

  private:
    glm::dvec2 corner(std::size_t i) const { return corners_[i % corners_.size()]; }

    std::uint32_t node_at(glm::dvec2 p, double tolerance) {
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
            const glm::dvec2 d = glm::abs(nodes_[i] - p);
            if (d.x <= tolerance && d.y <= tolerance) return i;
        }
        nodes_.push_back(p);
        return static_cast<std::uint32_t>(nodes_.size() - 1);
    }

    /// Side i is cut where corner k lies on it. Returns whether the polygon passes through the side there.
    bool note_touch(std::size_t i, std::size_t k) {
        const glm::dvec2 a = corners_[i], b = corner(i + 1), p = corners_[k];
        if (p == a || p == b || turn(a, b, p) != 0) return false;
        const double place = glm::dot(p - a, b - a) / glm::dot(b - a, b - a);
        if (!(place > 0 && place < 1)) return false;
        on_side_[i].emplace_back(place, corner_node_[k]);
        const double before = turn(a, b, corner(k + corners_.size() - 1)), after = turn(a, b, corner(k + 1));
        const double clear = kClear * glm::distance(a, b);
        return (before > clear && after < -clear) || (before < -clear && after > clear);
    }

    /// False where an edge is there twice.
    bool make_edges() {
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            auto& nodes = on_side_[i];
            nodes.emplace_back(0, corner_node_[i]);
            nodes.emplace_back(1, corner_node_[(i + 1) % corners_.size()]);
            std::sort(nodes.begin(), nodes.end());
            for (std::size_t k = 1; k < nodes.size(); ++k) {
                const std::uint32_t from = nodes[k - 1].second, to = nodes[k].second;
                if (from == to) continue;
                half_edges_.push_back({from, to});
                half_edges_.push_back({to, from});
            }
        }
        auto sorted = half_edges_;
        std::sort(sorted.begin(), sorted.end());
        return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
    }

    /// Finds for every half-edge the next one around the face on its left.
    void link() {
        std::vector<std::vector<std::uint32_t>> out(nodes_.size());
        for (std::uint32_t h = 0; h < half_edges_.size(); ++h) out[half_edges_[h][0]].push_back(h);
        next_.resize(half_edges_.size());
        for (auto& around : out) {
            const auto direction = [&](std::uint32_t h) {
                return nodes_[half_edges_[h][1]] - nodes_[half_edges_[h][0]];
            };
            const auto is_upper = [](glm::dvec2 d) { return d.y > 0 || (d.y == 0 && d.x > 0); };
            std::sort(around.begin(), around.end(), [&](std::uint32_t g, std::uint32_t h) {
                const glm::dvec2 a = direction(g), b = direction(h);
                if (is_upper(a) != is_upper(b)) return is_upper(a);
                const double c = cross(a, b);
                return c != 0 ? c > 0 : g < h;
            });
            // Coming in by the twin of one, the face goes on along the one that is next clockwise.
            for (std::size_t i = 0; i < around.size(); ++i) next_[around[(i + 1) % around.size()] ^ 1u] = around[i];
        }
    }

    std::optional<std::vector<std::vector<std::uint32_t>>> trace() const {
        constexpr std::uint32_t kNone = 0xFFFFFFFFu;
        std::vector<std::uint32_t> face_of(half_edges_.size(), kNone);
        std::vector<std::vector<std::uint32_t>> faces;
        std::uint32_t outer = kNone;
        for (std::uint32_t first = 0; first < half_edges_.size(); ++first) {
            if (face_of[first] != kNone) continue;
            double area = 0;
            std::vector<std::uint32_t> face;
            for (std::uint32_t h = first; face_of[h] == kNone; h = next_[h]) {
                face_of[h] = static_cast<std::uint32_t>(faces.size());
                area += cross(nodes_[half_edges_[h][0]] - nodes_[0], nodes_[half_edges_[h][1]] - nodes_[0]);
                face.push_back(half_edges_[h][0]);
            }
            if (area <= 0) {
                if (outer != kNone) return std::nullopt;  // the graph is not plane, but for rounding
                outer = static_cast<std::uint32_t>(faces.size());
            }
            faces.push_back(std::move(face));
        }
        if (outer == kNone) return std::nullopt;
        // Over each edge, inside becomes outside.
        std::vector<int> parity(faces.size(), -1);
        parity[outer] = 0;
        for (bool goes_on = true; goes_on;) {
            goes_on = false;
            for (std::uint32_t h = 0; h < half_edges_.size(); ++h) {
                int& here = parity[face_of[h]];
                const int there = parity[face_of[h ^ 1u]];
                if (there >= 0 && here == there) return std::nullopt;
                if (there < 0 || here >= 0) continue;
                here = 1 - there;
                goes_on = true;
            }
        }
        std::vector<std::vector<std::uint32_t>> covered;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            if (parity[i] == 1) covered.push_back(std::move(faces[i]));
        }
        return covered;
    }

    std::span<const glm::dvec2> corners_;
    std::vector<glm::dvec2> nodes_;  // corners first, each place once
    std::vector<std::uint32_t> corner_node_;
    std::size_t corner_nodes_ = 0;
    std::vector<NewNode> new_nodes_;
    std::vector<std::vector<std::pair<double, std::uint32_t>>> on_side_;
    std::size_t crossings_ = 0;
    std::vector<std::array<std::uint32_t, 2>> half_edges_;  // twins are neighbours
    std::vector<std::uint32_t> next_;
};

/// Makes the polygons of a soup anew from the first one on that is cut.
class Cutter {
  public:
    Cutter(const std::string& path, PolygonSoup& soup) : path_(path), soup_(soup) {}

    void cut() {
        for (std::size_t i = 0; i < soup_.polygon_ends.size(); ++i) {
            if ((i & 0xFFFF) == 0) throw_if_interrupted();
            const std::span<const std::uint32_t> polygon = soup_.polygon(i);
            const bool is_cut = polygon.size() >= 4 && find_pieces(polygon, i);
            if (is_cut && !is_any_cut_) {
                is_any_cut_ = true;
                for (std::size_t before = 0; before < i; ++before) add_whole(before);
            }
            if (!is_any_cut_) continue;
            if (!is_cut) add_whole(i);
            for (const auto& piece : pieces_) add(piece, i);
            origins_.insert(origins_.end(), piece_origins_.begin(), piece_origins_.end());
            pieces_.clear();
            piece_origins_.clear();
        }
        if (is_any_cut_) {
            soup_.corners = std::move(result_.corners);
            soup_.polygon_ends = std::move(result_.polygon_ends);
            soup_.polygon_object = std::move(result_.polygon_object);
            soup_.polygon_material = std::move(result_.polygon_material);
            if (!soup_.attributes.empty()) move_rows(origins_, soup_.attributes);
        }
        if (uncut_ > 0) {
            soup_.notes.push_back(
                "polygons that cross themselves and are not cut where they do: " + std::to_string(uncut_) +
                "; the first one is polygon " + std::to_string(first_uncut_ + 1) +
                " (they have more than 256 corners or crossings, or sides that lie on each other)");
        }
    }

  private:
    void add(std::span<const std::uint32_t> polygon, std::size_t i) {
        if (result_.corners.size() + polygon.size() > PolygonSoup::kMaxCorners) {
            throw InputError(path_ + ": more than 4 billion polygon corners; split the model");
        }
        result_.add_polygon(polygon);
        if (!soup_.polygon_object.empty()) result_.polygon_object.push_back(soup_.polygon_object[i]);
        if (!soup_.polygon_material.empty()) result_.polygon_material.push_back(soup_.polygon_material[i]);
    }

    void add_whole(std::size_t i) {
        const std::span<const std::uint32_t> polygon = soup_.polygon(i);
        add(polygon, i);
        if (soup_.attributes.empty()) return;
        auto corner = static_cast<std::uint32_t>(polygon.data() - soup_.corners.data());
        for (std::size_t k = 0; k < polygon.size(); ++k, ++corner) origins_.push_back({corner, corner, 0});
    }

    bool find_pieces(std::span<const std::uint32_t> polygon, std::size_t number) {
        const auto at = [&](std::size_t k) { return soup_.positions[polygon[k]]; };
        if (polygon.size() == 4 && !may_cross({at(0), at(1), at(2), at(3)})) return false;
        corners_.clear();
        for (const std::uint32_t v : polygon) corners_.push_back(soup_.positions[v]);
        if (!flatten(corners_, flat_) || is_convex(flat_)) return false;
        if (polygon.size() > kMostCorners) {
            if (large_one_crosses(flat_)) note_uncut(number);
            return false;
        }
        SideGraph graph(flat_);
        if (!graph.find_crossings()) return false;
        const auto faces = graph.covered_faces();
        if (!faces) {
            note_uncut(number);
            return false;
        }
        for (const auto& face : *faces) {
            auto& piece = pieces_.emplace_back();
            for (const std::uint32_t node : face) {
                piece.push_back(vertex_at(graph, node, polygon));
                if (!soup_.attributes.empty()) piece_origins_.push_back(origin_of(graph, node, polygon));
            }
        }
        new_vertices_.clear();
        return true;
    }
    std::uint32_t vertex_at(const SideGraph& graph, std::uint32_t node, std::span<const std::uint32_t> polygon) {
        if (graph.is_corner(node)) return polygon[graph.corner_at(node)];
        for (const auto& [known, vertex] : new_vertices_) {
            if (known == node) return vertex;
        }
        const auto [side, place] = graph.new_node(node);
        const glm::dvec3 a = corners_[side], b = corners_[(side + 1) % corners_.size()];
        const auto vertex = static_cast<std::uint32_t>(soup_.positions.size());
        soup_.positions.push_back(a + place * (b - a));
        new_vertices_.emplace_back(node, vertex);
        return vertex;
    }
    CornerOrigin origin_of(const SideGraph& graph, std::uint32_t node, std::span<const std::uint32_t> polygon) const {
        const auto first = static_cast<std::uint32_t>(polygon.data() - soup_.corners.data());
        if (graph.is_corner(node)) {
            const auto corner = first + static_cast<std::uint32_t>(graph.corner_at(node));
            return {corner, corner, 0};
        }
        const auto [side, place] = graph.new_node(node);
        return {first + static_cast<std::uint32_t>(side),
                first + static_cast<std::uint32_t>((side + 1) % polygon.size()), place};
    }
    void note_uncut(std::size_t number) {
        if (uncut_++ == 0) first_uncut_ = number;
    }

    const std::string& path_;
    PolygonSoup& soup_;
    PolygonSoup result_;
    bool is_any_cut_ = false;
    std::uint64_t uncut_ = 0;
    std::size_t first_uncut_ = 0;
    std::vector<glm::dvec3> corners_;
    std::vector<glm::dvec2> flat_;
    std::vector<std::vector<std::uint32_t>> pieces_;                     // of one polygon
    std::vector<CornerOrigin> origins_, piece_origins_;                  // of corners, if attributes are there
    std::vector<std::pair<std::uint32_t, std::uint32_t>> new_vertices_;  // its crossings: node, vertex
};

}  // namespace

void cut_at_self_crossings(const std::string& path, PolygonSoup& soup) { Cutter(path, soup).cut(); }

}  // namespace burin
