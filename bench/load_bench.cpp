// load_bench MODEL.ply RUNS: what it costs to read a model and link its edges, beside OpenMesh.
// Prints the JSON object of section "load": seconds of CPU time of one thread, medians over the
// runs. In each run the model is loaded on each of two cores first, and both are measured on the faster one.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>

#include "base/heap.h"
#include "base/json_writer.h"
#include "bench/cores.h"
#include "bench/openmesh_read.h"
#include "bench/statistics.h"
#include "mesh/build_meshes.h"
#include "mesh/readers.h"

namespace burin::bench {
namespace {

double load_s(const std::string& path, const cpu_set_t& core) {
    const OnCore here(core);
    const double start = thread_cpu_s();
    build_meshes(read_ply(path), {});
    return thread_cpu_s() - start;
}

std::string measure_loading(const std::string& path, int runs) {
    Samples read, build, ours, theirs;
    std::size_t triangles = 0, openmesh_faces = 0;
    const std::vector<cpu_set_t> cores = two_cores();
    for (int run = -1; run < runs; ++run) {  // run -1 warms the page cache
        std::optional<OnCore> here;
        if (!cores.empty()) {
            const double first_s = load_s(path, cores[0]), second_s = load_s(path, cores[1]);
            here.emplace(second_s < first_s ? cores[1] : cores[0]);
        }
        const double start = thread_cpu_s();
        PolygonSoup soup = read_ply(path);
        const double middle = thread_cpu_s();
        std::vector<Mesh> meshes = build_meshes(std::move(soup), {});
        const double end = thread_cpu_s();
        triangles = meshes.front().triangles.size();
        meshes.clear();
        const double openmesh_start = thread_cpu_s();
        openmesh_faces = openmesh_read(path);
        const double openmesh_end = thread_cpu_s();
        if (run < 0) continue;
        read.add(middle - start);
        build.add(end - middle);
        ours.add(end - start);
        theirs.add(openmesh_end - openmesh_start);
    }
    JsonWriter json;
    json.begin_object();
    json.key("runs").value(runs);
    json.key("triangles").value(std::uint64_t{triangles});
    json.key("openmesh_faces").value(std::uint64_t{openmesh_faces});
    write_samples(json, "read_s", read);
    write_samples(json, "build_s", build);
    write_samples(json, "load_s", ours);
    write_samples(json, "openmesh_read_mesh_s", theirs);
    write_ratio(json, "ratio", ours, theirs);
    json.end_object();
    return json.text();
}

}  // namespace
}  // namespace burin::bench

int main(int argc, char** argv) {
    const int runs = argc == 3 ? std::atoi(argv[2]) : 0;
    if (runs < 1) {
        std::fputs("usage: load_bench MODEL.ply RUNS\n", stderr);
        return 2;
    }
    burin::keep_freed_memory(1);  // as the program does
    try {
        std::fputs(burin::bench::measure_loading(argv[1], runs).c_str(), stdout);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "load_bench: %s\n", error.what());
        return 1;
    }
}
