#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "base/interrupt.h"
#include "base/json_writer.h"
#include "cli/commands.h"
#include "cli/job.h"
#include "mesh/text_scan.h"
#include "render/matte_names.h"

namespace burin {
namespace {

struct Totals {
    std::uint64_t meshes = 0, objects = 0, triangles = 0, polygons = 0, vertices = 0;
    MeshRepairs repairs;  // of the distinct meshes
    EdgeCounts edges;     // of the distinct meshes
    Box bounds;
};

Totals count(const Scene& scene) {
    Totals totals;
    totals.meshes = scene.meshes.size();
    totals.objects = scene.objects.size();
    for (const Mesh& mesh : scene.meshes) {
        const EdgeCounts edges = count_edges(mesh);
        totals.edges.edges += edges.edges;
        totals.edges.border += edges.border;
        totals.edges.non_manifold += edges.non_manifold;
        totals.edges.seam += edges.seam;
        totals.edges.marked += edges.marked;
        totals.edges.loose += edges.loose;
        totals.repairs.degenerate_polygons += mesh.repairs.degenerate_polygons;
        totals.repairs.duplicate_polygons += mesh.repairs.duplicate_polygons;
        totals.repairs.cut_polygons += mesh.repairs.cut_polygons;
        totals.repairs.cut_pieces += mesh.repairs.cut_pieces;
        totals.repairs.welded_vertices += mesh.repairs.welded_vertices;
    }
    for (const SceneObject& object : scene.objects) {
        throw_if_interrupted();
        const Mesh& mesh = scene.meshes[object.mesh];
        totals.triangles += mesh.repairs.input_triangles;
        totals.polygons += mesh.repairs.input_polygons;
        totals.vertices += mesh.positions.size();
    }
    totals.bounds = box_of(scene_points(scene));
    return totals;
}

/// What readers left out, and names that are hard to use in a compositor.
std::vector<std::string> all_notes(const Scene& scene) {
    std::vector<std::string> notes = scene.notes;
    const auto add = [&](const auto& named, const char* what) {
        std::vector<std::string> names;
        for (const auto& n : named) {
            throw_if_interrupted();
            names.push_back(n.name);
        }
        for (const std::string& warning : warnings_on_names(names)) notes.push_back(what + warning);
    };
    add(scene.objects, "object ");
    add(scene.materials, "material ");
    return notes;
}

void write_vector(JsonWriter& json, const char* key, const glm::dvec3& v) {
    json.key(key).begin_array().value(v.x).value(v.y).value(v.z).end_array();
}

std::string info_json(const Scene& scene, const std::vector<AnimationsOfFile>& animations, const std::string& input,
                      const Totals& t) {
    JsonWriter json;
    json.begin_object();
    json.key("file").value(input);
    json.key("meshes").value(t.meshes);
    json.key("objects").value(t.objects);
    json.key("triangles").value(t.triangles);
    json.key("polygons").value(t.polygons);
    json.key("vertices").value(t.vertices);
    json.key("bounds").begin_object();
    write_vector(json, "min", t.bounds.low);
    write_vector(json, "max", t.bounds.high);
    json.end_object();
    json.key("repairs").begin_object();
    json.key("degenerate_polygons").value(t.repairs.degenerate_polygons);
    json.key("duplicate_polygons").value(t.repairs.duplicate_polygons);
    json.key("non_finite_polygons").value(scene.non_finite_polygons);
    json.key("cut_polygons").value(t.repairs.cut_polygons);
    json.key("cut_pieces").value(t.repairs.cut_pieces);
    json.key("welded_vertices").value(t.repairs.welded_vertices);
    json.key("skipped_primitives").value(scene.skipped_primitives);
    json.end_object();
    json.key("notes").begin_array();
    for (const std::string& note : all_notes(scene)) json.value(note);
    json.end_array();
    json.key("edges").begin_object();
    json.key("total").value(t.edges.edges);
    json.key("border").value(t.edges.border);
    json.key("seam").value(t.edges.seam);
    json.key("non_manifold").value(t.edges.non_manifold);
    json.key("marked").value(t.edges.marked);
    json.key("loose").value(t.edges.loose);
    json.end_object();
    json.key("object_list").begin_array();
    for (const SceneObject& object : scene.objects) {
        throw_if_interrupted();
        const Mesh& mesh = scene.meshes[object.mesh];
        json.begin_object();
        json.key("name").value(object.name);
        json.key("mesh").value(object.mesh);
        json.key("triangles").value(mesh.repairs.input_triangles);
        json.key("polygons").value(mesh.repairs.input_polygons);
        json.end_object();
    }
    json.end_array();
    json.key("materials").begin_array();
    for (const Material& m : scene.materials) {
        json.begin_object().key("name").value(m.name);
        json.key("color").begin_array();
        for (int c = 0; c < 3; ++c) json.value(static_cast<double>(m.color[c]));
        json.end_array();
        json.key("opacity").value(static_cast<double>(m.opacity));
        json.end_object();
    }
    json.end_array();
    json.key("cameras").begin_array();
    for (const CameraSettings& c : scene.cameras) {
        if (scene.camera_is_default) break;  // the input has none
        json.begin_object().key("name").value(c.name);
        json.key("projection").value(c.orthographic ? "orthographic" : "perspective");
        if (c.orthographic && c.height) json.key("height").value(*c.height);
        if (!c.orthographic) json.key("fov_deg").value(c.fov_deg);
        json.end_object();
    }
    json.end_array();
    json.key("animations").begin_array();
    for (const AnimationsOfFile& of_file : animations) {
        for (const AnimationSummary& animation : of_file.animations) {
            json.begin_object().key("file").value(of_file.file);
            json.key("name").value(animation.name);
            json.key("seconds").value(animation.seconds);
            json.key("channels").value(animation.channels);
            json.end_object();
        }
    }
    json.end_array().end_object();
    return json.text();
}

/// The animations of each file, which are many at times.
void print_animations(const std::vector<AnimationsOfFile>& animations) {
    constexpr std::size_t kMostListed = 50;
    for (const AnimationsOfFile& of_file : animations) {
        const std::size_t count = of_file.animations.size();
        for (std::size_t i = 0; i < count && i < kMostListed; ++i) {
            const AnimationSummary& animation = of_file.animations[i];
            const std::string name =
                animation.name.empty() ? "(unnamed)" : "\"" + printable(animation.name, 200) + "\"";
            std::printf("  animation %zu  %s: %.6g s, %llu channels, of %s\n", i, name.c_str(), animation.seconds,
                        static_cast<unsigned long long>(animation.channels), printable(of_file.file, 4000).c_str());
        }
        if (count > kMostListed) std::printf("  ... and %zu more; --json lists all\n", count - kMostListed);
    }
}

void print_info(const Scene& scene, const std::string& input, const Totals& t) {
    const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    std::printf("%s\n", input.c_str());
    std::printf("  objects    %llu, of %llu meshes\n", number(t.objects), number(t.meshes));
    std::printf("  triangles  %llu, as %llu polygons with %llu vertices\n", number(t.triangles), number(t.polygons),
                number(t.vertices));
    std::printf("  bounds     %.6g %.6g %.6g  to  %.6g %.6g %.6g\n", t.bounds.low.x, t.bounds.low.y, t.bounds.low.z,
                t.bounds.high.x, t.bounds.high.y, t.bounds.high.z);
    std::printf("  edges      %llu: %llu border (%llu along a seam), %llu non-manifold, %llu marked\n",
                number(t.edges.edges), number(t.edges.border), number(t.edges.seam), number(t.edges.non_manifold),
                number(t.edges.marked));
    if (t.edges.loose > 0)
        std::printf("  lines      %llu of those marked that no polygon has\n", number(t.edges.loose));
    std::printf("  dropped    %llu degenerate and %llu duplicate polygons; %llu vertices welded\n",
                number(t.repairs.degenerate_polygons), number(t.repairs.duplicate_polygons),
                number(t.repairs.welded_vertices));
    if (t.repairs.cut_polygons > 0) {
        std::printf("  cut        %llu polygons that pass an edge twice in one direction, into %llu\n",
                    number(t.repairs.cut_polygons), number(t.repairs.cut_pieces));
    }
    for (const std::string& note : all_notes(scene)) std::printf("  note       %s\n", printable(note, 4000).c_str());
    std::printf("  materials  %zu:", scene.materials.size());
    for (const Material& m : scene.materials) {
        std::printf(" %s", m.name.empty() ? "(unnamed)" : printable(m.name, 200).c_str());
    }
    std::printf("\n  cameras    ");
    for (const CameraSettings& c : scene.cameras) {
        if (scene.camera_is_default) break;
        std::printf("%s (%s) ", c.name.empty() ? "(unnamed)" : printable(c.name, 200).c_str(),
                    c.orthographic ? "orthographic" : "perspective");
    }
    std::printf("%s\n", scene.camera_is_default ? "none; the view is fitted to the model" : "");
    constexpr std::size_t kMaxListed = 50;
    for (std::size_t i = 0; i < scene.objects.size() && i < kMaxListed; ++i) {
        const MeshRepairs& r = scene.meshes[scene.objects[i].mesh].repairs;
        std::printf("  object %zu  %s: %llu triangles\n", i + 1, printable(scene.objects[i].name, 200).c_str(),
                    number(r.input_triangles));
    }
    if (scene.objects.size() > kMaxListed) {
        std::printf("  ... and %zu more; --json lists all\n", scene.objects.size() - kMaxListed);
    }
}

}  // namespace

void run_info(const Arguments& a) {
    std::vector<AnimationsOfFile> animations;
    const Scene scene = load_scene_of(a, {}, &animations);
    const Totals totals = count(scene);
    if (a.json) {
        std::fputs(info_json(scene, animations, a.input, totals).c_str(), stdout);
    } else {
        print_info(scene, a.input, totals);
        print_animations(animations);
    }
}

}  // namespace burin
