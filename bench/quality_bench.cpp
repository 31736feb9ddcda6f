// quality_bench [--engine] SCENES_FOLDER [MODEL...]: how near lines of the method abuffer come to
// the truth, which is the method reference with very many samples. Prints the JSON object of
// section "quality".
// --engine adds the CAD engine at 960 x 540, which takes minutes.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "abuffer/screen/sampling.h"
#include "base/json_writer.h"
#include "bench/supersampled_lines.h"
#include "compare/chart_metrics.h"
#include "compare/metrics_error.h"
#include "compare/metrics_temporal.h"
#include "compare/moving_frames.h"
#include "compare/test_chart.h"
#include "methods/method_table.h"
#include "scene/scene_description.h"

namespace burin::bench {
namespace {

const Method& abuffer() { return *find_method("abuffer"); }
const Method& reference() { return *find_method("reference"); }

ComparedView view_of(const Scene& scene, int width, int height) {
    ComparedView view;
    view.width = width;
    view.height = height;
    view.crop = {0, 0, width, height};
    view.camera = resolve_camera(scene.cameras.front(), scene_points(scene), static_cast<double>(width) / height);
    return view;
}

Plane lines_of(const Method& method, const Scene& scene, const ComparedView& view) {
    return render_lines(method, scene, view, {}).coverage;
}

Plane truth_of(Scene& scene, const ComparedView& view, int samples) {
    scene.reference.samples = samples;
    return lines_of(reference(), scene, view);
}

/// Compares one picture with its truth of `samples` x `samples` per pixel.
void measure_picture(JsonWriter& json, const std::string& name, Scene& scene, const ComparedView& view, double width_px,
                     int samples) {
    scene.lines.style.width_px = width_px;
    const Plane result = lines_of(abuffer(), scene, view), truth = truth_of(scene, view, samples);
    json.begin_object().key("scene").value(name).key("width_px").value(width_px);
    json.key("truth_samples").value(samples);
    const auto optional = [&](const char* key, const std::optional<double>& value) {
        json.key(key);
        value ? json.value(*value) : json.null();
    };
    const auto error = coverage_error(result, truth);
    const auto mass = line_mass(result, truth);
    optional("psnr_db", error ? error->psnr_db : std::nullopt);
    optional("psnr98_db", error ? error->psnr98_db : std::nullopt);
    optional("missed", mass ? std::optional(mass->missed) : std::nullopt);
    optional("false", mass ? std::optional(mass->invented) : std::nullopt);
    json.end_object();
}

/// Lines of the chart's star, one per degree.
void measure_widths(JsonWriter& json, double width_px) {
    TestChart chart = make_test_chart(width_px);
    chart.scene.lines.classes = chart_classes(abuffer().draws);
    chart.scene.lines.style.width_px = width_px;
    const ComparedView view{chart.camera, chart.width, chart.height, {0, 0, chart.width, chart.height}};
    const Plane coverage = lines_of(abuffer(), chart.scene, view);
    std::vector<double> widths;
    for (const Segment& line : chart.star) widths.push_back(mean_of(widths_along(coverage, line, chart.reach_px)));
    const auto [least, most] = std::minmax_element(widths.begin(), widths.end());
    json.begin_object().key("asked_px").value(width_px).key("mean_px").value(mean_of(widths));
    json.key("smallest_px").value(*least).key("largest_px").value(*most);
    json.key("largest_per_smallest").value(*most / *least).end_object();
}

/// Measures the busiest part of a picture while the camera moves by 1/32 pixel per frame, beside what plain
/// supersampling with 16 x 16 samples makes of it. The truth is the method reference with 32 x 32.
void measure_motion(JsonWriter& json, const std::string& name, Scene& scene, const ComparedView& still) {
    constexpr int kFrames = 32, kPart = 48;
    const PixelRect part = busiest_part(lines_of(abuffer(), scene, still), still.crop, kPart, kPart);
    std::vector<Plane> results, plain, truths;
    for (int j = 0; j < kFrames; ++j) {
        ComparedView view = moved_view(scene, still, j);
        view.crop = part;
        results.push_back(lines_of(abuffer(), scene, view));
        plain.push_back(supersampled_lines(scene, view, 16));
        truths.push_back(truth_of(scene, view, 32));
    }
    const auto ours = flicker(results, truths), sampled = flicker(plain, truths);
    if (!ours || !sampled) return;
    json.begin_object().key("scene").value(name);
    json.key("flicker_sd").value(ours->flicker_sd).key("supersampled_16_flicker_sd").value(sampled->flicker_sd);
    json.key("ratio").value(ours->flicker_sd / sampled->flicker_sd);
    json.key("largest_pop").value(ours->pop).key("supersampled_16_largest_pop").value(sampled->pop).end_object();
}

std::string measure_quality(const std::string& scenes, const std::vector<std::string>& models, bool has_engine) {
    const auto load = [&](const std::string& name) {
        return load_scene(read_scene_file(scenes + "/" + name + ".toml", {}));
    };
    constexpr int kSize = 160;
    Scene star = load("star"), crossing = load("crossing"), teapot = load("teapot");
    const ComparedView star_view = view_of(star, kSize, kSize), crossing_view = view_of(crossing, kSize, kSize);
    JsonWriter json;
    json.begin_object();
    json.key("samples_per_pixel")
        .value(samples_per_pixel_of(make_frame(star, star_view.camera, kSize, kSize, star_view.crop)));
    json.key("pictures").begin_array();
    for (const double width_px : {1.0, 0.3, 3.0}) measure_picture(json, "star", star, star_view, width_px, 64);
    measure_picture(json, "star", star, star_view, 12, 16);
    measure_picture(json, "crossing", crossing, crossing_view, 1, 64);
    measure_picture(json, "teapot", teapot, view_of(teapot, kSize, kSize), 1, 64);
    for (const std::string& model : models) {
        Scene scene = load_scene(bare_model_scene(model, {}));
        measure_picture(json, std::filesystem::path(model).filename().string(), scene, view_of(scene, kSize, kSize), 1,
                        64);
    }
    if (has_engine) {
        Scene engine = load("engine");
        measure_picture(json, "engine", engine, view_of(engine, 960, 540), 1, 32);
    }
    json.end_array();
    json.key("widths").begin_array();
    for (const double width_px : {0.3, 1.0, 3.0, 12.0}) measure_widths(json, width_px);
    json.end_array();
    json.key("motion").begin_array();
    star.lines.style.width_px = crossing.lines.style.width_px = 1;
    measure_motion(json, "star", star, star_view);
    measure_motion(json, "crossing", crossing, crossing_view);
    json.end_array().end_object();
    return json.text();
}

}  // namespace
}  // namespace burin::bench

int main(int argc, char** argv) {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    const bool has_engine = !arguments.empty() && arguments.front() == "--engine";
    if (has_engine) arguments.erase(arguments.begin());
    if (arguments.empty()) {
        std::fputs("usage: quality_bench [--engine] SCENES_FOLDER [MODEL...]\n", stderr);
        return 2;
    }
    try {
        const std::string scenes = arguments.front();
        arguments.erase(arguments.begin());
        const std::string text = burin::bench::measure_quality(scenes, arguments, has_engine);
        std::fputs(text.c_str(), stdout);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "quality_bench: %s\n", error.what());
        return 1;
    }
}
