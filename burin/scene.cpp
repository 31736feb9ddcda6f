#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <utility>

#include "base/instruction_set.h"
#include "base/lower_extension.h"
#include "burin/failure.h"
#include "burin/mesh_input.h"
#include "burin/scene_state.h"
#include "mesh/build_meshes.h"
#include "mesh/model.h"
#include "mesh/text_scan.h"
#include "scene/animation/frame_pattern.h"

namespace burin {
namespace {

constexpr double kLargestNumber = 1e30;  // as in scene files
constexpr const char* kShownAtRest =
    "the scene moves, and the library shows it at rest in this version; `burin render --frames` draws its frames";

int next_number(int& last) {
    if (last == std::numeric_limits<int>::max()) throw InputError("a scene gives 2147483647 numbers; use a new one");
    return ++last;
}

ObjectState& object_of(burin_scene& scene, int number) {
    const auto found = scene.objects.find(number);
    if (found == scene.objects.end()) throw UsageError("there is no object " + std::to_string(number));
    return found->second;
}

/// Puts a loaded scene beside what is there. Returns the number of its first object.
int adopt(burin_scene& scene, Scene loaded, SceneSettings settings, bool moves) {
    std::map<int, ObjectState> objects;
    const auto group = std::make_shared<MeshGroup>();
    group->meshes = std::move(loaded.meshes);
    int last_object = scene.last_object;
    const auto first_material = static_cast<std::uint32_t>(scene.materials.size());
    std::map<const std::uint32_t*, MaterialList> moved_lists;  // objects share them
    const auto moved = [&](const MaterialList& list) {
        const auto [at, is_new] = moved_lists.try_emplace(list.address());
        if (is_new) {
            std::vector<std::uint32_t> materials;
            list.for_each([&](std::uint32_t m) { materials.push_back(first_material + m); });
            const bool are_alike = materials.size() < list.size();
            at->second = are_alike ? MaterialList::all_alike(list.size(), materials.front()) : MaterialList(materials);
        }
        return at->second;
    };
    const int first_object = next_number(last_object);
    for (std::size_t i = 0; i < loaded.objects.size(); ++i) {
        SceneObject& object = loaded.objects[i];
        const int number = i == 0 ? first_object : next_number(last_object);
        ObjectPart part{object.name, group, object.mesh, object.to_world,
                        first_material == 0 ? object.materials : moved(object.materials)};
        ObjectState& state = objects[number];
        state.name = std::move(object.name);
        state.parts.push_back(std::move(part));
    }
    std::vector<Material> materials = scene.materials;
    materials.insert(materials.end(), loaded.materials.begin(), loaded.materials.end());
    std::vector<CameraSettings> cameras = scene.file_cameras;
    if (!loaded.camera_is_default && settings.description().cameras.empty()) {
        cameras.insert(cameras.end(), loaded.cameras.begin(), loaded.cameras.end());
    }
    std::vector<std::string> notes = scene.notes;
    notes.insert(notes.end(), loaded.notes.begin(), loaded.notes.end());
    // Nothing fails from here on.
    scene.settings = std::move(settings);
    scene.materials.swap(materials);
    scene.file_cameras.swap(cameras);
    scene.notes.swap(notes);
    scene.objects.merge(objects);
    scene.last_object = last_object;
    scene.moves = scene.moves || moves;
    ++scene.revision;
    return first_object;
}

bool is_model_per_frame(const ObjectDescription& object) {
    std::error_code error;
    return !object.file.empty() && !std::filesystem::exists(object.file, error) &&
           FramePattern::find(object.file, FramePattern::SingleHash::letter).has_value();
}

/// The files that are shown as they stand, whatever animations they have.
std::set<std::string> files_at_rest(const SceneDescription& description) {
    std::set<std::string> at_rest, moving;
    for (const ObjectDescription& object : description.objects)
        (object.animation.by == AnimationChoice::By::none ? at_rest : moving).insert(object.file);
    for (const std::string& file : moving) at_rest.erase(file);
    return at_rest;
}

int load_description(burin_scene& scene, SceneDescription description, SceneSettings settings) {
    LoadOptions options{.threads = 0, .keeps_attributes = true};
    // Whether it moves is told, for it is shown at rest; a model per frame cannot be.
    options.lists_animations = std::none_of(description.objects.begin(), description.objects.end(), is_model_per_frame);
    const std::set<std::string> at_rest = files_at_rest(description);
    const bool turns = description.turntable.has_value();
    AnimatedScene loaded = load_animated_scene(std::move(description), options);
    const auto& files = loaded.animation.file_animations;
    const bool moves =
        turns || loaded.animation.moves() ||
        std::any_of(files.begin(), files.end(), [&](const AnimationsOfFile& f) { return !at_rest.contains(f.file); });
    if (moves) loaded.scene.notes.emplace_back(kShownAtRest);
    return adopt(scene, std::move(loaded.scene), std::move(settings), moves);
}

}  // namespace

bool is_unset(const double* numbers) {
    return std::all_of(numbers, numbers + 16, [](double n) { return n == 0; });
}

glm::dmat4 object_matrix(const double* numbers, const char* name) {
    if (is_unset(numbers)) return glm::dmat4(1.0);
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i) {
        if (!(std::abs(numbers[i]) <= kLargestNumber)) {
            throw UsageError(std::string(name) + ": number " + std::to_string(i) + " is not finite or beyond 1e30");
        }
        matrix[i % 4][i / 4] = numbers[i];
    }
    if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1) {
        throw UsageError(std::string(name) + ": the last row must be 0 0 0 1; matrices are given row by row");
    }
    if (glm::determinant(glm::dmat3(matrix)) == 0) {
        throw UsageError(std::string(name) + ": makes everything flat; its determinant must not be 0");
    }
    return matrix;
}

}  // namespace burin

