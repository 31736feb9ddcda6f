#include "abuffer/samples/flush_cover.h"

#include <algorithm>
#include <cmath>

#include "abuffer/screen/face_plane.h"
#include "lines/narrow_lap.h"

namespace burin {
namespace {

/// Gaps narrower than folds that are no contours. 1/64 pixel.
constexpr double kNegligibleSubpixels = 4;
/// What two samples on one plane are off it at most, for a first look: a part of a pixel's width, and of what the plane
/// rises between them.
constexpr double kAboutLevelPx = 1.0 / 16, kAboutLevelRise = 1.0 / 16;

}  // namespace

bool FlushCover::is_covered(const NeighbourSamples& pair, glm::ivec2 block) {
    const SurfaceId first = pair.surfaces[0], second = pair.surfaces[1];
    if (!are_flush(first, second, pair.place(0.5))) return false;
    const std::vector<Face>& faces = faces_from(block);
    covered_.clear();
    const double slack = kNegligibleSubpixels / pair.pitch;
    const glm::ivec2 low(pair.x, pair.y),
        high = low + (pair.down ? glm::ivec2(0, pair.pitch) : glm::ivec2(pair.pitch, 0));
    for (const Face& face : faces) {
        if (glm::any(glm::greaterThan(face.low, high)) || glm::any(glm::lessThan(face.high, low))) continue;
        const Interval part = part_within(pair, face.surface);
        if (!(part.begin < part.end)) continue;
        const glm::dvec2 middle = pair.place(0.5 * (part.begin + part.end));
        if (!are_flush(face.surface, first, middle) && !are_flush(face.surface, second, middle)) continue;
        if (part.begin <= slack && part.end + slack >= 1) return true;  // by itself: in a heap nearly all are so
        covered_.push_back(part);
    }
    std::sort(covered_.begin(), covered_.end(), [](const Interval& a, const Interval& b) { return a.begin < b.begin; });
    double reached = 0;
    for (const Interval& part : covered_) {
        if (part.begin > reached + slack) return false;
        reached = std::max(reached, part.end);
    }
    return reached + slack >= 1;
}

bool FlushCover::may_be_level(const NeighbourSamples& pair, const float (&nearness)[2]) const {
    const double from = static_cast<double>(nearness[0]), rise = static_cast<double>(nearness[1]) - from;
    const Projection& p = screen_.surfaces().projection;
    const double pixel = (p.orthographic ? 1 : from + screen_.surfaces().farthest_nearness) / p.focal_px;
    const double limit = kAboutLevelPx * pixel + kAboutLevelRise * std::abs(rise);
    const SurfaceId s = pair.surfaces[0];
    const ScreenMesh& mesh = screen_.mesh(s.instance);
    if (mesh.facing[s.triangle] == off_screen) return true;
    const std::uint32_t* const corners = mesh.corners + 3 * static_cast<std::size_t>(s.triangle);
    const ScreenVertex &a = mesh.vertices[corners[0]], &b = mesh.vertices[corners[1]], &c = mesh.vertices[corners[2]];
    const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - a.x, vy = c.y - a.y;
    const double rise_u = static_cast<double>(b.nearness - a.nearness),
                 rise_v = static_cast<double>(c.nearness - a.nearness);
    // Its plane's rise from one sample to the other.
    const double along = pair.down ? ux * rise_v - vx * rise_u : vy * rise_u - uy * rise_v, area = ux * vy - uy * vx;
    return std::abs(along * pair.pitch - rise * area) <= limit * std::abs(area);
}

bool FlushCover::stands_in_front(HalfEdge edge, SurfaceId face) const {
    if (edge == kNoHalfEdge) return false;
    const SurfaceSet& surfaces = screen_.surfaces();
    const FacePlane plane(surfaces, face);
    const auto rises = [&](HalfEdge h) {
        return rises_in_front(surfaces, {face.instance, h / 3}, plane, kCoincidentPx);
    };
    return rises(edge) || rises(screen_.mesh(face.instance).partners[edge]);
}

/// Whether one of the faces at a line laps over the other one by a narrow strip alone: that is a contact, unless a
/// third face goes on under both.
bool FlushCover::laps_narrowly(HalfEdge edge, const NeighbourSamples& pair, glm::ivec2 block) {
    if (edge == kNoHalfEdge) return false;
    const SurfaceSet& surfaces = screen_.surfaces();
    const std::uint32_t instance = pair.surfaces[0].instance;
    const auto pixel_at = [&](double fraction) { return to_pixels(pair.place(fraction)); };
    const glm::dvec2 middle = pair.place(0.5);
    const auto laps_over = [&](const FacePlace& other) {
        for (const HalfEdge h : {edge, screen_.mesh(instance).partners[edge]}) {
            const SurfaceId own{instance, h / 3};
            if (are_flush(own, other.surface, middle) && burin::laps_narrowly(surfaces, own, h, other, pixel_at(0.5)))
                return true;
        }
        return false;
    };
    if (!laps_over({pair.surfaces[0], pixel_at(0)}) && !laps_over({pair.surfaces[1], pixel_at(1)})) return false;
    const auto goes_on = [&](const FacePlace& from, double fraction) {
        return walk_surface(surfaces, from.surface, from.pixel, pixel_at(fraction), criteria_).end == WalkEnd::arrived;
    };
    const std::vector<Face>& faces = faces_from(block);
    return std::none_of(faces.begin(), faces.end(), [&](const Face& face) {
        const Interval part = part_within(pair, face.surface);
        if (!(part.begin < part.end) || !are_flush(face.surface, pair.surfaces[0], middle)) return false;
        const FacePlace place{face.surface, pixel_at(0.5 * (part.begin + part.end))};
        return goes_on(place, 0) && goes_on(place, 1) && !laps_over(place);
    });
}

/// Whether two triangles lie in one plane without a line between them. Triangles that have nothing in common on the
/// screen are compared at one place.
bool FlushCover::are_flush(SurfaceId a, SurfaceId b, glm::dvec2 subpixel) const {
    if (a.instance != b.instance) return false;
    if (a == b) return true;
    const SurfaceSet& surfaces = screen_.surfaces();
    const glm::dvec2 at = to_pixels(subpixel);
    if (surfaces.order_at(a, b, at).is_apart) return false;  // most are, and this takes less time
    return (contact_classes(surfaces, a, b, at, criteria_) & criteria_.classes).empty() &&
           surfaces.order_near(a, b, at).are_coincident();
}

/// The faces that pairs may reach which begin in a block of samples: these end in it or in the next one.
const std::vector<FlushCover::Face>& FlushCover::faces_from(glm::ivec2 block) {
    const auto at = static_cast<std::size_t>(block.y * BlockTable::kPitch + block.x);
    if (faces_.empty()) faces_.resize(BlockTable::kSize);
    std::vector<Face>& faces = faces_[at];
    if (std::find(filled_.begin(), filled_.end(), at) != filled_.end()) return faces;
    filled_.push_back(at);
    faces.clear();
    for (const auto runs : {bins_.runs_in(tile_), bins_.thin_runs_in(tile_)}) {
        for (const TriangleRun& run : runs) {
            for (std::uint32_t i = 0; i < run.count; ++i) {
                const TileTriangle& t = run.triangles[i];
                if (t.first_column() > block.x + 1 || t.last_column() < block.x || t.first_row() > block.y + 1 ||
                    t.last_row() < block.y)
                    continue;
                add({run.instance, t.triangle}, faces);
            }
        }
    }
    for (const auto numbers : {bins_.large_in(tile_), bins_.thin_large_in(tile_)}) {
        for (const std::uint32_t i : numbers) add(bins_.large(i).surface, faces);
    }
    return faces;
}

void FlushCover::add(SurfaceId s, std::vector<Face>& faces) const {
    const Facing facing = screen_.facing(screen_.number_of(s));
    if (facing == edge_on) return;
    Face face{s, glm::ivec2(0), glm::ivec2(0)};
    if (facing == off_screen) {
        const ScreenPolygon polygon = screen_.surfaces().screen_polygon(s);
        if (polygon.count == 0) return;
        face.low = face.high = {polygon.corners[0].x, polygon.corners[0].y};
        for (int i = 1; i < polygon.count; ++i) {
            const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
            face.low = glm::min(face.low, glm::ivec2(p.x, p.y));
            face.high = glm::max(face.high, glm::ivec2(p.x, p.y));
        }
    } else {
        const auto [a, b, c] = screen_.triangle(s).corners;
        face.low = {std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})};
        face.high = {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})};
    }
    faces.push_back(face);
}

