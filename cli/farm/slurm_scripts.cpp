#include "cli/farm/slurm_scripts.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace burin {
namespace {

// Scripts, in which @name@ stands for a value.

constexpr std::string_view kRenderScript = R"sh(#!/bin/sh
# Made by burin submit: each task renders its chunk of the frames, as far as they are not there.
#SBATCH --job-name=@job@
#SBATCH --array=0-@last_task@
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output="@logs@/%A_%a.txt"
#SBATCH --signal=B:TERM@@30
#SBATCH --cpus-per-task=@threads@
#SBATCH --mem=@megabytes@M
cd @folder@ || exit 1
band=$((SLURM_ARRAY_TASK_ID % @bands@))
case $((SLURM_ARRAY_TASK_ID / @bands@)) in
@frames_of_chunks@esac
@outputs_of_band@
echo "task $SLURM_ARRAY_TASK_ID: frames $frames, start $((${SLURM_RESTART_COUNT:-0} + 1))"
@program@ render@arguments@ "$@@" -f "$frames" \
    --skip-existing --progress alf -j "${SLURM_CPUS_PER_TASK:-@threads@}" \
    --stats @logs_quoted@/"${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID.jsonl" &
child=$!
trap 'kill -TERM $child' TERM INT
wait $child
status=$?
# A signal ends `wait`, not yet the program.
while [ $status -gt 128 ] && kill -0 $child 2>/dev/null; do
    wait $child
    status=$?
done
if [ $status -eq 1 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt @retries@ ]; then
    # The number of the array alone would mean all of its tasks. Slurm ends this task, and begins it anew.
    scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID" && sleep 60
fi
exit $status
)sh";

constexpr std::string_view kCollectScript = R"sh(#!/bin/sh
# Made by burin submit: runs when no task of the job is left.
#SBATCH --job-name=@job@-collect
#SBATCH --output="@logs@/collect_%j.txt"
cd @folder@ || exit 1
@joins@@removal@if ! found=$(@program@ render@arguments@ -f @frames@@outputs@ -q --skip-existing --dry-run); then
    # The scene cannot be loaded, as where a model of it is gone: so nothing tells which frames are there.
    echo "which frames are missing is not known: the scene cannot be loaded, see above"
    printf 'render what is missing: %s -f %s\n' @resubmit@ @frames@
    exit 1
fi
missing=$(printf '%s\n' "$found" | sed -n 's/^missing //p')
if [ -n "$missing" ]; then
    echo "missing: $missing"
    printf 'render them: %s -f %s\n' @resubmit@ "$missing"
    exit 1
fi
echo "all frames are there"
)sh";

constexpr std::string_view kJoin = R"sh(# join OUTPUT BAND...: makes one frame. Its bands are removed when it is there.
join() {
    output=$1
    shift
    for band in "$@@"; do
        [ -f "$band" ] || return
    done
    @program@ assemble -o "$output" "$@@" && rm -f "$@@"
}
)sh";

/// Puts values in the places of their names; @@ is one @.
std::string filled(std::string_view text, std::initializer_list<std::pair<std::string_view, std::string>> values) {
    std::string result;
    while (!text.empty()) {
        const std::size_t begin = text.find('@');
        result += text.substr(0, begin);
        if (begin == std::string_view::npos) break;
        const std::size_t end = text.find('@', begin + 1);
        const std::string_view name = text.substr(begin + 1, end - begin - 1);
        if (name.empty()) result += '@';
        for (const auto& [known, value] : values) {
            if (known == name) result += value;
        }
        text.remove_prefix(end + 1);
    }
    return result;
}

/// A path within the quotes of an #SBATCH line, where % stands for numbers of jobs.
std::string in_directive(const std::string& path) {
    std::string text;
    for (const char c : path) text += c == '%' ? std::string("%%") : std::string(1, c);
    return text;
}

std::string shell_words(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += ' ' + shell_quoted(word);
    return text;
}

std::string words_of(const std::vector<FarmOutput>& outputs) {
    std::string text;
    for (const FarmOutput& output : outputs) text += shell_words({output.option, output.pattern});
    return text;
}

/// What makes the outputs of a task, and its crop, the script's arguments.
std::string outputs_of_band(const FarmJob& job) {
    if (job.bands.empty()) return "set --" + words_of(job.outputs);
    std::string text = "case $band in\n";
    for (std::size_t b = 0; b < job.bands.size(); ++b) {
        text += std::to_string(b) + ") set -- --crop " + shell_quoted(job.bands[b].crop) +
                words_of(job.bands[b].outputs) + " ;;\n";
    }
    return text + "esac";
}

std::string joins(const FarmJob& job) {
    if (job.bands.empty()) return {};
    std::string text = filled(kJoin, {{"program", shell_quoted(job.program)}});
    for (const FarmFile& file : job.files) text += "join " + shell_quoted(file.output) + shell_words(file.bands) + '\n';
    return text;
}

/// Temporary files are named after the file that they become, the host and the process.
std::string removal(const FarmJob& job) {
    std::string text;
    for (const std::string& begin : job.leftovers) text += "rm -f " + shell_quoted(begin) + ".burin-*\n";
    return text;
}

}  // namespace

std::string shell_quoted(const std::string& word) {
    constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./=,:+%@";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

SlurmScripts slurm_scripts(const FarmJob& job) {
    const std::size_t bands = std::max<std::size_t>(1, job.bands.size());
    std::string frames_of_chunks;
    for (std::size_t i = 0; i < job.chunks.size(); ++i)
        frames_of_chunks += std::to_string(i) + ") frames=" + shell_quoted(job.chunks[i]) + " ;;\n";
    SlurmScripts scripts;
    scripts.render = filled(kRenderScript, {{"job", job.name},
                                            {"last_task", std::to_string(job.chunks.size() * bands - 1)},
                                            {"logs", in_directive(job.log_folder)},
                                            {"logs_quoted", shell_quoted(job.log_folder)},
                                            {"threads", std::to_string(job.threads)},
                                            {"megabytes", std::to_string(job.memory_bytes / 1'000'000 + 1)},
                                            {"folder", shell_quoted(job.folder)},
                                            {"bands", std::to_string(bands)},
                                            {"frames_of_chunks", frames_of_chunks},
                                            {"outputs_of_band", outputs_of_band(job)},
                                            {"program", shell_quoted(job.program)},
                                            {"arguments", shell_words(job.arguments)},
                                            {"retries", std::to_string(job.retries)}});
    scripts.collect = filled(kCollectScript, {{"job", job.name},
                                              {"logs", in_directive(job.log_folder)},
                                              {"folder", shell_quoted(job.folder)},
                                              {"joins", joins(job)},
                                              {"removal", removal(job)},
                                              {"program", shell_quoted(job.program)},
                                              {"arguments", shell_words(job.arguments)},
                                              {"frames", shell_quoted(job.frames)},
                                              {"outputs", words_of(job.outputs)},
                                              {"resubmit", shell_quoted(job.resubmit)}});
    return scripts;
}

}  // namespace burin
