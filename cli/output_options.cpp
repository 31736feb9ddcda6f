#include "cli/output_options.h"

#include <algorithm>
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

namespace {

OutputOptions options_of(const Arguments& a, const std::string& path) {
    OutputOptions options;
    options.path = path;
    options.exr = a.exr;
    options.exr.has_camera = a.views.empty();
    options.bits = a.bits;
    options.threads = resolve_thread_count(a.threads);
    return options;
}

OutputOptions picture_options(const Arguments& a, const std::string& path) {
    OutputOptions options = options_of(a, path);
    const std::string suffix = lower_extension(options.path);
    if (const NamedFormat* const found = find_format_of_suffix(suffix)) {
        options.format = found->format;
    } else {
        throw UsageError(
            "--output: " + (suffix.empty() ? "the name has no suffix" : "unknown kind of image '" + suffix + "'") +
            "; burin writes " + suffixes_of_formats());
    }
    if (a.command != Command::render && a.command != Command::submit &&
        FramePattern::find(options.path, FramePattern::SingleHash::letter))
        throw UsageError("--output: a pattern for frames is for burin render --frames");
    return options;
}

OutputOptions deep_options(const Arguments& a) {
    OutputOptions options = options_of(a, a.deep);
    if (lower_extension(options.path) != ".exr")
        throw UsageError("--deep: a deep file is an EXR; give a name that ends in .exr");
    options.is_deep = true;
    return options;
}

bool is_flat_option(const std::string& option) { return option == "--parts" || option == "--channel-names"; }

/// Whether an option of EXR files is given that only a flat one has.
bool has_flat_option(const Arguments& a) {
    return std::any_of(a.exr_options.begin(), a.exr_options.end(), is_flat_option);
}

/// What only a flat file has.
void refuse_flat_options(const Arguments& a) {
    const auto refuse = [](bool is_given, const std::string& option) {
        if (is_given) throw UsageError(option + ": a deep file has one part and channels of its own; give -o, too");
    };
    refuse(a.names_layers, "--layers");
    for (const std::string& option : a.exr_options) refuse(is_flat_option(option), option);
}

std::string first_output(const Arguments& a) {
    return a.output.empty() ? std::filesystem::path(a.input).stem().string() + ".png" : a.output;
}

}  // namespace

OutputOptions output_options(const Arguments& a) {
    if (!a.more_outputs.empty())
        throw UsageError("--output: is given more than once; only render writes several files, remove one");
    OutputOptions options = picture_options(a, first_output(a));
    refuse_exr_options(a, options.format);
    if (writes_stats_file(a) && is_one_file(a.stats, options.path))
        throw UsageError("--stats: would overwrite " + options.path + "; give another name");
    return options;
}

std::vector<OutputOptions> output_list(const Arguments& a) {
    std::vector<OutputOptions> list;
    if (!a.output.empty() || a.deep.empty()) list.push_back(picture_options(a, first_output(a)));
    for (const std::string& path : a.more_outputs) list.push_back(picture_options(a, path));
    if (list.empty()) {
        refuse_flat_options(a);
    } else if (std::none_of(list.begin(), list.end(),
                            [](const OutputOptions& o) { return o.format == OutputFormat::exr; }) &&
               (a.deep.empty() || has_flat_option(a))) {
        refuse_exr_options(a, list.front().format);
    }
    if (!a.deep.empty()) list.push_back(deep_options(a));
    return list;
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
