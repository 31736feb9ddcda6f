#include "compare/run_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <thread>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/stopwatch.h"
#include "mesh/text_scan.h"

namespace burin {
namespace {

constexpr std::size_t kLongestMessage = 300;

/// Where a program's standard streams go.
class StandardStreams {
  public:
    explicit StandardStreams(const std::string& log) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
    }
    ~StandardStreams() { posix_spawn_file_actions_destroy(&actions_); }
    StandardStreams(const StandardStreams&) = delete;
    StandardStreams& operator=(const StandardStreams&) = delete;

    const posix_spawn_file_actions_t* actions() const { return &actions_; }

  private:
    posix_spawn_file_actions_t actions_;
};

/// A program that runs; it is killed with this object if it has not ended.
class RunningProgram {
  public:
    explicit RunningProgram(pid_t child) : child_(child) {}
    ~RunningProgram() {
        if (child_ <= 0) return;
        ::kill(child_, SIGKILL);
        while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) continue;
    }
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    /// Whether it has ended; `status` is then as waitpid() tells it.
    bool has_ended(int& status) {
        if (::waitpid(child_, &status, WNOHANG) != child_) return false;
        child_ = 0;
        return true;
    }

  private:
    pid_t child_;
};

/// What a program printed, as a part of an error message.
std::string message_in(const std::string& log) {
    std::ifstream file(log, std::ios::binary);
    std::string text(kLongestMessage + 1, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text.empty() ? "" : ": " + printable(text, kLongestMessage);
}

}  // namespace

std::string find_program(const std::string& name) {
    const char* const path = std::getenv("PATH");
    std::string_view rest = path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin";
    while (!rest.empty()) {
        const std::size_t length = std::min(rest.find(':'), rest.size());
        const std::filesystem::path program = std::filesystem::path(rest.substr(0, length)) / name;
        rest.remove_prefix(std::min(length + 1, rest.size()));
        std::error_code error;
        if (!program.is_absolute() || !std::filesystem::is_regular_file(program, error)) continue;
        if (::access(program.c_str(), X_OK) == 0) return program.string();
    }
    return "";
}

void run_program(const std::string& path, const std::vector<std::string>& arguments, const std::string& log,
                 double time_limit_s) {
    std::vector<std::string> words = {path};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    const StandardStreams streams(log);
    const Stopwatch watch;
    pid_t child = 0;
    if (const int error = ::posix_spawn(&child, path.c_str(), streams.actions(), nullptr, argv.data(), environ)) {
        throw InputError(path + ": cannot run this program: " + std::strerror(error));
    }
    RunningProgram program(child);
    int status = 0;
    while (!program.has_ended(status)) {
        throw_if_interrupted();
        if (watch.seconds() > time_limit_s) {
            throw InputError(path + ": took longer than " + std::to_string(std::lround(std::ceil(time_limit_s))) +
                             " s and was stopped" + message_in(log));
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(watch.seconds() < 0.1 ? 1 : 10));
    }
    throw_if_interrupted();  // the terminal stops this program, too
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    throw InputError(path +
                     (WIFEXITED(status) ? ": failed with exit status " + std::to_string(WEXITSTATUS(status))
                                        : ": was killed by signal " + std::to_string(WTERMSIG(status))) +
                     message_in(log));
}

}  // namespace burin
