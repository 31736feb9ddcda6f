#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/interrupt.h"
#include "mesh/model.h"
#include "mesh/text_scan.h"
#include "scene/animation/frame_list.h"
#include "scene/animation/model_sequence.h"
#include "scene/animation/placeable.h"
#include "scene/animation/played_model.h"
#include "scene/missing_attributes.h"
#include "scene/object_names.h"
#include "scene/scene_description.h"
#include "shading/sheet/sheet_attributes.h"
#include "shading/surface/surface_recipe.h"

namespace burin {
namespace {

/// A model as it arrived in the scene: where its meshes start, and the scene's materials for its own.
struct LoadedModel {
    std::vector<ModelObject> objects;
    std::uint32_t first_mesh = 0;
    MaterialList materials;
    std::uint64_t polygons = 0;                  // of all objects
    std::uint64_t name_bytes = 0;                // of all objects
    std::size_t motion = SceneAnimation::kNone;  // number among the animation's models
};

class SceneLoader {
  public:
    SceneLoader(SceneDescription description, const LoadOptions& options, std::vector<std::string>* files)
        : from_(std::move(description)),
          threads_(options.threads),
          strict_(options.strict),
          budget_(options.budget),
          first_frame_(options.first_frame),
          frames_instead_(options.frames_instead),
          lists_animations_(options.lists_animations),
          files_read_(files) {
        scene_.materials = from_.materials;
        scene_.cameras = from_.cameras;
        scene_.picture = from_.picture;
        scene_.frame = from_.frame;
        scene_.crypto = from_.crypto;
        scene_.deep = from_.deep;
        scene_.shutter = from_.shutter;
        scene_.lines = from_.lines;
        scene_.sheet = from_.sheet;
        scene_.surfaces = from_.surfaces;
        scene_.lights = from_.lights;
        scene_.abuffer = from_.abuffer;
        scene_.patel = from_.patel;
        scene_.reference = from_.reference;
        scene_.gbuffer = from_.gbuffer;
        scene_.zbuffer = from_.zbuffer;
        scene_.wire = from_.wire;
        may_move_ = std::any_of(from_.objects.begin(), from_.objects.end(), [&](const ObjectDescription& object) {
            return !object.keys.empty() || (first_frame_ && !object.file.empty());
        });
        if (first_frame_ && !from_.frame_range.empty()) first_frame_ = from_.frame_range.front();
        if (from_.sheet) attribute_readers_.sheet = attributes_named_in(*from_.sheet);
        kept_attributes_ = options.keeps_attributes ? AttributeWish::all() : attribute_readers_.sheet;
        if (from_.surfaces.recipe) {
            add_attributes_named_in(*from_.surfaces.recipe, attribute_readers_.surfaces);
            add_attributes_named_in(*from_.surfaces.recipe, kept_attributes_);
        }
        for (std::uint32_t i = 0; i < from_.materials.size(); ++i)
            material_numbers_.emplace(from_.materials[i].name, i);
    }

    AnimatedScene load() {
        count_shapes();
        for (const ObjectDescription& object : from_.objects) {
            throw_if_interrupted();
            if (!object.file.empty()) at_place_of(object, [&] { model_of(object); });
        }
        count_models();
        for (const ObjectDescription& object : from_.objects) {
            throw_if_interrupted();
            at_place_of(object, [&] {
                if (object.file.empty()) {
                    count_polygons(object, polygons_of_shape(object).polygons);
                    place(object, make_shape(object));
                } else {
                    LoadedModel& model = model_of(object);
                    count_polygons(object, model.polygons);
                    place(object, model);
                }
            });
        }
        tell_cameras();
        scene_.camera_is_default = scene_.cameras.empty();
        if (scene_.cameras.empty()) scene_.cameras.emplace_back();
        check_highlights();
        draw_lines_without_polygons(scene_);
        for (std::string& note : notes_on_missing_attributes(scene_, attribute_readers_, attribute_names_))
            scene_.notes.push_back(std::move(note));
        return {std::move(scene_), std::move(animation_), std::move(pictures_)};
    }

