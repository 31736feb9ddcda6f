#include "scene/animation/model_sequence.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "base/error.h"
#include "base/lower_extension.h"
#include "mesh/text_scan.h"
#include "scene/animation/frame_list.h"

namespace burin {
namespace {

/// Gives each object a mesh of its own.
void share_no_meshes(Model& model) {
    std::vector<Mesh> meshes;
    for (ModelObject& object : model.objects) {
        meshes.push_back(model.meshes[object.mesh]);
        object.mesh = static_cast<std::uint32_t>(meshes.size() - 1);
    }
    model.meshes = std::move(meshes);
}

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// For each name its place among others: of the same name, in order; then of those left over, in order. kNone: there
/// are too few.
std::vector<std::size_t> places_by_name(const std::vector<std::string>& names, const std::vector<std::string>& others) {
    std::vector<std::size_t> places(names.size(), kNone);
    std::vector<bool> is_taken(others.size(), false);
    std::vector<std::pair<std::string, std::size_t>> sorted;
    for (std::size_t i = 0; i < others.size(); ++i) sorted.emplace_back(others[i], i);
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::pair<std::string, std::size_t>> wanted;
    for (std::size_t i = 0; i < names.size(); ++i) wanted.emplace_back(names[i], i);
    std::sort(wanted.begin(), wanted.end());
    auto other = sorted.begin();
    for (const auto& [name, i] : wanted) {
        while (other != sorted.end() && other->first < name) ++other;
        if (other == sorted.end() || other->first != name) continue;
        places[i] = other->second;
        is_taken[other->second] = true;
        ++other;
    }
    std::size_t next = 0;
    for (std::size_t& place : places) {
        if (place != kNone) continue;
        while (next < others.size() && is_taken[next]) ++next;
        if (next < others.size()) place = next++;
    }
    return places;
}

void renumber_materials(const std::vector<std::uint32_t>& numbers, Mesh& mesh) {
    if (mesh.polygon_material.empty() && !numbers.empty() && numbers[0] != 0)
        mesh.polygon_material.assign(mesh.polygon_count, 0);
    for (std::uint32_t& material : mesh.polygon_material) material = numbers[material];
}

template <typename T>
std::vector<std::string> names_of(const std::vector<T>& things) {
    std::vector<std::string> names;
    for (const T& thing : things) names.push_back(thing.name);
    return names;
}

}  // namespace

ModelSequence::ModelSequence(SequenceSettings settings) : settings_(std::move(settings)) {
    settings_.options.budget = nullptr;  // it counts for the loader, each file for itself
}

Model ModelSequence::load(double frame) {
    std::vector<std::string> notes;
    Model model = model_at(frame, notes);
    share_no_meshes(model);
    object_names_ = names_of(model.objects);
    material_names_ = names_of(model.materials);
    return model;
}

ModelMotion::Pose ModelSequence::at(double frame) const {
    Pose pose;
    Model model = model_at(frame, pose.notes);
    for (const std::string& note : model.notes) pose.notes.push_back(note);
    const std::string file = files_of(frame).file;
    const std::vector<std::uint32_t> materials = materials_for(model, file, pose.notes);
    const std::vector<std::size_t> places = places_by_name(object_names_, names_of(model.objects));
    std::vector<bool> is_shown(model.objects.size(), false);
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        Mesh mesh;
        glm::dmat4 to_model(1.0);
        if (places[i] != kNone) {
            const ModelObject& object = model.objects[places[i]];
            is_shown[places[i]] = true;
            to_model = object.to_world;
            mesh = model.meshes[object.mesh];  // objects may share it
            renumber_materials(materials, mesh);
        }
        mesh.name = object_names_[i];
        pose.parts.push_back(to_model);
        pose.meshes.emplace_back(i, std::move(mesh));
    }
    if (const auto left_out = std::count(is_shown.begin(), is_shown.end(), false); left_out > 0) {
        pose.notes.push_back(file + ": left out " + std::to_string(left_out) +
                             (left_out == 1 ? " object" : " objects") + ", which the first file of the frames has not");
    }
    return pose;
}

std::vector<std::string> ModelSequence::files_at(double frame) const {
    const Shown shown = files_of(frame);
    std::vector<std::string> files{shown.file};
    if (!shown.later.empty()) files.push_back(shown.later);
    const std::size_t count = files.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (lower_extension(files[i]) != ".gltf") continue;
        const Source source = read(files[i]);
        const std::vector<std::string>& buffers = std::get<GltfScene>(source->content).buffer_files;
        files.insert(files.end(), buffers.begin(), buffers.end());
    }
    return files;
}

