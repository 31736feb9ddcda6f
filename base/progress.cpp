#include "base/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace burin {
namespace {

constexpr int kBarWidth = 30;

std::string minutes_and_seconds(double seconds) {
    const auto whole = static_cast<long>(std::min(std::ceil(seconds), 359999.0));
    char text[32];
    std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
    return text;
}

}  // namespace

void Progress::start_phase(std::uint64_t steps) {
    steps_ = std::max<std::uint64_t>(steps, 1);
    done_ = 0;
    any_phase_ = true;
}

void Progress::begin(std::string label, std::uint64_t steps) {
    if (style_ == ProgressStyle::none) return;
    const std::lock_guard lock(mutex_);
    start_phase(steps);
    if (total_weight_ > 0) return;
    label_ = std::move(label);
    start_ = Clock::now();
    next_show_ = (start_ + interval_).time_since_epoch().count();
}

void Progress::plan(std::uint64_t total_weight) {
    if (style_ == ProgressStyle::none) return;
    const std::lock_guard lock(mutex_);
    total_weight_ = std::max<std::uint64_t>(total_weight, 1);
    weight_before_ = part_weight_ = 0;
    highest_ = 0;
    start_ = Clock::now();
    next_show_ = (start_ + interval_).time_since_epoch().count();
    start_phase(1);
}

void Progress::next_part(std::string label, std::uint64_t weight) {
    if (style_ == ProgressStyle::none) return;
    const std::lock_guard lock(mutex_);
    label_ = std::move(label);
    weight_before_ += part_weight_;
    part_weight_ = weight;
    start_phase(1);
}

double Progress::fraction(std::uint64_t done) {
    const double of_phase = std::min(1.0, static_cast<double>(done) / static_cast<double>(steps_));
    if (total_weight_ == 0) return of_phase;
    const double weight = static_cast<double>(weight_before_) + of_phase * static_cast<double>(part_weight_);
    highest_ = std::max(highest_, std::min(1.0, weight / static_cast<double>(total_weight_)));
    return highest_;
}

void Progress::advance(std::uint64_t steps) {
    if (style_ == ProgressStyle::none) return;
    const std::uint64_t done = done_.fetch_add(steps, std::memory_order_relaxed) + steps;
    const auto now = Clock::now();
    if (now.time_since_epoch().count() < next_show_.load(std::memory_order_relaxed)) return;
    if (style_ == ProgressStyle::told && std::this_thread::get_id() != maker_) return;
    std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    next_show_ = (now + interval_).time_since_epoch().count();
    show(done);
}

void Progress::show(std::uint64_t done) {
    const double complete = fraction(done);
    if (style_ == ProgressStyle::told) return tell_(complete);
    const int percent = static_cast<int>(complete * 100.0);
    if (style_ == ProgressStyle::alf) {
        if (percent == last_percent_) return;
        std::printf("ALF_PROGRESS %d%%\n", percent);
        std::fflush(stdout);
        last_percent_ = percent;
        return;
    }
    const double left_s = seconds_left(complete);
    const int filled = static_cast<int>(complete * kBarWidth);
    std::string bar(static_cast<std::size_t>(filled), '#');
    bar.resize(kBarWidth, '.');
    std::fprintf(stderr, "\r%-10s [%s] %3d %%  %s left \x1b[K", label_.c_str(), bar.c_str(), percent,
                 minutes_and_seconds(left_s).c_str());
    std::fflush(stderr);
    bar_visible_ = true;
}

double Progress::seconds_left(double complete) const {
    const auto since = [](Clock::time_point start) {
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    if (expected_s_ >= 0) return std::max(0.0, expected_s_ - since(expected_since_));
    return complete > 0 ? since(start_) * (1 - complete) / complete : 0;
}

void Progress::expect(double seconds) {
    if (style_ == ProgressStyle::none) return;
    const std::lock_guard lock(mutex_);
    expected_s_ = seconds;
    expected_since_ = Clock::now();
}

void Progress::hide() {
    const std::lock_guard lock(mutex_);
    clear_bar();
}

void Progress::clear_bar() {
    if (!bar_visible_) return;
    std::fputs("\r\x1b[K", stderr);
    std::fflush(stderr);
    bar_visible_ = false;
}

void Progress::finish() {
    const std::lock_guard lock(mutex_);
    clear_bar();
    if (style_ == ProgressStyle::alf && any_phase_ && done_ >= steps_ && last_percent_ != 100 &&
        weight_before_ + part_weight_ >= total_weight_) {
        std::printf("ALF_PROGRESS 100%%\n");
        std::fflush(stdout);
        last_percent_ = 100;
    }
}

}  // namespace burin
