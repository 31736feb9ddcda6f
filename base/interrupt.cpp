#include "base/interrupt.h"

#include <csignal>

#include "base/error.h"

namespace burin {
namespace {

// A signal handler can reach nothing but a global.
StopFlag g_interrupted{false};
static_assert(StopFlag::is_always_lock_free);

thread_local const StopFlag* t_stop_flag = &g_interrupted;

extern "C" void on_signal(int signal_number) {
    const bool is_second = g_interrupted.exchange(true, std::memory_order_relaxed);
    // SIGXCPU comes again after every second of CPU time, which many threads use up in a moment.
    if (!is_second || signal_number == SIGXCPU) return;
    std::signal(signal_number, SIG_DFL);
    std::raise(signal_number);  // it kills when this handler returns
}

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
        sigemptyset(&action.sa_mask);
        sigaction(signal_number, &action, nullptr);
    }
}

const StopFlag& stop_flag_of_thread() noexcept { return *t_stop_flag; }

StopScope::StopScope(const StopFlag& flag) noexcept : outer_(t_stop_flag) { t_stop_flag = &flag; }
StopScope::~StopScope() { t_stop_flag = outer_; }

bool interrupt_requested() noexcept { return t_stop_flag->load(std::memory_order_relaxed); }

void throw_if_interrupted() {
    if (interrupt_requested()) throw Interrupted();
}

}  // namespace burin
