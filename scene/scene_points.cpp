#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/interrupt.h"
#include "mesh/box.h"
#include "scene/animation/scene_animation.h"
#include "scene/scene.h"

namespace burin {
namespace {

constexpr std::size_t kPointBlock = 512;
constexpr std::size_t kBoxBlock = 32;

/// Boxes around blocks of a mesh's positions, around blocks of these boxes, and so on up to the
/// whole mesh.
class BoxTree {
  public:
    explicit BoxTree(const Mesh& mesh) {
        const std::span<const glm::vec3> positions(mesh.positions);
        std::vector<Box> boxes;
        for (std::size_t first = 0; first < positions.size(); first += kPointBlock) {
            const std::size_t count = std::min(kPointBlock, positions.size() - first);
            Box box = box_of(positions.subspan(first, count));
            if (mesh.has_residuals()) {
                box = {};
                for (std::size_t v = first; v < first + count; ++v)
                    box.add(mesh.local_position(static_cast<std::uint32_t>(v)));
            }
            box.low += mesh.origin;  // rounds as points do
            box.high += mesh.origin;
            boxes.push_back(box);
        }
        while (!boxes.empty()) {
            levels_.push_back(std::move(boxes));
            boxes.clear();
            const std::vector<Box>& below = levels_.back();
            if (below.size() == 1) break;
            for (std::size_t i = 0; i < below.size(); ++i) {
                if (i % kBoxBlock == 0) boxes.emplace_back();
                boxes.back().add(below[i].low);
                boxes.back().add(below[i].high);
            }
        }
    }

    /// Calls use(number of a block) for the blocks in all of whose boxes, from the whole mesh down
    /// to its own, is_needed(box) is true.
    template <typename IsNeeded, typename Use>
    void for_each_block(const IsNeeded& is_needed, const Use& use) const {
        if (!levels_.empty()) visit(levels_.size() - 1, 0, is_needed, use);
    }

  private:
    template <typename IsNeeded, typename Use>
    void visit(std::size_t level, std::size_t number, const IsNeeded& is_needed, const Use& use) const {
        if (!is_needed(levels_[level][number])) return;
        if (level == 0) return use(number);
        const std::size_t end = std::min((number + 1) * kBoxBlock, levels_[level - 1].size());
        for (std::size_t i = number * kBoxBlock; i < end; ++i) visit(level - 1, i, is_needed, use);
    }

    std::vector<std::vector<Box>> levels_;  // from the smallest boxes up
};

/// A box around all that the points of `box` become, in whatever way they are rounded.
Box transformed(const glm::dmat4& m, const Box& box) {
    glm::dvec3 low(m[3]), high(m[3]), size = glm::abs(glm::dvec3(m[3]));
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 a = glm::dvec3(m[axis]) * box.low[axis], b = glm::dvec3(m[axis]) * box.high[axis];
        low += glm::min(a, b);
        high += glm::max(a, b);
        size += glm::max(glm::abs(a), glm::abs(b));
    }
    constexpr double kRounding = 1e-14;  // of some additions and multiplications
    return {low - kRounding * size, high + kRounding * size};
}

}  // namespace

namespace {

using BoxTrees = std::vector<std::unique_ptr<const BoxTree>>;

/// The points of a mesh at its place.
void visit_points(const Mesh& mesh, const BoxTree& tree, const glm::dmat4& to_world, const PointVisitor& visit) {
    std::array<glm::dvec3, kPointBlock> some;
    const auto visit_block = [&](std::size_t block, const auto& place) {
        throw_if_interrupted();
        const std::size_t first = block * kPointBlock, count = std::min(kPointBlock, mesh.positions.size() - first);
        for (std::size_t i = 0; i < count; ++i) some[i] = place(mesh.position(static_cast<std::uint32_t>(first + i)));
        visit(std::span(some).first(count));
    };
    if (to_world == glm::dmat4(1.0)) {
        tree.for_each_block([&](const Box& box) { return visit.needs(box, true); },
                            [&](std::size_t block) { visit_block(block, [](const glm::dvec3& p) { return p; }); });
    } else {
        tree.for_each_block(
            [&](const Box& box) { return visit.needs(transformed(to_world, box), false); },
            [&](std::size_t block) {
                visit_block(block, [&](const glm::dvec3& p) { return glm::dvec3(to_world * glm::dvec4(p, 1.0)); });
            });
    }
}

const BoxTree& tree_of(const Mesh& mesh, std::unique_ptr<const BoxTree>& tree) {
    if (!tree) tree = std::make_unique<const BoxTree>(mesh);
    return *tree;
}

}  // namespace

PointSource scene_points(const Scene& scene) {
    // The trees of each mesh, made once they are needed: a camera's fit runs twice over all points.
    const auto trees = std::make_shared<BoxTrees>(scene.meshes.size());
    return [&scene, trees](const PointVisitor& visit) {
        for (const SceneObject& object : scene.objects) {
            throw_if_interrupted();
            const Mesh& mesh = scene.meshes[object.mesh];
            visit_points(mesh, tree_of(mesh, (*trees)[object.mesh]), object.to_world, visit);
        }
    };
}

namespace {

/// Nothing if the frame cannot be read, and `unreadable` takes that.
std::optional<SceneChange> readable_change(const SceneAnimation& animation, double frame,
                                           const UnreadableFrame& unreadable) {
    try {
        return animation.at(frame);
    } catch (const InputError& error) {
        const FrameError of_frame(frame, error.what());
        if (!unreadable) throw of_frame;
        unreadable(of_frame);
        return std::nullopt;
    }
}

}  // namespace

PointSource points_of_frames(const Scene& scene, const SceneAnimation& animation, std::vector<double> frames,
                             UnreadableFrame unreadable) {
    if (!animation.moves_objects() || frames.empty()) return scene_points(scene);
    const auto trees = std::make_shared<BoxTrees>(scene.meshes.size());
    return [&scene, &animation, frames = std::move(frames), trees,
            unreadable = std::move(unreadable)](const PointVisitor& visit) {
        for (const double frame : frames) {
            const std::optional<SceneChange> found = readable_change(animation, frame, unreadable);
            if (!found) continue;
            const SceneChange& change = *found;
            std::vector<const Mesh*> meshes;
            for (const Mesh& mesh : scene.meshes) meshes.push_back(&mesh);
            for (const auto& [number, mesh] : change.meshes) meshes[number] = &mesh;
            BoxTrees changed(scene.meshes.size());
            for (std::size_t i = 0; i < scene.objects.size(); ++i) {
                throw_if_interrupted();
                const std::uint32_t number = scene.objects[i].mesh;
                const Mesh& mesh = *meshes[number];
                const bool is_as_loaded = &mesh == &scene.meshes[number];
                const BoxTree& tree = tree_of(mesh, (is_as_loaded ? *trees : changed)[number]);
                visit_points(mesh, tree, change.to_world.empty() ? scene.objects[i].to_world : change.to_world[i],
                             visit);
            }
        }
    };
}

}  // namespace burin
