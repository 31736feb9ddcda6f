#include "compare/peak_memory.h"

#include <malloc.h>

#include <cstdio>
#include <memory>
#include <string>

namespace burin {
namespace {

/// A line like "VmHWM:   1234 kB" of /proc/self/status.
std::optional<std::uint64_t> status_bytes(const std::string& name) {
    const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen("/proc/self/status", "r"), std::fclose);
    if (!file) return std::nullopt;
    char line[256];
    while (std::fgets(line, sizeof line, file.get()) != nullptr) {
        unsigned long long kilobytes = 0;
        if (std::sscanf(line, (name + ": %llu kB").c_str(), &kilobytes) == 1) return kilobytes * 1024;
    }
    return std::nullopt;
}

/// Makes the kernel forget the highest use so far (VmHWM).
bool reset_peak() {
    const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen("/proc/self/clear_refs", "w"), std::fclose);
    return file && std::fputs("5", file.get()) >= 0 && std::fflush(file.get()) == 0;
}

}  // namespace

PeakMemory::PeakMemory() {
    malloc_trim(0);
    if (reset_peak()) start_ = status_bytes("VmRSS");
}

std::optional<std::uint64_t> PeakMemory::bytes() const {
    const auto peak = status_bytes("VmHWM");
    if (!start_ || !peak) return std::nullopt;
    return *peak > *start_ ? *peak - *start_ : 0;
}

}  // namespace burin
