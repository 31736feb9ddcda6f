#include "cli/frames/frame_plan.h"

#include <algorithm>
#include <filesystem>
#include <unordered_set>
#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/interrupt.h"
#include "cli/job.h"

namespace burin {
namespace {

bool asks_for_frames(const Arguments& a) { return !a.frame_list.empty() || a.turntable_frames; }

FrameFile frame_file(const std::string& option, const std::string& path, FramePattern::SingleHash single) {
    try {
        return {option, path, FramePattern::find(path, single)};
    } catch (const InputError& error) {
        throw UsageError(option + ": " + error.what());
    }
}

[[noreturn]] void fail_without_pattern(const FrameFile& file) {
    const bool has_lines = file.option == "--save-lines";
    throw UsageError(file.option + ": several frames need a pattern, as out.####." + (has_lines ? "lines" : "exr"));
}

/// The frames of a turntable, once around.
std::vector<double> frames_around(double first, int count) {
    std::vector<double> frames;
    for (int i = 0; i < count; ++i) frames.push_back(first + i);
    return frames;
}

std::vector<const FrameFile*> files_of(const FramePlan& plan) {
    std::vector<const FrameFile*> files;
    for (const FrameFile& file : plan.outputs) files.push_back(&file);
    if (plan.lines) files.push_back(&*plan.lines);
    return files;
}

const char* option_of(const OutputOptions& output) { return output.is_deep ? "--deep" : "-o"; }

/// With a slash at its end; empty: where the program runs. A pattern stands behind it.
std::string folder_of(const FrameFile& file) { return file.path.substr(0, file.path.rfind('/') + 1); }

std::unordered_set<std::string> names_in(const std::string& folder) {
    namespace fs = std::filesystem;
    std::unordered_set<std::string> names;
    std::error_code error;
    for (fs::directory_iterator it(folder.empty() ? "." : folder, error), end; !error && it != end; it.increment(error))
        names.insert(it->path().filename().string());
    return names;
}

}  // namespace

void check_names_of_frames(const Arguments& a, const std::vector<OutputOptions>& outputs) {
    if (a.stats != "-" && FramePattern::find(a.stats, FramePattern::SingleHash::letter))
        throw UsageError("--stats: is one file for all frames; give a name without a pattern");
    if (!asks_for_frames(a)) return;
    const std::size_t count =
        a.frame_list.empty() ? static_cast<std::size_t>(*a.turntable_frames) : a.frame_list.size();
    const auto check = [&](const char* option, const std::string& path) {
        const FrameFile file = frame_file(option, path, FramePattern::SingleHash::digits);
        if (count > 1 && !file.pattern && !path.empty()) fail_without_pattern(file);
    };
    for (const OutputOptions& output : outputs) check(option_of(output), output.path);
    check("--save-lines", a.save_lines);
}

FramePlan plan_frames(const Arguments& a, const SceneDescription& scene, const std::vector<OutputOptions>& outputs) {
    const bool scene_has_frames = !scene.frame_range.empty() || scene.turntable;
    // A name that is made from the input's has no pattern unless frames are asked for.
    const bool names_output = !a.output.empty() || !a.deep.empty();
    const bool takes_single = asks_for_frames(a) || (scene_has_frames && names_output && !a.frame);
    const auto single = takes_single ? FramePattern::SingleHash::digits : FramePattern::SingleHash::letter;
    FramePlan plan;
    for (const OutputOptions& output : outputs)
        plan.outputs.push_back(frame_file(option_of(output), output.path, single));
    if (!a.save_lines.empty()) plan.lines = frame_file("--save-lines", a.save_lines, single);
    const std::vector<const FrameFile*> files = files_of(plan);
    const auto with_pattern =
        std::find_if(files.begin(), files.end(), [](const FrameFile* file) { return file->pattern.has_value(); });
    const bool has_pattern = with_pattern != files.end();
    plan.is_sequence = asks_for_frames(a) || (has_pattern && scene_has_frames && !a.frame);
    if (!plan.is_sequence) {
        if (has_pattern) {
            throw UsageError((*with_pattern)->option +
                             ": a pattern for frames needs --frames, or a range in [frames] of the scene");
        }
        plan.is_at_rest = !a.frame && scene.frame_range.empty();
        plan.frames = {still_frame(a, scene.frame_range, scene.turntable)};
    } else if (!a.frame_list.empty()) {
        plan.frames = a.frame_list;
    } else if (a.turntable_frames || scene.frame_range.empty()) {
        plan.frames = frames_around(scene.turntable->first, scene.turntable->frames);
    } else {
        plan.frames = scene.frame_range;
    }
    for (const FrameFile* file : files) {
        if (plan.frames.size() > 1 && !file->pattern) fail_without_pattern(*file);
    }
    return plan;
}

std::vector<OutputFile> existing_outputs(const FramePlan& plan) {
    std::vector<OutputFile> outputs;
    for (const FrameFile* file : files_of(plan)) {
        const std::string option = file->option == "-o" ? "--output" : file->option;
        if (plan.frames.size() == 1) {
            outputs.push_back({option, file->path_of(plan.frames.front())});
            continue;
        }
        const std::unordered_set<std::string> names = names_in(folder_of(*file));
        for (const double frame : plan.frames) {
            throw_if_interrupted();
            std::string path = file->path_of(frame);
            if (names.contains(path.substr(path.rfind('/') + 1))) outputs.push_back({option, std::move(path)});
        }
    }
    return outputs;
}

void check_files_of(const FramePlan& plan, double frame) {
    for (const FrameFile* file : files_of(plan)) check_output_file(file->path_of(frame));
}

std::vector<OutputFile> all_outputs(const FramePlan& plan, std::vector<OutputFile> others) {
    for (const FrameFile* file : files_of(plan)) {
        const std::string option = file->option == "-o" ? "--output" : file->option;
        for (const double frame : plan.frames) others.push_back({option, file->path_of(frame)});
    }
    return others;
}

void sweep_outputs(const FramePlan& plan) {
    for (const FrameFile* file : files_of(plan)) {
        const std::unordered_set<std::string> names = names_in(folder_of(*file));
        const bool has_any = std::any_of(names.begin(), names.end(), [](const std::string& name) {
            return name[0] == '.' && name.find(".burin-") != std::string::npos;
        });
        if (!has_any) continue;
        std::vector<std::string> paths;
        for (const double frame : plan.frames) paths.push_back(file->path_of(frame));
        remove_left_behind(paths);
    }
}

}  // namespace burin
