#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace burin {

/// The layers of Cryptomatte (Friedman and Jones 2015): for each pixel, which names cover how much of it.
enum class CryptoLayer : std::uint8_t {
    object,       ///< of surfaces and lines, whose object is their owner's
    material,     ///< in the same way
    line,         ///< class of a line, `hidden CLASS` of hidden ones
    line_object,  ///< the object that a line belongs to
    line_set,     ///< the set of a style sheet that drew it
};
inline constexpr int kCryptoLayerCount = 5;
inline constexpr std::array<std::string_view, kCryptoLayerCount> kCryptoLayerNames = {
    "CryptoObject", "CryptoMaterial", "CryptoLine", "CryptoLineObject", "CryptoLineSet"};

struct CryptoLayerSet {
    std::uint8_t bits = 0;
    bool is_all = false;  ///< all were asked for that there are

    bool has(CryptoLayer layer) const { return (bits >> static_cast<int>(layer) & 1) != 0; }
    bool has_any() const { return bits != 0; }
    bool has_surfaces() const { return has(CryptoLayer::object) || has(CryptoLayer::material); }
    void add(CryptoLayer layer) { bits = static_cast<std::uint8_t>(bits | 1 << static_cast<int>(layer)); }
    void add_all() {
        bits = (1 << kCryptoLayerCount) - 1;
        is_all = true;
    }
    void remove(CryptoLayer layer) { bits = static_cast<std::uint8_t>(bits & ~(1 << static_cast<int>(layer))); }
};

}  // namespace burin
