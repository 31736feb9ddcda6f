#include "mesh/text_pieces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

#include "base/parallel.h"

namespace burin {
namespace {

std::size_t count_feeds(std::string_view text) {
    using Bytes = std::uint8_t __attribute__((vector_size(16)));
    constexpr std::size_t kLanes = 64, kRounds = 255;  // until a byte is full
    std::size_t count = 0;
    while (text.size() >= kLanes) {
        std::array<Bytes, kLanes / sizeof(Bytes)> feeds{};
        const std::size_t rounds = std::min(kRounds, text.size() / kLanes);
        for (std::size_t round = 0; round < rounds; ++round) {
            std::array<Bytes, kLanes / sizeof(Bytes)> bytes;
            std::memcpy(&bytes, text.data() + kLanes * round, kLanes);
            for (std::size_t i = 0; i < feeds.size(); ++i) feeds[i] += (bytes[i] == '\n') & 1;
        }
        for (const Bytes& some : feeds) {
            for (std::size_t i = 0; i < sizeof(Bytes); ++i) count += some[i];
        }
        text.remove_prefix(kLanes * rounds);
    }
    return count + static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

LineCutter::LineCutter(std::size_t text_size, std::size_t first_line, std::size_t piece_size, Copy copy)
    : text_size_(text_size), piece_size_(piece_size), line_(first_line), copy_(std::move(copy)) {}

std::size_t LineCutter::size_for(std::size_t text_size, int threads) {
    return std::clamp<std::size_t>(text_size / (8 * static_cast<std::size_t>(resolve_thread_count(threads))), 4096,
                                   1 << 18);
}

std::optional<TextPiece> LineCutter::take(std::vector<char>& buffer) {
    if (at_end()) return std::nullopt;
    constexpr std::size_t kMargin = TextPiece::kMargin;
    std::string_view text;
    for (std::size_t wanted = piece_size_; text.empty(); wanted *= 2) {
        const std::size_t size = std::min(wanted, text_size_ - place_);
        if (buffer.size() < size + 2 * kMargin) buffer.resize(size + 2 * kMargin);
        copy_(place_, std::span(buffer).subspan(kMargin, size));
        text = {buffer.data() + kMargin, size};
        if (place_ + size < text_size_) text = text.substr(0, text.rfind('\n') + 1);  // none without a feed
    }
    std::fill_n(buffer.begin(), kMargin, '\n');
    std::fill_n(buffer.begin() + static_cast<std::ptrdiff_t>(kMargin + text.size()), kMargin, '\n');
    const TextPiece piece{text, place_, line_, count_feeds(text)};
    place_ += text.size();
    line_ += piece.feeds;
    return piece;
}

}  // namespace burin
