#pragma once

#include <array>
#include <cstdio>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/stopwatch.h"
#include "cli/arguments.h"
#include "cli/frames/frame_renderer.h"

namespace burin {

/// Says how far a job of several frames is: the lines of --stats, "Saved:" for render farms, errors of frames that do
/// not end it, and the time left. Any threads may call it.
class JobReport {
  public:
    /// Throws InputError if the statistics cannot be written.
    JobReport(const Arguments& arguments, const FramePlan& plan, Progress& progress);
    ~JobReport();
    JobReport(const JobReport&) = delete;
    JobReport& operator=(const JobReport&) = delete;

    /// How long reading the input took.
    void loaded(double seconds);
    /// A frame is drawn next.
    void begin(double frame);
    void done(const DrawnFrame& frame);
    /// These are there already.
    void skipped(const std::vector<double>& frames);
    void failed(double frame, const std::string& why);
    void interrupted(double frame);
    /// Writes what all frames have in common. Throws InputError if statistics could not be written.
    void finish();

    bool has_failures();
    // When nothing is written any more:
    const std::vector<double>& failed_frames() const { return failed_frames_; }
    const std::string& first_failure() const { return first_failure_; }
    /// The last frame that is there.
    std::optional<double> last_done() const { return last_done_; }

  private:
    enum Status : std::size_t { kDone, kSkipped, kFailed, kInterrupted, kStatusCount };
    void tell(double frame, Status status, const StageTimes* times, const std::string* error);
    /// Writes a frame's line once those of the frames before it are written.
    void write_in_turn(double frame, std::string line);
    void write(const std::string& line);

    const Arguments& arguments_;
    const FramePlan& plan_;
    Progress& progress_;
    std::mutex mutex_;  // guards all that follows
    std::FILE* stats_ = nullptr;
    bool owns_stats_ = false;
    std::array<std::size_t, kStatusCount> counts_{};
    StageTimes sum_;
    Stopwatch total_, since_last_;
    std::deque<double> last_seconds_;  // of the frames drawn last
    std::vector<double> failed_frames_;
    std::string first_failure_;
    std::optional<double> last_done_;
    bool is_finished_ = false;
    std::map<std::size_t, std::string> waiting_;  // lines, by the place of their frame in the plan
    std::size_t next_line_ = 0;
};

}  // namespace burin