/// The part of the way that lies in a convex polygon; a corner on the line counts to one side, as samples on an edge
/// belong to one.
FlushCover::Interval FlushCover::part_within(const NeighbourSamples& pair, SurfaceId s) const {
    const bool is_cut = screen_.facing(screen_.number_of(s)) == off_screen;
    ScreenPolygon polygon;
    if (is_cut) {
        polygon = screen_.surfaces().screen_polygon(s);
    } else {
        const ScreenTriangle t = screen_.triangle(s);
        polygon.count = 3;
        for (std::size_t k = 0; k < 3; ++k) polygon.corners[k] = {t.corners[k].x, t.corners[k].y};
    }
    const std::int32_t across = pair.down ? pair.x : pair.y, origin = pair.down ? pair.y : pair.x;
    Interval part{1, 0};
    for (int i = 0; i < polygon.count; ++i) {
        const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
        const SubpixelPoint q = polygon.corners[static_cast<std::size_t>(i + 1 == polygon.count ? 0 : i + 1)];
        const std::int32_t u = pair.down ? p.y : p.x, v = pair.down ? p.x : p.y, next_u = pair.down ? q.y : q.x,
                           next_v = pair.down ? q.x : q.y;
        if ((v > across) == (next_v > across)) continue;
        const double at = (u + static_cast<double>(across - v) * (next_u - u) / (next_v - v) - origin) / pair.pitch;
        part.begin = std::min(part.begin, at);
        part.end = std::max(part.end, at);
    }
    return {std::max(part.begin, 0.0), std::min(part.end, 1.0)};
}

}  // namespace burin