  private:
    void tell_cameras() {
        animation_.fps = from_.frame.fps;
        for (std::size_t i = 0; i < from_.camera_keys.size(); ++i)
            animation_.cameras.push_back({.rest = from_.cameras[i], .keys = from_.camera_keys[i]});
        if (!scene_.cameras.empty()) return;
        scene_.cameras = std::move(file_cameras_);
        animation_.cameras = std::move(moving_file_cameras_);
    }
    void check_highlights() const {
        const ObjectNames names(scene_.zbuffer.highlight_objects);
        std::set<std::string_view> found;
        for (const SceneObject& object : scene_.objects) {
            names.for_each_of(object.name, [&](const std::string& name) { found.insert(name); });
        }
        for (const std::string& name : scene_.zbuffer.highlight_objects) {
            if (!found.contains(name)) {
                throw InputError("[zbuffer] highlight: '" + printable(name) + "' is neither a line class (" +
                                 to_string(LineClassSet::all()) + ") nor an object");
            }
        }
    }

    /// What is wrong with a model of a scene file is told with the place that names it.
    template <typename Work>
    static void at_place_of(const ObjectDescription& object, const Work& work) {
        if (object.where.line == 0) return work();
        try {
            work();
        } catch (const FrameError&) {
            throw;
        } catch (const InputError& error) {
            throw InputError(object.where, error.what());
        }
    }

    /// Calls count(budget) for what it counts: first to foresee all of it, then for the budget of the scene.
    template <typename Count>
    void count_all(const Count& count) {
        ModelBudget all(UINT64_MAX);
        count(all);
        budget_.foresee(all.counted_bytes());
        count(budget_);
    }

    /// Counts what shapes take, before any file is read.
    void count_shapes() {
        count_all([&](ModelBudget& budget) {
            for (const ObjectDescription& object : from_.objects) {
                if (object.file.empty()) at_place_of(object, [&] { count_shape(budget, object); });
            }
        });
    }
    static PolygonCounts polygons_of_shape(const ObjectDescription& object) {
        const Shape& shape = object.shape;
        return count_subdivided({shape.polygons, shape.corners}, object.scheme, object.subdivide, shape.name);
    }
    static void count_shape(ModelBudget& budget, const ObjectDescription& object) {
        std::string settings = object.shape.settings;
        if (object.subdivide > 0)
            settings += (settings.empty() ? "" : ", ") + ("subdivide " + std::to_string(object.subdivide));
        count_mesh(budget, polygons_of_shape(object), quoted(object), settings);
        count_instances(budget, object, object.instances.size(), 1, 0);
    }

    /// Counts what instances of models take, before any is placed.
    void count_models() {
        count_all([&](ModelBudget& budget) {
            std::set<const LoadedModel*> shown;
            for (const ObjectDescription& object : from_.objects) {
                if (object.file.empty()) continue;
                at_place_of(object, [&] {
                    const LoadedModel& model = model_of(object);
                    // The file itself spells out what it takes to show it once.
                    const std::size_t more = object.instances.size() - (shown.insert(&model).second ? 1 : 0);
                    count_instances(budget, object, more, model.objects.size(), model.name_bytes);
                });
            }
        });
    }

    /// Counts what instances of an object take that has `parts` parts.
    static void count_instances(ModelBudget& budget, const ObjectDescription& object, std::uint64_t instances,
                                std::uint64_t parts, std::uint64_t name_bytes) {
        constexpr std::uint64_t kBytesPerPart = 600;  // here and in a frame; measured
        const std::uint64_t bytes = parts * (kBytesPerPart + object.name.size()) + name_bytes;
        budget.add(saturating_product(instances, bytes),
                   quoted(object) + " of " + std::to_string(object.instances.size()) + " instances with " +
                       std::to_string(parts) + (parts == 1 ? " part each" : " parts each"));
    }
    void count_polygons(const ObjectDescription& object, std::uint64_t polygons) {
        polygons_ += std::min(saturating_product(object.instances.size(), polygons), kMostPolygons + 1);
        if (polygons_ > kMostPolygons) throw InputError("the scene has more than 4 billion polygons; split it");
    }
    static std::string quoted(const ObjectDescription& object) {
        return "object '" + printable(object.name.empty() ? object.file : object.name, 200) + "'";
    }

