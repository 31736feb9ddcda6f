#include "base/interrupt.h"

#include <atomic>
#include <csignal>

#include "base/error.h"

namespace burin {
namespace {

// A signal handler can reach nothing but a global.
std::atomic<bool> g_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void on_signal(int) { g_interrupted.store(true, std::memory_order_relaxed); }

}  // namespace

void install_interrupt_handlers() {
    for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) {
        struct sigaction action {};
        if (signal_number == SIGHUP && sigaction(SIGHUP, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) {
            continue;  // nohup
        }
        action = {};
        action.sa_handler = on_signal;
        action.sa_flags = SA_RESTART;
        // SIGXCPU comes again after every second of CPU time, which many threads use up in a
        // moment.
        if (signal_number != SIGXCPU) action.sa_flags |= static_cast<int>(SA_RESETHAND);
        sigemptyset(&action.sa_mask);
        sigaction(signal_number, &action, nullptr);
    }
}

bool interrupt_requested() noexcept { return g_interrupted.load(std::memory_order_relaxed); }

void throw_if_interrupted() {
    if (interrupt_requested()) throw Interrupted();
}

}  // namespace burin
