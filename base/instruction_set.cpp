#include "base/instruction_set.h"

#include <array>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.h"

namespace burin {
namespace {

constexpr const char* kVariable = "BURIN_KERNELS";

std::optional<InstructionSet> set_of_word(std::string_view word) {
    constexpr std::array<std::string_view, 3> kWords{"baseline", "avx2", "avx512"};
    for (std::size_t i = 0; i < kWords.size(); ++i) {
        if (word == kWords[i]) return static_cast<InstructionSet>(i);
    }
    return std::nullopt;
}

}  // namespace

bool has_instruction_set(InstructionSet set) {
#ifdef __x86_64__
    switch (set) {
        case InstructionSet::baseline:
            return true;
        case InstructionSet::avx2:
            return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt");
        case InstructionSet::avx512:
            return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                   __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("popcnt");
    }
#endif
    return set == InstructionSet::baseline;
}

InstructionSet allowed_instruction_set() {
    static const InstructionSet allowed = [] {
        const char* const word = std::getenv(kVariable);
        return set_of_word(word == nullptr ? "" : word).value_or(InstructionSet::avx512);
    }();
    return allowed;
}

void check_instruction_set() {
    const char* const word = std::getenv(kVariable);
    if (word == nullptr) return;
    const auto set = set_of_word(word);
    const std::string name = std::string(kVariable) + "=" + word;
    if (!set) throw UsageError(name + ": unknown; give baseline, avx2 or avx512");
    if (!has_instruction_set(*set))
        throw UsageError(name + ": this processor has no such instructions; give baseline, or leave it out");
}

}  // namespace burin
