#include "render/copied_objects.h"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <utility>
#include <vector>

#include "base/interrupt.h"

namespace burin {
namespace {

template <typename T>
bool are_same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool are_equal(const Mesh& a, const Mesh& b) {
    return &a == &b ||
           (a.origin == b.origin && are_same_bytes(a.positions, b.positions) &&
            are_same_bytes(a.residuals, b.residuals) && are_same_bytes(a.triangles, b.triangles) &&
            a.triangle_polygon == b.triangle_polygon && a.polygon_count == b.polygon_count &&
            a.polygon_material == b.polygon_material && a.marked == b.marked && a.loose_edges == b.loose_edges);
}

/// Mixes bytes into a number that differs where they do, nearly always.
std::uint64_t mixed(std::uint64_t hash, const void* data, std::size_t size) {
    const char* const bytes = static_cast<const char*>(data);
    for (std::size_t at = 0; at < size; at += sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes + at, std::min(sizeof word, size - at));
        hash = (hash ^ word) * 0x9E3779B97F4A7C15u;
        hash ^= hash >> 29;
    }
    return hash;
}

/// A hash of what differs between most objects and takes little time to look at.
std::uint64_t hash_of_place(const Scene& scene, const SceneObject& object) {
    const Mesh& mesh = scene.meshes[object.mesh];
    std::uint64_t hash = mixed(mesh.positions.size(), &object.to_world, sizeof object.to_world);
    hash = mixed(hash ^ mesh.triangles.size(), &mesh.origin, sizeof mesh.origin);
    return mixed(hash, mesh.positions.data(), std::min(mesh.positions.size(), std::size_t{4}) * sizeof(glm::vec3));
}

std::uint64_t hash_of_mesh(const Mesh& mesh) {
    const std::uint64_t hash = mixed(1, mesh.positions.data(), mesh.positions.size() * sizeof(glm::vec3));
    return mixed(hash, mesh.triangles.data(), mesh.triangles.size() * sizeof mesh.triangles[0]);
}

struct HashedObject {
    std::uint64_t hash;
    std::uint32_t number;
    bool operator<(const HashedObject& o) const { return std::tie(hash, number) < std::tie(o.hash, o.number); }
};

/// Calls use(objects) for each group of objects with one hash.
template <typename Use>
void for_equal_hashes(std::vector<HashedObject>& objects, const Use& use) {
    std::sort(objects.begin(), objects.end());
    for (auto begin = objects.begin(), end = begin; begin != objects.end(); begin = end) {
        while (end != objects.end() && end->hash == begin->hash) ++end;
        if (end - begin > 1) use(std::vector<HashedObject>(begin, end));
    }
}

std::vector<bool> find_copies(const Scene& scene) {
    std::vector<bool> is_copy(scene.objects.size(), false);
    std::vector<HashedObject> objects;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        if (!scene.meshes[scene.objects[i].mesh].positions.empty())
            objects.push_back({hash_of_place(scene, scene.objects[i]), i});
    }
    for_equal_hashes(objects, [&](std::vector<HashedObject> some) {
        throw_if_interrupted();
        for (HashedObject& o : some) o.hash = hash_of_mesh(scene.meshes[scene.objects[o.number].mesh]);
        for_equal_hashes(some, [&](const std::vector<HashedObject>& equal) {
            const SceneObject& first = scene.objects[equal.front().number];
            bool is_opaque = true;
            first.materials.for_each(
                [&](std::uint32_t m) { is_opaque = is_opaque && scene.materials[m].opacity >= 1; });
            if (!is_opaque) return;
            for (std::size_t i = 1; i < equal.size(); ++i) {
                const SceneObject& other = scene.objects[equal[i].number];
                is_copy[equal[i].number] =
                    other.to_world == first.to_world && are_equal(scene.meshes[first.mesh], scene.meshes[other.mesh]) &&
                    (other.materials.address() == first.materials.address() || other.materials == first.materials);
            }
        });
    });
    return is_copy;
}

}  // namespace

std::size_t empty_copied_objects(Scene& scene, ReplacedMeshes* replaced) {
    if (scene.objects.size() < 2 || !scene.zbuffer.highlight_objects.empty()) return 0;
    const std::vector<bool> is_copy = find_copies(scene);
    const auto count = static_cast<std::size_t>(std::count(is_copy.begin(), is_copy.end(), true));
    if (count == 0) return 0;
    std::vector<bool> is_seen(scene.meshes.size(), false);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        if (!is_copy[i]) is_seen[scene.objects[i].mesh] = true;
    }
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        if (!is_copy[i]) continue;
        const std::uint32_t mesh = scene.objects[i].mesh;
        Mesh nothing;
        nothing.name = scene.meshes[mesh].name;
        nothing.polygon_count = scene.meshes[mesh].polygon_count;
        if (is_seen[mesh]) {
            scene.objects[i].mesh = static_cast<std::uint32_t>(scene.meshes.size());
            scene.meshes.push_back(std::move(nothing));
        } else {
            replace_mesh(scene, mesh, std::move(nothing), replaced);
        }
    }
    return count;
}

}  // namespace burin
