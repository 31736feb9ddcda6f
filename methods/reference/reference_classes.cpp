// Which classes the lines of the method `reference` have.

#include "methods/reference/reference_lines.h"

namespace burin {

/// A sliver's normal is noise; what counts is the surface on its other side.
Facet ReferenceLines::solid_beyond(Facet sliver, Facet not_this) const {
    Facet current = sliver;
    Facet previous = not_this;
    for (int step = 0; step < 4 && geometry_.is_sliver(current); ++step) {
        const Mesh& mesh = geometry_.mesh(current.object);
        glm::dvec3 c[3];
        geometry_.corners(current, c);
        double longest = -1;
        Facet next = current;
        for (unsigned k = 0; k < 3; ++k) {
            const HalfEdge h = 3 * current.triangle + k;
            const Facet neighbour{current.object, mesh.next_on_edge[h] / 3};
            const double length = glm::distance(c[k], c[(k + 1) % 3]);
            if (neighbour == current || neighbour == previous || length <= longest) continue;
            longest = length;
            next = neighbour;
        }
        if (next == current) break;
        previous = current;
        current = next;
    }
    return current;
}

LineClassSet ReferenceLines::edge_classes(Facet a, HalfEdge ha, Facet b, HalfEdge hb, glm::dvec2 at) const {
    const Mesh& mesh = geometry_.mesh(a.object);
    LineClassSet classes;
    if (mesh.is_marked(ha)) classes |= LineClass::mark;
    if (geometry_.is_sliver(a) || geometry_.is_sliver(b)) {
        return classes | contact_classes(solid_beyond(a, b), solid_beyond(b, a), at);
    }
    if (geometry_.same_polygon(a, b)) return classes;
    classes |= LineClass::polygon;
    if (geometry_.material(a) != geometry_.material(b)) classes |= LineClass::material;
    const auto start = [&mesh](HalfEdge h) { return mesh.triangles[h / 3][h % 3]; };
    // Wound alike, the two run along their edge in opposite directions.
    const double winding = start(ha) == start(hb) ? -1 : 1;
    if (winding * glm::dot(geometry_.polygon_normal(a), geometry_.polygon_normal(b)) < cos_crease_angle_) {
        classes |= LineClass::crease;
    }
    return classes;
}

LineClassSet ReferenceLines::classes_of_edge(Facet a, HalfEdge h, glm::dvec2 at) const {
    const Mesh& mesh = geometry_.mesh(a.object);
    LineClassSet classes;
    if (mesh.is_marked(h)) classes |= LineClass::mark;
    for (HalfEdge g = mesh.next_on_edge[h]; g != h; g = mesh.next_on_edge[g]) {
        classes |= edge_classes(a, h, {a.object, g / 3}, g, at);
    }
    return classes;
}

LineClassSet ReferenceLines::contact_classes(Facet a, Facet b, glm::dvec2 at) const {
    LineClassSet classes;
    if (a.object != b.object) {
        classes = LineClass::object;
        if (geometry_.material(a) != geometry_.material(b)) classes |= LineClass::material;
        return classes;
    }
    const Facet solid_a = solid_beyond(a, b), solid_b = solid_beyond(b, a);
    if (geometry_.same_polygon(solid_a, solid_b)) return classes;
    classes = LineClass::polygon;
    if (geometry_.material(solid_a) != geometry_.material(solid_b)) classes |= LineClass::material;
    const double cosine =
        glm::dot(geometry_.normal_towards_eye(solid_a, at), geometry_.normal_towards_eye(solid_b, at));
    if (cosine < cos_crease_angle_) classes |= LineClass::crease;
    return classes;
}

}  // namespace burin
