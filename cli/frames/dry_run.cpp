#include "cli/frames/dry_run.h"

#include <cmath>
#include <cstdio>

#include "base/json_writer.h"
#include "base/parallel.h"
#include "cli/job.h"
#include "cli/vector_output.h"
#include "scene/animation/frame_list.h"

namespace burin {
namespace {

std::string megabytes(std::uint64_t bytes) {
    return std::to_string(static_cast<std::uint64_t>(std::llround(static_cast<double>(bytes) / 1e6)));
}

}  // namespace

PictureLoad load_of(RenderJob& job, const Arguments& a) {
    PictureLoad load;
    load.layers = job.renderer().layers_of_first_frame(load.is_in_bands);
    const Scene& scene = job.renderer().scene();
    for (const Mesh& mesh : scene.meshes) load.triangles += mesh.triangles.size();
    load.objects = scene.objects.size();
    load.area = crop_of(a, scene.picture.width, scene.picture.height);
    load.classes = kLineClassCount;
    load.is_blurred = job.renderer().is_blurred();
    if (load.is_blurred) load.is_in_bands = false;
    load.format = job.outputs().front().format;
    for (const OutputOptions& output : job.outputs()) {  // what needs most
        if (output.format == OutputFormat::png || output.format == OutputFormat::tiff) load.format = output.format;
    }
    load.keeps_all_lines = draws_hidden_lines(scene) || (scene.sheet && !is_vector(load.format));
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
    const std::uint64_t bytes = is_vector(load.format) ? 0 : uncompressed_bytes(load);
    if (a.json) {
        JsonWriter json;
        json.begin_object();
        json.key("frames").value(frames.size()).key("there").value(there);
        json.key("missing").value(text_of_frames(missing));
        json.key("triangles").value(load.triangles);
        json.key("memory_bytes").begin_object();
        json.key("total").value(memory.total()).key("program").value(memory.program).key("model").value(memory.model);
        json.key("film").value(memory.film).key("method").value(memory.method);
        json.end_object();
        json.key("uncompressed_bytes_per_frame").value(bytes);
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
    std::printf("triangles %llu\n", static_cast<unsigned long long>(load.triangles));
    std::printf("memory %s MB (program %s, model %s, film %s, method %s)\n", megabytes(memory.total()).c_str(),
                megabytes(memory.program).c_str(), megabytes(memory.model).c_str(), megabytes(memory.film).c_str(),
                megabytes(memory.method).c_str());
    if (bytes > 0) std::printf("frame %s MB before compression\n", megabytes(bytes).c_str());
}

}  // namespace burin
