#pragma once

#include <concepts>
#include <cstdint>

/// Coverage masks and the two functions on them that find lines.
///
/// Source: Mayur Patel, "Hidden Line Rendering with a Modified A-Buffer", 27 March 2000 (slides);
/// his GetHalo and GetEdgeBetween. This header depends on nothing else, so that it can be used
/// alone.
///
/// A mask is a square grid of samples, one bit each: bit = side * row + column. Which way rows and
/// columns run is free: everything here is symmetric under the symmetries of the square. Samples
/// outside of the grid count as not covered. Neighbours are the four to the sides, no diagonals.
///
/// | type            | grid  | bits |
/// |-----------------|-------|------|
/// | std::uint16_t   | 4x4   | 16   |
/// | std::uint64_t   | 8x8   | 64   |
/// | burin::Mask256  | 16x16 | 256  |
///
/// An *extended* mask holds a pixel's own samples in the middle and an apron of its neighbours'
/// samples around them. After a halo of n steps, samples n or more away from the border of the grid
/// are exact; those nearer to it may lack bits. So the apron must be n samples wide, and only the
/// pixel's own samples are to be read.
namespace burin {

/// 16x16 samples: word w holds rows 4w to 4w + 3, row r at bit 16 * (r % 4).
struct Mask256 {
    std::uint64_t words[4] = {0, 0, 0, 0};

    friend constexpr bool operator==(const Mask256& a, const Mask256& b) {
        return a.words[0] == b.words[0] && a.words[1] == b.words[1] && a.words[2] == b.words[2] &&
               a.words[3] == b.words[3];
    }
    friend constexpr Mask256 operator&(const Mask256& a, const Mask256& b) {
        return {{a.words[0] & b.words[0], a.words[1] & b.words[1], a.words[2] & b.words[2], a.words[3] & b.words[3]}};
    }
    friend constexpr Mask256 operator|(const Mask256& a, const Mask256& b) {
        return {{a.words[0] | b.words[0], a.words[1] | b.words[1], a.words[2] | b.words[2], a.words[3] | b.words[3]}};
    }
    friend constexpr Mask256 operator^(const Mask256& a, const Mask256& b) {
        return {{a.words[0] ^ b.words[0], a.words[1] ^ b.words[1], a.words[2] ^ b.words[2], a.words[3] ^ b.words[3]}};
    }
    friend constexpr Mask256 operator~(const Mask256& a) {
        return {{~a.words[0], ~a.words[1], ~a.words[2], ~a.words[3]}};
    }
    constexpr Mask256& operator&=(const Mask256& b) { return *this = *this & b; }
    constexpr Mask256& operator|=(const Mask256& b) { return *this = *this | b; }
};

/// 8x8 masks: std::uint64_t and its synonyms. No other type converts to one by itself.
template <typename T>
concept Mask64 = std::unsigned_integral<T> && sizeof(T) == 8;

namespace mask_detail {

/// The mask and its four neighbours: one step of dilation.
constexpr std::uint16_t dilate(std::uint16_t mask) {
    const unsigned m = mask;
    return static_cast<std::uint16_t>(m | (m & 0x7777u) << 1 | (m & 0xEEEEu) >> 1 | m << 4 | m >> 4);
}

template <Mask64 Mask>
constexpr Mask dilate(Mask m) {
    return m | (m & 0x7F7F7F7F7F7F7F7Fu) << 1 | (m & 0xFEFEFEFEFEFEFEFEu) >> 1 | m << 8 | m >> 8;
}

constexpr Mask256 dilate(const Mask256& m) {
    Mask256 result;
    for (int w = 0; w < 4; ++w) {
        const std::uint64_t here = m.words[w];
        const std::uint64_t above = w > 0 ? m.words[w - 1] >> 48 : 0;  // its last row
        const std::uint64_t below = w < 3 ? m.words[w + 1] << 48 : 0;  // its first row
        result.words[w] = here | (here & 0x7FFF7FFF7FFF7FFFu) << 1 | (here & 0xFFFEFFFEFFFEFFFEu) >> 1 | here << 16 |
                          here >> 16 | above | below;
    }
    return result;
}

template <typename Mask>
constexpr Mask halo(Mask mask, int steps) {
    Mask grown = mask;
    for (int i = 0; i < steps; ++i) grown = dilate(grown);
    return static_cast<Mask>(grown ^ mask);
}

template <typename Mask>
constexpr Mask edge_between(Mask front, Mask back, int steps) {
    const Mask visible_back = static_cast<Mask>(back & ~front);
    return static_cast<Mask>((halo(front, steps) & visible_back) | (halo(visible_back, steps) & front));
}

}  // namespace mask_detail

/// Samples not in the mask that have a neighbour in it. Patel's GetHalo.
constexpr std::uint16_t halo(std::uint16_t mask) { return mask_detail::halo(mask, 1); }

/// Samples not in the mask within `steps` steps to the sides (city-block distance) of it.
constexpr std::uint16_t halo(std::uint16_t mask, int steps) { return mask_detail::halo(mask, steps); }
template <Mask64 Mask>
constexpr Mask halo(Mask mask, int steps = 1) {
    return mask_detail::halo(mask, steps);
}
constexpr Mask256 halo(const Mask256& mask, int steps = 1) { return mask_detail::halo(mask, steps); }

/// The two rims along the common border of the front mask and the part of the back mask that the
/// front leaves visible: one sample on either side. Patel's GetEdgeBetween.
constexpr std::uint16_t edge_between(std::uint16_t front, std::uint16_t back) {
    return mask_detail::edge_between(front, back, 1);
}

/// The rims along the common border with `steps` samples on either side: a stroke 2 * steps samples wide, measured
/// along rows or columns (so that a straight border at angle a gets a stroke of
/// 2 * steps * max(|cos a|, |sin a|) samples across).
constexpr std::uint16_t edge_between(std::uint16_t front, std::uint16_t back, int steps) {
    return mask_detail::edge_between(front, back, steps);
}
template <Mask64 Mask>
constexpr Mask edge_between(Mask front, Mask back, int steps = 1) {
    return mask_detail::edge_between(front, back, steps);
}
constexpr Mask256 edge_between(const Mask256& front, const Mask256& back, int steps = 1) {
    return mask_detail::edge_between(front, back, steps);
}

}  // namespace burin
