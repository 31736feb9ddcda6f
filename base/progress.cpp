#include "base/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace burin {
namespace {

constexpr std::chrono::milliseconds kShowInterval{100};
constexpr int kBarWidth = 30;

std::string minutes_and_seconds(double seconds) {
    const auto whole = static_cast<long>(std::min(std::ceil(seconds), 359999.0));
    char text[32];
    std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
    return text;
}

}  // namespace

void Progress::begin(std::string label, std::uint64_t steps) {
    if (style_ == ProgressStyle::none) return;
    const std::lock_guard lock(mutex_);
    label_ = std::move(label);
    steps_ = std::max<std::uint64_t>(steps, 1);
    done_ = 0;
    start_ = Clock::now();
    next_show_ = (start_ + kShowInterval).time_since_epoch().count();
    any_phase_ = true;
}

void Progress::advance(std::uint64_t steps) {
    if (style_ == ProgressStyle::none) return;
    const std::uint64_t done = done_.fetch_add(steps, std::memory_order_relaxed) + steps;
    const auto now = Clock::now();
    if (now.time_since_epoch().count() < next_show_.load(std::memory_order_relaxed)) return;
    std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    next_show_ = (now + kShowInterval).time_since_epoch().count();
    show(done);
}

void Progress::show(std::uint64_t done) {
    const double fraction =
        std::min(1.0, static_cast<double>(done) / static_cast<double>(steps_));
    const int percent = static_cast<int>(fraction * 100.0);
    if (style_ == ProgressStyle::alf) {
        if (percent == last_percent_) return;
        std::printf("ALF_PROGRESS %d%%\n", percent);
        std::fflush(stdout);
        last_percent_ = percent;
        return;
    }
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
    const double left_s = fraction > 0 ? elapsed_s * (1 - fraction) / fraction : 0;
    const int filled = static_cast<int>(fraction * kBarWidth);
    std::string bar(static_cast<std::size_t>(filled), '#');
    bar.resize(kBarWidth, '.');
    std::fprintf(stderr, "\r%-10s [%s] %3d %%  %s left \x1b[K", label_.c_str(), bar.c_str(), percent,
                 minutes_and_seconds(left_s).c_str());
    std::fflush(stderr);
    bar_visible_ = true;
}

void Progress::finish() {
    const std::lock_guard lock(mutex_);
    if (bar_visible_) {
        std::fputs("\r\x1b[K", stderr);
        std::fflush(stderr);
        bar_visible_ = false;
    }
    if (style_ == ProgressStyle::alf && any_phase_ && done_ >= steps_ && last_percent_ != 100) {
        std::printf("ALF_PROGRESS 100%%\n");
        std::fflush(stdout);
        last_percent_ = 100;
    }
}

}  // namespace burin
