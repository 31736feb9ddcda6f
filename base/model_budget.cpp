#include "base/model_budget.h"

#include <algorithm>
#include <cstdio>

#include "base/error.h"

namespace burin {
namespace {

/// A size as options take it, rounded up.
std::string option_text(std::uint64_t bytes) {
    constexpr int kMega = 20, kGiga = 30;
    const int shift = bytes >> kGiga < 16 ? kMega : kGiga;
    return std::to_string((bytes >> shift) + 1) + (shift == kMega ? "M" : "G");
}

std::uint64_t saturating_sum(std::uint64_t a, std::uint64_t b) { return b > UINT64_MAX - a ? UINT64_MAX : a + b; }

}  // namespace

std::string size_text(std::uint64_t bytes) {
    constexpr const char* kUnits[] = {"bytes", "KB", "MB", "GB", "TB"};
    auto value = static_cast<double>(bytes);
    int unit = 0;
    for (; value >= 1000 && unit < 4; ++unit) value /= 1024;
    char text[64];
    std::snprintf(text, sizeof text, unit > 0 && value < 9.95 ? "%.1f %s" : "%.0f %s", value, kUnits[unit]);
    return text;
}

void ModelBudget::add(std::uint64_t bytes, const std::string& what) {
    const std::uint64_t sum = saturating_sum(counted_bytes_, bytes);
    if (sum > limit_bytes_) {
        const std::uint64_t needed = std::max(sum, foreseen_bytes_);
        const std::string all = size_text(needed) == size_text(bytes) ? ""
                                : needed == sum ? ", with what was counted before " + size_text(needed)
                                                : ", all of its kind together " + size_text(needed);
        const std::string option(option_);
        throw InputError(what + " needs about " + size_text(bytes) + all + ", more than the " +
                         size_text(limit_bytes_) + " that " +
                         (option.empty() ? "models may take" : option + " allows") + "; make it simpler" +
                         (option.empty() ? "" : ", or give " + option + " " + option_text(needed)));
    }
    counted_bytes_ = sum;
}

void ModelBudget::foresee(std::uint64_t bytes) { foreseen_bytes_ = saturating_sum(counted_bytes_, bytes); }

}  // namespace burin
