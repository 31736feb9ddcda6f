#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.h"
#include "base/model_budget.h"
#include "mesh/animation_choice.h"
#include "mesh/polygon_soup.h"
#include "mesh/shapes.h"
#include "scene/animation/keys.h"
#include "scene/animation/scene_animation.h"
#include "scene/animation/turntable.h"
#include "scene/scene.h"

// A scene description is what a scene file says, before any model is loaded.

namespace burin {

/// One object of a scene file: a model file or a built-in shape, and where it stands.
struct ObjectDescription {
    std::string name;
    std::string file;  ///< path, already relative to where the program runs; or empty
    Shape shape;       ///< if there is no file
    int subdivide = 0;
    SubdivisionScheme scheme = SubdivisionScheme::automatic;
    std::string material;        ///< name; empty: the file's own materials
    AnimationChoice animation;   ///< of the file, if it is a glTF
    double frame_offset = 0;     ///< of a sequence: the number of a frame's file less that of the frame
    bool holds_missing = false;  ///< of a sequence: where a file is missing, an earlier one is shown
    glm::dmat4 to_world{1.0};
    ObjectKeys keys;                    ///< they say what to_world is at a frame
    std::vector<glm::dmat4> instances;  ///< each within to_world; never empty
    SourcePosition where;               ///< for messages
};

/// A scene file (docs/scene-format.md), checked, but with no model loaded yet.
struct SceneDescription {
    std::vector<ObjectDescription> objects;
    std::vector<Material> materials;
    std::vector<CameraSettings> cameras;
    std::vector<CameraKeys> camera_keys;  ///< one per camera
    PictureSettings picture;
    FrameSettings frame;
    std::optional<ShutterSettings> shutter;
    std::vector<double> frame_range;  ///< the frames that the scene has; empty: it does not say
    std::optional<Turntable> turntable;
    std::uint64_t hash = 0;  ///< of what its tables say of all frames (hash_of_scene_tables())
    CryptoSettings crypto;
    DeepSettings deep;
    LineSettings lines;
    std::shared_ptr<const StyleSheet> sheet;
    std::vector<std::string> unread_line_keys;  ///< keys of [lines] that nothing reads beside the sheet
    bool sheet_surfaces_unread = false;         ///< the given sheet has [surfaces], and so has the scene's own file
    SurfaceStyle surfaces;
    std::vector<SceneLight> lights;
    AbufferSettings abuffer;
    PatelSettings patel;
    ReferenceSettings reference;
    GBufferSettings gbuffer;
    ZBufferSettings zbuffer;
    WireSettings wire;
};

/// "KEY=VALUE", for example "lines.width=2": overrides a value of the scene file.
struct Override {
    /// What gives it, as messages begin.
    enum class From : std::uint8_t { option /* --set */, call /* burin_set() */ };

    std::string key;
    std::string value;
    From from = From::option;
};

/// Reads a scene file. Throws InputError with line and column for anything unknown or out of range,
/// UsageError for an override that does not fit. `style`: the name or the file of a style sheet that takes the place of
/// the scene's own, as --style has it; empty: none. Overrides whose keys begin with "style." are values of the sheet.
SceneDescription read_scene_file(const std::string& path, const std::vector<Override>& overrides,
                                 const std::string& style = {});

/// The scene of a bare model: that one object, everything else at its default.
SceneDescription bare_model_scene(const std::string& path, const std::vector<Override>& overrides,
                                  const std::string& style = {});

/// Has lines look as a sheet says, and be found as it says.
void use_sheet(SceneDescription& scene, std::shared_ptr<const StyleSheet> sheet);

/// How to load a scene.
struct LoadOptions {
    int threads = 1;                ///< 0 = all cores. Changes no result.
    bool strict = false;            ///< refuses a model of which a reader would leave a part out with a note
    bool keeps_attributes = false;  ///< of vertices, all that files have; else what the sheet reads
    ModelBudget budget{};           ///< what shapes, subdivisions and instances may take
    /// The first frame that is drawn: what moves within models is loaded, and sequences with the file of this frame.
    /// None: a still, in which models stand as their files put them.
    std::optional<double> first_frame = std::nullopt;
    /// Frames whose file, in this order, may stand for that of the first one if that cannot be read, with a note.
    std::vector<double> frames_instead = {};
    bool lists_animations = false;  ///< of files; then a sequence needs no frame
};

/// Loads the models that a description names, each file once, and makes its shapes, one after the other. Throws
/// InputError; where shapes, subdivisions or instances take more memory than the budget allows, before they are made.
/// `files`: gets the paths of all files that were read.
Scene load_scene(SceneDescription description, const LoadOptions& options = {},
                 std::vector<std::string>* files = nullptr);

/// A scene as it is at rest, and how it moves.
struct AnimatedScene {
    Scene scene;
    SceneAnimation animation;
    std::vector<std::string> pictures;  ///< paths that models name as textures: not read, and perhaps missing
};
/// The same with what moves.
AnimatedScene load_animated_scene(SceneDescription description, const LoadOptions& options = {},
                                  std::vector<std::string>* files = nullptr);

}  // namespace burin
