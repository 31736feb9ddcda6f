#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace burin::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

/// How the program is run, beyond its arguments.
struct ProgramOptions {
    int time_limit_s = kSanitized ? 60 : 10;
    std::optional<std::size_t> file_size_limit;  ///< bytes; what a full disk looks like
    std::optional<std::size_t> memory_limit;     ///< bytes, less than what every run is limited to
    std::vector<int> closed_streams;             ///< standard streams that are closed: 0, 1, 2
    std::string stdout_file;                     ///< instead of a pipe
    bool has_reader = true;                      ///< else what standard output leads to is gone
    bool stderr_is_terminal = false;
    bool obeys_permissions = false;  ///< even where root runs the tests
};

struct ProgramResult {
    int status = -1;  ///< exit status, or 128 + number of the signal that killed it
    bool timed_out = false;
    std::string out, err;
};

/// The program itself, running in a folder, with its memory and time limited.
class Program {
  public:
    Program(const std::string& folder, const std::vector<std::string>& arguments, const ProgramOptions& options = {});
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void send(int signal_number) const;
    /// Collects what it prints until it ends, and kills it at the time limit.
    ProgramResult wait();

  private:
    ProgramOptions options_;
    pid_t child_ = -1;
    int out_ = -1, err_ = -1;
};

inline ProgramResult run_burin(const std::string& folder, const std::vector<std::string>& arguments,
                               const ProgramOptions& options = {}) {
    return Program(folder, arguments, options).wait();
}

/// True for one line with a line feed at its end.
bool is_one_line(const std::string& text);

}  // namespace burin::test
