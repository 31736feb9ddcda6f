#include <unistd.h>

#include <cstdio>
#include <future>
#include <optional>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "cli/commands.h"
#include "cli/frames/dry_run.h"
#include "cli/frames/frame_plan.h"
#include "cli/frames/frame_renderer.h"
#include "cli/frames/frame_writer.h"
#include "cli/frames/job_report.h"
#include "cli/frames/render_job.h"
#include "cli/job.h"
#include "cli/output_options.h"
#include "mesh/text_scan.h"
#include "scene/animation/frame_list.h"

namespace burin {
namespace {

/// Says why a frame that was to be there is rendered again.
void note_on_frame(const Arguments& a, const std::string& frame, const std::string& note) {
    if (note.empty() || a.quiet) return;
    std::fprintf(stderr, "burin: note: %s%s; it is rendered again\n", frame.c_str(), printable(note, 4000).c_str());
}

/// One picture: the file, then its statistics.
void render_still(const Arguments& a, RenderJob& job, double load_s, const Stopwatch& total, Progress& progress,
                  bool shows_bar) {
    Stopwatch watch;
    FrameRenderer& renderer = job.renderer();
    const FramePlan& plan = job.plan();
    const double frame = plan.frames.front();
    const FrameFingerprint fingerprint = renderer.fingerprint_of(frame);
    if (a.skips_existing) {
        std::string note;
        if (renderer.is_there(frame, fingerprint, note)) return;
        note_on_frame(a, "", note);
        check_files_of(plan, frame);
    }
    auto change = renderer.change_at(frame);
    load_s += watch.lap();
    renderer.pose(std::move(change));  // its time is counted with the frame's
    DrawnFrame drawn = renderer.draw(renderer.outputs_of(frame, fingerprint), &progress);
    StageTimes& times = drawn.times;
    drawn.write(a);
    times.load_s += load_s;
    progress.finish();
    times.total_s = a.repeat > 0 ? times.load_s + drawing_seconds(times.render) + times.write_s : total.seconds();
    if (!a.stats.empty()) write_stats(a.stats, stats_json(times, drawn.frame, job.method()));
    if (a.verbose || shows_bar) {
        std::fprintf(stderr, "%s: %dx%d, %llu triangles, %.2f s (read %.2f, draw %.2f, write %.2f)\n",
                     drawn.outputs.front().path.c_str(), drawn.frame.crop.width(), drawn.frame.crop.height(),
                     static_cast<unsigned long long>(times.render.triangles), total.seconds(), times.load_s,
                     drawing_seconds(times.render), times.write_s);
    }
}

/// What the next frame changes, found while the one before is drawn.
class NextChange {
  public:
    NextChange(const FrameRenderer& renderer, bool in_background)
        : renderer_(renderer), in_background_(in_background) {}

    void begin(double frame) {
        frame_ = frame;
        if (!in_background_) return;
        const StopFlag& flag = stop_flag_of_thread();
        change_ = std::async(std::launch::async, [this, frame, &flag] {
            const StopScope scope(flag);
            return renderer_.change_at(frame);
        });
    }
    /// Throws InputError and Interrupted.
    SceneChange take() { return change_.valid() ? change_.get() : renderer_.change_at(frame_); }

  private:
    const FrameRenderer& renderer_;
    bool in_background_;
    double frame_ = 0;
    std::future<SceneChange> change_;
};

/// Renders all frames of a plan: one is drawn, the next one is made ready beside it, and the last one written.
class FrameJob {
  public:
    FrameJob(const Arguments& a, const FramePlan& plan, FrameRenderer& renderer, Progress& progress, double load_s)
        : arguments_(a),
          plan_(plan),
          renderer_(renderer),
          progress_(progress),
          report_(a, plan, progress),
          in_background_(resolve_thread_count(a.threads) > 1),
          next_(renderer, in_background_ && renderer.moves()),
          writer_(
              a, in_background_,
              [this](const DrawnFrame& frame) {
                  report_.done(frame);
                  report_.skipped(frame.skipped_behind);
              },
              [this](const DrawnFrame& frame, const std::string& why) {
                  report_.failed(frame.number, why);
                  report_.skipped(frame.skipped_behind);
              }) {
        report_.loaded(load_s);
    }

    void run() {
        std::optional<Due> due;
        double frame = plan_.frames.front();
        try {
            due = next_due();
            report_.skipped(std::exchange(skipped_, {}));
            if (due) next_.begin(due->frame);
            while (due) {
                frame = due->frame;
                throw_if_interrupted();
                due = render(*std::move(due));
                if (report_.has_failures() && !arguments_.keeps_going) break;
            }
            writer_.wait();
        } catch (const Interrupted&) {
            stop_at(frame);
        }
        if (!report_.has_failures()) {
            progress_.next_part("", 0);
            progress_.advance();
        }
        progress_.finish();
        report_.finish();
        fail_if_frames_failed();
    }

