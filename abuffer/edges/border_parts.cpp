#include "abuffer/edges/border_parts.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "abuffer/edges/edge_sides.h"
#include "base/interrupt.h"
#include "lines/seam_sight.h"

namespace burin {
namespace {

/// Wider gaps between patches are no seams. 1 pixel.
constexpr double kWidestCrackSubpixels = to_subpixels(kWidestCrackPx);
/// A mesh with more than kMostBorderPairs pairs of a border and one about it has heaps of borders: there only borders
/// that come near are told apart, and where borders lie over each other, only those that run along. Where more than
/// kMostNear, or KnownSeams::Along::kFew, do, the border lies in a crowd.
constexpr std::size_t kMostBorderPairs = std::size_t{1} << 24, kFewAbout = 256, kMostNear = 32;
/// What runs along a border in a crowd is looked up at this many places, and at fewer in meshes of more than 2^13
/// borders, so that all lookups of a mesh are limited.
constexpr std::size_t kPartsInCrowd = 8, kPlacesInCrowd = std::size_t{1} << 16;

/// Whether two borders are at one depth, as walks over a seam ask it.
bool is_level(const ScreenSurfaces& screen, double nearness_a, double nearness_b, SurfaceId steep) {
    const auto distance = [&](double nearness) {
        return distance_of(screen.surfaces().projection, screen.surfaces().farthest_nearness + nearness);
    };
    const double a = distance(nearness_a);
    return std::abs(a - distance(nearness_b)) <= depth_tolerance(screen.surfaces(), a, screen.surfaces().plane(steep));
}

/// The border of another patch that runs along, nearer than a pixel and level, at a share of edge_on_screen().
std::optional<HalfEdge> seam_partner(const ScreenSurfaces& screen, SurfaceId s, HalfEdge h, const EdgeOnScreen& edge,
                                     const BorderIndex::SeamCandidates* few, double on_screen) {
    const Mesh& mesh = screen.surfaces().mesh_of(s);
    const glm::dvec3 a = mesh.local_position(start_of(mesh, h)), b = mesh.local_position(end_of(mesh, h));
    const glm::dvec3 at = glm::mix(a, b, share_in_space(screen, edge, on_screen));
    const auto partner = few != nullptr ? few->nearest(at) : seam_partner_seen(screen.surfaces(), s.instance, h, at);
    if (!partner) return std::nullopt;
    const auto other = edge_on_screen(screen, s.instance, start_of(mesh, *partner), end_of(mesh, *partner));
    if (!other) return std::nullopt;
    const glm::dvec2 place = edge.at(on_screen);
    const glm::dvec2 p = other->from, along = other->to - p;
    const double square = glm::dot(along, along);
    const double t = square > 0 ? std::clamp(glm::dot(place - p, along) / square, 0.0, 1.0) : 0.0;
    if (glm::distance(place, p + along * t) > kWidestCrackSubpixels) return std::nullopt;
    const double own_nearness = edge.nearness_at(on_screen);
    const SurfaceId beyond{s.instance, *partner / 3};
    const SurfaceSet& surfaces = screen.surfaces();
    const double in_its_plane = surfaces.plane(beyond).nearness(to_pixels(place)) - surfaces.farthest_nearness;
    if (!is_level(screen, own_nearness, other->nearness_at(t), beyond) &&
        !is_level(screen, own_nearness, in_its_plane, beyond)) {
        return std::nullopt;  // it lies before or behind, as a stair's next tread does
    }
    return partner;
}

/// Whether another border is nearer than a crack is wide, somewhere on the screen; true also for some that are not.
bool is_crack_beside(const ScreenSurfaces& screen, std::uint32_t instance, const EdgeOnScreen& edge, HalfEdge h) {
    const Mesh& mesh = *screen.surfaces().instances[instance].mesh;
    const auto other = edge_on_screen(screen, instance, start_of(mesh, h), end_of(mesh, h));
    if (!other) return false;
    const double length = glm::distance(edge.from, edge.to), p = edge.side_of(other->from), q = edge.side_of(other->to);
    const bool is_beyond = std::min(std::abs(p), std::abs(q)) > kWidestCrackSubpixels * length && (p < 0) == (q < 0);
    return !is_beyond;
}

}  // namespace

std::vector<BorderPart> parts_of_border(const ScreenSurfaces& screen, SurfaceId s, HalfEdge h,
                                        const EdgeOnScreen& edge) {
    throw_if_interrupted();  // in a crowd each takes long
    const Mesh& mesh = screen.surfaces().mesh_of(s);
    if (!mesh.borders.has_partners()) return {{}};
    BorderIndex::SeamCandidates listed, near;
    bool is_crowd = false;
    std::shared_ptr<const KnownSeams::Along> known;
    if (mesh.borders.has_crowds()) {
        known = screen.known_seams().along(mesh.borders, h);
        is_crowd = !known->is_complete;
    } else {
        const std::size_t most_about =
            std::max(kMostBorderPairs / std::max(mesh.borders.segments().size(), std::size_t{1}), kFewAbout);
        is_crowd =
            !mesh.borders.find_candidates(h, most_about, listed) && !mesh.borders.find_near(h, kMostNear, listed);
    }
    const BorderIndex::SeamCandidates& about = known ? known->candidates : listed;
    if (!is_crowd && about.segments().empty()) return {{}};
    const glm::dvec3 a = mesh.local_position(start_of(mesh, h)), along = mesh.local_position(end_of(mesh, h)) - a;
    const double square = glm::dot(along, along);
    std::vector<double> ends;
    bool has_crack = is_crowd;
    for (const BorderIndex::Segment& other : about.segments()) {
        if (!is_crack_beside(screen, s.instance, edge, other.half_edge)) continue;
        has_crack = true;
        for (const glm::dvec3& end : {other.a, other.b}) {
            const double in_space = glm::dot(end - a, along) / square;
            if (in_space > edge.begin && in_space < edge.end) ends.push_back(share_on_screen(screen, edge, in_space));
        }
    }
    if (!has_crack) return {{}};
    const std::size_t part_count =
        std::clamp<std::size_t>(kPlacesInCrowd / mesh.borders.segments().size(), 1, kPartsInCrowd);
    for (std::size_t k = 1; is_crowd && k < part_count; ++k)
        ends.push_back(static_cast<double>(k) / static_cast<double>(part_count));
    std::sort(ends.begin(), ends.end());
    // Few of the segments about the border come near it. Where many do, each place is looked up by itself.
    constexpr std::size_t kFew = KnownSeams::Along::kFew;
    const bool has_few = about.segments().size() <= kFew && !is_crowd;
    const bool has_few_near = !has_few && !is_crowd && mesh.borders.find_near(h, kFew, near);
    if (has_few_near && near.segments().empty()) return {{}};
    const BorderIndex::SeamCandidates* const few = has_few ? &about : has_few_near ? &near : nullptr;
    const double shortest = kWidestCrackSubpixels / glm::distance(edge.from, edge.to);  // a crack is no part of its own
    std::vector<BorderPart> parts;
    const auto add_part = [&](double begin, double end) {
        const auto partner = seam_partner(screen, s, h, edge, few, 0.5 * (begin + end));
        if (!parts.empty() && parts.back().partner == partner) {
            parts.back().end = end;
        } else {
            parts.push_back({begin, end, partner});
        }
    };
    double begin = 0;
    for (const double end : ends) {
        if (end - begin <= shortest || 1 - end <= shortest) continue;
        add_part(begin, end);
        begin = end;
    }
    add_part(begin, 1);
    return parts;
}

}  // namespace burin
