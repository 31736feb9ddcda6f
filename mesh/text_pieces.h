#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace burin {

/// Where a part of a text begins: at the start of a line.
struct TextPiece {
    const char* begin = nullptr;
    std::size_t line = 0;  ///< its number
};

/// Cuts a text, whose first line has the number `first_line`, into pieces of about `size` bytes. Lines are counted when a
/// piece is taken: whoever reads it then finds it in the caches.
class LineCutter {
  public:
    LineCutter(std::string_view text, std::size_t first_line, std::size_t size);

    /// Of a size that leaves something to do for each of so many threads, and fits into their caches.
    static std::size_t size_for(std::size_t text_size, int threads);

    /// The next piece, the first of which begins where the text does; nullptr behind the last one.
    const TextPiece* next() const { return next_.begin == nullptr ? nullptr : &next_; }
    void take();
    /// How many are left at most.
    std::size_t most_left() const { return (text_.size() - place_) / size_ + 1; }

  private:
    std::string_view text_;
    std::size_t size_;
    std::size_t place_ = 0;  // from here on lines are not counted
    std::size_t line_;       // of this place
    TextPiece next_;
};

}  // namespace burin
