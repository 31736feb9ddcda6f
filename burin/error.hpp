/// Failures of burin.h as exceptions; a part of burin.hpp.
#pragma once

#include <burin/burin.h>

#include <new>
#include <stdexcept>

namespace burin {
inline namespace v1 {

/// What a call threw that failed. what() says what is wrong and what to do.
class Error : public std::runtime_error {
  public:
    Error(int kind, const char* text) : std::runtime_error(text), kind_(kind) {}
    /// A burin_result, such as BURIN_BAD_INPUT.
    int kind() const noexcept { return kind_; }
    bool was_stopped() const noexcept { return kind_ == BURIN_STOPPED; }

  private:
    int kind_;
};

/// Throws the last failure of this thread.
[[noreturn]] inline void throw_error() {
    if (burin_error_kind() == BURIN_NO_MEMORY) throw std::bad_alloc();
    throw Error(burin_error_kind(), burin_error());
}
/// Passes on what a call returned, unless it failed.
inline int checked(int result) {
    if (result < 0) throw_error();
    return result;
}
template <typename T>
T* checked(T* result) {
    if (result == nullptr) throw_error();
    return result;
}

}  // namespace v1
}  // namespace burin
