#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <tuple>
#include <utility>

#include "mesh/model.h"
#include "mesh/text_scan.h"
#include "scene/scene_description.h"

namespace burin {
namespace {

bool is_finite(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            if (!(std::abs(m[c][r]) <= 1e60)) return false;
        }
    }
    return true;
}

constexpr std::size_t kPointBlock = 512;

/// Around the blocks of a mesh's positions.
std::vector<Box> block_boxes(const Mesh& mesh) {
    std::vector<Box> boxes;
    for (std::size_t first = 0; first < mesh.positions.size(); first += kPointBlock) {
        Box box = box_of(std::span(mesh.positions).subspan(first, std::min(kPointBlock, mesh.positions.size() - first)));
        box.low += mesh.origin;  // rounds as points do
        box.high += mesh.origin;
        boxes.push_back(box);
    }
    return boxes;
}

/// A model as it arrived in the scene: where its meshes and materials start.
struct LoadedModel {
    std::vector<ModelObject> objects;
    std::uint32_t first_mesh = 0;
    std::uint32_t first_material = 0;
    std::uint32_t material_count = 0;
};

class SceneLoader {
  public:
    SceneLoader(SceneDescription description, int threads) : from_(std::move(description)), threads_(threads) {
        scene_.materials = from_.materials;
        scene_.cameras = from_.cameras;
        scene_.picture = from_.picture;
        scene_.lines = from_.lines;
        scene_.surfaces = from_.surfaces;
        scene_.abuffer = from_.abuffer;
        scene_.patel = from_.patel;
        scene_.reference = from_.reference;
        scene_.gbuffer = from_.gbuffer;
        scene_.zbuffer = from_.zbuffer;
        scene_.wire = from_.wire;
    }

    Scene load() {
        for (ObjectDescription& object : from_.objects) place(object, model_of(object));
        if (scene_.cameras.empty()) scene_.cameras = std::move(file_cameras_);
        scene_.camera_is_default = scene_.cameras.empty();
        if (scene_.cameras.empty()) scene_.cameras.emplace_back();
        check_highlights();
        return std::move(scene_);
    }

  private:
    void check_highlights() const {
        for (const std::string& name : scene_.zbuffer.highlight_objects) {
            const bool exists = std::any_of(scene_.objects.begin(), scene_.objects.end(),
                                            [&](const SceneObject& o) { return is_named(o, name); });
            if (!exists) {
                throw InputError("[zbuffer] highlight: '" + printable(name) + "' is neither a line class (" +
                                 to_string(LineClassSet::all()) + ") nor an object");
            }
        }
    }

    /// What is wrong with a model of a scene file is told with the place that names it.
    const LoadedModel& model_of(ObjectDescription& object) {
        if (object.where.line == 0) return load_model(object);
        try {
            return load_model(object);
        } catch (const InputError& error) {
            throw InputError(object.where, error.what());
        }
    }

    const LoadedModel& load_model(ObjectDescription& object) {
        const MeshOptions options{.subdivision_levels = object.subdivide, .scheme = object.scheme, .threads = threads_};
        if (object.file.empty()) {
            Model model;
            model.materials = std::move(object.shape.materials);
            model.meshes = build_meshes(std::move(object.shape), options);
            model.objects.push_back({object.name, 0, glm::dmat4(1.0)});
            shapes_.push_back(adopt(std::move(model)));
            return shapes_.back();
        }
        const auto key = std::tuple(object.file, object.subdivide, object.scheme);
        const auto known = files_.find(key);
        if (known != files_.end()) return known->second;
        Model model = read_model(object.file, options);
        for (const ModelCamera& c : model.cameras) {
            CameraSettings camera;
            camera.name = c.name;
            camera.orthographic = c.orthographic;
            camera.fov_deg = c.fov_deg;
            if (c.orthographic) camera.height = c.height;
            camera.to_world = object.to_world * object.instances.front() * c.to_world;
            file_cameras_.push_back(camera);
        }
        return files_.emplace(key, adopt(std::move(model))).first->second;
    }

