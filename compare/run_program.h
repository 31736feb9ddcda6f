#pragma once

#include <string>
#include <vector>

// Another program does a part of the work: found on PATH, run without a shell, and never waited for without end.

namespace burin {

/// The path of a program that a folder of PATH has; empty if none has it.
std::string find_program(const std::string& name);

/// Runs a program with nothing to read and waits for it. `log`: the path of a file that gets what it prints.
/// Throws InputError, with what it printed, if it cannot start, fails, or takes longer than the limit, which ends it.
void run_program(const std::string& path, const std::vector<std::string>& arguments, const std::string& log,
                 double time_limit_s);

}  // namespace burin
