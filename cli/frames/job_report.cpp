#include "cli/frames/job_report.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/json_writer.h"
#include "cli/output_options.h"
#include "mesh/text_scan.h"
#include "scene/animation/frame_list.h"

namespace burin {
namespace {

constexpr std::size_t kFramesInMean = 5;
constexpr std::uint64_t kWeightOfFrame = 1000;

void add(const StageTimes& more, StageTimes& sum) {
    for (double RenderStats::*stage : {&RenderStats::prepare_s, &RenderStats::raster_s, &RenderStats::resolve_s,
                                       &RenderStats::lines_s, &RenderStats::shade_s})
        sum.render.*stage += more.render.*stage;
    sum.load_s += more.load_s;
    sum.write_s += more.write_s;
    sum.total_s += more.total_s;
    if (!more.paths) return;
    if (!sum.paths) sum.paths.emplace();
    sum.paths->chain_s += more.paths->chain_s;
    sum.paths->clean_s += more.paths->clean_s;
    sum.paths->fit_s += more.paths->fit_s;
}

}  // namespace

JobReport::JobReport(const Arguments& a, const FramePlan& plan, Progress& progress)
    : arguments_(a), plan_(plan), progress_(progress) {
    progress_.plan(plan.frames.size() * kWeightOfFrame);
    if (a.stats.empty()) return;
    owns_stats_ = writes_stats_file(a);
    stats_ = owns_stats_ ? std::fopen(a.stats.c_str(), "we") : stdout;
    if (stats_ == nullptr) {
        throw InputError(a.stats + ": cannot write: " + std::strerror(errno) +
                         "; choose another place or change its permissions");
    }
}

JobReport::~JobReport() {
    if (owns_stats_) std::fclose(stats_);
}

void JobReport::loaded(double seconds) {
    const std::lock_guard lock(mutex_);
    sum_.load_s += seconds;
    sum_.total_s += seconds;
    since_last_.lap();
}

void JobReport::begin(double frame) { progress_.next_part("frame " + text_of_frame(frame), kWeightOfFrame); }

void JobReport::done(const DrawnFrame& frame) {
    const std::lock_guard lock(mutex_);
    last_done_ = frame.number;
    add(frame.times, sum_);
    if (arguments_.alf_progress) {
        for (const OutputOptions& output : frame.outputs) std::printf("Saved: '%s'\n", output.path.c_str());
        std::fflush(stdout);
    }
    last_seconds_.push_back(since_last_.lap());
    if (last_seconds_.size() > kFramesInMean) last_seconds_.pop_front();
    tell(frame.number, kDone, &frame.times, nullptr);
    const std::size_t told = std::accumulate(counts_.begin(), counts_.end(), std::size_t{0});
    const double mean =
        std::accumulate(last_seconds_.begin(), last_seconds_.end(), 0.0) / static_cast<double>(last_seconds_.size());
    progress_.expect(mean * static_cast<double>(plan_.frames.size() - told));
    if (arguments_.verbose) {
        progress_.hide();
        std::fprintf(stderr, "%s: %dx%d, %llu triangles (ready %.2f, draw %.2f, write %.2f)\n",
                     frame.outputs.front().path.c_str(), frame.frame.crop.width(), frame.frame.crop.height(),
                     static_cast<unsigned long long>(frame.times.render.triangles), frame.times.load_s,
                     drawing_seconds(frame.times.render), frame.times.write_s);
    }
}

void JobReport::skipped(const std::vector<double>& frames) {
    for (const double frame : frames) {
        progress_.next_part("frame " + text_of_frame(frame), kWeightOfFrame);
        const std::lock_guard lock(mutex_);
        last_done_ = frame;
        tell(frame, kSkipped, nullptr, nullptr);
    }
}

void JobReport::failed(double frame, const std::string& why) {
    const std::lock_guard lock(mutex_);
    if (failed_frames_.empty()) first_failure_ = why;
    failed_frames_.push_back(frame);
    tell(frame, kFailed, nullptr, &why);
    if (!arguments_.keeps_going) return;  // it ends the job, which says so
    progress_.hide();
    std::fprintf(stderr, "frame %s: %s\n", text_of_frame(frame).c_str(), printable(why, 4000).c_str());
}

bool JobReport::has_failures() {
    const std::lock_guard lock(mutex_);
    return !failed_frames_.empty();
}

void JobReport::interrupted(double frame) {
    const std::lock_guard lock(mutex_);
    tell(frame, kInterrupted, nullptr, nullptr);
}

void JobReport::tell(double frame, Status status, const StageTimes* times, const std::string* error) {
    static constexpr std::array<const char*, kStatusCount> kWords = {"done", "skipped", "failed", "interrupted"};
    ++counts_[status];
    if (stats_ == nullptr) return;
    JsonWriter json(JsonWriter::Layout::one_line);
    json.begin_object().key("frame").value(frame).key("output").value(plan_.outputs.front().path_of(frame));
    json.key("status").value(kWords[status]);
    add_stages(json, times != nullptr ? *times : StageTimes());
    if (times != nullptr && times->crypto_dropped) json.key("crypto_dropped").value(*times->crypto_dropped);
    json.key("triangles").value(times != nullptr ? times->render.triangles : 0);
    json.key("peak_rss_bytes").value(peak_memory_bytes()).key("error");
    if (error != nullptr) {
        json.value(*error);
    } else {
        json.null();
    }
    json.end_object();
    write_in_turn(frame, json.text());
}

void JobReport::write_in_turn(double frame, std::string line) {
    const auto at =
        std::find(plan_.frames.begin() + static_cast<std::ptrdiff_t>(next_line_), plan_.frames.end(), frame);
    waiting_.emplace(static_cast<std::size_t>(at - plan_.frames.begin()), std::move(line));
    for (; !waiting_.empty() && waiting_.begin()->first == next_line_; ++next_line_) {
        write(waiting_.begin()->second);
        waiting_.erase(waiting_.begin());
    }
}

void JobReport::write(const std::string& line) {
    std::fputs(line.c_str(), stats_);
    std::fflush(stats_);
}

void JobReport::finish() {
    const std::lock_guard lock(mutex_);
    if (std::exchange(is_finished_, true)) return;
    if (stats_ == nullptr) return;
    for (const auto& [place, line] : waiting_) write(line);  // frames between were not begun
    waiting_.clear();
    JsonWriter json(JsonWriter::Layout::one_line);
    json.begin_object().key("summary").value(true).key("frames").value(std::uint64_t{plan_.frames.size()});
    json.key("done").value(std::uint64_t{counts_[kDone]}).key("skipped").value(std::uint64_t{counts_[kSkipped]});
    json.key("failed").value(std::uint64_t{counts_[kFailed]});
    json.key("interrupted").value(std::uint64_t{counts_[kInterrupted]});
    add_stages(json, sum_);
    json.key("wall").value(total_.seconds()).key("peak_rss_bytes").value(peak_memory_bytes()).end_object();
    write(json.text());
    if (std::ferror(stats_) != 0 && owns_stats_)
        throw InputError(arguments_.stats + ": cannot write; is the disk full?");
}

}  // namespace burin
