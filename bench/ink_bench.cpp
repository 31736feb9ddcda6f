// ink_bench MODEL WIDTH HEIGHT RUNS: what it costs to draw the lines of a frame with looks, beside drawing them with
// one. Prints the JSON object of section "ink": seconds of CPU time of one thread, medians over the runs.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/heap.h"
#include "base/json_writer.h"
#include "bench/statistics.h"
#include "methods/abuffer.h"
#include "render/close_cracks.h"
#include "scene/scene_description.h"
#include "strokes/ink_printer.h"

namespace burin::bench {
namespace {

enum class Look { constant, translucent, varying };

/// Numbers for pieces, equal for those that hang together.
class Chains {
  public:
    std::uint64_t chain_of(const LinePiece& piece) {
        std::uint64_t& from = ends_.try_emplace({piece.from.x, piece.from.y}, ends_.size()).first->second;
        return ends_.try_emplace({piece.to.x, piece.to.y}, from).first->second = from;
    }

  private:
    std::map<std::pair<double, double>, std::uint64_t> ends_;
};

/// The visible lines as strokes.
InkedLines inked(const LineDrawing& drawing, const LineStyle& style, Look look) {
    InkedLines lines;
    Chains chains;
    for (const auto& list : drawing.visible()) {
        for (const LinePiece& piece : list) {
            InkOrder order;
            order.drawn_as = piece.drawn_as;
            if (piece.occludes)
                lines.boundaries.push_back({piece.from, piece.to, piece.nearness_from, piece.nearness_to,
                                            piece.front_on_left, order, piece.is_drawn});
            if (!piece.is_drawn) continue;
            InkStroke stroke;
            stroke.first_point = lines.points.size();
            stroke.point_count = 2;
            stroke.order = order;
            stroke.chain = chains.chain_of(piece);
            stroke.is_constant = look != Look::varying;
            InkPoint point;
            point.occludes = piece.occludes;
            point.front_on_left = piece.front_on_left;
            const auto add = [&](glm::dvec2 place, float nearness) {
                // Evenly from one place to another, as a look that depends on depth or light.
                const auto wave = static_cast<float>(0.5 + 0.5 * std::sin(0.05 * (place.x + place.y)));
                point.place = place;
                point.nearness = nearness;
                point.width_px = static_cast<float>(style.width_px) * (look == Look::varying ? 0.6f + 0.8f * wave : 1);
                point.opacity = look == Look::constant ? 1 : look == Look::translucent ? 0.5f : 0.5f + 0.5f * wave;
                point.color = glm::vec3(look == Look::varying ? 0.3f * wave : 0);
                lines.points.push_back(point);
            };
            add(piece.from, piece.nearness_from);
            add(piece.to, piece.nearness_to);
            lines.strokes.push_back(stroke);
        }
    }
    return lines;
}

struct Case {
    std::string name;
    std::function<void(Film&)> draw;
    Samples cpu;
};

std::string measure(const std::string& model, int width, int height, int runs) {
    Scene scene = load_scene(bare_model_scene(model, {}));
    CameraSettings settings;
    settings.fov_deg = 35;
    settings.fit = 0.95;
    const Camera camera = resolve_camera(settings, scene_points(scene), static_cast<double>(width) / height);
    close_cracks(scene, camera, width, height, 1);
    JsonWriter json;
    json.begin_object().key("runs").value(runs).key("width").value(width).key("height").value(height);
    for (const double width_px : {1.0, 3.0}) {
        scene.lines.style.width_px = width_px;
        const PreparedScene prepared = prepare_for_abuffer(scene, 1);
        const Frame frame = make_frame(scene, camera, width, height, {0, 0, width, height}, &prepared);
        RunOptions options;
        options.threads = 1;
        const LayerSet layers{.depth = false, .normal = false, .ids = false};
        Film film(frame.crop, frame.crop, layers, frame.criteria.classes);
        const LineDrawing drawing = find_drawing(frame, options, film);
        const InkedLines constant = inked(drawing, scene.lines.style, Look::constant),
                         translucent = inked(drawing, scene.lines.style, Look::translucent),
                         varying = inked(drawing, scene.lines.style, Look::varying);
        std::vector<Case> cases;
        cases.push_back({"one_look", [&](Film& f) { draw_lines(frame, drawing, options, f); }, {}});
        cases.push_back({"constant", [&](Film& f) { draw_ink(frame, constant, 1, f); }, {}});
        cases.push_back({"translucent", [&](Film& f) { draw_ink(frame, translucent, 1, f); }, {}});
        cases.push_back({"varying", [&](Film& f) { draw_ink(frame, varying, 1, f); }, {}});
        for (int run = -1; run < runs; ++run) {  // run -1 warms up
            for (Case& c : cases) {
                Film own = film.copy();
                const double start = thread_cpu_s();
                c.draw(own);
                if (run >= 0) c.cpu.add(thread_cpu_s() - start);
            }
        }
        json.key("width_" + std::to_string(static_cast<int>(width_px)) + "_px").begin_object();
        json.key("strokes").value(static_cast<std::uint64_t>(constant.strokes.size()));
        for (const Case& c : cases) write_samples(json, c.name + "_cpu_s", c.cpu);
        write_ratio(json, "constant_per_one_look", cases[1].cpu, cases[0].cpu);
        write_ratio(json, "varying_per_constant", cases[3].cpu, cases[1].cpu);
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
