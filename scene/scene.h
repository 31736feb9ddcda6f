#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lines/crease_fade.h"
#include "mesh/material_list.h"
#include "mesh/mesh.h"
#include "mesh/subdivide.h"
#include "scene/camera.h"
#include "scene/method_settings.h"
#include "scene/paper.h"
#include "scene/shutter.h"
#include "shading/line_style.h"
#include "shading/surface/light.h"
#include "shading/surface_shader.h"

// A scene is what a picture is made of: meshes, objects, materials, cameras and settings; it computes nothing.

namespace burin {

struct LineShaders;
struct StyleSheet;

/// The picture as a whole.
struct PictureSettings {
    int width = 1920;
    int height = 1080;
    std::optional<glm::vec3> background;  ///< linear RGB
    double dpi = 96;                      ///< pixels per inch, for lengths in mm and pt
    bool transparent = false;             ///< PNG and TIFF get an alpha channel instead of white paper
    PaperSettings paper;                  ///< of its size; fit_to_paper() has made width, height and dpi follow
};

/// Which frame of an animation the picture is: what `frame` and `time` are in a style sheet.
struct FrameSettings {
    double number = 0;
    double fps = 24;              ///< frames per second
    bool is_of_sequence = false;  ///< several frames were asked for, be it one at a time
};

/// Layers of Cryptomatte.
struct CryptoSettings {
    int ranks = 6;  ///< how many names a pixel has room for: even, 2 to 16
};

struct DeepSettings {
    bool is_float = false;         ///< colours and alphas in single precision, else in half
    bool has_lines_behind = true;  ///< hidden lines are samples behind surfaces
};

/// Where a smooth surface turns away from the eye.
enum class Contours : std::uint8_t {
    mesh,    ///< along the edges between polygons that face apart
    smooth,  ///< where normals, interpolated between the vertices, are across the line of sight
};

/// Which lines are drawn, and how.
struct LineSettings {
    LineClassSet classes = kDefaultLineClasses;
    double crease_angle_deg = 40;
    /// Creases fade in over this many degrees, half of them below that angle. Only method `abuffer`; the others draw a
    /// crease or none.
    double crease_fade_deg = 0;
    Contours contours = Contours::mesh;  ///< only method `abuffer`
    LineStyle style;

    /// Creases fade in from the first angle to the second; equal angles: they do not fade.
    void set_crease_angle(double from_deg, double to_deg) {
        crease_angle_deg = 0.5 * (from_deg + to_deg);
        crease_fade_deg = to_deg - from_deg;
    }
    CreaseFade crease_fade() const {
        return {crease_angle_deg - 0.5 * crease_fade_deg, crease_angle_deg + 0.5 * crease_fade_deg};
    }
};

/// An object of the finished scene: a mesh at its place.
struct SceneObject {
    std::string name;
    std::uint32_t mesh = 0;
    glm::dmat4 to_world{1.0};
    MaterialList materials;  ///< per material number of the mesh: scene's material
};

/// Everything that a picture is made of. Describes and computes nothing.
struct Scene {
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<SceneObject> objects;
    std::vector<CameraSettings> cameras;  ///< at least one; the first is the default
    bool camera_is_default = false;       ///< the input has no camera
    PictureSettings picture;
    FrameSettings frame;
    CryptoSettings crypto;
    DeepSettings deep;
    std::optional<ShutterSettings> shutter;  ///< none: pictures show one moment
    LineSettings lines;
    /// How lines look; none: as `lines.style` says. What it says of finding lines stands in `lines`, too (use_sheet()).
    std::shared_ptr<const StyleSheet> sheet;
    std::shared_ptr<const LineShaders> line_shaders;  ///< that the sheet may name; nullptr: the program has none
    /// Beside a sheet: lines are found and known as if it asked for everything, so that any sheet can restyle them.
    bool finds_all = false;
    /// Beside a sheet: chains and how many surfaces hide a line are known, too, for vector files name lines by them.
    bool names_lines = false;
    /// Beside a sheet: no other sheet will draw what is found, so what this one does not read may be left out.
    bool draws_one_sheet = false;
    SurfaceStyle surfaces;
    std::vector<SceneLight> lights;  ///< the first one is the key light; none: it is at the eye
    AbufferSettings abuffer;
    PatelSettings patel;
    ReferenceSettings reference;
    GBufferSettings gbuffer;
    ZBufferSettings zbuffer;
    WireSettings wire;
    std::uint64_t skipped_primitives = 0;
    std::uint64_t non_finite_polygons = 0;
    std::vector<std::string> notes;  ///< of the models' readers, "path: what", each once
};

/// What has no polygon has marks only: they are drawn unless the scene wants other classes than those by default.
/// load_scene() has done it.
void draw_lines_without_polygons(Scene& scene);

/// Whether lines are drawn that opaque surfaces hide.
bool draws_hidden_lines(const Scene& scene);

/// Whether some surface of the scene lets light through.
bool has_transparent_surfaces(const Scene& scene);

/// All vertices of all objects in world space, for fitting cameras.
PointSource scene_points(const Scene& scene);

}  // namespace burin
