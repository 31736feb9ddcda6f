#pragma once

#include "base/error.h"

namespace burin {

/// A job needs more than a limit that its caller has set: an option of the program, a field of the library's interface.
/// The caller puts its own name of the limit in front.
class LimitError : public InputError {
  public:
    using InputError::InputError;
};

}  // namespace burin
