#include "cli/output_options.h"

#include <cstdio>
#include <filesystem>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/lower_extension.h"
#include "base/parallel.h"
#include "cli/exr_options.h"
#include "cli/output_files.h"
#include "scene/animation/frame_pattern.h"

namespace burin {

bool writes_stats_file(const Arguments& a) { return !a.stats.empty() && a.stats != "-"; }

OutputOptions output_options(const Arguments& a) {
    OutputOptions options;
    options.path = a.output;
    if (options.path.empty()) {
        options.path = std::filesystem::path(a.input).stem().string() + ".png";
    }
    const std::string suffix = lower_extension(options.path);
    if (const NamedFormat* const found = find_format_of_suffix(suffix)) {
        options.format = found->format;
    } else {
        throw UsageError(
            "--output: " + (suffix.empty() ? "the name has no suffix" : "unknown kind of image '" + suffix + "'") +
            "; burin writes " + suffixes_of_formats());
    }
    refuse_exr_options(a, options.format);
    if (a.command != Command::render && a.command != Command::submit &&
        FramePattern::find(options.path, FramePattern::SingleHash::letter))
        throw UsageError("--output: a pattern for frames is for burin render --frames");
    if (writes_stats_file(a) && is_one_file(a.stats, options.path)) {
        throw UsageError("--stats: would overwrite " + options.path + "; give another name");
    }
    options.exr = a.exr;
    options.exr.has_camera = a.views.empty();
    options.bits = a.bits;
    options.threads = resolve_thread_count(a.threads);
    return options;
}

void write_stats(const std::string& path, const std::string& text) {
    if (path == "-") {
        std::fputs(text.c_str(), stdout);
        return;
    }
    AtomicFile file(path);
    file.write(text.data(), text.size());
    file.commit();
}

}  // namespace burin
