#include "cli/frames/render_job.h"

#include <utility>

#include "base/atomic_file.h"
#include "base/interrupt.h"
#include "cli/job.h"
#include "cli/output_options.h"
#include "image/image_io.h"
#include "methods/method_table.h"

namespace burin {
namespace {

const Method& method_of(const Arguments& a) { return a.method.empty() ? methods().front() : *find_method(a.method); }

/// Files that a job writes once.
std::vector<OutputFile> files_of_job(const Arguments& a) {
    if (!writes_stats_file(a)) return {};
    return {{"--stats", a.stats}};
}

/// The picture's file. Refuses what can be known to fail before the scene is read.
OutputOptions checked_output(const Arguments& a, const Method& method) {
    OutputOptions output = output_options(a);
    check_names_of_frames(a, output.path);
    std::vector<OutputFile> outputs = files_of_job(a);
    outputs.push_back({"--output", output.path});
    if (!a.save_lines.empty()) outputs.push_back({"--save-lines", a.save_lines});
    refuse_to_overwrite(outputs, {a.input});
    const bool has_paths = is_vector(output.format);
    if (output.format != OutputFormat::exr && !has_paths) check_display_writer(output.path);
    if (has_paths && method.name != "abuffer") {
        throw UsageError("--output: method " + std::string(method.name) +
                         " makes pixels only; draw a vector file with method abuffer");
    }
    if (a.memory_bytes > 0 && method.name != "abuffer") {
        throw UsageError("--memory: method " + std::string(method.name) + " cannot render in pieces; abuffer can");
    }
    return output;
}

}  // namespace

RenderJob::RenderJob(const Arguments& a)
    : arguments_(a),
      method_(method_of(a)),
      output_(checked_output(a, method_)),
      described_(describe_input(a)),
      plan_(plan_frames(a, described_.description, output_.path)),
      renderer_(load(std::move(described_))) {}

FrameRenderer RenderJob::load(DescribedInput described) {
    const std::vector<OutputFile> once = files_of_job(arguments_);
    std::vector<OutputFile> outputs = existing_outputs(plan_);
    outputs.insert(outputs.end(), once.begin(), once.end());
    refuse_to_overwrite(outputs, {arguments_.input});
    // The first frame stands for all: what becomes of later ones is seen when their turn comes.
    output_.path = plan_.picture.path_of(plan_.frames.front());
    check_output_file(output_.path);
    if (plan_.lines) check_output_file(plan_.lines->path_of(plan_.frames.front()));
    for (const OutputFile& file : once) check_output_file(file.path);
    if (plan_.frames.size() > 1 && !arguments_.is_dry_run) sweep_outputs(plan_);
    return FrameRenderer(arguments_, method_, load_input(std::move(described), arguments_, outputs), plan_, output_);
}

std::vector<double> RenderJob::missing_frames() const {
    if (!arguments_.skips_existing) return plan_.frames;
    std::vector<double> missing;
    for (const double frame : plan_.frames) {
        throw_if_interrupted();
        std::string note;
        if (!renderer_.is_there(frame, renderer_.fingerprint_of(frame), note)) missing.push_back(frame);
    }
    return missing;
}

}  // namespace burin