    LoadedModel make_shape(const ObjectDescription& object) {
        PolygonSoup soup = object.shape.make();
        Model model;
        model.materials = std::move(soup.materials);
        model.meshes = build_meshes(std::move(soup), {.subdivision_levels = object.subdivide, .scheme = object.scheme});
        model.objects.push_back({object.name, 0, glm::dmat4(1.0)});
        return adopt(std::move(model));
    }

    LoadedModel& model_of(const ObjectDescription& object) {
        // Without subdivision the scheme changes nothing.
        const SubdivisionScheme scheme = object.subdivide > 0 ? object.scheme : SubdivisionScheme::automatic;
        const auto key = [&](const std::string& file) {
            // While nothing moves, what says how does not count.
            const AnimationChoice choice = first_frame_ ? object.animation : AnimationChoice();
            return std::tuple(file, object.subdivide, scheme, choice, object.frame_offset, object.holds_missing);
        };
        std::shared_ptr<LoadedModel>& as_written = files_[key(object.file)];
        if (as_written) return *as_written;
        std::shared_ptr<LoadedModel>& model = files_[key(spelled_one_way(object.file))];
        if (!model) model = std::make_shared<LoadedModel>(read(object, scheme));
        as_written = model;
        return *model;
    }

    /// A file that is named in several ways is read once.
    static std::string spelled_one_way(const std::string& file) {
        const std::filesystem::path path(file);
        std::error_code error;
        const std::filesystem::path folder =
            std::filesystem::canonical(path.has_parent_path() ? path.parent_path() : ".", error);
        return error ? file : (folder / path.filename()).string();
    }

    /// The pattern of a sequence's files; none: it is one file, whose name may look like a pattern.
    std::optional<FramePattern> pattern_of(const ObjectDescription& object) const {
        using Single = FramePattern::SingleHash;
        std::error_code error;
        if (std::filesystem::exists(object.file, error)) return std::nullopt;
        return FramePattern::find(object.file, first_frame_ ? Single::digits : Single::letter);
    }

    /// Reads the first file of a sequence, and tells its motion.
    Model load_sequence(const ObjectDescription& object, const FramePattern& pattern, const MeshOptions& options,
                        std::size_t& motion) {
        SequenceSettings settings{
            pattern,
            object.name.empty() ? std::filesystem::path(object.file).filename().string() : object.name,
            object.frame_offset,
            object.holds_missing,
            options,
            budget_.limit_bytes()};
        const auto sequence = std::make_shared<ModelSequence>(std::move(settings));
        if (!first_frame_ && !lists_animations_) {
            throw UsageError(object.file + ": is a model per frame; say which with --frames or [frames] range");
        }
        double frame = first_frame_ ? *first_frame_ : sequence->first_frame();
        Model model = load_first(*sequence, frame);
        if (first_frame_) motion = add_motion(sequence);
        if (files_read_ != nullptr) {
            for (std::string& file : sequence->files_at(frame)) files_read_->push_back(std::move(file));
        }
        return model;
    }

    /// `frame`: gets the one that is read instead, if there is.
    Model load_first(ModelSequence& sequence, double& frame) {
        try {
            return sequence.load(frame);
        } catch (const InputError& error) {
            if (!first_frame_) throw;
            const FrameError first(frame, error.what());
            for (const double other : frames_instead_) {
                if (other == frame) continue;
                throw_if_interrupted();
                try {
                    Model model = sequence.load(other);
                    scene_.notes.push_back(std::string(first.what()) + "; objects and materials are those of frame " +
                                           text_of_frame(other));
                    frame = other;
                    return model;
                } catch (const InputError&) {
                    continue;
                }
            }
            throw first;
        }
    }

    std::size_t add_motion(std::shared_ptr<const ModelMotion> motion) {
        animation_.models.push_back({std::move(motion), static_cast<std::uint32_t>(scene_.meshes.size())});
        return animation_.models.size() - 1;
    }

