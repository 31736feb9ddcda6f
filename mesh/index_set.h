#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace burin {

/// A set of indices below a limit that finds the next index at or after another one, in a time that grows with the
/// logarithm of the limit: bits, and above them one bit for each word of bits that is not 0, and so on.
class IndexSet {
  public:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

    /// An empty set.
    explicit IndexSet(std::uint32_t limit) {
        std::size_t count = limit;
        do {
            count = (count + 63) / 64;
            levels_.emplace_back(count);
        } while (count > 1);
    }

    void insert(std::uint32_t i) {
        for (std::vector<std::uint64_t>& level : levels_) {
            level[i / 64] |= bit(i);
            i /= 64;
        }
    }

    void erase(std::uint32_t i) {
        for (std::vector<std::uint64_t>& level : levels_) {
            level[i / 64] &= ~bit(i);
            if (level[i / 64] != 0) return;
            i /= 64;
        }
    }

    /// The least index that is in the set and not less than i, which is below the limit; kNone: there is none.
    std::uint32_t find_from(std::uint32_t i) const {
        for (std::size_t l = 0; l < levels_.size(); ++l) {
            if (i / 64 >= levels_[l].size()) return kNone;
            const std::uint64_t rest = levels_[l][i / 64] & (~std::uint64_t{0} << (i % 64));
            if (rest == 0) {
                i = i / 64 + 1;  // the next word
                continue;
            }
            std::uint32_t found = i / 64 * 64 + static_cast<std::uint32_t>(std::countr_zero(rest));
            while (l-- > 0) found = found * 64 + static_cast<std::uint32_t>(std::countr_zero(levels_[l][found]));
            return found;
        }
        return kNone;
    }

  private:
    static std::uint64_t bit(std::uint32_t i) { return std::uint64_t{1} << (i % 64); }

    std::vector<std::vector<std::uint64_t>> levels_;
};

}  // namespace burin