using namespace burin;

burin_scene* burin_scene_new(void) {
    return guarded_pointer([] {
        check_instruction_set();
        return new burin_scene;
    });
}
void burin_scene_free(burin_scene* scene) { delete scene; }

int burin_load(burin_scene* scene, const char* path) {
    return guarded([&] {
        StoppableCall call(required(scene, "scene"));
        const std::string file = &required(path, "path");
        SceneSettings settings = scene->settings;
        if (lower_extension(file) == ".toml") {
            SceneDescription description = settings.take_scene_file(file);
            return load_description(*scene, std::move(description), std::move(settings));
        }
        if (is_model_file(file)) return load_description(*scene, bare_model_scene(file, {}), std::move(settings));
        throw InputError(file + ": unknown kind of input; burin reads .toml scenes and " + kModelExtensions +
                         " models");
    });
}

int burin_load_text(burin_scene* scene, const char* toml, const char* base_folder) {
    return guarded([&] {
        StoppableCall call(required(scene, "scene"));
        SceneSettings settings = scene->settings;
        SceneDescription description =
            settings.take_scene(&required(toml, "toml"), "scene", text_or_empty(base_folder));
        return load_description(*scene, std::move(description), std::move(settings));
    });
}

const char* burin_note(const burin_scene* scene, int index) {
    return guarded_pointer([&]() -> const char* { return note_at(required(scene, "scene").notes, index); });
}

int burin_add_material(burin_scene* scene, const burin_material* material) {
    return guarded([&] {
        required(scene, "scene");
        const burin_material given = read_struct(material, "material");
        const float numbers[] = {given.color[0], given.color[1], given.color[2], given.opacity};
        for (const float number : numbers) {
            if (!(number >= 0 && number <= 1)) throw UsageError("material: colors and opacity must be from 0 to 1");
        }
        if (scene->materials.size() >= std::size_t{std::numeric_limits<int>::max()})
            throw InputError("too many materials");
        scene->materials.push_back(
            {text_or_empty(given.name), {given.color[0], given.color[1], given.color[2]}, given.opacity});
        ++scene->revision;
        return static_cast<int>(scene->materials.size());
    });
}

int burin_add_mesh(burin_scene* scene, const burin_mesh* mesh) {
    return guarded([&] {
        StoppableCall call(required(scene, "scene"));
        const burin_mesh given = read_struct(mesh, "mesh");
        const auto material_count = static_cast<std::uint32_t>(scene->materials.size());
        const std::uint32_t default_material =
            scene->default_material == 0 ? material_count : scene->default_material - 1;
        MeshInput input = checked_mesh(given, material_count, default_material);
        const auto group = std::make_shared<MeshGroup>();
        group->name = text_or_empty(given.name);
        group->has_parts = given.polygon_objects != nullptr;
        group->materials = input.materials;
        group->meshes = build_meshes(std::move(input.soup), {});
        int last = scene->last_mesh;
        scene->meshes.emplace(next_number(last), group);
        if (input.needs_default_material && scene->default_material == 0) {
            try {
                scene->materials.emplace_back();
            } catch (...) {
                scene->meshes.erase(last);
                throw;
            }
            scene->default_material = static_cast<std::uint32_t>(scene->materials.size());
        }
        return scene->last_mesh = last;
    });
}

int burin_remove_mesh(burin_scene* scene, int mesh) {
    return guarded([&] {
        if (required(scene, "scene").meshes.erase(mesh) == 0)
            throw UsageError("there is no mesh " + std::to_string(mesh));
        return int{BURIN_DONE};
    });
}

