#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

// Exceptions say what is wrong with an input or a command line, where, and what to do; each stands for an exit status.

namespace burin {

/// A place in an input file, for error messages. Line and column count from 1; 0 = unknown.
struct SourcePosition {
    std::string file;
    std::size_t line = 0;
    std::size_t column = 0;
};

/// "file:line:column", without the parts that are unknown.
std::string to_string(const SourcePosition& position);

/// Bad input or a job that cannot be finished: exit status 1.
/// `what()` is one line: "file:line: what is wrong; what to do about it".
class InputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    InputError(const SourcePosition& position, const std::string& message)
        : std::runtime_error(to_string(position) + ": " + message) {}
};

/// The command line does not make sense: exit status 2.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The user pressed Ctrl-C, or the process got another signal that asks it to stop: exit status 130.
class Interrupted : public std::runtime_error {
  public:
    Interrupted() : std::runtime_error("interrupted; no file was written") {}
    /// When there is something to say about what is left.
    explicit Interrupted(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace burin
