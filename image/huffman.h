#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

// Deflate blocks need codes that fit the frequencies of their symbols.

namespace burin {

/// A canonical Huffman code (RFC 1951, 3.2.2) for symbols that occur with given frequencies. At
/// least two symbols get a code, which keeps the code complete.
template <std::size_t kSymbols, std::uint32_t kMaxBits>
struct HuffmanCode {
    std::array<std::uint8_t, kSymbols> lengths{};  ///< bits; 0 = does not occur
    std::array<std::uint16_t, kSymbols> codes{};   ///< first bit lowest

    explicit HuffmanCode(const std::array<std::uint8_t, kSymbols>& known_lengths) : lengths(known_lengths) {
        find_codes();
    }
    explicit HuffmanCode(std::array<std::uint32_t, kSymbols> frequencies) {
        const auto used = [&] {
            return std::count_if(frequencies.begin(), frequencies.end(), [](auto f) { return f > 0; });
        };
        for (std::size_t s = 0; used() < 2; ++s) frequencies[s] += frequencies[s] == 0 ? 1 : 0;
        find_lengths(frequencies);
        find_codes();
    }

  private:
    void find_lengths(const std::array<std::uint32_t, kSymbols>& frequencies) {
        struct Node {
            std::uint64_t frequency;
            std::uint16_t symbol, parent;
        };
        std::array<Node, 2 * kSymbols> nodes;  // leaves by frequency, then the tree's inner nodes
        std::size_t leaves = 0;
        for (std::uint16_t s = 0; s < kSymbols; ++s) {
            if (frequencies[s] > 0) nodes[leaves++] = {frequencies[s], s, 0};
        }
        std::sort(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(leaves), [](const Node& a, const Node& b) {
            return a.frequency != b.frequency ? a.frequency < b.frequency : a.symbol < b.symbol;
        });
        // Inner nodes arise in the order of their frequencies: both queues are sorted.
        std::size_t leaf = 0, inner = leaves, end = leaves;
        const auto least = [&] {
            const bool takes_leaf = leaf < leaves && (inner == end || nodes[leaf].frequency <= nodes[inner].frequency);
            return takes_leaf ? leaf++ : inner++;
        };
        while (end < 2 * leaves - 1) {
            const std::size_t a = least(), b = least();
            nodes[a].parent = nodes[b].parent = static_cast<std::uint16_t>(end);
            nodes[end++] = {nodes[a].frequency + nodes[b].frequency, 0, 0};
        }
        // Depths, from the root down; too deep leaves are lifted, and others lowered for them.
        std::array<std::uint32_t, kMaxBits + 1> leaves_at{};
        std::array<std::uint16_t, 2 * kSymbols> depth;
        depth[end - 1] = 0;
        for (std::size_t i = end - 1; i-- > 0;) {
            depth[i] = static_cast<std::uint16_t>(depth[nodes[i].parent] + 1);
            if (i < leaves) ++leaves_at[std::min<std::uint32_t>(depth[i], kMaxBits)];
        }
        std::uint32_t taken = 0;  // of 2^kMaxBits codes of the greatest length
        for (std::uint32_t bits = 1; bits <= kMaxBits; ++bits) taken += leaves_at[bits] << (kMaxBits - bits);
        for (; taken > 1u << kMaxBits; --taken) {
            std::uint32_t bits = kMaxBits - 1;
            while (leaves_at[bits] == 0) --bits;
            --leaves_at[kMaxBits];
            --leaves_at[bits];
            leaves_at[bits + 1] += 2;
        }
        std::size_t next = 0;  // the rarest symbols get the longest codes
        for (std::uint32_t bits = kMaxBits; bits > 0; --bits) {
            for (std::uint32_t i = 0; i < leaves_at[bits]; ++i) {
                lengths[nodes[next++].symbol] = static_cast<std::uint8_t>(bits);
            }
        }
    }

    void find_codes() {
        std::array<std::uint32_t, kMaxBits + 1> count{}, next{};
        for (const std::uint8_t length : lengths) count[length] += length > 0 ? 1 : 0;
        for (std::uint32_t bits = 1; bits <= kMaxBits; ++bits) {
            next[bits] = (next[bits - 1] + count[bits - 1]) << 1;
        }
        for (std::size_t s = 0; s < kSymbols; ++s) {
            std::uint32_t reversed = 0;
            if (lengths[s] == 0) continue;
            const std::uint32_t code = next[lengths[s]]++;
            for (std::uint32_t i = 0; i < lengths[s]; ++i) reversed |= (code >> i & 1u) << (lengths[s] - 1 - i);
            codes[s] = static_cast<std::uint16_t>(reversed);
        }
    }
};

// Symbols 286 and 287 never occur, but have their place in the fixed code. With codes of at most 14 bits four literals
// can be put at once.
using LiteralCode = HuffmanCode<288, 14>;
using DistanceCode = HuffmanCode<30, 15>;

}  // namespace burin
