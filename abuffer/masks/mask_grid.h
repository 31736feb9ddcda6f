#pragma once

#include <bit>
#include <cstdint>
#include <string>

#include "abuffer/coverage_mask.h"

// Masks of 4 x 4, 8 x 8 and 16 x 16 samples are used by the same code.

namespace burin {

/// Access to masks of any size by row and column.
template <typename Mask>
struct MaskGrid;

template <>
struct MaskGrid<std::uint16_t> {
    static constexpr int kSide = 4;
    static constexpr void set_row(std::uint16_t& mask, int row, unsigned bits) {
        mask = static_cast<std::uint16_t>(mask | bits << (4 * row));
    }
    static constexpr bool get(std::uint16_t mask, int row, int column) { return (mask >> (4 * row + column) & 1) != 0; }
    static constexpr unsigned row(std::uint16_t mask, int row) {
        return static_cast<unsigned>(mask) >> (4 * row) & 0xFu;
    }
    static constexpr int count(std::uint16_t mask) { return std::popcount(mask); }
};

template <>
struct MaskGrid<std::uint64_t> {
    static constexpr int kSide = 8;
    static constexpr void set_row(std::uint64_t& mask, int row, unsigned bits) {
        mask |= std::uint64_t{bits} << (8 * row);
    }
    static constexpr bool get(std::uint64_t mask, int row, int column) { return (mask >> (8 * row + column) & 1) != 0; }
    static constexpr unsigned row(std::uint64_t mask, int row) {
        return static_cast<unsigned>(mask >> (8 * row) & 0xFFu);
    }
    static constexpr int count(std::uint64_t mask) { return std::popcount(mask); }
};

template <>
struct MaskGrid<Mask256> {
    static constexpr int kSide = 16;
    static constexpr void set_row(Mask256& mask, int row, unsigned bits) {
        mask.words[row / 4] |= std::uint64_t{bits} << (16 * (row % 4));
    }
    static constexpr bool get(const Mask256& mask, int row, int column) {
        return (mask.words[row / 4] >> (16 * (row % 4) + column) & 1) != 0;
    }
    static constexpr unsigned row(const Mask256& mask, int row) {
        return static_cast<unsigned>(mask.words[row / 4] >> (16 * (row % 4)) & 0xFFFFu);
    }
    static constexpr int count(const Mask256& mask) {
        int sum = 0;
        for (const std::uint64_t w : mask.words) sum += std::popcount(w);
        return sum;
    }
};

template <typename Mask>
constexpr int mask_side = MaskGrid<Mask>::kSide;

/// A mask with only this sample.
template <typename Mask>
constexpr Mask sample_bit(int row, int column) {
    Mask mask{};
    MaskGrid<Mask>::set_row(mask, row, 1u << column);
    return mask;
}

/// The samples at least `apron` away from the rim of the mask: a pixel's own.
template <typename Mask>
constexpr Mask inner_samples(int apron) {
    Mask mask{};
    const unsigned row_bits = ((1u << (mask_side<Mask> - 2 * apron)) - 1) << apron;
    for (int row = apron; row < mask_side<Mask> - apron; ++row) {
        MaskGrid<Mask>::set_row(mask, row, row_bits);
    }
    return mask;
}

template <typename Mask>
constexpr Mask full_mask() {
    return inner_samples<Mask>(0);
}

/// A picture of the mask, one line per row: '#' for a sample that is set, '.' for one that is not.
template <typename Mask>
std::string mask_picture(const Mask& mask) {
    std::string text;
    for (int row = 0; row < mask_side<Mask>; ++row) {
        for (int column = 0; column < mask_side<Mask>; ++column) {
            text += MaskGrid<Mask>::get(mask, row, column) ? '#' : '.';
        }
        text += '\n';
    }
    return text;
}

}  // namespace burin
