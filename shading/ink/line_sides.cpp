#include "shading/ink/line_sides.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lines/vertex_normal.h"
#include "mesh/vectors.h"

namespace burin {
namespace {

glm::dvec2 middle_of(const LinePiece& piece) { return 0.5 * (piece.from + piece.to); }

}  // namespace

/// The unit vector to the eye from an end of a piece, in view space.
glm::dvec3 LineSidesFinder::to_eye(const LinePiece& piece, int end) const {
    glm::dvec3 origin, direction;
    surfaces_.projection.view_ray(end == 0 ? piece.from : piece.to, origin, direction);
    return -unit(direction);
}

/// How much a triangle turns to the eye: N · V, 0 to 1.
double LineSidesFinder::facing(SurfaceId s, glm::dvec2 place) const {
    glm::dvec3 origin, direction;
    surfaces_.projection.view_ray(place, origin, direction);
    return std::abs(glm::dot(surfaces_.view_normal(s), unit(direction)));
}

LineSides LineSidesFinder::sides_of(const LinePiece& piece, bool has_normals, FrontFace* front) const {
    LineSides sides;
    if (piece.line.is_none()) return sides;
    sides.is_beyond = piece.occludes;
    Surfaces at;
    if (piece.line.is_edge()) {
        at = at_edge(piece, sides, has_normals);
    } else {
        at = at_meeting(piece);
        if (has_normals) set_flat_normals(piece, at, sides);
    }
    if (front != nullptr) *front = {at.front, at.front_edge};
    if (sides.front_object == 0) sides.front_object = surfaces_.object_id(at.front);
    sides.other_object = surfaces_.object_id(at.other);
    sides.front_material = surfaces_.material_id(at.front);
    sides.other_material = surfaces_.material_id(at.other);
    if (!at.front.is_background()) sides.front_plane = surfaces_.plane(at.front);
    if (sides.is_beyond && !at.other.is_background()) sides.beyond_plane = surfaces_.plane(at.other);
    return sides;
}

/// A line where two surfaces meet, or of which the mesh does not say why it is there.
LineSidesFinder::Surfaces LineSidesFinder::at_meeting(const LinePiece& piece) const {
    SurfaceId a = numbers_.of(piece.line.lower_surface()), b = numbers_.of(piece.line.member());
    const glm::dvec2 place = middle_of(piece);
    if (a.is_background()) std::swap(a, b);
    if (!a.is_background() && !b.is_background()) {
        const bool is_b_first = piece.occludes ? surfaces_.plane(b).nearness(place) > surfaces_.plane(a).nearness(place)
                                               : facing(b, place) > facing(a, place);
        if (is_b_first) std::swap(a, b);
    }
    return {a, b};
}

LineSidesFinder::Surfaces LineSidesFinder::at_edge(const LinePiece& piece, LineSides& sides, bool has_normals) const {
    const std::uint32_t instance = piece.line.instance();
    const Mesh& mesh = *surfaces_.instances[instance].mesh;
    const HalfEdge h = piece.line.half_edge();
    if (mesh.is_loose(h)) {
        sides.front_object = surfaces_.instances[instance].object_id;
        return {};
    }
    const glm::dvec2 place = middle_of(piece);
    Face best, second;
    std::size_t count = 0;
    for (HalfEdge at = h; count == 0 || at != h; at = mesh.next_on_edge[at]) {
        const SurfaceId s{instance, at / 3};
        const Face face{at, s, facing(s, place)};
        const auto comes_before = [this](const Face& a, const Face& b) {
            if (b.half_edge == kNoHalfEdge) return true;
            return a.facing != b.facing ? a.facing > b.facing
                                        : surfaces_.polygon_id(a.surface) < surfaces_.polygon_id(b.surface);
        };
        if (comes_before(face, best)) {
            second = best;
            best = face;
        } else if (comes_before(face, second)) {
            second = face;
        }
        ++count;
    }
    if (count == 2 && covers(piece, second, best)) std::swap(best, second);
    if (count == 2) add_fold(piece, best, second, sides);
    const Surfaces at{best.surface, piece.occludes ? numbers_.of(piece.beyond) : second.surface, best.half_edge};
    if (!has_normals) return at;
    set_flat_normals(piece, at, sides);
    const bool is_contour = piece.occludes && count == 2;
    const bool may_be_smooth = is_contour || piece.drawn_as == LineClass::polygon || piece.drawn_as == LineClass::mark;
    if (may_be_smooth && is_smooth_edge(mesh, h, cos_crease_angle_))
        add_smooth_normals(piece, h, at.front, is_contour, sides);
    return at;
}

/// Whether, of two faces of an edge that both lie on one side of it on the screen, a is in front of b.
bool LineSidesFinder::covers(const LinePiece& piece, const Face& a, const Face& b) const {
    const Mesh& mesh = surfaces_.mesh_of(a.surface);
    const auto corner = [&](const Face& face, unsigned k) {
        return surfaces_.view_position(face.surface.instance,
                                       mesh.triangles[face.half_edge / 3][(face.half_edge % 3 + k) % 3]);
    };
    const glm::dvec2 middle = middle_of(piece);
    glm::dvec3 origin, direction;
    surfaces_.projection.view_ray(middle, origin, direction);
    const glm::dvec3 start = corner(a, 0), across = glm::cross(corner(a, 1) - start, direction);
    const glm::dvec3 way_a = corner(a, 2) - start, way_b = corner(b, 2) - start;
    if (!(glm::dot(across, way_a) * glm::dot(across, way_b) > 0)) return false;
    return glm::dot(surfaces_.normal_towards_eye(b.surface, middle), way_a) > 0;
}

/// The angle at an edge of two polygons, and whether it sticks out as seen from the side of the first one that the eye
/// sees.
void LineSidesFinder::add_fold(const LinePiece& piece, const Face& a, const Face& b, LineSides& sides) const {
    const Mesh& mesh = surfaces_.mesh_of(a.surface);
    const glm::dvec3 n_a = surfaces_.view_normal(a.surface), n_b = surfaces_.view_normal(b.surface);
    const auto start_of = [&mesh](HalfEdge h) { return mesh.triangles[h / 3][h % 3]; };
    const bool are_alike = start_of(a.half_edge) != start_of(b.half_edge);
    const double cosine = std::clamp(are_alike ? glm::dot(n_a, n_b) : -glm::dot(n_a, n_b), -1.0, 1.0);
    const bool is_contour = piece.occludes && is_smooth_edge(mesh, a.half_edge, cos_crease_angle_);
    sides.dihedral_deg = is_contour ? 0 : static_cast<float>(glm::degrees(std::acos(cosine)));
    constexpr double kFlatSine = 1e-9;
    // Whether b's far corner lies below a's plane, on the side of a that the eye sees.
    const auto corner = [&](HalfEdge h, unsigned k) {
        return surfaces_.view_position(a.surface.instance, mesh.triangles[h / 3][(h % 3 + k) % 3]);
    };
    const glm::dvec3 towards = surfaces_.normal_towards_eye(a.surface, middle_of(piece));
    const glm::dvec3 way = corner(b.half_edge, 2) - corner(b.half_edge, 0);
    const double above = glm::dot(unit(way), towards);
    sides.convex = static_cast<std::int8_t>(above < -kFlatSine ? 1 : above > kFlatSine ? -1 : 0);
}

void LineSidesFinder::set_flat_normals(const LinePiece& piece, const Surfaces& at, LineSides& sides) const {
    const auto set = [&](SurfaceId s, glm::vec3(&normals)[2]) {
        if (s.is_background()) return;
        normals[0] = surfaces_.normal_towards_eye(s, piece.from);
        normals[1] = surfaces_.normal_towards_eye(s, piece.to);
    };
    set(at.front, sides.front_normals);
    set(at.other, sides.other_normals);
}

/// Normals of the smooth surface that the mesh stands for; a contour's are at right angles to the line of sight.
void LineSidesFinder::add_smooth_normals(const LinePiece& piece, HalfEdge h, SurfaceId front, bool is_contour,
                                         LineSides& sides) const {
    const SurfaceInstance& instance = surfaces_.instances[piece.line.instance()];
    const Mesh& mesh = *instance.mesh;
    const HalfEdge next = h - h % 3 + (h % 3 + 1) % 3;
    const auto& t = mesh.triangles[h / 3];
    const glm::dvec3 ends[2] = {surfaces_.view_position(piece.line.instance(), t[h % 3]),
                                surfaces_.view_position(piece.line.instance(), t[(h % 3 + 1) % 3])};
    const glm::dvec3 normals[2] = {unit(instance.normal_to_view * smooth_normal_at(mesh, h, cos_crease_angle_)),
                                   unit(instance.normal_to_view * smooth_normal_at(mesh, next, cos_crease_angle_))};
    const glm::dvec3 along = ends[1] - ends[0];
    // Polygons wound away from the eye are seen from behind, and so is the surface that they stand for.
    const SurfaceId own{piece.line.instance(), h / 3};
    const bool is_alike =
        front.triangle == own.triangle || glm::dot(surfaces_.view_normal(front), surfaces_.view_normal(own)) > 0;
    const bool is_front_behind =
        glm::dot(surfaces_.view_normal(front), glm::dvec3(surfaces_.normal_towards_eye(front, middle_of(piece)))) < 0;
    const double side = is_front_behind == is_alike ? -1 : 1;
    for (int end = 0; end < 2; ++end) {
        const double depth = surfaces_.projection.distance(end == 0 ? piece.nearness_from : piece.nearness_to);
        glm::dvec3 origin, direction;
        surfaces_.projection.view_ray(end == 0 ? piece.from : piece.to, origin, direction);
        const glm::dvec3 place = origin + direction * depth;
        const double square = glm::dot(along, along);
        const double share = square > 0 ? std::clamp(glm::dot(place - ends[0], along) / square, 0.0, 1.0) : 0.0;
        glm::dvec3 normal = unit(glm::mix(normals[0], normals[1], share));
        const glm::dvec3 eye = to_eye(piece, end);
        normal *= side;
        // What is seen turns away no farther than across the line of sight.
        if (is_contour || glm::dot(normal, eye) < 0) normal = unit(normal - eye * glm::dot(normal, eye));
        // A contour's normal points away from the surface that ends: to the side beyond it on the screen.
        if (is_contour) {
            const glm::dvec2 way = piece.to - piece.from;
            const glm::dvec2 left(way.y, -way.x), outwards = piece.front_on_left ? -left : left;
            if (normal.x * outwards.x - normal.y * outwards.y < 0) normal = -normal;
        }
        sides.front_normals[end] = normal;
        if (!is_contour) sides.other_normals[end] = normal;
    }
}

}  // namespace burin