    LoadedModel read(const ObjectDescription& object, SubdivisionScheme scheme) {
        const MeshOptions options{object.subdivide, scheme, &budget_, threads_, strict_, kept_attributes_};
        const std::optional<FramePattern> pattern = pattern_of(object);
        std::size_t motion = SceneAnimation::kNone;
        Model model =
            pattern ? load_sequence(object, *pattern, options, motion)
                    : read_model(object.file, options, {first_frame_.has_value(), lists_animations_, object.animation});
        if (model.player)
            motion = add_motion(std::make_shared<PlayedModel>(object.file, model.player, from_.frame.fps));
        if (!model.animations.empty()) animation_.file_animations.push_back({object.file, std::move(model.animations)});
        if (files_read_ != nullptr) {
            if (!pattern) files_read_->push_back(object.file);
            files_read_->insert(files_read_->end(), model.other_files.read.begin(), model.other_files.read.end());
        }
        pictures_.insert(pictures_.end(), model.other_files.pictures.begin(), model.other_files.pictures.end());
        for (std::size_t i = 0; i < model.cameras.size(); ++i) {
            const ModelCamera& c = model.cameras[i];
            CameraSettings camera;
            camera.name = c.name;
            camera.orthographic = c.orthographic;
            camera.fov_deg = c.fov_deg;
            if (c.orthographic) camera.height = c.height;
            camera.to_world = object.to_world * object.instances.front() * c.to_world;
            file_cameras_.push_back(camera);
            moving_file_cameras_.push_back({.rest = camera,
                                            .place = {.keys = keys_of(object),
                                                      .object = object.to_world,
                                                      .instance = object.instances.front(),
                                                      .model = motion,
                                                      .part = i,
                                                      .own = c.to_world}});
        }
        LoadedModel loaded = adopt(std::move(model));
        loaded.motion = motion;
        return loaded;
    }

    /// Moves a model's meshes and materials into the scene.
    LoadedModel adopt(Model model) {
        LoadedModel loaded;
        loaded.first_mesh = static_cast<std::uint32_t>(scene_.meshes.size());
        std::vector<std::uint32_t> materials(model.materials.size());
        std::iota(materials.begin(), materials.end(), static_cast<std::uint32_t>(scene_.materials.size()));
        loaded.materials = materials;
        for (const ModelObject& object : model.objects) {
            loaded.polygons += model.meshes[object.mesh].polygon_count;
            loaded.name_bytes += object.name.size();
        }
        for (Mesh& mesh : model.meshes) scene_.meshes.push_back(std::move(mesh));
        for (Material& material : model.materials) scene_.materials.push_back(std::move(material));
        loaded.objects = std::move(model.objects);
        for (std::string& name : model.attribute_names) {
            if (std::find(attribute_names_.begin(), attribute_names_.end(), name) == attribute_names_.end())
                attribute_names_.push_back(std::move(name));
        }
        scene_.skipped_primitives += model.skipped_primitives;
        scene_.non_finite_polygons += model.non_finite_polygons;
        for (std::string& note : model.notes) {
            // A file that is read twice, with and without subdivision, says the same twice.
            if (std::find(scene_.notes.begin(), scene_.notes.end(), note) == scene_.notes.end())
                scene_.notes.push_back(std::move(note));
        }
        return loaded;
    }

    void place(const ObjectDescription& object, const LoadedModel& model) {
        MaterialList materials = model.materials;
        if (!object.material.empty()) {
            materials = MaterialList::all_alike(materials.size(), material_numbers_.find(object.material)->second);
        }
        const std::size_t keys = keys_of(object);
        for (std::size_t i = 0; i < object.instances.size(); ++i) {
            throw_if_interrupted();
            for (std::size_t k = 0; k < model.objects.size(); ++k) {
                const ModelObject& part = model.objects[k];
                SceneObject placed;
                placed.name = name_of(object, part, i);
                placed.mesh = model.first_mesh + part.mesh;
                placed.to_world = object.to_world * object.instances[i] * part.to_world;
                placed.materials = materials;
                if (!is_placeable(placed.to_world)) throw InputError(not_placeable(placed.name));
                if (may_move_) {
                    animation_.objects.push_back({.keys = keys,
                                                  .object = object.to_world,
                                                  .instance = object.instances[i],
                                                  .model = model.motion,
                                                  .part = k,
                                                  .own = part.to_world,
                                                  .name = placed.name});
                }
                scene_.objects.push_back(std::move(placed));
            }
        }
    }

