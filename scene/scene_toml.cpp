#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <unordered_set>

#include "base/interrupt.h"
#include "base/lower_extension.h"
#include "base/mapped_file.h"
#include "mesh/text_scan.h"
#include "scene/animation/frame_list.h"
#include "scene/animation/frame_pattern.h"
#include "scene/animation/keys_toml.h"
#include "scene/animation/table_hash.h"
#include "scene/color.h"
#include "scene/gbuffer_toml.h"
#include "scene/lines_toml.h"
#include "scene/parse_toml.h"
#include "scene/scene_description.h"
#include "scene/scene_tables.h"
#include "scene/shape_toml.h"
#include "scene/sheet_library.h"
#include "scene/sheet_toml.h"
#include "scene/shutter_toml.h"
#include "scene/surfaces_toml.h"
#include "scene/toml_depth.h"
#include "scene/toml_reader.h"
#include "scene/wire_settings_toml.h"
#include "shading/sheet/style_sheet.h"

namespace burin {
namespace {

constexpr std::size_t kMaxSceneBytes = 64u << 20;

// ---- transforms ----

Placement read_placement(TomlReader& t) {
    Placement placement;
    placement.translate = t.vector("translate").value_or(placement.translate);
    placement.rotate_deg = t.vector("rotate").value_or(placement.rotate_deg);
    placement.scale = read_scale(t).value_or(placement.scale);
    return placement;
}

/// translate * rotate * scale, or a matrix of 16 numbers, row by row.
glm::dmat4 read_transform(TomlReader& t) {
    if (t.has("matrix")) {
        for (const char* key : {"translate", "rotate", "scale"}) {
            if (t.has(key)) t.fail(key, "cannot stand beside a matrix; use one or the other");
        }
        const auto m = *t.numbers("matrix", 16);
        glm::dmat4 matrix;
        for (int row = 0; row < 4; ++row) {
            for (int column = 0; column < 4; ++column) {
                matrix[column][row] = m[static_cast<std::size_t>(4 * row + column)];
            }
        }
        if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1) {
            t.fail("matrix", "the last row must be 0 0 0 1");
        }
        if (glm::determinant(glm::dmat3(matrix)) == 0)
            t.fail("matrix", "makes everything flat; its determinant must not be 0");
        return matrix;
    }
    return matrix_of(read_placement(t));
}

// ---- the tables of a scene file ----

class SceneReader {
  public:
    SceneReader(const ScenePlace& place, TomlReader root, const SheetWishes& wishes)
        : folder_(place.folder), root_(std::move(root)), wishes_(wishes) {}

    SceneDescription read(SceneParts parts) {
        read_cameras();
        for (TomlReader& t : root_.tables("material")) read_material(t);
        for (TomlReader& t : root_.tables("object")) read_object(t);
        if (auto t = root_.table("picture")) read_picture(*t);
        if (auto t = root_.table("frames")) read_frames(*t);
        if (auto t = root_.table("shutter")) scene_.shutter = read_shutter(*t);
        if (auto t = root_.table("turntable")) scene_.turntable = read_turntable(*t);
        if (auto t = root_.table("crypto")) read_crypto(*t);
        if (auto t = root_.table("deep")) read_deep(*t);
        if (auto t = root_.table("lines")) scene_.lines = read_line_settings(*t);
        read_style();
        if (auto t = root_.table("surfaces")) {
            scene_.surfaces = read_surfaces(*t);
            scene_.sheet_surfaces_unread = !wishes_.style.empty() && scene_.sheet && scene_.sheet->surfaces;
        } else if (scene_.sheet && scene_.sheet->surfaces) {
            scene_.surfaces = *scene_.sheet->surfaces;
        }
        scene_.lights = read_lights(root_);
        if (auto t = root_.table("abuffer")) read_abuffer(*t);
        if (auto t = root_.table("patel")) read_patel(*t);
        if (auto t = root_.table("reference")) read_reference(*t);
        if (auto t = root_.table("gbuffer")) scene_.gbuffer = read_gbuffer(*t);
        if (auto t = root_.table("zbuffer")) read_zbuffer(*t);
        if (auto t = root_.table("wire")) scene_.wire = read_wire_settings(*t);
        root_.finish();
        if (parts == SceneParts::all && scene_.objects.empty()) {
            root_.fail("the scene has no [[object]]; add one with a file or a shape");
        }
        return std::move(scene_);
    }

