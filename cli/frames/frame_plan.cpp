#include "cli/frames/frame_plan.h"

#include <utility>

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
    const bool is_picture = file.option == "-o";
    throw UsageError(file.option + ": several frames need a pattern, as out.####." + (is_picture ? "exr" : "lines"));
}

/// The frames of a turntable, once around.
std::vector<double> frames_around(double first, int count) {
    std::vector<double> frames;
    for (int i = 0; i < count; ++i) frames.push_back(first + i);
    return frames;
}

}  // namespace

void check_names_of_frames(const Arguments& a, const std::string& picture) {
    if (a.stats != "-" && FramePattern::find(a.stats, FramePattern::SingleHash::letter))
        throw UsageError("--stats: is one file for all frames; give a name without a pattern");
    if (!asks_for_frames(a)) return;
    const std::size_t count =
        a.frame_list.empty() ? static_cast<std::size_t>(*a.turntable_frames) : a.frame_list.size();
    for (const auto& [option, path] : {std::pair("-o", picture), std::pair("--save-lines", a.save_lines)}) {
        const FrameFile file = frame_file(option, path, FramePattern::SingleHash::digits);
        if (count > 1 && !file.pattern && !path.empty()) fail_without_pattern(file);
    }
}

FramePlan plan_frames(const Arguments& a, const SceneDescription& scene, const std::string& picture) {
    const bool scene_has_frames = !scene.frame_range.empty() || scene.turntable;
    // A name that is made from the input's has no pattern unless frames are asked for.
    const bool takes_single = asks_for_frames(a) || (scene_has_frames && !a.output.empty() && !a.frame);
    const auto single = takes_single ? FramePattern::SingleHash::digits : FramePattern::SingleHash::letter;
    FramePlan plan;
    plan.picture = frame_file("-o", picture, single);
    if (!a.save_lines.empty()) plan.lines = frame_file("--save-lines", a.save_lines, single);
    const bool has_pattern = plan.picture.pattern || (plan.lines && plan.lines->pattern);
    plan.is_sequence = asks_for_frames(a) || (has_pattern && scene_has_frames && !a.frame);
    if (!plan.is_sequence) {
        if (has_pattern) {
            const FrameFile& file = plan.picture.pattern ? plan.picture : *plan.lines;
            throw UsageError(file.option +
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
    if (plan.frames.size() > 1 && !plan.picture.pattern) fail_without_pattern(plan.picture);
    if (plan.frames.size() > 1 && plan.lines && !plan.lines->pattern) fail_without_pattern(*plan.lines);
    return plan;
}

std::vector<OutputFile> outputs_of(const FramePlan& plan) {
    std::vector<OutputFile> outputs;
    for (const double frame : plan.frames) {
        throw_if_interrupted();
        outputs.push_back({"--output", plan.picture.path_of(frame)});
        if (plan.lines) outputs.push_back({"--save-lines", plan.lines->path_of(frame)});
    }
    return outputs;
}

}  // namespace burin
