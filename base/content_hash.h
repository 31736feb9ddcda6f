#pragma once

#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>

namespace burin {

/// A hash of 64 bits over what is added, in order: to tell whether something is what it was, not against those who mean
/// harm. It is the same on all machines.
class ContentHash {
  public:
    ContentHash& add(std::uint64_t number) {
        mix(number);
        return *this;
    }
    ContentHash& add(double number) { return add(std::bit_cast<std::uint64_t>(number + 0.0)); }  // -0 is 0
    /// With its length, so that "ab", "c" is not "a", "bc".
    ContentHash& add(std::string_view bytes) {
        mix(bytes.size());
        for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes.data(), 8);
            mix(word);
        }
        std::uint64_t rest = 0;
        std::memcpy(&rest, bytes.data(), bytes.size());
        mix(rest);
        return *this;
    }
    ContentHash& add(const std::string& bytes) { return add(std::string_view(bytes)); }
    ContentHash& add(const char* bytes) { return add(std::string_view(bytes)); }

    std::uint64_t value() const { return finished(state_); }
    /// 16 hexadecimal digits.
    std::string text() const {
        char digits[17];
        std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(value()));
        return digits;
    }

  private:
    /// The last step of splitmix64: each bit changes half of all.
    static std::uint64_t finished(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    void mix(std::uint64_t word) { state_ = finished((state_ + 0x9E3779B97F4A7C15u) ^ word); }

    std::uint64_t state_ = 0;
};

}  // namespace burin