  private:
    void read_cameras() {
        for (TomlReader& t : root_.tables("camera")) {
            throw_if_interrupted();
            CameraSettings camera;
            camera.where = t.position();
            camera.name = t.text("name").value_or("");
            if (!camera_names_.insert(camera.name).second) t.fail("name", "two cameras have this name; rename one");
            const auto projection = t.choice("projection", {"perspective", "orthographic"});
            camera.orthographic = projection == 1u;
            camera.eye = t.vector("eye");
            camera.target = t.vector("target");
            camera.up = t.vector("up");
            camera.direction = t.vector("direction");
            if (camera.eye && camera.direction) t.fail("direction", "cannot stand beside an eye; remove one");
            camera.height = t.number("height", kPositive);
            camera.fov_deg = t.number("fov", {0, 180, true, true}).value_or(35);
            if (camera.height && projection == 0u) {
                t.fail("height", "a perspective camera has none; use fov, or another projection");
            }
            if (camera.height) camera.orthographic = true;
            camera.fit = t.number("fit", {0, 1, true, false}).value_or(0.95);
            read_lens(t, camera);
            scene_.camera_keys.push_back(read_camera_keys(t, camera));
            t.finish();
            scene_.cameras.push_back(camera);
        }
    }

    static void read_lens(TomlReader& t, CameraSettings& camera) {
        if (const auto shift = t.numbers("shift", 2)) {
            camera.shift = {(*shift)[0], (*shift)[1]};
            if (std::max(std::abs(camera.shift.x), std::abs(camera.shift.y)) > 100) {
                t.fail("shift", "must be from -100 to 100 heights of the picture");
            }
        }
        camera.pixel_aspect = t.number("pixel_aspect", {kLeastPixelAspect, kMostPixelAspect}).value_or(1);
        camera.lens_radius = t.number("lens_radius", {0, 1e30}).value_or(0);
        camera.focus = t.number("focus", kPositive);
        if (camera.orthographic && camera.lens_radius > 0) t.fail("lens_radius", "an orthographic camera has no lens");
    }

    void read_material(TomlReader& t) {
        throw_if_interrupted();
        Material material;
        const auto name = t.text("name");
        if (!name || name->empty()) t.fail("needs a name");
        if (!material_names_.insert(*name).second) t.fail("name", "two materials have this name; rename one");
        material.name = *name;
        material.color = t.color("color").value_or(material.color);
        material.opacity = static_cast<float>(t.number("opacity", {0, 1}).value_or(1));
        t.finish();
        scene_.materials.push_back(material);
    }

    void read_object(TomlReader& t) {
        throw_if_interrupted();
        ObjectDescription object;
        object.where = t.position();
        const bool has_file = t.has("file");
        if (has_file && t.has("shape")) t.fail("shape", "cannot stand beside a file; remove one");
        if (!has_file && !t.has("shape")) {
            for (const char* key : {"file", "shape"}) {
                if (const auto other = t.misspelled(key))
                    t.fail(*other, std::string("unknown key; did you mean '") + key + "'?");
            }
            t.fail("needs either a file or a shape");
        }
        if (has_file) {
            const std::filesystem::path file(*t.text("file"));
            object.file = file.is_absolute() ? file.string() : (folder_ / file).string();
            object.where = t.position("file");
            read_motion(t, object);
        } else {
            for (const char* key : {"animation", "frame_offset", "missing"}) {
                if (t.has(key)) t.fail(key, "is for model files; a shape has none");
            }
            object.shape = read_shape(t);
        }
        object.name = t.text("name").value_or(has_file ? "" : object.shape.name);
        object.material = t.text("material").value_or("");
        if (!object.material.empty() && !material_names_.contains(object.material)) {
            t.fail("material",
                   "there is no [[material]] named '" + printable(object.material) + "'; add it or correct the name");
        }
        object.subdivide = t.integer("subdivide", 0, 8).value_or(0);
        static constexpr SubdivisionScheme kSchemes[] = {SubdivisionScheme::automatic, SubdivisionScheme::loop,
                                                         SubdivisionScheme::catmull_clark};
        object.scheme = kSchemes[t.choice("scheme", {"automatic", "loop", "catmull-clark"}).value_or(0)];
        object.to_world = read_transform(t);
        object.keys = read_object_keys(t, t.has("matrix") ? Placement{} : read_placement(t));
        for (TomlReader& instance : t.tables("instance")) {
            throw_if_interrupted();
            object.instances.push_back(read_transform(instance));
            instance.finish();
        }
        if (object.instances.empty()) object.instances.emplace_back(1.0);
        t.finish();
        scene_.objects.push_back(std::move(object));
    }

