#pragma once

#include <cstddef>

namespace burin::test {

/// A program that links counting_heap.cpp counts what C++ takes from the heap, on all threads, in bytes.
struct CountingHeap {
    static std::size_t now();
    /// The most since the last call of forget_peak().
    static std::size_t peak();
    static void forget_peak();
};

}  // namespace burin::test
