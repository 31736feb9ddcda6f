#include "tests/cli/program.h"

#include <fcntl.h>
#include <linux/capability.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <stdexcept>

namespace burin::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr rlim_t kMemoryLimit = rlim_t{2} << 30;

struct Pipe {
    int read_end = -1, write_end = -1;
};

Pipe make_pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    return {ends[0], ends[1]};
}

Pipe make_terminal() {
    const int master = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (master < 0 || ::grantpt(master) != 0 || ::unlockpt(master) != 0) throw std::runtime_error("no terminal");
    return {master, ::open(::ptsname(master), O_RDWR | O_NOCTTY | O_CLOEXEC)};
}

void limit(__rlimit_resource resource, rlim_t value) {
    const rlimit limits{value, value};
    ::setrlimit(resource, &limits);
}

/// Reads what is there; false at the end.
bool drain(int fd, std::string& text) {
    std::array<char, 65536> buffer;
    const ssize_t count = ::read(fd, buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    return count > 0 || (count < 0 && errno == EINTR);
}

}  // namespace

Program::Program(const std::string& folder, const std::vector<std::string>& arguments, const ProgramOptions& options)
    : options_(options) {
    std::vector<std::string> words = {BURIN_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    const Pipe out = make_pipe();
    if (!options.has_reader) ::close(out.read_end);
    const Pipe err = options.stderr_is_terminal ? make_terminal() : make_pipe();
    child_ = ::fork();
    if (child_ < 0) throw std::runtime_error("no process");
    if (child_ == 0) {
        // Nothing here may allocate: between fork and exec only system calls are safe.
        if (::chdir(folder.c_str()) != 0) ::_exit(126);
        ::dup2(::open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
        const int target =
            options.stdout_file.empty() ? out.write_end : ::open(options.stdout_file.c_str(), O_WRONLY | O_CLOEXEC);
        ::dup2(target, STDOUT_FILENO);
        ::dup2(err.write_end, STDERR_FILENO);
        for (const int stream : options.closed_streams) ::close(stream);
        limit(RLIMIT_CORE, 0);
        if (!kSanitized) limit(RLIMIT_AS, options.memory_limit.value_or(kMemoryLimit));  // sanitizers reserve terabytes
        if (options.file_size_limit) limit(RLIMIT_FSIZE, *options.file_size_limit);
        if (options.obeys_permissions && ::geteuid() == 0) {
            ::prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE);
            ::prctl(PR_CAPBSET_DROP, CAP_DAC_READ_SEARCH);
        }
        for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGPIPE, SIGXFSZ})
            ::signal(signal_number, SIG_DFL);
        ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    ::close(out.write_end);
    ::close(err.write_end);
    out_ = options.has_reader ? out.read_end : -1;
    err_ = err.read_end;
}

Program::~Program() {
    if (child_ > 0) {
        ::kill(child_, SIGKILL);
        ::waitpid(child_, nullptr, 0);
    }
    if (out_ >= 0) ::close(out_);
    if (err_ >= 0) ::close(err_);
}

void Program::send(int signal_number) const { ::kill(child_, signal_number); }

ProgramResult Program::wait() {
    ProgramResult result;
    const auto end = Clock::now() + std::chrono::seconds(options_.time_limit_s);
    std::array<pollfd, 2> streams = {pollfd{out_, POLLIN, 0}, pollfd{err_, POLLIN, 0}};
    while (streams[0].fd >= 0 || streams[1].fd >= 0) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        if (left <= 0) {
            result.timed_out = true;
            ::kill(child_, SIGKILL);
            break;
        }
        if (::poll(streams.data(), streams.size(), static_cast<int>(left)) <= 0) continue;
        if (streams[0].revents != 0 && !drain(out_, result.out)) streams[0].fd = -1;
        if (streams[1].revents != 0 && !drain(err_, result.err)) streams[1].fd = -1;
    }
    // Both streams are closed: it has ended, or is about to, or was killed.
    int status = 0;
    ::waitpid(child_, &status, 0);
    child_ = -1;
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
}

bool is_one_line(const std::string& text) {
    return text.size() > 1 && std::count(text.begin(), text.end(), '\n') == 1 && text.back() == '\n';
}

}  // namespace burin::test