    /// What says how a model file moves.
    static void read_motion(TomlReader& t, ObjectDescription& object) {
        if (t.has("animation")) {
            const std::string suffix = lower_extension(object.file);
            if (suffix != ".gltf" && suffix != ".glb") t.fail("animation", "only .gltf and .glb files have animations");
            using By = AnimationChoice::By;
            if (t.is_number("animation")) {
                const int number = *t.integer("animation", 0, std::numeric_limits<int>::max());
                object.animation = {By::number, static_cast<std::uint32_t>(number), {}};
            } else {
                const std::string name = *t.text("animation");
                object.animation = {name == "none" ? By::none : By::name, 0, name == "none" ? "" : name};
            }
        }
        for (const char* key : {"frame_offset", "missing"}) {
            if (!t.has(key)) continue;
            try {
                if (FramePattern::find(object.file, FramePattern::SingleHash::digits)) continue;
            } catch (const InputError& error) {
                t.fail("file", error.what());
            }
            t.fail(key, "is for a file per frame, as walk.####.obj");
        }
        object.frame_offset = t.number("frame_offset", {-kLargestFrame, kLargestFrame}).value_or(0);
        object.holds_missing = t.choice("missing", {"error", "hold"}).value_or(0) == 1;
    }

    void read_picture(TomlReader& t) {
        PictureSettings& picture = scene_.picture;
        if (const auto size = t.numbers("size", 2)) {
            for (const double side : *size) {
                if (side != std::floor(side) || side < 1 || side > 65535) {
                    t.fail("size", "must be two whole numbers from 1 to 65535");
                }
            }
            picture.width = static_cast<int>((*size)[0]);
            picture.height = static_cast<int>((*size)[1]);
        }
        picture.dpi = t.number("dpi", {1, 100000}).value_or(picture.dpi);
        read_paper(t);
        if (t.has("background")) {
            // A colour, or the word that asks for none.
            if (t.is_text("background") && t.text("background") == "transparent") {
                picture.transparent = true;
            } else {
                picture.background = t.color("background");
            }
        }
        t.finish();
    }

    void read_paper(TomlReader& t) {
        PaperSettings& paper = scene_.picture.paper;
        if (const auto name = t.text("paper")) {
            paper.size_mm = paper_named(*name);
            if (!paper.size_mm) t.fail("paper", "must be one of " + names_of_papers());
            if (t.has("dpi"))
                t.fail("dpi", "cannot stand beside paper, whose size and that in pixels say it; remove one");
        }
        if (t.is_number("margin")) {
            paper.margin_mm.fill(*t.number("margin", {0, 5000}));
        } else if (const auto sides = t.numbers("margin", 4)) {
            for (std::size_t i = 0; i < 4; ++i) {
                paper.margin_mm[i] = (*sides)[i];
                if (!(paper.margin_mm[i] >= 0 && paper.margin_mm[i] <= 5000))
                    t.fail("margin", "must be from 0 to 5000 mm");
            }
        }
        if (t.is_number("scale")) {
            paper.scale = t.number("scale", {1e-12, 1e12});
        } else if (const auto text = t.text("scale")) {
            paper.scale = scale_named(*text);
            if (!paper.scale) t.fail("scale", "must be a scale like \"1:2\" or \"5:1\"");
        }
        if (const auto unit = t.text("unit")) {
            paper.unit_mm = unit_named(*unit);
            if (!paper.unit_mm) t.fail("unit", "must be \"mm\", \"cm\", \"m\", \"in\" or \"ft\"");
        }
        fit_to_paper(scene_.picture);
    }

