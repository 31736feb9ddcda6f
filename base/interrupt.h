#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>

// Signals that ask the program to stop become an exception that long loops throw, so that no partial file is left.

namespace burin {

/// From now on SIGINT, SIGTERM, SIGHUP (the terminal is gone), SIGQUIT and SIGXCPU (a limit of CPU time) ask the
/// program to stop instead of killing it. A second one, of whatever kind but SIGXCPU, kills at once. A SIGHUP that is
/// ignored stays so.
void install_interrupt_handlers();

/// What tells a thread to stop: a flag that somebody else sets.
using StopFlag = std::atomic<bool>;

/// The flag that this thread looks at: the one that the signals set, unless a StopScope names another.
const StopFlag& stop_flag_of_thread() noexcept;

/// While it lives, its thread looks at a flag of its own and no longer at the signals': so one of several jobs of a
/// process can be stopped. The threads that help with parallel_for() do as the one that calls it. Scopes may be nested.
class StopScope {
  public:
    explicit StopScope(const StopFlag& flag) noexcept;
    ~StopScope();
    StopScope(const StopScope&) = delete;
    StopScope& operator=(const StopScope&) = delete;

  private:
    const StopFlag* outer_;
};

/// True once this thread's flag is set.
bool interrupt_requested() noexcept;

/// Throws `Interrupted` once this thread's flag is set. Long loops call this now and then.
void throw_if_interrupted();

/// std::fill_n for what may be gigabytes that the system must back first: asks in between whether to stop.
template <typename T>
void fill_stoppably(T* to, std::size_t count, T value) {
    constexpr std::size_t kAtOnce = (std::size_t{1} << 21) / sizeof(T);
    for (std::size_t begin = 0; begin < count; begin += kAtOnce) {
        throw_if_interrupted();
        std::fill_n(to + begin, std::min(kAtOnce, count - begin), value);
    }
}

}  // namespace burin