double ModelSequence::first_frame() const {
    const std::vector<double> all = numbers();
    if (!all.empty()) return all.front() - settings_.frame_offset;
    throw InputError(settings_.pattern.path_of(1) + ": no such file, and none of another frame");
}

/// The numbers of all files, in ascending order.
std::vector<double> ModelSequence::numbers() const {
    namespace fs = std::filesystem;
    const fs::path example(settings_.pattern.path_of(0));
    const fs::path folder = example.has_parent_path() ? example.parent_path() : ".";
    std::vector<double> found;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        if (const auto number = settings_.pattern.number_in(it->path().filename().string())) found.push_back(*number);
    }
    std::sort(found.begin(), found.end());
    return found;
}

bool ModelSequence::has_file(double number) const {
    std::error_code error;
    return std::filesystem::exists(settings_.pattern.path_of(number), error);
}

/// Whether a number lies before the first file or behind the last one.
bool ModelSequence::is_beyond_all(double number) const {
    const std::vector<double> all = numbers();
    return all.empty() || number < all.front() || number > all.back();
}

/// The file of a number that is whole.
std::string ModelSequence::file_for(double frame, double number) const {
    const std::string path = settings_.pattern.path_of(number);
    if (has_file(number)) return path;
    const std::string of_frame =
        "frame " + text_of_frame(frame) + " of object \"" + printable(settings_.object, 200) + "\"";
    if (!settings_.holds_missing) throw InputError(path + ": no such file (" + of_frame + ")");
    const std::vector<double> all = numbers();
    if (all.empty()) throw InputError(path + ": no such file (" + of_frame + "), and none of another frame");
    const auto later = std::upper_bound(all.begin(), all.end(), number);
    return settings_.pattern.path_of(later == all.begin() ? all.front() : *(later - 1));
}

ModelSequence::Shown ModelSequence::files_of(double frame) const {
    const double number = frame + settings_.frame_offset, whole = std::floor(number), nearest = std::round(number);
    if (nearest == number) return {file_for(frame, number), {}, 0};
    // A shutter that is open before the first file, or behind the last one, sees that file.
    const double other = nearest == whole ? whole + 1 : whole;
    const std::string file = file_for(frame, nearest);
    if (!settings_.holds_missing && !has_file(other))
        return {file, {}, 0, is_beyond_all(other) ? std::nullopt : std::optional(other)};
    Shown shown{file_for(frame, whole), {}, number - whole};
    shown.later = file_for(frame, whole + 1);
    if (shown.later == shown.file) shown.later.clear();
    return shown;
}

ModelSequence::Source ModelSequence::read(const std::string& path) const {
    constexpr std::size_t kMostKept = 2;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [known, source] : read_) {
            if (known == path) return source;
        }
    }
    ModelBudget budget(settings_.budget_bytes);
    MeshOptions options = settings_.options;
    options.budget = &budget;
    auto source = std::make_shared<const ModelSource>(read_model_source(path, options));
    const std::lock_guard lock(mutex_);
    read_.emplace_back(path, source);
    if (read_.size() > kMostKept) read_.erase(read_.begin());
    return source;
}

Model ModelSequence::model_at(double frame, std::vector<std::string>& notes) const {
    const Shown shown = files_of(frame);
    const Source source = read(shown.file);
    if (shown.missing) {
        notes.push_back(settings_.pattern.path_of(*shown.missing) +
                        ": no such file; at moments beside it the nearer file is held");
    }
    std::optional<ModelSource> model;
    if (!shown.later.empty()) {
        model = between(*source, *read(shown.later), shown.part);
        if (!model) {
            notes.push_back(shown.later + ": other polygons than in the file before; between both, that one is held");
        }
    }
    ModelBudget budget(settings_.budget_bytes);
    MeshOptions options = settings_.options;
    options.budget = &budget;
    return make_model(model ? *std::move(model) : *source, options);
}

/// For each material of a model the number of the first file's that stands for it.
std::vector<std::uint32_t> ModelSequence::materials_for(const Model& model, const std::string& file,
                                                        std::vector<std::string>& notes) const {
    const std::vector<std::size_t> places = places_by_name(names_of(model.materials), material_names_);
    std::vector<std::uint32_t> numbers;
    std::size_t without = 0;
    for (const std::size_t place : places) {
        without += place == kNone;
        numbers.push_back(place == kNone ? 0 : static_cast<std::uint32_t>(place));
    }
    if (without > 0) {
        notes.push_back(file + ": " + std::to_string(without) + (without == 1 ? " material" : " materials") +
                        ", which the first file of the frames has not, drawn as that file's first one");
    }
    return numbers;
}

}  // namespace burin
