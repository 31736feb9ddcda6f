// command_bench BURIN MODEL RUNS: what the whole command `burin render MODEL -o d.exr` costs,
// beside OpenMesh reading the same file. Prints the JSON object of section "command": seconds of
// CPU time of processes (all their threads, user and system), medians over the runs.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "base/json_writer.h"
#include "bench/openmesh_read.h"
#include "bench/statistics.h"

namespace burin::bench {
namespace {

double seconds(const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); }

/// CPU time of a process that does `work`, which returns its exit status.
template <typename Work>
double process_cpu_s(const char* what, const Work& work) {
    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("cannot start a process");
    if (child == 0) ::_exit(work());
    int status = 0;
    rusage usage{};
    if (::wait4(child, &status, 0, &usage) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw std::runtime_error(std::string(what) + " failed");
    }
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string measure_command(const std::string& burin, const std::string& model, int runs) {
    const std::string picture =
        (std::filesystem::temp_directory_path() / ("burin-bench-" + std::to_string(::getpid()) + ".exr")).string();
    Samples command, openmesh;
    for (int run = -1; run < runs; ++run) {  // run -1 warms the page cache
        const double ours = process_cpu_s("burin render", [&] {
            const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
            ::dup2(nowhere, STDOUT_FILENO);
            ::dup2(nowhere, STDERR_FILENO);
            ::execl(burin.c_str(), "burin", "render", model.c_str(), "-o", picture.c_str(), nullptr);
            return 127;
        });
        const double theirs = process_cpu_s("OpenMesh's read_mesh", [&] { return openmesh_read(model) > 0 ? 0 : 1; });
        if (run < 0) continue;
        command.add(ours);
        openmesh.add(theirs);
    }
    std::filesystem::remove(picture);
    JsonWriter json;
    json.begin_object();
    json.key("runs").value(runs);
    write_samples(json, "render_s", command);
    write_samples(json, "openmesh_read_mesh_s", openmesh);
    write_ratio(json, "ratio", command, openmesh);
    json.end_object();
    return json.text();
}

}  // namespace
}  // namespace burin::bench

int main(int argc, char** argv) {
    const int runs = argc == 4 ? std::atoi(argv[3]) : 0;
    if (runs < 1) {
        std::fputs("usage: command_bench BURIN MODEL RUNS\n", stderr);
        return 2;
    }
    try {
        std::fputs(burin::bench::measure_command(argv[1], argv[2], runs).c_str(), stdout);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "command_bench: %s\n", error.what());
        return 1;
    }
}
