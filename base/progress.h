#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

// Long jobs tell the user on a terminal how far they are.

namespace burin {

/// How progress is shown.
enum class ProgressStyle : std::uint8_t {
    none,
    bar,   ///< one line on standard error, redrawn, with the time left
    alf,   ///< lines "ALF_PROGRESS n%" on standard output, as render farms read them
    told,  ///< to a function
};

/// Shows how far a job is. Any thread may call advance(); the screen is touched a few times a
/// second at most.
class Progress {
  public:
    explicit Progress(ProgressStyle style) : style_(style) {}
    /// Calls tell(part that is done, 0 to 1) instead, after an interval at least, from advance() on the thread that
    /// made this, and on no other.
    explicit Progress(std::function<void(double)> tell, std::chrono::milliseconds interval = kInterval)
        : style_(ProgressStyle::told), tell_(std::move(tell)), interval_(interval) {}
    ~Progress() { finish(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Starts a phase of `steps` steps. `label` is shown in front of the bar.
    void begin(std::string label, std::uint64_t steps);
    /// From now on all phases are parts of one job of this weight, with one bar and one time left.
    void plan(std::uint64_t total_weight);
    /// The phases that follow are one part of the planned job. The weights of all parts add up to
    /// the total.
    void next_part(std::string label, std::uint64_t weight);
    void advance(std::uint64_t steps = 1);
    /// The job that was planned will take so many seconds more: from now on that is what is shown as left.
    void expect(double seconds);
    /// Clears the bar from the screen until it is shown again.
    void hide();
    /// Clears the bar from the screen, or reports 100 %. Idempotent.
    void finish();

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds kInterval{100};
    void show(std::uint64_t done);
    void start_phase(std::uint64_t steps);
    double fraction(std::uint64_t done);
    double seconds_left(double complete) const;
    void clear_bar();

    ProgressStyle style_;
    std::function<void(double)> tell_;
    std::chrono::milliseconds interval_ = kInterval;
    std::thread::id maker_ = std::this_thread::get_id();
    std::mutex mutex_;  // guards everything below but done_
    std::string label_;
    std::uint64_t steps_ = 0;
    std::atomic<std::uint64_t> done_{0};
    Clock::time_point start_{};
    std::atomic<Clock::rep> next_show_{0};
    std::uint64_t total_weight_ = 0;  // 0: every phase is a job of its own
    std::uint64_t weight_before_ = 0;
    std::uint64_t part_weight_ = 0;
    double expected_s_ = -1;  // left at expected_since_; negative: nobody has said it
    Clock::time_point expected_since_{};
    double highest_ = 0;  // a planned job's bar never moves back
    int last_percent_ = -1;
    bool bar_visible_ = false;
    bool any_phase_ = false;
};

}  // namespace burin
