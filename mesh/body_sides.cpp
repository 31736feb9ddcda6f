#include "mesh/body_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>

namespace burin {
namespace {

/// Less volume than this, over the 3/2nd power of the area, encloses nothing: a ball has 0.094, a box of 1 x 1 x 0.001
/// 0.0004.
constexpr double kLeastVolume = 1e-5;
constexpr std::int8_t kSheet = 2;  // until all are known; 0 = not looked at

}  // namespace

std::vector<std::int8_t> find_body_sides(const Mesh& mesh) {
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    std::vector<std::int8_t> sides(count,
                                   0);  // first: wound as the body's first triangle, 1, or the other way round, -1
    std::vector<std::uint32_t> body;
    for (std::uint32_t start = 0; start < count; ++start) {
        if (sides[start] != 0) continue;
        sides[start] = 1;
        body.assign(1, start);
        double volume = 0, area = 0;  // six times, twice
        bool has_border = false;
        const glm::dvec3 origin = mesh.local_position(mesh.triangles[start][0]);
        glm::dvec3 area_vector(0.0), moment(0.0);
        for (std::size_t i = 0; i < body.size(); ++i) {
            const std::uint32_t t = body[i];
            const auto& corners = mesh.triangles[t];
            const auto corner = [&](std::size_t k) { return mesh.local_position(corners[k]) - origin; };
            const glm::dvec3 a = corner(0), b = corner(1), c = corner(2), own = glm::cross(b - a, c - a);
            volume += sides[t] * glm::dot(a, glm::cross(b, c));
            area_vector += static_cast<double>(sides[t]) * own;
            area += glm::length(own);
            moment += (a + b + c) * (glm::length(own) / 3);
            for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
                const HalfEdge g = mesh.next_on_edge[h];
                has_border = has_border || g == h;
                if (g == h || mesh.next_on_edge[g] != h || sides[g / 3] != 0) continue;
                const bool runs_against = mesh.triangles[g / 3][g % 3] != corners[h - 3 * t];
                sides[g / 3] = static_cast<std::int8_t>(runs_against ? sides[t] : -sides[t]);
                body.push_back(g / 3);
            }
        }
        // The volume is counted as seen from the middle, which matters where the body is open.
        if (area > 0) volume -= glm::dot(moment / area, area_vector);
        const double least = kLeastVolume * 6 * std::pow(0.5 * area, 1.5);
        // A face between edges of more than two triangles is a part of a body: it is believed as it is wound.
        const int body_side = volume > least ? -1 : volume < -least ? 1 : has_border ? 0 : -1;
        for (const std::uint32_t t : body)
            sides[t] = body_side == 0 ? kSheet : static_cast<std::int8_t>(sides[t] * body_side);
    }
    std::replace(sides.begin(), sides.end(), kSheet, std::int8_t{0});
    return sides;
}

bool are_wound_alike(const Mesh& mesh, std::uint32_t a, std::uint32_t b, std::size_t most) {
    constexpr std::size_t kFew = 64;
    std::array<std::uint32_t, kFew> few;  // wound as the first one
    std::vector<std::uint32_t> all;       // these and all else, once they are more
    std::unordered_set<std::uint32_t> known;
    std::size_t count = 0;
    const auto add = [&](std::uint32_t t) {
        if (count < kFew) {
            if (std::find(few.data(), few.data() + count, t) == few.data() + count) few[count++] = t;
            return;
        }
        if (all.empty()) {
            all.assign(few.begin(), few.end());
            known.insert(few.begin(), few.end());
        }
        if (!known.insert(t).second) return;
        all.push_back(t);
        ++count;
    };
    add(a);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t t = i < kFew ? few[i] : all[i];
        if (t == b) return true;
        for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
            const HalfEdge g = mesh.next_on_edge[h];
            const bool is_alike =
                g != h && mesh.next_on_edge[g] == h && mesh.triangles[g / 3][g % 3] != mesh.triangles[t][h - 3 * t];
            if (is_alike && count < most) add(g / 3);
        }
    }
    return false;
}

bool BodySides::are_same(std::uint32_t a, std::uint32_t b) const {
    if (are_known_.load(std::memory_order_acquire)) return sides_[a] == sides_[b];
    if (are_wound_alike(mesh_, a, b)) return true;
    // A few long ways, though they lead nowhere, are less work than the whole mesh.
    constexpr std::size_t kMost = 4096;
    if (visited_.load(std::memory_order_relaxed) < mesh_.triangles.size() / 4) {
        if (are_wound_alike(mesh_, a, b, kMost)) return true;
        visited_.fetch_add(kMost, std::memory_order_relaxed);
    }
    return of(a) == of(b);
}

}  // namespace burin
