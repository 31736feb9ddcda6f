// ink_bench MODEL WIDTH HEIGHT RUNS: what it costs to shade and to draw the lines of a frame with looks, beside drawing
// them with one. Prints the JSON object of section "ink": seconds of CPU time of one thread, medians over the runs.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/heap.h"
#include "base/json_writer.h"
#include "bench/statistics.h"
#include "methods/abuffer.h"
#include "render/close_cracks.h"
#include "scene/scene_description.h"
#include "scene/sheet_toml.h"
#include "shading/ink/ink_lines.h"
#include "strokes/ink_printer.h"

namespace burin::bench {
namespace {

enum class Look { constant, translucent, width, varying };

/// A sheet that draws the lines that are found without one. Varying ink changes evenly along a line, as a look that
/// depends on depth or light.
std::shared_ptr<const StyleSheet> sheet_of(Look look, double width_px) {
    const std::string width = std::to_string(width_px);
    std::string text =
        "[let]\n"
        "wave = \"=0.5 + 0.5 * sind(3 * (x + y))\"\n"
        "[[set]]\n"
        "name = \"all\"\n"
        "style = \"ink\"\n"
        "classes = [\"silhouette\", \"border\", \"crease\", \"intersection\", \"object\"]\n"
        "[style.ink]\n";
    if (look == Look::varying || look == Look::width) text += "width = \"=" + width + " * (0.6 + 0.8 * wave)\"\n";
    if (look == Look::varying) {
        text += "opacity = \"=0.5 + 0.5 * wave\"\ncolor = \"=rgb(0.3 * wave, 0, 0)\"\n";
    }
    if (look == Look::constant || look == Look::translucent) text += "width = " + width + "\n";
    if (look == Look::translucent) text += "opacity = 0.5\n";
    return std::make_shared<const StyleSheet>(read_sheet_text(text, "sheet"));
}

struct Case {
    std::string name;
    std::function<void(Film&)> draw;
    Samples cpu;
};

/// A frame whose lines are found, so that they can be shaded and drawn again and again.
struct Styled {
    Frame frame;
    FoundLines lines;
    InkedLines ink;
};

std::string measure(const std::string& model, int width, int height, int runs) {
    Scene scene = load_scene(bare_model_scene(model, {}));
    CameraSettings settings;
    settings.fov_deg = 35;
    settings.fit = 0.95;
    const Camera camera = resolve_camera(settings, scene_points(scene), static_cast<double>(width) / height);
    close_cracks(scene, camera, width, height, 1);
    RunOptions options;
    options.threads = 1;
    const LayerSet layers{.depth = false, .normal = false, .ids = false};
    const PixelRect whole{0, 0, width, height};
    JsonWriter json;
    json.begin_object().key("runs").value(runs).key("width").value(width).key("height").value(height);
    for (const double width_px : {1.0, 3.0}) {
        scene.lines.style.width_px = width_px;
        scene.sheet.reset();
        const PreparedScene prepared = prepare_for_abuffer(scene, 1);
        const Frame frame = make_frame(scene, camera, width, height, whole, &prepared);
        Film film(whole, whole, layers, frame.criteria.classes);
        const LineDrawing drawing = find_drawing(frame, options, film);
        std::vector<Case> cases;
        cases.push_back({"frame", [&](Film& f) { render_abuffer(frame, options, f); }, {}});
        cases.push_back({"one_look", [&](Film& f) { draw_lines(frame, drawing, options, f); }, {}});
        const auto styled = [&](Look look) {
            scene.sheet = sheet_of(look, width_px);
            auto made = std::make_shared<Styled>();
            made->frame = make_frame(scene, camera, width, height, whole, &prepared);
            Film own(whole, whole, layers, frame.criteria.classes);
            RenderStats stats;
            std::vector<std::string> notes;
            made->lines = find_styled_lines(made->frame, options, own, stats);
            made->ink = ink_lines(made->lines, *made->frame.sheet, 1, notes);
            return made;
        };
        const auto constant = styled(Look::constant), translucent = styled(Look::translucent),
                   wide = styled(Look::width), varying = styled(Look::varying);
        const auto shade = [](const Styled& s) {
            return [&s](Film&) {
                std::vector<std::string> notes;
                ink_lines(s.lines, *s.frame.sheet, 1, notes);
            };
        };
        const auto draw = [](const Styled& s) { return [&s](Film& f) { draw_ink(s.frame, s.ink, 1, f); }; };
        cases.push_back({"shade_constant", shade(*constant), {}});
        cases.push_back({"shade_varying", shade(*varying), {}});
        cases.push_back({"constant", draw(*constant), {}});
        cases.push_back({"translucent", draw(*translucent), {}});
        cases.push_back({"varying_width", draw(*wide), {}});
        cases.push_back({"varying", draw(*varying), {}});
        for (int run = -1; run < runs; ++run) {  // run -1 warms up
            for (Case& c : cases) {
                Film own = film.copy();
                const double start = thread_cpu_s();
                c.draw(own);
                if (run >= 0) c.cpu.add(thread_cpu_s() - start);
            }
        }
        json.key("width_" + std::to_string(static_cast<int>(width_px)) + "_px").begin_object();
        json.key("strokes").value(static_cast<std::uint64_t>(varying->ink.strokes.size()));
        json.key("samples").value(static_cast<std::uint64_t>(varying->ink.points.size()));
        for (const Case& c : cases) write_samples(json, c.name + "_cpu_s", c.cpu);
        const Samples &of_frame = cases[0].cpu, &of_varying = cases[7].cpu;
        Samples more;
        for (std::size_t run = 0; run < of_frame.size(); ++run) more.add(cases[3].cpu[run] - cases[2].cpu[run]);
        write_ratio(json, "expressions_per_frame", more, of_frame);
        write_ratio(json, "constant_per_one_look", cases[4].cpu, cases[1].cpu);
        write_ratio(json, "varying_width_per_constant", cases[6].cpu, cases[4].cpu);
        write_ratio(json, "varying_per_constant", of_varying, cases[4].cpu);
        write_ratio(json, "varying_per_translucent", of_varying, cases[5].cpu);
        json.end_object();
    }
    json.end_object();
    return json.text();
}

}  // namespace
}  // namespace burin::bench

int main(int argc, char** argv) {
    const int width = argc == 5 ? std::atoi(argv[2]) : 0, height = argc == 5 ? std::atoi(argv[3]) : 0;
    const int runs = argc == 5 ? std::atoi(argv[4]) : 0;
    if (width < 1 || height < 1 || runs < 1) {
        std::fputs("usage: ink_bench MODEL WIDTH HEIGHT RUNS\n", stderr);
        return 2;
    }
    burin::keep_freed_memory(2);  // as the program does
    try {
        std::fputs(burin::bench::measure(argv[1], width, height, runs).c_str(), stdout);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "ink_bench: %s\n", error.what());
        return 1;
    }
}
