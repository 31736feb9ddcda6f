// frame_bench MODEL WIDTH HEIGHT RUNS [scaling]: what frames of the method abuffer cost, beside
// Embree's primary rays. Prints the JSON object of section "frame": seconds of CPU time of this
// process (of all its threads) or, where a name says so, of wall time; medians over the runs.
//
// The camera fits the model to 95 % of the frame, at a vertical field of view of 35 degrees. With
// "scaling" also a frame of four times the pixels, and one of four times the triangles.
//
// Cores of a shared machine are often not equally fast. In each run, one thread draws on each of two first; what else
// takes one thread, E too, is then measured on the faster one ("stages" excepted, which have a process of their own).
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "abuffer/edges/intersecting_pairs.h"
#include "base/heap.h"
#include "base/json_writer.h"
#include "base/stopwatch.h"
#include "bench/cores.h"
#include "bench/embree_view.h"
#include "bench/statistics.h"
#include "mesh/build_meshes.h"
#include "methods/abuffer.h"
#include "output/film_files.h"
#include "render/close_cracks.h"
#include "scene/scene_description.h"

namespace burin::bench {
namespace {

// What a PNG needs, and what an EXR gets unless asked otherwise.
const LayerSet kLinesAndFill{.depth = false, .normal = false, .ids = false};
const LayerSet kAllLayers{};

/// Cuts each triangle into four, at the middles of its sides.
void quarter(Mesh& mesh) {
    PolygonSoup soup;
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::dvec3 p = mesh.position(a), q = mesh.position(b), r = mesh.position(c);
        const glm::dvec3 pq = 0.5 * (p + q), qr = 0.5 * (q + r), rp = 0.5 * (r + p);
        soup.positions.insert(soup.positions.end(), {p, pq, rp, pq, q, qr, rp, qr, r, pq, qr, rp});
    }
    for (std::uint32_t i = 0; i < soup.positions.size(); ++i) soup.corners.push_back(i);
    soup.object_names = {mesh.name};
    mesh = std::move(build_meshes(soup, {}).front());
}

/// A model, ready to be drawn.
struct View {
    Scene scene;
    PreparedScene prepared;
    Frame frame, frame_with_hidden;  ///< without hidden lines, and with: a frame says which lines are found

    View(const std::string& model, int width, int height, bool has_quarters = false)
        : scene(load_scene(bare_model_scene(model, {}))) {
        for (Mesh& mesh : scene.meshes) {
            if (has_quarters) quarter(mesh);
        }
        CameraSettings settings;
        settings.fov_deg = 35;
        settings.fit = 0.95;
        const Camera camera = resolve_camera(settings, scene_points(scene), static_cast<double>(width) / height);
        close_cracks(scene, camera, width, height, 1);
        prepared = prepare_for_abuffer(scene, 1);
        const auto frame_of = [&](HiddenStyle hidden) {
            scene.lines.style.hidden.style = hidden;
            return make_frame(scene, camera, width, height, {0, 0, width, height}, &prepared);
        };
        frame_with_hidden = frame_of(HiddenStyle::solid);
        frame = frame_of(HiddenStyle::none);
    }
    View(const View&) = delete;  // the frame points into the scene
    View& operator=(const View&) = delete;