    /// Moves a model's meshes and materials into the scene.
    LoadedModel adopt(Model model) {
        LoadedModel loaded;
        loaded.first_mesh = static_cast<std::uint32_t>(scene_.meshes.size());
        loaded.first_material = static_cast<std::uint32_t>(scene_.materials.size());
        loaded.material_count = static_cast<std::uint32_t>(model.materials.size());
        for (Mesh& mesh : model.meshes) scene_.meshes.push_back(std::move(mesh));
        for (Material& material : model.materials) scene_.materials.push_back(std::move(material));
        loaded.objects = std::move(model.objects);
        scene_.skipped_primitives += model.skipped_primitives;
        for (LeftOut& part : model.left_out) {
            if (std::find(scene_.left_out.begin(), scene_.left_out.end(), part) == scene_.left_out.end()) {
                scene_.left_out.push_back(std::move(part));  // once, though a file may be read in several ways
            }
        }
        return loaded;
    }

    void place(const ObjectDescription& object, const LoadedModel& model) {
        std::vector<std::uint32_t> materials(model.material_count);
        if (object.material.empty()) {
            std::iota(materials.begin(), materials.end(), model.first_material);
        } else {
            const auto it = std::find_if(from_.materials.begin(), from_.materials.end(),
                                         [&](const Material& m) { return m.name == object.material; });
            std::fill(materials.begin(), materials.end(),
                      static_cast<std::uint32_t>(it - from_.materials.begin()));
        }
        for (std::size_t i = 0; i < object.instances.size(); ++i) {
            for (const ModelObject& part : model.objects) {
                SceneObject placed;
                placed.name = name_of(object, part, i);
                placed.mesh = model.first_mesh + part.mesh;
                placed.to_world = object.to_world * object.instances[i] * part.to_world;
                placed.materials = materials;
                if (!is_finite(placed.to_world)) {
                    throw InputError(object.where, "object '" + placed.name +
                                                       "' has a transform that is not finite or far too large");
                }
                scene_.objects.push_back(std::move(placed));
            }
        }
    }

    static std::string name_of(const ObjectDescription& object, const ModelObject& part,
                               std::size_t instance) {
        std::string name = object.name;
        if (!object.file.empty() && !part.name.empty()) name += (name.empty() ? "" : "/") + part.name;
        if (object.instances.size() > 1) name += "#" + std::to_string(instance + 1);
        return name;
    }

    SceneDescription from_;
    int threads_;
    Scene scene_;
    std::map<std::tuple<std::string, int, SubdivisionScheme>, LoadedModel> files_;
    std::vector<LoadedModel> shapes_;
    std::vector<CameraSettings> file_cameras_;
};

}  // namespace

Scene load_scene(SceneDescription description, int threads) {
    return SceneLoader(std::move(description), threads).load();
}

bool is_named(const SceneObject& object, const std::string& name) {
    const std::string& own = object.name;
    return own.starts_with(name) &&
           (own.size() == name.size() || own[name.size()] == '/' || own[name.size()] == '#');
}

bool has_transparent_surfaces(const Scene& scene) {
    return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const SceneObject& object) {
        return std::any_of(object.materials.begin(), object.materials.end(),
                           [&](std::uint32_t m) { return scene.materials[m].opacity < 1; });
    });
}

PointSource scene_points(const Scene& scene) {
    // Of each mesh, once they are needed: a camera's fit runs twice over all points.
    const auto boxes = std::make_shared<std::vector<std::vector<Box>>>(scene.meshes.size());
    return [&scene, boxes](const PointVisitor& visit) {
        std::array<glm::dvec3, kPointBlock> some;
        const auto visit_all = [&](const Mesh& mesh, const Box* box, const auto& place) {
            for (std::size_t first = 0; first < mesh.positions.size(); first += kPointBlock) {
                if (box != nullptr && !visit.needs(*box++)) continue;
                const std::size_t count = std::min(kPointBlock, mesh.positions.size() - first);
                for (std::size_t i = 0; i < count; ++i) some[i] = place(mesh.position(static_cast<std::uint32_t>(first + i)));
                visit(std::span(some).first(count));
            }
        };
        for (const SceneObject& object : scene.objects) {
            const Mesh& mesh = scene.meshes[object.mesh];
            const glm::dmat4 to_world = object.to_world;
            if (to_world == glm::dmat4(1.0)) {
                std::vector<Box>& of_mesh = (*boxes)[object.mesh];
                if (of_mesh.empty()) of_mesh = block_boxes(mesh);
                visit_all(mesh, of_mesh.data(), [](const glm::dvec3& p) { return p; });
            } else {
                visit_all(mesh, nullptr, [&](const glm::dvec3& p) { return glm::dvec3(to_world * glm::dvec4(p, 1.0)); });
            }
        }
    };
}

}  // namespace burin