  private:
    /// A frame that is to be rendered.
    struct Due {
        double frame = 0;
        FrameFingerprint fingerprint;
    };

    /// The next frame that is to be rendered; nothing if no more is.
    std::optional<Due> next_due() {
        for (; at_ < plan_.frames.size(); ++at_) {
            throw_if_interrupted();
            const double frame = plan_.frames[at_];
            try {
                Due due{frame, renderer_.fingerprint_of(frame)};
                if (!is_there(frame, due.fingerprint)) {
                    if (arguments_.skips_existing && !std::exchange(has_checked_, true)) check_files_of(plan_, frame);
                    ++at_;
                    return due;
                }
                skipped_.push_back(frame);
            } catch (const InputError& error) {
                fail(frame, error.what());
                if (!arguments_.keeps_going) return std::nullopt;
            }
        }
        return std::nullopt;
    }

    /// Renders a frame, and returns the next one.
    std::optional<Due> render(Due due) {
        std::optional<Due> next;
        bool has_next = false;
        const auto look_ahead = [&] {
            if (std::exchange(has_next, true)) return;
            next = next_due();
            if (next) next_.begin(next->frame);
        };
        report_.begin(due.frame);
        try {
            SceneChange change = next_.take();
            look_ahead();
            renderer_.pose(std::move(change));
            DrawnFrame drawn = renderer_.draw(renderer_.outputs_of(due.frame, due.fingerprint), &progress_);
            drawn.skipped_behind = std::exchange(skipped_, {});
            writer_.write(std::move(drawn));
        } catch (const InputError& error) {
            fail(due.frame, error.what());
            if (arguments_.keeps_going) look_ahead();
            report_.skipped(std::exchange(skipped_, {}));
        }
        return next;
    }

    void fail(double frame, const std::string& why) {
        writer_.wait();
        report_.failed(frame, why);
    }

    /// Whether a frame need not be rendered again.
    bool is_there(double frame, const FrameFingerprint& fingerprint) {
        if (!arguments_.skips_existing) return false;
        std::string note;
        if (renderer_.is_there(frame, fingerprint, note)) return true;
        progress_.hide();
        note_on_frame(arguments_, "frame " + text_of_frame(frame) + ": ", note);
        return false;
    }

    [[noreturn]] void stop_at(double frame) {
        writer_.wait();
        report_.interrupted(frame);
        progress_.finish();
        report_.finish();
        if (!report_.last_done()) throw Interrupted();
        throw Interrupted("interrupted after frame " + text_of_frame(*report_.last_done()) +
                          "; --skip-existing goes on");
    }

    void fail_if_frames_failed() const {
        const std::vector<double>& failed = report_.failed_frames();
        if (failed.empty()) return;
        if (!arguments_.keeps_going)
            throw InputError("frame " + text_of_frame(failed.front()) + ": " + report_.first_failure());
        throw InputError(std::to_string(failed.size()) + " of " + std::to_string(plan_.frames.size()) +
                         " frames failed: " + text_of_frames(failed));
    }

    const Arguments& arguments_;
    const FramePlan& plan_;
    FrameRenderer& renderer_;
    Progress& progress_;
    JobReport report_;
    bool in_background_;
    NextChange next_;
    FrameWriter writer_;
    std::size_t at_ = 0;           // of the frames: what next_due() looks at
    std::vector<double> skipped_;  // found by it, and not told
    bool has_checked_ = false;     // that files can be written
};

}  // namespace

void run_render(const Arguments& a) {
    const bool shows_bar = !a.quiet && isatty(STDERR_FILENO) != 0;
    Progress progress(a.alf_progress ? ProgressStyle::alf : (shows_bar ? ProgressStyle::bar : ProgressStyle::none));
    Stopwatch total, watch;
    RenderJob ready(a);
    if (a.is_dry_run) return tell_dry_run(ready, a);
    const FramePlan& plan = ready.plan();
    const double load_s = watch.lap() - ready.renderer().pose_s();  // that is counted with the first frame's
    if (!plan.is_sequence) return render_still(a, ready, load_s, total, progress, shows_bar);
    FrameJob job(a, plan, ready.renderer(), progress, load_s);
    job.run();
    if (a.verbose || shows_bar) {
        std::fprintf(stderr, "%s: %zu frames, %.2f s\n", plan.outputs.front().path.c_str(), plan.frames.size(),
                     total.seconds());
    }
}

}  // namespace burin
