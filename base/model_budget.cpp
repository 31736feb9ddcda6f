#include "base/model_budget.h"

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
    const std::uint64_t sum = bytes > UINT64_MAX - counted_bytes_ ? UINT64_MAX : counted_bytes_ + bytes;
    if (sum > limit_bytes_) {
        const std::string before = counted_bytes_ > 0 ? ", with what was counted before " + size_text(sum) : "";
        const std::string option(option_);
        throw InputError(what + " needs about " + size_text(bytes) + before + ", more than the " +
                         size_text(limit_bytes_) + " that " +
                         (option.empty() ? "models may take" : option + " allows") + "; make it simpler" +
                         (option.empty() ? "" : ", or give " + option + " " + option_text(sum)));
    }
    counted_bytes_ = sum;
}

}  // namespace burin
