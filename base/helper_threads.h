#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace burin {

class HelperThread;

/// Has helper threads do something beside the calling one, as long as it lives.
///
/// A frame does so five times and more, and to start a thread and to end it takes 0.1 to 0.3 ms on a virtual machine.
/// So helpers are started when they are first needed, wait for more to do until the process ends (for a moment awake:
/// what comes next mostly comes soon), and are taken by whoever needs some, on any thread. A process that was forked
/// has its own ones. A helper keeps the affinity and the signal mask of the thread that it was started for.
class HelperThreads {
  public:
    /// Calls work(number) for each number in [1, count], each on its own helper; for fewer, those least, where the
    /// system has no more threads. `work` must not throw, and must live until this is destroyed.
    HelperThreads(std::size_t count, const std::function<void(int)>& work);
    /// Returns when all are done.
    ~HelperThreads();
    HelperThreads(const HelperThreads&) = delete;
    HelperThreads& operator=(const HelperThreads&) = delete;

  private:
    std::vector<HelperThread*> helpers_;
};

}  // namespace burin
