#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

// A text is cut into pieces at line ends, for threads to read.

namespace burin {

/// Whole lines of a text, copied. kMargin line feeds stand in front of and behind them.
struct TextPiece {
    static constexpr std::size_t kMargin = 128;
    std::string_view text;
    std::size_t place = 0;  ///< where they begin in the text that was cut
    std::size_t line = 0;   ///< the number of the first one
    std::size_t feeds = 0;  ///< how many line feeds are in them
};

/// Cuts a text, whose first line has the number `first_line`, into pieces of about `piece_size` bytes, but a line at
/// least. Each is copied, and its lines are counted, when it is taken: whoever reads it then finds it in the caches.
class LineCutter {
  public:
    /// Copies what stands in the text from a place on.
    using Copy = std::function<void(std::size_t place, std::span<char> to)>;

    LineCutter(std::size_t text_size, std::size_t first_line, std::size_t piece_size, Copy copy);

    /// The size of pieces that leaves something to do for each of `threads` threads, and fits into their caches.
    static std::size_t size_for(std::size_t text_size, int threads);

    /// The next piece, which is put into `buffer`; nothing behind the last one.
    std::optional<TextPiece> take(std::vector<char>& buffer);
    bool at_end() const { return place_ == text_size_; }

  private:
    std::size_t text_size_, piece_size_;
    std::size_t place_ = 0, line_;  // of the next piece
    Copy copy_;
};

}  // namespace burin
