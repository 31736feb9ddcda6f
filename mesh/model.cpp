#include "mesh/model.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <new>
#include <optional>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/lower_extension.h"
#include "base/mapped_file.h"
#include "mesh/deforming_mesh.h"
#include "mesh/gltf.h"
#include "mesh/model_player.h"
#include "mesh/model_source.h"
#include "mesh/readers.h"
#include "mesh/self_crossings.h"

namespace burin {
namespace {

/// build_meshes, with the file in the message of an error.
std::vector<Mesh> build_meshes_of(const std::string& path, PolygonSoup soup, const MeshOptions& options) {
    try {
        return build_meshes(std::move(soup), options);
    } catch (const InputError& error) {
        throw InputError(path + ": " + error.what());
    }
}

/// The same of a mesh that deforms.
DeformingMesh deforming_mesh_of(const std::string& path, PolygonSoup soup, const GltfMover& mover,
                                const MeshOptions& options) {
    try {
        return DeformingMesh(std::move(soup), mover.deformation.kinds(), options);
    } catch (const InputError& error) {
        throw InputError(path + ": " + error.what());
    }
}

void add_notes(const std::string& path, const std::vector<std::string>& notes, Model& model) {
    for (const std::string& note : notes) model.notes.push_back(path + ": " + note);
}

void note_subdivision(bool has_attributes, const MeshOptions& options, std::vector<std::string>& notes) {
    if (has_attributes && options.subdivision_levels > 0)
        notes.push_back("what the file gives at vertices (u, v, colours, attributes) is lost where it is subdivided");
}

Model model_of(const std::string& path, PolygonSoup soup, const MeshOptions& options) {
    Model model;
    list_rows(soup.corners, soup.attributes);
    note_subdivision(!soup.attributes.empty(), options, soup.notes);
    model.attribute_names = std::move(soup.attribute_names);
    // A control mesh is what its file says, or none at all.
    if (options.subdivision_levels == 0) cut_at_self_crossings(path, soup);
    model.materials = std::move(soup.materials);
    model.non_finite_polygons = soup.non_finite_polygons;
    add_notes(path, soup.notes, model);
    model.meshes = build_meshes_of(path, std::move(soup), options);
    for (std::uint32_t i = 0; i < model.meshes.size(); ++i) {
        model.objects.push_back({model.meshes[i].name, i, glm::dmat4(1.0)});
    }
    return model;
}

Model model_of(const std::string& path, GltfScene scene, const MeshOptions& options) {
    Model model;
    constexpr std::uint32_t kNoMesh = 0xFFFFFFFFu;
    std::vector<std::uint32_t> mesh_number(scene.meshes.size(), kNoMesh);
    const auto add_name = [&model](std::string name) {
        auto& names = model.attribute_names;
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
    };
    bool has_attributes = false;
    for (PolygonSoup& soup : scene.meshes) {
        has_attributes = has_attributes || !soup.attributes.empty();
        for (std::string& name : soup.attribute_names) add_name(std::move(name));
        for (const std::string& note : soup.notes) {
            if (std::find(scene.notes.begin(), scene.notes.end(), note) == scene.notes.end())
                scene.notes.push_back(note);
        }
    }
    note_subdivision(has_attributes, options, scene.notes);
    std::map<std::size_t, GltfMover*> movers;
    if (scene.motion) {
        for (auto& [mesh, mover] : scene.motion->movers) movers[mesh] = &mover;
    }
    std::vector<ModelPlayer::Part> parts;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const auto number = static_cast<std::uint32_t>(model.meshes.size());
        if (const auto mover = movers.find(i); mover != movers.end()) {
            DeformingMesh surface = deforming_mesh_of(path, std::move(scene.meshes[i]), *mover->second, options);
            std::optional<Mesh> rest = surface.take_rest();
            if (!rest) continue;
            model.meshes.push_back(*std::move(rest));
            parts.push_back({number, std::move(surface), std::move(*mover->second)});
        } else {
            std::vector<Mesh> built = build_meshes_of(path, std::move(scene.meshes[i]), options);
            if (built.empty()) continue;
            model.meshes.push_back(std::move(built.front()));
        }
        mesh_number[i] = number;
    }
    std::vector<RiggedObject> rigged;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        GltfObject& object = scene.objects[i];
        const std::uint32_t mesh = mesh_number[object.mesh];
        if (mesh == kNoMesh) continue;
        model.objects.push_back({std::move(object.name), mesh, object.to_world});
        if (scene.motion) rigged.push_back(scene.motion->objects[i]);
    }
    if (scene.motion) {
        model.player = std::make_shared<const ModelPlayer>(std::move(scene.motion->rig), std::move(rigged),
                                                           std::move(scene.motion->cameras), std::move(parts));
    }
    model.animations = std::move(scene.animations);
    for (GltfCamera& c : scene.cameras) {
        model.cameras.push_back({std::move(c.name), c.orthographic, c.fov_deg, c.height, c.to_world});
    }
    model.materials = std::move(scene.materials);
    model.skipped_primitives = scene.skipped_primitives;
    model.other_files = {std::move(scene.buffer_files), std::move(scene.picture_files)};
    add_notes(path, scene.notes, model);
    return model;
}

