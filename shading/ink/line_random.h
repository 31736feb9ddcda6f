#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

// Random numbers of lines are hashes of names and of places in objects, so that they are the same in all frames.

namespace burin {

/// LineHash mixes what it is given into 64 bits (splitmix64 by Vigna, after FNV-1a for texts).
class LineHash {
  public:
    constexpr explicit LineHash(std::uint64_t seed = 0) : bits_(mix(seed)) {}

    constexpr LineHash& add(std::uint64_t number) {
        bits_ = mix(bits_ ^ mix(number));
        return *this;
    }
    constexpr LineHash& add(float number) { return add(std::uint64_t{std::bit_cast<std::uint32_t>(number + 0.0f)}); }
    constexpr LineHash& add(std::string_view text) {
        std::uint64_t hash = 0xCBF29CE484222325;
        for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3;
        return add(hash);
    }
    constexpr std::uint64_t bits() const { return bits_; }
    /// In [0, 1).
    constexpr float unit() const { return static_cast<float>(bits_ >> 40) * 0x1p-24f; }

  private:
    static constexpr std::uint64_t mix(std::uint64_t z) {
        z += 0x9E3779B97F4A7C15;
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9;
        z = (z ^ z >> 27) * 0x94D049BB133111EB;
        return z ^ z >> 31;
    }
    std::uint64_t bits_;
};

}  // namespace burin