    /// The number of an object's keys.
    std::size_t keys_of(const ObjectDescription& object) {
        if (object.keys.empty()) return SceneAnimation::kNone;
        if (placed_ != &object) animation_.keys.push_back(object.keys);
        placed_ = &object;
        return animation_.keys.size() - 1;
    }

    static std::string name_of(const ObjectDescription& object, const ModelObject& part, std::size_t instance) {
        std::string name = object.name;
        if (!object.file.empty() && !part.name.empty()) name += (name.empty() ? "" : "/") + part.name;
        if (object.instances.size() > 1) name += "#" + std::to_string(instance + 1);
        return name;
    }

    static constexpr std::uint64_t kMostPolygons =
        std::numeric_limits<std::uint32_t>::max() - 1;  // as make_frame() numbers them

    SceneDescription from_;
    int threads_;
    bool strict_;
    ModelBudget budget_;
    std::optional<double> first_frame_;
    std::vector<double> frames_instead_;
    bool lists_animations_;
    std::vector<std::string>* files_read_;  // nullptr: nobody asks
    std::vector<std::string> pictures_;     // that models name
    Scene scene_;
    std::map<std::string, std::uint32_t, std::less<>> material_numbers_;  // of those of the scene file
    std::map<std::tuple<std::string, int, SubdivisionScheme, AnimationChoice, double, bool>,
             std::shared_ptr<LoadedModel>>
        files_;
    std::uint64_t polygons_ = 0;
    AttributeReaders attribute_readers_;
    AttributeWish kept_attributes_;             // of files
    std::vector<std::string> attribute_names_;  // of all files, if any are kept
    std::vector<CameraSettings> file_cameras_;
    std::vector<SceneAnimation::MovingCamera> moving_file_cameras_;
    SceneAnimation animation_;
    bool may_move_ = false;                      // some object: else their places are not told
    const ObjectDescription* placed_ = nullptr;  // the last one that has keys
};

}  // namespace

Scene load_scene(SceneDescription description, const LoadOptions& options, std::vector<std::string>* files) {
    return SceneLoader(std::move(description), options, files).load().scene;
}

AnimatedScene load_animated_scene(SceneDescription description, const LoadOptions& options,
                                  std::vector<std::string>* files) {
    return SceneLoader(std::move(description), options, files).load();
}

void draw_lines_without_polygons(Scene& scene) {
    const bool has_polygons =
        std::any_of(scene.meshes.begin(), scene.meshes.end(), [](const Mesh& mesh) { return !mesh.triangles.empty(); });
    if (!has_polygons && !scene.sheet && scene.lines.classes == kDefaultLineClasses)
        scene.lines.classes |= LineClass::mark;
}

bool draws_hidden_lines(const Scene& scene) {
    if (!scene.sheet) return scene.lines.style.hidden.style != HiddenStyle::none;
    const std::vector<LineSet>& sets = scene.sheet->sets;
    return std::any_of(sets.begin(), sets.end(), [](const LineSet& set) { return set.is_enabled && set.qi[1] > 0; });
}

bool has_transparent_surfaces(const Scene& scene) {
    if (std::all_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) { return m.opacity >= 1; }))
        return false;
    std::set<const std::uint32_t*> seen;  // objects share lists
    bool is_transparent = false;
    for (const SceneObject& object : scene.objects) {
        if (!seen.insert(object.materials.address()).second) continue;
        object.materials.for_each(
            [&](std::uint32_t m) { is_transparent = is_transparent || scene.materials[m].opacity < 1; });
    }
    return is_transparent;
}

}  // namespace burin
