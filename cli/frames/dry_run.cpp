#include "cli/frames/dry_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "base/json_writer.h"
#include "base/parallel.h"
#include "cli/job.h"
#include "cli/vector_output.h"
#include "scene/animation/frame_list.h"

namespace burin {
namespace {

/// In megabytes; what is less than ten of them has one digit behind the point, and what is less than one, in kilobytes.
std::string rounded_size(std::uint64_t bytes) {
    constexpr std::uint64_t kMega = 1'000'000, kKilo = 1'000;
    if (bytes < kMega) return std::to_string((bytes + kKilo - 1) / kKilo) + " kB";
    if (bytes >= 10 * kMega) return std::to_string((bytes + kMega / 2) / kMega) + " MB";
    const std::uint64_t tenths = (bytes + kMega / 20) / (kMega / 10);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " MB";
}

/// In megabytes, without a unit.
std::string megabytes(std::uint64_t bytes) {
    return std::to_string(static_cast<std::uint64_t>(std::llround(static_cast<double>(bytes) / 1e6)));
}

/// How many files all frames have.
std::uint64_t file_count(const FramePlan& plan) {
    return plan.frames.size() * (plan.outputs.size() + (plan.lines ? 1 : 0));
}

}  // namespace

PictureLoad load_of(RenderJob& job, const Arguments& a) {
    const FrameRenderer::Outlook outlook = job.renderer().outlook();
    PictureLoad load;
    load.layers = outlook.layers;
    load.is_in_bands = outlook.is_in_bands;
    load.finishes_in_bands = outlook.finishes_in_bands;
    load.covered = outlook.covered;
    load.sub_frames = outlook.sub_frames;
    load.pieces = outlook.pieces;
    load.least_cap_bytes = outlook.least_cap_bytes;
    const Scene& scene = job.renderer().scene();
    for (const Mesh& mesh : scene.meshes) load.triangles += mesh.triangles.size();
    for (const SceneObject& object : scene.objects) load.placed_triangles += scene.meshes[object.mesh].triangles.size();
    load.objects = scene.objects.size();
    load.area = crop_of(a, scene.picture.width, scene.picture.height);
    load.classes = kLineClassCount;
    load.has_flat = std::any_of(job.outputs().begin(), job.outputs().end(),
                                [](const OutputOptions& output) { return !output.is_deep; });
    load.format = job.outputs().front().format;
    for (const OutputOptions& output : job.outputs()) {  // what needs most
        if (output.format == OutputFormat::png || output.format == OutputFormat::tiff) load.format = output.format;
    }
    load.keeps_all_lines = draws_hidden_lines(scene) || (scene.sheet && !is_vector(load.format));
    load.finds_all = a.finds_all;
    load.saves_surface = a.saves_surface;
    load.has_regions = is_vector(load.format) && draws_regions(scene, a);
    load.threads = resolve_thread_count(a.threads);
    load.cap_bytes = a.memory_bytes;
    load.frames_at_once = job.plan().frames.size() > 1 && load.threads > 1 ? 2 : 1;
    return load;
}

void tell_dry_run(RenderJob& job, const Arguments& a) {
    const std::vector<double>& frames = job.plan().frames;
    const std::vector<double> missing = job.missing_frames();
    const PictureLoad load = load_of(job, a);
    const MemoryForecast memory = forecast_memory(load);
    const std::size_t there = frames.size() - missing.size();
    const std::uint64_t bytes = uncompressed_bytes(load), deep = deep_bytes(load);
    if (a.json) {
        JsonWriter json;
        json.begin_object();
        json.key("frames").value(frames.size()).key("there").value(there);
        json.key("missing").value(text_of_frames(missing));
        json.key("files").value(file_count(job.plan()));
        json.key("sub_frames").value(load.sub_frames).key("pieces").value(load.pieces);
        json.key("triangles").value(load.triangles);
        json.key("memory_bytes").begin_object();
        json.key("total").value(memory.total()).key("program").value(memory.program).key("model").value(memory.model);
        json.key("film").value(memory.film).key("blur").value(memory.blur).key("method").value(memory.method);
        json.key("least").value(memory.least);
        json.end_object();
        json.key("uncompressed_bytes_per_frame").value(bytes);
        json.key("deep_bytes_per_frame").value(deep);
        json.end_object();
        std::printf("%s", json.text().c_str());
        return;
    }
    if (a.skips_existing) {
        std::printf("frames %zu (%zu there)\n", frames.size(), there);
        if (!missing.empty()) std::printf("missing %s\n", text_of_frames(missing).c_str());
    } else {
        std::printf("frames %zu\n", frames.size());
    }
    std::printf("files %llu\nsub-frames %d\npieces %zu\n", static_cast<unsigned long long>(file_count(job.plan())),
                load.sub_frames, load.pieces);
    std::printf("triangles %llu\n", static_cast<unsigned long long>(load.triangles));
    std::string parts = "program " + megabytes(memory.program) + ", model " + megabytes(memory.model) + ", film " +
                        megabytes(memory.film) + ", blur " + megabytes(memory.blur) + ", method " +
                        megabytes(memory.method);
    if (memory.least > 0) parts += "; least " + megabytes(memory.least);
    std::printf("memory %s MB (%s)\n", megabytes(memory.total()).c_str(), parts.c_str());
    if (bytes > 0) std::printf("frame %s before compression\n", rounded_size(bytes).c_str());
    if (deep > 0) std::printf("deep %s before compression\n", rounded_size(deep).c_str());
}

}  // namespace burin
