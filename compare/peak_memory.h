#pragma once

#include <cstdint>
#include <optional>

// The memory of a method is the peak that its run adds to the process.

namespace burin {

/// How much memory a piece of work adds to the process at its peak, as the kernel counts it.
class PeakMemory {
  public:
    /// Begins to measure. Free memory that the allocator holds back is given to the kernel first.
    PeakMemory();
    /// Bytes beyond what there was at the start; nothing where the kernel does not tell.
    std::optional<std::uint64_t> bytes() const;

  private:
    std::optional<std::uint64_t> start_;
};

}  // namespace burin
