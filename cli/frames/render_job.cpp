#include "cli/frames/render_job.h"

#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/interrupt.h"
#include "cli/job.h"
#include "cli/output_options.h"
#include "image/image_io.h"
#include "methods/method_table.h"
#include "scene/animation/scene_animation.h"

namespace burin {
namespace {

const Method& method_of(const Arguments& a) { return a.method.empty() ? methods().front() : *find_method(a.method); }

/// Files that a job writes once.
std::vector<OutputFile> files_of_job(const Arguments& a) {
    if (!writes_stats_file(a)) return {};
    return {{"--stats", a.stats}};
}

/// The files of a frame. Refuses what can be known to fail before the scene is read.
std::vector<OutputOptions> checked_outputs(const Arguments& a, const Method& method) {
    std::vector<OutputOptions> list = output_list(a);
    check_names_of_frames(a, list);
    std::vector<OutputFile> outputs;
    for (const OutputOptions& output : list) outputs.push_back({output.is_deep ? "--deep" : "--output", output.path});
    if (!a.save_lines.empty()) outputs.push_back({"--save-lines", a.save_lines});
    for (OutputFile& file : files_of_job(a)) outputs.push_back(std::move(file));
    refuse_same_files(outputs);
    refuse_to_overwrite(outputs, {a.input});
    for (const OutputOptions& output : list) {
        const bool has_paths = is_vector(output.format);
        if (output.format != OutputFormat::exr && !has_paths) check_display_writer(output.path);
        if (has_paths && method.name != "abuffer") {
            throw UsageError("--output: method " + std::string(method.name) +
                             " makes pixels only; draw a vector file with method abuffer");
        }
        if (output.is_deep && method.name != "abuffer") throw UsageError("--deep: needs method abuffer");
        if (output.is_deep && !a.views.empty()) throw UsageError("--views: cannot stand beside --deep; remove one");
    }
    if (a.memory_bytes > 0 && method.name != "abuffer") {
        throw UsageError("--memory: method " + std::string(method.name) + " cannot render in pieces; abuffer can");
    }
    if (a.has_depth_limit && method.name != "abuffer")
        throw UsageError("--depth-complexity: limits method abuffer only; remove it");
    return list;
}

}  // namespace

RenderJob::RenderJob(const Arguments& a)
    : arguments_(a),
      method_(method_of(a)),
      outputs_(checked_outputs(a, method_)),
      described_(describe_input(a)),
      plan_(plan_frames(a, described_.description, outputs_)),
      renderer_(load(std::move(described_))) {}

FrameRenderer RenderJob::load(DescribedInput described) {
    const std::vector<OutputFile> once = files_of_job(arguments_);
    std::vector<OutputFile> outputs = existing_outputs(plan_);
    outputs.insert(outputs.end(), once.begin(), once.end());
    refuse_same_files(all_outputs(plan_, once));
    refuse_to_overwrite(outputs, {arguments_.input});
    // The first frame stands for all: what becomes of later ones is seen when their turn comes.
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
        outputs_[i].path = plan_.outputs[i].path_of(plan_.frames.front());
    }
    // Those that are there may stand where nothing can be written. A frame that fails need not end the job.
    const bool must_write = !arguments_.skips_existing && !(arguments_.keeps_going && plan_.is_sequence);
    try {
        if (must_write) check_files_of(plan_, plan_.frames.front());
    } catch (const InputError& error) {
        if (!plan_.is_sequence) throw;
        throw FrameError(plan_.frames.front(), error.what());
    }
    for (const OutputFile& file : once) check_output_file(file.path);
    if ((plan_.is_sequence || !must_write) && !arguments_.is_dry_run) sweep_outputs(plan_);
    return FrameRenderer(arguments_, method_, load_input(std::move(described), arguments_, outputs), plan_, outputs_);
}

std::vector<double> RenderJob::missing_frames() const {
    if (!arguments_.skips_existing) return plan_.frames;
    std::vector<double> missing;
    for (const double frame : plan_.frames) {
        throw_if_interrupted();
        try {
            std::string note;
            if (renderer_.is_there(frame, renderer_.fingerprint_of(frame), note)) continue;
        } catch (const InputError&) {  // an input of the frame is missing, as its run will say
        }
        missing.push_back(frame);
    }
    return missing;
}

}  // namespace burin