    Film film(const LayerSet& layers) const { return {frame.crop, frame.crop, layers, frame.criteria.classes}; }
};

// ---- stages of the whole way from a file to a file, in a process of its own ----

constexpr std::array<const char*, 8> kStageNames = {"load",  "prepare", "raster", "resolve",
                                                    "lines", "shade",   "write",  "fragments"};
using Stages = std::array<double, kStageNames.size()>;

Stages run_stages(const std::string& model, int width, int height, const std::string& picture) {
    Stopwatch watch;
    const View view(model, width, height);
    const double load_s = watch.lap();
    RunOptions options;
    options.threads = 1;
    Film film = view.film(kAllLayers);
    const RenderStats stats = render_abuffer(view.frame, options, film);
    watch.lap();
    OutputOptions output;
    output.path = picture;
    write_output(view.frame, film, output);
    return {load_s,        stats.prepare_s, stats.raster_s, stats.resolve_s,
            stats.lines_s, stats.shade_s,   watch.lap(),    static_cast<double>(stats.fragments)};
}

/// Calls work() in a process of its own. Returns what it returned, and the process's peak memory in bytes.
std::pair<Stages, double> in_process(const std::function<Stages()>& work) {
    int pipe_ends[2];
    std::fflush(nullptr);
    if (::pipe(pipe_ends) != 0) throw std::runtime_error("cannot open a pipe");
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("cannot start a process");
    if (child == 0) {
        const Stages stages = work();
        ::_exit(::write(pipe_ends[1], &stages, sizeof stages) == sizeof stages ? 0 : 1);
    }
    ::close(pipe_ends[1]);
    Stages stages{};
    const bool is_read = ::read(pipe_ends[0], &stages, sizeof stages) == sizeof stages;
    ::close(pipe_ends[0]);
    rusage usage{};
    if (::wait4(child, nullptr, 0, &usage) != child || !is_read) throw std::runtime_error("a run of all stages failed");
    return {stages, 1024.0 * static_cast<double>(usage.ru_maxrss)};
}

void write_stages(JsonWriter& json, const std::string& model, int width, int height, int runs) {
    const std::string picture =
        (std::filesystem::temp_directory_path() / ("burin-bench-" + std::to_string(::getpid()) + ".exr")).string();
    std::array<Samples, kStageNames.size()> stages;
    Samples peak;
    for (int run = 0; run < runs; ++run) {
        const auto [times, bytes] = in_process([&] { return run_stages(model, width, height, picture); });
        for (std::size_t i = 0; i < stages.size(); ++i) stages[i].add(times[i]);
        peak.add(bytes);
    }
    std::filesystem::remove(picture);
    json.key("stages").begin_object();
    for (std::size_t i = 0; i + 1 < stages.size(); ++i) {
        write_samples(json, std::string(kStageNames[i]) + "_wall_s", stages[i]);
    }
    json.key("fragments").value(static_cast<std::uint64_t>(stages.back().median()));
    json.key("peak_bytes").value(static_cast<std::uint64_t>(peak.median()));
    json.end_object();
}

// ---- frames against Embree ----

/// Something that is timed once in every run.
struct Case {
    const char* name;
    std::function<void()> work;
    bool takes_one_thread = true;
    Samples cpu, wall;
};

double process_cpu_s() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void run_case(Case& c, bool counts) {
    const Stopwatch watch;
    const double start = process_cpu_s();
    c.work();
    if (!counts) return;
    c.cpu.add(process_cpu_s() - start);
    c.wall.add(watch.seconds());
}

/// What a frame has if nothing else is asked for.
constexpr std::optional<int> kDefault;

/// Draws a view with some settings.
std::function<void()> drawing(View& view, Film& film, std::optional<int> samples, int threads = 1,
                              HiddenStyle hidden = HiddenStyle::none) {
    return [&view, &film, samples, threads, hidden] {
        view.scene.abuffer.samples = samples;
        view.scene.lines.style.hidden.style = hidden;
        RunOptions options;
        options.threads = threads;
        render_abuffer(hidden == HiddenStyle::none ? view.frame : view.frame_with_hidden, options, film);
    };
}

std::function<void()> on_core(const cpu_set_t& core, std::function<void()> work) {
    return [core, work = std::move(work)] {
        const OnCore here(core);
        work();
    };
}

/// How often as fast two threads are as one is on average, where there are just two cores, equally fast or not: with
/// the times of one thread on each of them, what both together could do takes 1 / (1 / a + 1 / b). CPU times, for a
/// thread that may not leave its core waits where something else runs there.
void write_speed_up(JsonWriter& json, const std::string& name, const Samples& a, const Samples& b, const Samples& two) {
    Samples speed_ups;
    for (std::size_t run = 0; run < two.size(); ++run) speed_ups.add(2 / (1 / a[run] + 1 / b[run]) / two[run]);
    write_samples(json, name, speed_ups);
}

std::string measure_frames(const std::string& model, int width, int height, int runs, bool has_scaling) {
    JsonWriter json;
    json.begin_object().key("runs").value(runs);
    json.key("width").value(width).key("height").value(height);
    write_stages(json, model, width, height, runs);

    View view(model, width, height);
    const EmbreeView embree(view.frame);
    Film picture = view.film(kLinesAndFill), layers = view.film(kAllLayers);
    std::size_t hits = 0;
    std::vector<Case> cases;
    const auto add = [&](const char* name, std::function<void()> work, bool takes_one_thread = true) {
        cases.push_back({name, std::move(work), takes_one_thread, {}, {}});
    };
    const std::vector<cpu_set_t> cores = two_cores();
    if (!cores.empty()) {
        add("samples_2_first_core", on_core(cores[0], drawing(view, picture, 2)), false);
        add("samples_2_second_core", on_core(cores[1], drawing(view, picture, 2)), false);
        add("default_first_core", on_core(cores[0], drawing(view, picture, kDefault)), false);
        add("default_second_core", on_core(cores[1], drawing(view, picture, kDefault)), false);
    }
    add("E", [&] { hits = embree.trace(); });
    add("samples_2", drawing(view, picture, 2));
    add("default", drawing(view, picture, kDefault));
    add("samples_4", drawing(view, picture, 4));
    add("samples_2_all_layers", drawing(view, layers, 2));
    add("default_all_layers", drawing(view, layers, kDefault));
    add("samples_2_two_threads", drawing(view, picture, 2, 2), false);
    add("default_two_threads", drawing(view, picture, kDefault, 2), false);
    // Frames in a row are those of a sequence: what the frame before left in the caches is still there.
    constexpr int kInARow = 10;
    const auto in_a_row = [](const std::function<void()>& work) {
        return [work] {
            for (int i = 0; i < kInARow; ++i) work();
        };
    };
    add("samples_2_ten_in_a_row", in_a_row(drawing(view, picture, 2, 2)), false);
    add("default_ten_in_a_row", in_a_row(drawing(view, picture, kDefault, 2)), false);
    // Pairs are searched once per scene, for any number of frames; "searched" is a frame that searches for itself.
    add("prepare_hidden",
        [&view] { view.prepared.intersecting_pairs = find_intersecting_pairs(view.scene, best_kernels(), 1); });
    add("hidden_solid", drawing(view, picture, kDefault, 1, HiddenStyle::solid));
    const auto searched = drawing(view, picture, kDefault, 1, HiddenStyle::solid);
    add("hidden_solid_searched", [&view, searched] {
        std::optional<std::vector<SurfacePair>> kept;
        kept.swap(view.prepared.intersecting_pairs);
        searched();
        kept.swap(view.prepared.intersecting_pairs);
    });
    std::unique_ptr<View> large, fine;
    std::unique_ptr<Film> large_film;
    if (has_scaling) {
        large = std::make_unique<View>(model, 2 * width, 2 * height);
        large_film = std::make_unique<Film>(large->film(kLinesAndFill));
        fine = std::make_unique<View>(model, width, height, true);
        add("pixels_x4", drawing(*large, *large_film, kDefault));
        add("triangles_x4", drawing(*fine, picture, kDefault));
    }
    const auto named = [&](const std::string& name) -> const Case& {
        for (const Case& c : cases) {
            if (name == c.name) return c;
        }
        throw std::logic_error(name);
    };
    const auto faster_core = [&](std::size_t run) {
        const auto time = [&](const char* name) { return named(name).cpu[run]; };
        const bool is_second = time("samples_2_second_core") + time("default_second_core") <
                               time("samples_2_first_core") + time("default_first_core");
        return cores[is_second ? 1 : 0];
    };
    for (int run = -1; run < runs; ++run) {  // run -1 warms up
        for (Case& c : cases) {
            std::optional<OnCore> here;
            if (run >= 0 && c.takes_one_thread && !cores.empty())
                here.emplace(faster_core(static_cast<std::size_t>(run)));
            run_case(c, run >= 0);
        }
    }
    json.key("triangles").value(view.frame.surfaces.triangle_count());
    json.key("covered_pixels").value(static_cast<std::uint64_t>(hits));
    for (const Case& c : cases) {
        json.key(c.name).begin_object();
        write_samples(json, "cpu_s", c.cpu);
        write_samples(json, "wall_s", c.wall);
        write_ratio(json, "per_E", c.cpu, named("E").cpu);
        json.end_object();
    }
    const auto ratio = [&](const char* name, const Samples& a, const Samples& b) { write_ratio(json, name, a, b); };
    for (const std::string what : {"samples_2", "default"}) {
        const Samples& one = named(what).wall;
        write_speed_up(json, "one_thread_per_two_wall_" + what, cores.empty() ? one : named(what + "_first_core").cpu,
                       cores.empty() ? one : named(what + "_second_core").cpu, named(what + "_two_threads").wall);
        write_ratio(json, "faster_core_per_two_wall_" + what, one, named(what + "_two_threads").wall);
        Samples per_s;
        const Samples& in_a_row_s = named(what + "_ten_in_a_row").wall;
        for (std::size_t run = 0; run < in_a_row_s.size(); ++run) per_s.add(kInARow / in_a_row_s[run]);
        write_samples(json, "two_threads_frames_per_s_" + what, per_s);
    }
    if (has_scaling) {
        ratio("pixels_x4_per_one", named("pixels_x4").cpu, named("default").cpu);
        ratio("triangles_x4_per_one", named("triangles_x4").cpu, named("default").cpu);
    }
    json.end_object();
    return json.text();
}

}  // namespace
}  // namespace burin::bench

int main(int argc, char** argv) {
    const bool has_scaling = argc == 6 && std::strcmp(argv[5], "scaling") == 0;
    const int width = argc >= 5 ? std::atoi(argv[2]) : 0, height = argc >= 5 ? std::atoi(argv[3]) : 0;
    const int runs = argc >= 5 ? std::atoi(argv[4]) : 0;
    if ((argc != 5 && !has_scaling) || width < 1 || height < 1 || runs < 1) {
        std::fputs("usage: frame_bench MODEL WIDTH HEIGHT RUNS [scaling]\n", stderr);
        return 2;
    }
    burin::keep_freed_memory(2);  // as the program does
    try {
        std::fputs(burin::bench::measure_frames(argv[1], width, height, runs, has_scaling).c_str(), stdout);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "frame_bench: %s\n", error.what());
        return 1;
    }
}
