#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/interrupt.h"
#include "burin/burin.h"
#include "burin/late_film.h"
#include "render/prepared.h"
#include "scene/scene.h"
#include "scene/scene_settings.h"
#include "shading/line_shader.h"

namespace burin {

/// The meshes of a burin_add_mesh() or burin_load(), which objects share.
struct MeshGroup {
    std::vector<Mesh> meshes;
    // Of meshes that were added:
    std::string name;
    bool has_parts = false;  ///< whose names they have
    MaterialList materials;  ///< the scene's material for each material number
};

/// One mesh of an object.
struct ObjectPart {
    std::string name;
    std::shared_ptr<MeshGroup> group;
    std::size_t mesh = 0;  ///< of the group's
    glm::dmat4 to_world{1.0};
    MaterialList materials;
};

/// What is made of a scene's meshes once for all views of it, see prepare_for_abuffer().
struct Preparation {
    std::uint64_t revision = 0;         ///< of the scene that it was made for; 0: there is none
    std::uint64_t placement = 0;        ///< of the same
    std::vector<std::size_t> replaced;  ///< meshes that were others for that frame than they are in the scene
    bool closes_cracks = false;         ///< which ones, depends on the view
    PreparedScene made;
    std::uint64_t meshes_made = 0;  ///< how many meshes it was made for so far, one as often as it was
};

struct ObjectState {
    std::string name;
    std::vector<ObjectPart> parts;  ///< empty if the mesh has no polygon with an area
};

}  // namespace burin

/// A scene while it is used through the interface. What a picture is made of, a burin::Scene, is put together for each
/// picture (burin/scene_for_frame.h).
struct burin_scene {
    burin::SceneSettings settings;
    std::vector<burin::Material> materials;
    std::uint32_t default_material = 0;                       ///< its number, from 1; 0: not needed so far
    std::vector<burin::CameraSettings> file_cameras;          ///< of models
    std::map<int, std::shared_ptr<burin::MeshGroup>> meshes;  ///< by their numbers
    std::map<int, burin::ObjectState> objects;                ///< by their numbers
    int last_mesh = 0, last_object = 0;                       ///< numbers that were given
    bool moves = false;                                       ///< what was loaded has animations, which are not played
    std::vector<std::string> notes;
    std::string explanation;  ///< the last one of burin_explain()
    /// Of the program, by name; drawings share it, so that it is replaced and not changed.
    std::shared_ptr<const burin::LineShaders> line_shaders = std::make_shared<const burin::LineShaders>();
    std::uint64_t revision = 1;   ///< counts changes of objects, materials and settings
    std::uint64_t placement = 1;  ///< counts moves of objects
    burin::Preparation preparation;
    burin::StopFlag stop{false};
    burin::LateFilm late_film;  ///< of the last picture that was stopped
};

namespace burin {

/// A call that burin_cancel() can stop.
class StoppableCall {
  public:
    explicit StoppableCall(burin_scene& scene) : scope_((scene.stop.store(false), scene.stop)) {}

  private:
    StopScope scope_;
};

/// 16 numbers, row by row. Throws UsageError if they are no matrix that an object may have.
glm::dmat4 object_matrix(const double* numbers, const char* name);
/// Whether all 16 are 0.
bool is_unset(const double* numbers);

}  // namespace burin
