// command_bench BURIN MODEL RUNS [STYLED]: what the whole command `burin render MODEL -o d.exr` costs, beside OpenMesh
// reading the same file, and `burin restyle` of the saved lines of model STYLED to a PNG of 1920 x 1080 pixels. Prints
// the JSON object of section "command": seconds of CPU time of processes (all their threads, user and system), medians
// over the runs.
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
#include <vector>

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

double burin_cpu_s(std::vector<std::string> command) {
    return process_cpu_s(command[1].c_str(), [&] {
        const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
        ::dup2(nowhere, STDOUT_FILENO);
        ::dup2(nowhere, STDERR_FILENO);
        std::vector<char*> arguments;
        for (std::string& argument : command) arguments.push_back(argument.data());
        arguments.push_back(nullptr);
        ::execv(arguments.front(), arguments.data());
        return 127;
    });
}

std::string measure_command(const std::string& burin, const std::string& model, int runs, const std::string& styled) {
    const std::string stem =
        (std::filesystem::temp_directory_path() / ("burin-bench-" + std::to_string(::getpid()))).string();
    const std::string picture = stem + ".exr", small = stem + ".png", lines = stem + ".lines";
    Samples command, openmesh, restyle;
    if (!styled.empty())
        burin_cpu_s(
            {burin, "render", styled, "-r", "1920x1080", "--style", "technical", "--save-lines", lines, "-o", small});
    for (int run = -1; run < runs; ++run) {  // run -1 warms the page cache
        const double ours = burin_cpu_s({burin, "render", model, "-o", picture});
        const double theirs = process_cpu_s("OpenMesh's read_mesh", [&] { return openmesh_read(model) > 0 ? 0 : 1; });
        const double again =
            styled.empty() ? 0 : burin_cpu_s({burin, "restyle", lines, "--style", "technical", "-o", small});
        if (run < 0) continue;
        command.add(ours);
        openmesh.add(theirs);
        restyle.add(again);
    }
    for (const std::string& file : {picture, small, lines}) std::filesystem::remove(file);
    JsonWriter json;
    json.begin_object();
    json.key("runs").value(runs);
    write_samples(json, "render_s", command);
    write_samples(json, "openmesh_read_mesh_s", openmesh);
    write_ratio(json, "ratio", command, openmesh);
    if (!styled.empty()) write_samples(json, "restyle_s", restyle);
    json.end_object();
    return json.text();
}

}  // namespace
}  // namespace burin::bench

int main(int argc, char** argv) {
    const int runs = argc == 4 || argc == 5 ? std::atoi(argv[3]) : 0;
    if (runs < 1) {
        std::fputs("usage: command_bench BURIN MODEL RUNS [STYLED]\n", stderr);
        return 2;
    }
    try {
        std::fputs(burin::bench::measure_command(argv[1], argv[2], runs, argc == 5 ? argv[4] : "").c_str(), stdout);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "command_bench: %s\n", error.what());
        return 1;
    }
}
