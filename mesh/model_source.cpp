#include "mesh/model_source.h"

#include <utility>

#include "base/interrupt.h"

namespace burin {
namespace {

bool have_same_polygons(const PolygonSoup& a, const PolygonSoup& b) {
    return a.positions.size() == b.positions.size() && a.corners == b.corners && a.polygon_ends == b.polygon_ends &&
           a.polygon_object == b.polygon_object && a.object_names.size() == b.object_names.size() &&
           a.polygon_material == b.polygon_material && a.marked_edges == b.marked_edges;
}

bool have_same_polygons(const GltfScene& a, const GltfScene& b) {
    if (a.meshes.size() != b.meshes.size() || a.objects.size() != b.objects.size()) return false;
    for (std::size_t i = 0; i < a.meshes.size(); ++i) {
        if (!have_same_polygons(a.meshes[i], b.meshes[i])) return false;
    }
    for (std::size_t i = 0; i < a.objects.size(); ++i) {
        const GltfObject &own = a.objects[i], &other = b.objects[i];
        // Where both the vertices and the matrix change, places between are those of no matrix and no vertices.
        const bool is_rigid = a.meshes[own.mesh].positions == b.meshes[own.mesh].positions;
        if (own.mesh != other.mesh || (own.to_world != other.to_world && !is_rigid)) return false;
    }
    return true;
}

void move_towards(PolygonSoup& soup, const PolygonSoup& to, double part) {
    throw_if_interrupted();
    for (std::size_t i = 0; i < soup.positions.size(); ++i)
        soup.positions[i] = (1 - part) * soup.positions[i] + part * to.positions[i];
}

void move_towards(GltfScene& scene, const GltfScene& to, double part) {
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) move_towards(scene.meshes[i], to.meshes[i], part);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        glm::dmat4& own = scene.objects[i].to_world;
        if (own != to.objects[i].to_world) own = own * (1 - part) + to.objects[i].to_world * part;
        own[3][3] = 1;  // which the sum of the parts may miss
    }
}

}  // namespace

std::optional<ModelSource> between(const ModelSource& first, const ModelSource& second, double part) {
    return std::visit(
        [&](const auto& own) -> std::optional<ModelSource> {
            using Content = std::decay_t<decltype(own)>;
            const Content* const other = std::get_if<Content>(&second.content);
            if (other == nullptr || !have_same_polygons(own, *other)) return std::nullopt;
            ModelSource result = first;
            move_towards(std::get<Content>(result.content), *other, part);
            return result;
        },
        first.content);
}

}  // namespace burin