ModelSource read_by_extension(const std::string& path, const MeshOptions& options, const AnimationWish& animations) {
    const std::string extension = lower_extension(path);
    ModelSource source{path, PolygonSoup(), {}};
    if (extension == ".obj") {
        PolygonSoup soup = read_obj(path, options.threads, &source.other_files, options.attributes);
        if (options.strict && !soup.notes.empty()) {
            throw InputError(path + ": " + soup.notes.front() + "; re-export the model, or leave out --strict");
        }
        source.content = std::move(soup);
    } else if (extension == ".ply") {
        source.content = read_ply(path, options.threads, options.strict, options.attributes);
    } else if (extension == ".stl") {
        source.content = read_stl(path, options.strict);
    } else if (extension == ".off") {
        source.content = read_off(path, options.strict);
    } else if (extension == ".gltf" || extension == ".glb") {
        ModelBudget by_default;
        source.content = read_gltf(path, options.budget != nullptr ? *options.budget : by_default, options.strict,
                                   options.attributes, animations);
    } else {
        throw InputError(path + ": unknown kind of model '" + extension + "'; burin reads " + kModelExtensions);
    }
    return source;
}

/// Calls work(). What is wrong may be the zeros where the file ends now: then that is said.
template <typename Work>
auto while_whole(const std::string& path, const Work& work) {
    const FileLength given(path);
    try {
        auto result = work();
        given.check();
        return result;
    } catch (const InputError&) {
        given.check();
        throw;
    }
}

}  // namespace

bool is_model_file(const std::string& path) {
    const std::string extension = lower_extension(path);
    std::istringstream known(kModelExtensions);
    return std::find(std::istream_iterator<std::string>(known), {}, extension) != std::istream_iterator<std::string>();
}

ModelSource read_model_source(const std::string& path, const MeshOptions& options, const AnimationWish& animations) {
    return while_whole(path, [&] { return read_by_extension(path, options, animations); });
}

Model make_model(ModelSource source, const MeshOptions& options) {
    const std::string path = source.path;
    Model model =
        std::visit([&](auto& content) { return model_of(path, std::move(content), options); }, source.content);
    if (!source.other_files.read.empty()) model.other_files = std::move(source.other_files);
    const bool has_any = std::any_of(model.objects.begin(), model.objects.end(), [&](const auto& o) {
        const Mesh& mesh = model.meshes[o.mesh];
        return !mesh.triangles.empty() || !mesh.loose_edges.empty();
    });
    if (!has_any) {
        throw InputError(path + ": no polygon with an area is in it; burin draws the lines of surfaces");
    }
    return model;
}

Model read_model(const std::string& path, const MeshOptions& options, const AnimationWish& animations) {
    return while_whole(path, [&] { return make_model(read_by_extension(path, options, animations), options); });
}

}  // namespace burin