    void read_frames(TomlReader& t) {
        scene_.frame.fps = read_frame_rate(t, "fps").value_or(scene_.frame.fps);
        scene_.frame_range = read_frame_range(t, "range");
        t.finish();
    }

    void read_crypto(TomlReader& t) {
        constexpr int kFewest = 2, kMost = 16;
        if (const auto ranks = t.integer("ranks", kFewest, kMost)) {
            if (*ranks % 2 != 0) t.fail("ranks", "must be an even number from 2 to 16");
            scene_.crypto.ranks = static_cast<int>(*ranks);
        }
        t.finish();
    }

    void read_deep(TomlReader& t) {
        scene_.deep.is_float = t.boolean("float").value_or(false);
        scene_.deep.has_lines_behind = t.choice("hidden", {"behind", "none"}).value_or(0) == 0;
        t.finish();
    }

    /// The sheet that the command line or the library names, or else the scene.
    std::optional<StyleSheet> wanted_sheet() {
        if (!wishes_.text.empty()) return read_sheet_text(wishes_.text, wishes_.style, wishes_.overrides);
        const auto named = root_.text("style");
        std::optional<SheetSource> source;
        if (!wishes_.style.empty()) {
            source = find_sheet(wishes_.style, {});
            if (!source) throw UsageError("--style: " + no_such_sheet(wishes_.style));
        } else if (named && named->find('\n') != std::string::npos) {
            return read_sheet_text(*named, root_.file() + ": style", wishes_.overrides);
        } else if (named) {
            source = find_sheet(*named, folder_);
            if (!source) root_.fail("style", no_such_sheet(*named));
        }
        if (source) return read_sheet(*source, wishes_.overrides);
        if (wishes_.overrides.empty()) return std::nullopt;
        throw UsageError("--set " + printable(wishes_.overrides.front().key) +
                         ": there is no style sheet; give one with --style");
    }

    void read_style() {
        std::optional<StyleSheet> sheet = wanted_sheet();
        if (!sheet) return;
        // A sheet of the command line takes the place of all looks of the scene.
        if (const auto lines = root_.table("lines"))
            scene_.unread_line_keys = keys_beside_sheet(*lines, *sheet, !wishes_.style.empty());
        use_sheet(scene_, std::make_shared<StyleSheet>(*std::move(sheet)));
    }

    void read_abuffer(TomlReader& t) {
        const std::optional<int> samples = t.integer("samples", 2, 8);
        if (samples && *samples != 2 && *samples != 4 && *samples != 8) t.fail("samples", "must be 2, 4 or 8");
        scene_.abuffer.samples = samples;
        scene_.abuffer.fine_lines = t.boolean("fine_lines");
        t.finish();
    }

    void read_patel(TomlReader& t) {
        const int bits = t.integer("mask", 16, 256).value_or(64);
        if (bits != 16 && bits != 64 && bits != 256) t.fail("mask", "must be 16, 64 or 256");
        scene_.patel.mask_bits = bits;
        static constexpr HaloShape kShapes[] = {HaloShape::four, HaloShape::eight, HaloShape::octagon};
        scene_.patel.halo = kShapes[t.choice("halo", {"four", "eight", "octagon"}).value_or(0)];
        t.finish();
    }

    void read_reference(TomlReader& t) {
        scene_.reference.samples = t.integer("samples", 4, 64).value_or(scene_.reference.samples);
        t.finish();
    }

