#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "base/stopwatch.h"
#include "cli/commands.h"
#include "cli/job.h"
#include "compare/report.h"
#include "compare/run_comparison.h"
#include "compare/truth.h"

namespace burin {
namespace {

/// Fails before the work, not after it.
void make_folder(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder)) {
        throw InputError(folder + ": cannot make this folder" +
                         (error ? ": " + error.message() : "") +
                         "; give the name of a folder to write to");
    }
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
        throw InputError(folder + ": this folder cannot be written to; change its permissions");
    }
}

/// All methods but the truth itself, unless they are named.
std::vector<const Method*> chosen_methods(const std::vector<std::string>& names) {
    std::vector<const Method*> chosen;
    for (const std::string& name : names) chosen.push_back(find_method(name));
    if (!names.empty()) return chosen;
    for (const Method& method : methods()) {
        if (&method != &truth_method()) chosen.push_back(&method);
    }
    return chosen;
}

}  // namespace

void run_compare(const Arguments& a) {
    const bool shows_bar = !a.quiet && isatty(STDERR_FILENO) != 0;
    Progress progress(a.alf_progress ? ProgressStyle::alf
                                     : (shows_bar ? ProgressStyle::bar : ProgressStyle::none));
    const Stopwatch total;
    Scene scene = load_input(a);
    View view;
    {
        const Frame frame = frame_of(scene, a);
        view = {frame.camera, frame.width, frame.height, frame.crop};
    }
    make_folder(a.output);
    ComparisonOptions options{a.output, chosen_methods(a.methods), a.frames, a.threads, &progress};
    Comparison so_far;
    try {
        const Comparison comparison =
            run_comparison(scene, a.input, view, options, [&](const Comparison& c) {
                so_far = c;
                write_metrics(c, a.output);
            });
        write_report(comparison, a.output);
    } catch (const Interrupted&) {
        progress.finish();
        if (so_far.methods.empty()) throw Interrupted("interrupted; no method was finished");
        throw Interrupted("interrupted; " + a.output + "/metrics.json has the " +
                          std::to_string(so_far.methods.size()) + " of " +
                          std::to_string(options.methods.size()) + " methods that were finished");
    }
    progress.finish();
    if (a.verbose || shows_bar) {
        std::fprintf(stderr, "%s/report.html: %zu methods, %dx%d, %.1f s\n", a.output.c_str(),
                     options.methods.size(), view.crop.width(), view.crop.height(),
                     total.seconds());
    }
}

}  // namespace burin
