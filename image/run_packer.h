#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace burin {

/// Packs bytes as OpenEXR's RLE does: of a run of equal bytes its length less one and the byte; of others minus their
/// number, and these.
inline void pack_runs(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& packed) {
    constexpr std::size_t kLongestRun = 128, kMostOthers = 127, kShortestRun = 3;
    packed.clear();
    const auto run_at = [&](std::size_t i) {
        std::size_t end = i + 1;
        while (end < bytes.size() && end - i < kLongestRun && bytes[end] == bytes[i]) ++end;
        return end - i;
    };
    for (std::size_t i = 0; i < bytes.size();) {
        if (const std::size_t run = run_at(i); run >= kShortestRun) {
            packed.push_back(static_cast<std::uint8_t>(run - 1));
            packed.push_back(bytes[i]);
            i += run;
            continue;
        }
        std::size_t end = i;
        while (end < bytes.size() && end - i < kMostOthers) {
            const std::size_t run = run_at(end);
            if (run >= kShortestRun) break;
            end = std::min(end + run, i + kMostOthers);
        }
        packed.push_back(static_cast<std::uint8_t>(256 - (end - i)));
        packed.insert(packed.end(), bytes.begin() + static_cast<std::ptrdiff_t>(i),
                      bytes.begin() + static_cast<std::ptrdiff_t>(end));
        i = end;
    }
}

}  // namespace burin