    void read_zbuffer(TomlReader& t) {
        ZBufferSettings& z = scene_.zbuffer;
        const int bits = t.integer("depth_bits", 16, 64).value_or(24);
        if (bits != 16 && bits != 24 && bits != 32 && bits != 64) {
            t.fail("depth_bits", "must be 16, 24, 32 or 64");
        }
        z.depth_bits = bits;
        if (const auto range = t.numbers("depth_range", 2)) {
            if (!((*range)[0] >= 0 && (*range)[1] > (*range)[0])) {
                t.fail("depth_range", "must be two distances from the eye, the nearer one first");
            }
            z.depth_range = {(*range)[0], (*range)[1]};
        }
        z.eps = t.number("eps", {0, 1}).value_or(1e-3);
        z.factor = t.number("factor", {0, 1e6}).value_or(1);
        z.units = t.number("units", {0, 1e6}).value_or(1);
        z.clamp = t.number("clamp", {0, 1});
        if (const auto adjust = t.choice("adjust", {"edges", "fills"})) {
            z.adjust = *adjust == 0 ? DepthAdjust::edges : DepthAdjust::fills;
        }
        z.canonical_edges = t.boolean("canonical_edges").value_or(true);
        std::vector<std::string> highlight;
        if (t.is_text("highlight")) {
            highlight.push_back(*t.text("highlight"));
        } else if (const auto names = t.texts("highlight")) {
            highlight = *names;
        }
        for (const std::string& name : highlight) {
            if (const auto line_class = line_class_named(name)) {
                z.highlight_classes |= *line_class;
            } else {
                z.highlight_objects.push_back(name);
            }
        }
        z.highlight_color = t.color("highlight_color").value_or(z.highlight_color);
        t.finish();
    }

    std::filesystem::path folder_;
    TomlReader root_;
    const SheetWishes& wishes_;
    SceneDescription scene_;
    std::unordered_set<std::string> camera_names_, material_names_;
};

}  // namespace

void use_sheet(SceneDescription& scene, std::shared_ptr<const StyleSheet> sheet) {
    LineSettings& lines = scene.lines;
    if (sheet->crease_angle_deg) lines.set_crease_angle((*sheet->crease_angle_deg)[0], (*sheet->crease_angle_deg)[1]);
    if (sheet->smooth_contours) lines.contours = *sheet->smooth_contours ? Contours::smooth : Contours::mesh;
    if (sheet->filter) lines.style.filter = *sheet->filter;
    lines.classes = classes_of(*sheet);
    scene.sheet = std::move(sheet);
}

SceneDescription read_scene_tables(const toml::table& tables, const ScenePlace& place, SceneParts parts,
                                   const SheetWishes& wishes) {
    SceneDescription description = SceneReader(place, TomlReader(tables, "", place.name), wishes).read(parts);
    description.hash = hash_of_scene_tables(tables);
    return description;
}

toml::table parse_scene_text(std::string_view text, const std::string& name) {
    return parse_checked_toml(text, name, "a scene file", kMaxSceneBytes);
}

toml::table read_scene_toml(const std::string& path) {
    const MappedFile file(path);
    try {
        return parse_scene_text(file.bytes(), path);
    } catch (const InputError&) {
        file.check_is_whole();
        throw;
    }
}

toml::table bare_model_tables(const std::string& path) {
    toml::table object;
    object.insert("file", std::filesystem::path(path).filename().string());  // relative to the scene: itself
    toml::table root;
    root.insert("object", toml::array(std::move(object)));
    return root;
}

namespace {

SceneDescription read_with_overrides(toml::table tables, const std::string& path,
                                     const std::vector<Override>& overrides, const std::string& style) {
    SheetWishes wishes;
    wishes.style = style;
    for (const Override& o : overrides) {
        if (is_of_sheet(o)) {
            wishes.overrides.push_back(o);
        } else {
            apply_override(tables, o);
        }
    }
    return read_scene_tables(tables, place_of_scene(path), SceneParts::all, wishes);
}

}  // namespace

SceneDescription read_scene_file(const std::string& path, const std::vector<Override>& overrides,
                                 const std::string& style) {
    return read_with_overrides(read_scene_toml(path), path, overrides, style);
}

SceneDescription bare_model_scene(const std::string& path, const std::vector<Override>& overrides,
                                  const std::string& style) {
    return read_with_overrides(bare_model_tables(path), path, overrides, style);
}

}  // namespace burin
