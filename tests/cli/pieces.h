#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/program.h"

namespace burin::test {

/// What `burin render --dry-run` says of a picture that one thread draws.
inline nlohmann::json dry_run(const std::string& folder, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"--dry-run", "--json", "-q", "-j", "1"});
    return nlohmann::json::parse(run_burin(folder, arguments).out);
}

/// Options that have one thread draw a picture under the least cap for memory. Empty if that is not in several pieces.
inline std::vector<std::string> in_pieces(const std::string& folder, std::vector<std::string> arguments) {
    const std::uint64_t least = dry_run(folder, arguments).at("memory_bytes").at("least");
    const std::string cap = std::to_string((least + (1 << 20) - 1) >> 20) + "M";
    arguments.insert(arguments.end(), {"--memory", cap});
    if (dry_run(folder, arguments).at("pieces") < 2) return {};
    return {"-j", "1", "--memory", cap};
}

}  // namespace burin::test
