#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/commands.h"
#include "cli/farm/memory_forecast.h"
#include "cli/farm/slurm_scripts.h"
#include "cli/frames/dry_run.h"
#include "cli/frames/render_job.h"
#include "cli/job.h"
#include "compare/run_program.h"
#include "scene/animation/frame_list.h"

namespace burin {
namespace {

constexpr std::size_t kMostTasks = 1000;  // Slurm's MaxArraySize is 1001 unless its administrator says otherwise
constexpr int kRowsOfChunk = 16;          // that an EXR compresses together

std::string path_of_program() {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", error);
    return error ? "burin" : path.string();
}

/// The name of a band's files: ".bandN" before the suffix.
std::string band_name(const std::string& path, std::size_t band) {
    const std::string suffix = std::filesystem::path(path).extension().string();
    return path.substr(0, path.size() - suffix.size()) + ".band" + std::to_string(band + 1) + suffix;
}

/// Bands of rows, nearly equal in height; each but the first begins with a chunk of the EXR.
std::vector<FarmBand> bands_of(const Arguments& a, PixelRect area, const std::vector<FarmOutput>& outputs) {
    if (a.band_count <= 1) return {};
    const int chunks = (area.height() + kRowsOfChunk - 1) / kRowsOfChunk;
    if (a.band_count > chunks) {
        throw UsageError("--bands: a picture of " + std::to_string(area.height()) + " rows has " +
                         std::to_string(chunks) + " bands at most");
    }
    std::vector<FarmBand> bands;
    for (int b = 0; b < a.band_count; ++b) {
        const auto row = [&](int band) {
            return std::min(area.y1, area.y0 + chunks * band / a.band_count * kRowsOfChunk);
        };
        const std::array<int, 4> crop = {area.x0, row(b), area.x1, row(b + 1)};
        std::string text;
        for (const int side : crop) text += (text.empty() ? "" : ",") + std::to_string(side);
        FarmBand& band = bands.emplace_back(FarmBand{text, outputs});
        for (FarmOutput& output : band.outputs) output.pattern = band_name(output.pattern, static_cast<std::size_t>(b));
    }
    return bands;
}

/// The frames of the tasks.
std::vector<std::string> chunks_of(const std::vector<double>& frames, std::size_t frames_of_a_task) {
    std::vector<std::string> chunks;
    for (std::size_t i = 0; i < frames.size(); i += frames_of_a_task) {
        const auto first = frames.begin() + static_cast<std::ptrdiff_t>(i);
        const auto count = static_cast<std::ptrdiff_t>(std::min(frames_of_a_task, frames.size() - i));
        chunks.push_back(text_of_frames({first, first + count}));
    }
    return chunks;
}

FarmJob farm_job(RenderJob& job, const Arguments& a, const std::vector<double>& missing) {
    const std::vector<FrameFile>& files = job.plan().outputs;
    const Scene& scene = job.renderer().scene();
    FarmJob farm;
    farm.name = "burin-" + std::filesystem::path(a.input).stem().string();
    for (char& c : farm.name) {
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
        if (!is_plain) c = '_';
    }
    farm.program = path_of_program();
    farm.folder = std::filesystem::current_path().string();
    if (!missing.empty()) {
        for (const FrameFile& file : files) check_output_file(file.path_of(missing.front()));
    }
    const std::filesystem::path folder = std::filesystem::absolute(files.front().path).parent_path();
    farm.log_folder = (folder / "burin-logs").string();
    if (farm.log_folder.find_first_of("\"\\\n") != std::string::npos)
        throw InputError(farm.log_folder +
                         ": sbatch takes no folder with quotes, backslashes or line feeds in its name");
    farm.arguments = a.render_arguments;
    for (const FrameFile& file : files) farm.outputs.push_back({file.option, file.path});
    farm.frames = text_of_frames(job.plan().frames);
    farm.bands = bands_of(a, crop_of(a, scene.picture.width, scene.picture.height), farm.outputs);
    // Slurm numbers tasks; more of them than it takes become larger.
    const std::size_t tasks = std::max<std::size_t>(1, kMostTasks / std::max<std::size_t>(1, farm.bands.size()));
    const std::size_t least = (missing.size() + tasks - 1) / tasks;
    farm.chunks = chunks_of(missing, std::max(static_cast<std::size_t>(a.frames_of_a_task), least));
    for (std::size_t i = 0; !farm.bands.empty() && i < missing.size(); ++i) {
        for (const FrameFile& whole : files) {
            FarmFile file{whole.path_of(missing[i]), {}};
            for (std::size_t b = 0; b < farm.bands.size(); ++b) file.bands.push_back(band_name(file.output, b));
            farm.files.push_back(std::move(file));
        }
    }
    for (const double frame : missing) {
        for (const FrameFile& file : files) {
            const std::filesystem::path path = std::filesystem::absolute(file.path_of(frame));
            farm.leftovers.push_back((path.parent_path() / ("." + path.stem().string())).string());
        }
    }
    farm.resubmit = shell_quoted(farm.program) + " submit";
    for (const std::string& argument : a.submit_arguments) farm.resubmit += ' ' + shell_quoted(argument);
    farm.retries = a.retries;
    farm.threads = a.threads > 0 ? a.threads : 1;
    PictureLoad load = load_of(job, a);
    load.threads = farm.threads;
    constexpr double kReserve = 1.3;
    farm.memory_bytes = static_cast<std::uint64_t>(kReserve * static_cast<double>(forecast_memory(load).total()));
    return farm;
}

/// A folder for scripts, until they are submitted.
class ScriptFolder {
  public:
    ScriptFolder() : path_((std::filesystem::temp_directory_path() / "burin-XXXXXX").string()) {
        if (::mkdtemp(path_.data()) == nullptr) throw InputError(path_ + ": the folder cannot be made");
    }
    ~ScriptFolder() {
        std::error_code error;
        std::filesystem::remove_all(path_, error);
    }
    ScriptFolder(const ScriptFolder&) = delete;
    ScriptFolder& operator=(const ScriptFolder&) = delete;
    std::string file(const std::string& name) const { return path_ + "/" + name; }

