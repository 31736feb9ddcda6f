#pragma once

#include <sched.h>

#include <stdexcept>
#include <vector>

namespace burin::bench {

// Cores of a shared machine are often not equally fast, and which one is faster changes: benchmarks time both and
// choose.

/// The first two cores that this process may run on; none where there are fewer.
inline std::vector<cpu_set_t> two_cores() {
    std::vector<cpu_set_t> cores;
    cpu_set_t all;
    if (::sched_getaffinity(0, sizeof all, &all) != 0) return cores;
    for (int i = 0; i < CPU_SETSIZE && cores.size() < 2; ++i) {
        if (!CPU_ISSET(i, &all)) continue;
        CPU_ZERO(&cores.emplace_back());
        CPU_SET(i, &cores.back());
    }
    if (cores.size() < 2) cores.clear();
    return cores;
}

/// Keeps this thread on one core for as long as it lives.
class OnCore {
  public:
    explicit OnCore(const cpu_set_t& core) {
        if (::sched_getaffinity(0, sizeof before_, &before_) != 0 || ::sched_setaffinity(0, sizeof core, &core) != 0)
            throw std::runtime_error("cannot choose a core");
    }
    ~OnCore() { ::sched_setaffinity(0, sizeof before_, &before_); }
    OnCore(const OnCore&) = delete;
    OnCore& operator=(const OnCore&) = delete;

  private:
    cpu_set_t before_;
};

}  // namespace burin::bench
