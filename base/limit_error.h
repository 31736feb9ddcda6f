#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "base/error.h"

namespace burin {

/// A job needs more than a limit that its caller has set: an option of the program, a field of the library's interface.
/// The caller puts its own name of the limit in front.
class LimitError : public InputError {
  public:
    /// "PICTURE takes at least 17M; give that or more, or ADVICE". `least_mb`: in units of 2^20 bytes.
    LimitError(std::string picture, std::uint64_t least_mb, std::string advice)
        : InputError(picture + " takes at least " + std::to_string(least_mb) + "M; give that or more, or " + advice),
          picture_(std::move(picture)),
          advice_(std::move(advice)),
          least_mb_(least_mb) {}

    /// The message for a job that needs `count` times the memory of this one.
    LimitError times(std::uint64_t count) const { return {picture_, count * least_mb_, advice_}; }

  private:
    std::string picture_, advice_;
    std::uint64_t least_mb_;
};

}  // namespace burin