  private:
    std::string path_;
};

/// The folder for what tasks print. One that was made for tasks that never were is taken away again.
class LogFolder {
  public:
    explicit LogFolder(std::string path) : path_(std::move(path)) {
        std::error_code error;
        is_mine_ = std::filesystem::create_directories(path_, error);
        if (error) throw InputError(path_ + ": cannot be made: " + error.message());
    }
    ~LogFolder() {
        std::error_code error;
        if (is_mine_) std::filesystem::remove(path_, error);  // if it is empty
    }
    LogFolder(const LogFolder&) = delete;
    LogFolder& operator=(const LogFolder&) = delete;
    void keep() { is_mine_ = false; }

  private:
    std::string path_;
    bool is_mine_ = false;
};

/// Gives a script to sbatch. Returns the job's number.
std::string submitted(const std::string& sbatch, const std::string& script, std::vector<std::string> options) {
    const ScriptFolder folder;
    const std::string path = folder.file("script.sh"), log = folder.file("log");
    std::ofstream(path) << script;
    options.insert(options.begin(), "--parsable");
    options.push_back(path);
    constexpr double kTimeLimit_s = 300;
    run_program(sbatch, options, log, kTimeLimit_s);
    // "NUMBER" or "NUMBER;CLUSTER" in the last line; warnings may stand before it.
    std::ifstream file(log);
    std::string line, number;
    while (std::getline(file, line)) number = line.substr(0, line.find(';'));
    if (number.empty() || number.find_first_not_of("0123456789") != std::string::npos)
        throw InputError(sbatch + ": has not said the number of the job");
    return number;
}

}  // namespace

void run_submit(const Arguments& a) {
    RenderJob job(a);
    if (!job.plan().is_sequence) {
        throw UsageError("--frames: is needed, or [frames] range in the scene and a pattern in -o, as out.####.exr");
    }
    const std::vector<double> missing = job.missing_frames();
    if (missing.empty()) {
        std::printf("all %zu frames are there\n", job.plan().frames.size());
        return;
    }
    const FarmJob farm = farm_job(job, a, missing);
    const SlurmScripts scripts = slurm_scripts(farm);
    std::string options;
    for (const std::string& option : a.sbatch_options) options += ' ' + shell_quoted(option);
    if (a.is_dry_run) {
        std::printf("# sbatch --parsable%s\n%s\n", options.c_str(), scripts.render.c_str());
        std::printf("# sbatch --parsable%s --dependency=afterany:JOB\n%s", options.c_str(), scripts.collect.c_str());
        return;
    }
    const std::string sbatch = find_program("sbatch");
    if (sbatch.empty()) throw InputError("sbatch not found; --dry-run prints the scripts");
    LogFolder logs(farm.log_folder);
    const std::string tasks = submitted(sbatch, scripts.render, a.sbatch_options);
    logs.keep();
    std::vector<std::string> after = a.sbatch_options;
    after.push_back("--dependency=afterany:" + tasks);
    const std::string collect = submitted(sbatch, scripts.collect, after);
    std::printf("%zu of %zu frames in %zu tasks: job %s, then %s\n", missing.size(), job.plan().frames.size(),
                farm.chunks.size() * std::max<std::size_t>(1, farm.bands.size()), tasks.c_str(), collect.c_str());
}

}  // namespace burin
