#include "mesh/text_pieces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "base/parallel.h"

namespace burin {
namespace {

std::size_t count_feeds(std::string_view text) {
    constexpr std::size_t kLanes = 64, kRounds = 255;  // until a byte is full
    std::size_t count = 0;
    while (text.size() >= kLanes) {
        std::array<std::uint8_t, kLanes> feeds{};
        const std::size_t rounds = std::min(kRounds, text.size() / kLanes);
        for (std::size_t round = 0; round < rounds; ++round) {
            const char* const p = text.data() + kLanes * round;
            for (std::size_t i = 0; i < kLanes; ++i) {
                feeds[i] = static_cast<std::uint8_t>(feeds[i] + (p[i] == '\n' ? 1 : 0));
            }
        }
        for (const std::uint8_t n : feeds) count += n;
        text.remove_prefix(kLanes * rounds);
    }
    return count + static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

std::vector<TextPiece> split_at_lines(std::string_view text, std::size_t first_line, int threads) {
    const std::size_t wanted =
        text.size() / (8 * static_cast<std::size_t>(resolve_thread_count(threads)));
    const std::size_t size = std::clamp<std::size_t>(wanted, 4096, 1 << 20);
    const std::size_t count = text.size() / size + 1;
    std::vector<std::size_t> feeds(count);
    parallel_for(count, threads,
                 [&](std::size_t i, int) { feeds[i] = count_feeds(text.substr(i * size, size)); });
    std::vector<TextPiece> pieces{{text.data(), first_line}};
    std::size_t line = first_line;
    for (std::size_t i = 1; i < count; ++i) {
        line += feeds[i - 1];  // that of the character at i * size
        const std::size_t feed = text.find('\n', i * size);
        if (feeds[i] > 0) pieces.push_back({text.data() + feed + 1, line + 1});
    }
    return pieces;
}

}  // namespace burin
