#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/interrupt.h"

namespace burin {

/// EndLinks links the ends of numbered pieces or lines in pairs, where one goes on as the other, and follows the links:
/// what follows each other is a chain. End 2i is the beginning of number i, end 2i + 1 its end.
class EndLinks {
  public:
    explicit EndLinks(std::size_t count) : links_(2 * count, kNone) {}

    static std::uint32_t number_of(std::uint32_t end) { return end / 2; }
    static bool is_beginning(std::uint32_t end) { return end % 2 == 0; }
    static std::uint32_t other_end(std::uint32_t end) { return end ^ 1; }

    bool is_free(std::uint32_t end) const { return links_[end] == kNone; }
    void link(std::uint32_t a, std::uint32_t b) {
        links_[a] = b;
        links_[b] = a;
    }

    /// Calls visit(ends, is_loop) for each chain, those with two free ends first: `ends`, a vector that it may change,
    /// are those by which each number is entered.
    template <typename Visit>
    void for_chains(const Visit& visit) const {
        std::vector<bool> done(links_.size() / 2, false);
        std::vector<std::uint32_t> chain;
        const auto follow = [&](std::uint32_t end, bool is_loop) {
            throw_if_interrupted();
            chain.clear();
            for (; end != kNone && !done[number_of(end)]; end = links_[other_end(end)]) {
                done[number_of(end)] = true;
                chain.push_back(end);
            }
            visit(chain, is_loop);
        };
        for (std::uint32_t end = 0; end < links_.size(); ++end) {
            if (is_free(end) && !done[number_of(end)]) follow(end, false);
        }
        for (std::uint32_t end = 0; end < links_.size(); end += 2) {
            if (!done[number_of(end)]) follow(end, true);
        }
    }

  private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    std::vector<std::uint32_t> links_;
};

}  // namespace burin
