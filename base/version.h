#pragma once

namespace burin {

/// The program and its version, as files and --version say it.
constexpr const char* kProgramVersion = "burin 0.1.0";

}  // namespace burin
