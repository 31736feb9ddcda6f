// Signals that ask the program to stop: the first one is obeyed, the second one kills.

#include "base/interrupt.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

namespace burin::interrupt_test {
namespace {

/// What becomes of a process that gets these signals: "asked", or the number of the signal that killed it.
std::string fate(const std::vector<int>& signals, bool ignores_hangup = false) {
    const pid_t child = ::fork();
    if (child == 0) {
        for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) std::signal(number, SIG_DFL);
        if (ignores_hangup) std::signal(SIGHUP, SIG_IGN);
        install_interrupt_handlers();
        for (const int number : signals) std::raise(number);
        ::_exit(interrupt_requested() ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFSIGNALED(status)) return std::to_string(WTERMSIG(status));
    return WEXITSTATUS(status) == 0 ? "asked" : "not asked";
}

TEST(Interrupt, TheFirstSignalAsksAndTheSecondKillsWhateverItsKind) {
    const std::vector<int> kinds = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
    EXPECT_EQ(fate({}), "not asked");
    for (const int first : kinds) {
        EXPECT_EQ(fate({first}), "asked") << first;
        for (const int second : kinds) EXPECT_EQ(fate({first, second}), std::to_string(second)) << first;
    }
}

TEST(Interrupt, CpuTimeThatIsUsedUpAgainKillsNobody) {
    EXPECT_EQ(fate({SIGXCPU, SIGXCPU, SIGXCPU}), "asked");
    EXPECT_EQ(fate({SIGTERM, SIGXCPU}), "asked");
    EXPECT_EQ(fate({SIGXCPU, SIGTERM}), std::to_string(SIGTERM));
}

TEST(Interrupt, AHangupThatIsIgnoredStaysSo) {
    EXPECT_EQ(fate({SIGHUP, SIGHUP}, true), "not asked");
    EXPECT_EQ(fate({SIGINT, SIGHUP}, true), "asked");
}

}  // namespace
}  // namespace burin::interrupt_test
