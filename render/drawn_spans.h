#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace burin {

/// DrawnSpans notes which spans of a picture's rows may have anything but background, so that what is blank is not
/// cleared again for the next picture. Columns and rows are counted from 0. Different threads may note and ask at the
/// same time.
class DrawnSpans {
  public:
    /// Keeps no record: all spans may have been drawn, always.
    DrawnSpans() = default;
    /// All spans may have been drawn, until a picture ends.
    DrawnSpans(int width, int height)
        : per_row_(static_cast<std::size_t>((width + kColumns - 1) >> kShift)),
          before_(per_row_ * static_cast<std::size_t>(height)),
          now_(before_.size()) {
        set(before_, 1);
    }

    void note(int column, int row) {
        if (per_row_ > 0) now_[place(column, row)].store(1, std::memory_order_relaxed);
    }
    void note(int begin, int end, int row) {
        for (int at = begin; at < end; at = next(at)) note(at, row);
    }
    /// Calls use(begin, end) for the parts of columns [begin, end) that may have been drawn, in this picture or the one
    /// before.
    template <typename Use>
    void for_drawn(int begin, int end, int row, const Use& use) const {
        if (per_row_ == 0) return use(begin, end);
        for (int at = begin; at < end; at = next(at)) {
            const std::size_t i = place(at, row);
            const auto is_set = [i](const Flags& flags) { return flags[i].load(std::memory_order_relaxed) != 0; };
            if (is_set(before_) || is_set(now_)) use(at, std::min(end, next(at)));
        }
    }
    /// Every pixel has been put since the last picture ended: only what has been noted since then is left.
    void end_picture() {
        before_.swap(now_);
        set(now_, 0);
    }

  private:
    using Flags = std::vector<std::atomic<std::uint8_t>>;
    static constexpr int kShift = 6, kColumns = 1 << kShift;

    static int next(int column) { return (column | (kColumns - 1)) + 1; }
    static void set(Flags& flags, std::uint8_t value) {
        for (auto& flag : flags) flag.store(value, std::memory_order_relaxed);
    }
    std::size_t place(int column, int row) const {
        return static_cast<std::size_t>(row) * per_row_ + static_cast<std::size_t>(column >> kShift);
    }

    std::size_t per_row_ = 0;
    Flags before_, now_;
};

}  // namespace burin