int burin_add_object(burin_scene* scene, const burin_object* object) {
    return guarded([&] {
        required(scene, "scene");
        const burin_object given = read_struct(object, "object");
        const auto found = scene->meshes.find(given.mesh);
        if (found == scene->meshes.end()) {
            throw UsageError("object: there is no mesh " + std::to_string(given.mesh) + "; burin_add_mesh() adds one");
        }
        if (given.material < 0 || static_cast<std::size_t>(given.material) > scene->materials.size()) {
            throw UsageError("object: there is no material " + std::to_string(given.material));
        }
        const std::shared_ptr<MeshGroup>& group = found->second;
        const glm::dmat4 to_world = object_matrix(given.to_world, "object.to_world");
        MaterialList materials = group->materials;
        if (given.material > 0) {
            materials = MaterialList::all_alike(materials.size(), static_cast<std::uint32_t>(given.material - 1));
        }
        ObjectState state;
        state.name = given.name != nullptr ? given.name : group->name;
        for (std::size_t i = 0; i < group->meshes.size(); ++i) {
            std::string name = state.name;
            const std::string& part = group->meshes[i].name;
            if (group->has_parts && !part.empty()) name += (name.empty() ? "" : "/") + part;
            state.parts.push_back({std::move(name), group, i, to_world, materials});
        }
        int last = scene->last_object;
        scene->objects.emplace(next_number(last), std::move(state));
        ++scene->revision;
        return scene->last_object = last;
    });
}

int burin_move_object(burin_scene* scene, int object, const double to_world[16]) {
    return guarded([&] {
        ObjectState& state = object_of(required(scene, "scene"), object);
        const glm::dmat4 matrix = object_matrix(&required(to_world, "to_world"), "to_world");
        for (ObjectPart& part : state.parts) part.to_world = matrix;
        ++scene->placement;
        return int{BURIN_DONE};
    });
}

int burin_remove_object(burin_scene* scene, int object) {
    return guarded([&] {
        object_of(required(scene, "scene"), object);
        scene->objects.erase(object);
        ++scene->revision;
        return int{BURIN_DONE};
    });
}

int burin_clear_objects(burin_scene* scene) {
    return guarded([&] {
        required(scene, "scene").objects.clear();
        scene->moves = false;
        ++scene->revision;
        return int{BURIN_DONE};
    });
}

int burin_scene_box(const burin_scene* scene, double low[3], double high[3]) {
    return guarded([&] {
        glm::dvec3 least(std::numeric_limits<double>::infinity()), most(-least);
        for (const auto& [number, object] : required(scene, "scene").objects) {
            for (const ObjectPart& part : object.parts) {
                const Mesh& mesh = part.group->meshes[part.mesh];
                for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
                    const glm::dvec3 place(part.to_world * glm::dvec4(mesh.position(v), 1));
                    least = glm::min(least, place);
                    most = glm::max(most, place);
                }
            }
        }
        if (!(least.x <= most.x)) throw InputError("the scene has no points");
        required(low, "low");
        required(high, "high");
        for (int i = 0; i < 3; ++i) {
            low[i] = least[i];
            high[i] = most[i];
        }
        return int{BURIN_DONE};
    });
}

int burin_object_of_id(const burin_scene* scene, uint32_t id) {
    return guarded([&] {
        std::uint64_t last = 0;
        for (const auto& [number, object] : required(scene, "scene").objects) {
            last += object.parts.size();
            if (id >= 1 && id <= last) return number;
        }
        throw UsageError("no object has the id " + std::to_string(id));
    });
}

const char* burin_object_name(const burin_scene* scene, int object) {
    return guarded_pointer([&]() -> const char* {
        const auto& objects = required(scene, "scene").objects;
        const auto found = objects.find(object);
        if (found == objects.end()) throw UsageError("there is no object " + std::to_string(object));
        return found->second.name.c_str();
    });
}

int burin_set(burin_scene* scene, const char* key_and_value) {
    return guarded([&] {
        required(scene, "scene");
        const std::string text = &required(key_and_value, "key_and_value");
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos) {
            throw UsageError("'" + printable(text) + "' must be KEY=VALUE, such as lines.width=2");
        }
        scene->settings.set({text.substr(0, equals), text.substr(equals + 1), Override::From::call});
        ++scene->revision;
        return int{BURIN_DONE};
    });
}

int burin_set_style(burin_scene* scene, const char* text_or_name) {
    return guarded([&] {
        required(scene, "scene").settings.set_style(text_or_empty(text_or_name));
        ++scene->revision;
        return int{BURIN_DONE};
    });
}

int burin_set_toml(burin_scene* scene, const char* toml) {
    return guarded([&] {
        required(scene, "scene").settings.set_tables(&required(toml, "toml"), "settings");
        ++scene->revision;
        return int{BURIN_DONE};
    });
}
