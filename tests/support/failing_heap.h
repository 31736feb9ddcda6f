#pragma once

#include <cstddef>

namespace burin::test {

/// The program's `new`, which runs out of memory when it is told to, on the thread that says so. Other threads get what
/// they ask for. Programs with failing_heap.cpp among their sources have it.
class FailingHeap {
  public:
    /// Of the next calls of `new`, `good` ones get memory; all that follow throw std::bad_alloc, until the end of this.
    explicit FailingHeap(std::size_t good);
    ~FailingHeap();
    FailingHeap(const FailingHeap&) = delete;
    FailingHeap& operator=(const FailingHeap&) = delete;

    /// Whether any call has failed.
    bool has_failed() const;
};

}  // namespace burin::test
