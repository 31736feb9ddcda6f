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

LineCutter::LineCutter(std::string_view text, std::size_t first_line, std::size_t size)
    : text_(text), size_(size), line_(first_line), next_{text.data(), first_line} {}

std::size_t LineCutter::size_for(std::size_t text_size, int threads) {
    return std::clamp<std::size_t>(text_size / (8 * static_cast<std::size_t>(resolve_thread_count(threads))), 4096, 1 << 18);
}

void LineCutter::take() {
    // Cuts are looked for from multiples of the size on.
    const std::size_t begin = static_cast<std::size_t>(next_.begin - text_.data());
    const std::size_t end = std::min((begin / size_ + 1) * size_, text_.size());
    line_ += count_feeds(text_.substr(place_, end - place_));
    place_ = end;
    const std::size_t feed = text_.find('\n', place_);
    next_ = feed == std::string_view::npos ? TextPiece{} : TextPiece{text_.data() + feed + 1, line_ + 1};
}

}  // namespace burin
