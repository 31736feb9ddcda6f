#pragma once

#include <cstdint>
#include <optional>

// A walk that comes back to where it was would go on for ever, so it is told to end.

namespace burin {

/// Tells when something that goes from state to state, each of which follows from the one before, goes round in
/// circles: a state that comes again will come again for ever.
///
/// Each state is compared with one of before, which is replaced after 8, 16, 32 ... steps, so that a circle is found
/// within a few times its length. R. P. Brent, An improved Monte Carlo factorization algorithm, BIT 20 (1980).
template <typename State>
class CircleFinder {
  public:
    /// Whether a state has been there before; to be called with each state in turn.
    bool is_closed_by(const State& state) {
        if (earlier_ && *earlier_ == state) return true;
        if (++steps_ == next_) {
            earlier_ = state;
            next_ *= 2;
        }
        return false;
    }

  private:
    std::optional<State> earlier_;
    std::uint64_t steps_ = 0, next_ = 8;  // what ends sooner never pays for a copy
};

}  // namespace burin
