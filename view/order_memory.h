#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "view/surface_set.h"

// How triangles lie to each other is remembered where the same pairs are asked about again and again.

namespace burin {

inline std::size_t hash_of_pair(SurfaceId a, SurfaceId b) {
    const auto number = [](SurfaceId s) { return std::uint64_t{s.instance} << 32 | s.triangle; };
    const std::uint64_t mixed =
        (number(a) * 0x9E3779B97F4A7C15u ^ number(b)) * 0xD6E8FEB86659FD93u;  // odd numbers without a pattern
    return static_cast<std::size_t>(mixed >> 32);
}

/// How two triangles lie to each other.
struct KnownOrder {
    SurfaceOrder order;
    bool are_parallel = false;  ///< nearly, as surfaces that run along each other
};

/// Some pairs of triangles of one SurfaceSet whose order is known: a later one takes an earlier one's place.
/// For one thread; 2.4 MB from the first pair on.
class OrderMemory {
  public:
    static constexpr std::size_t kMost = std::size_t{1} << 15;
    explicit OrderMemory(std::size_t most = kMost) : most_(most) {}

    /// `find`: returns the KnownOrder of a pair that is not known. The result is valid until the next call.
    template <typename Find>
    const KnownOrder& get(SurfaceId a, SurfaceId b, const Find& find) {
        if (entries_.empty()) entries_.resize(most_);
        Entry& entry = entries_[hash_of_pair(a, b) % most_];
        if (!entry.is_used || entry.a != a || entry.b != b) entry = {a, b, true, find()};
        return entry.known;
    }

  private:
    struct Entry {
        SurfaceId a, b;
        bool is_used = false;
        KnownOrder known;
    };
    std::size_t most_;
    std::vector<Entry> entries_;
};

}  // namespace burin
