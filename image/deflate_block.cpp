#include "image/deflate_block.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace burin {
namespace {

constexpr std::uint32_t kMaxLength = 258;
constexpr std::uint32_t kEndOfBlock = 256;
constexpr std::uint32_t kLastBlock = 1, kStored = 0 << 1, kFixedCodes = 1 << 1, kOwnCodes = 2 << 1;  // bits of a header
constexpr std::uint32_t kManyLiterals = 64;  // as many at once, or more, may be stored
constexpr std::size_t kMaxStored = 65535;    // in one block
/// How many bits, about, the lengths of own codes take, and what stands beside the bytes of a stored block.
constexpr std::uint64_t kOwnCodesBits = 600, kStoredBlockBits = 50;

/// A symbol of an alphabet and bits that follow it.
struct Symbol {
    std::uint32_t symbol, extra_bits, extra;
};
Symbol length_symbol(std::uint32_t length) {
    const std::uint32_t v = length - 3;
    if (length == kMaxLength) return {285, 0, 0};
    if (v < 8) return {257 + v, 0, 0};
    const std::uint32_t bits = static_cast<std::uint32_t>(std::bit_width(v)) - 3;
    return {257 + 4 * bits + (v >> bits), bits, v & ((1u << bits) - 1)};
}
Symbol distance_symbol(std::uint32_t distance) {
    const std::uint32_t v = distance - 1;
    if (v < 4) return {v, 0, 0};
    const std::uint32_t bits = static_cast<std::uint32_t>(std::bit_width(v)) - 2;
    return {2 * bits + (v >> bits), bits, v & ((1u << bits) - 1)};
}

/// Calls use(length, times) for the pieces, each of 3 to 258 bytes, of a copy of any length.
template <typename Use>
void for_each_piece(std::uint32_t length, const Use& use) {
    std::uint32_t longest = length / kMaxLength, rest = length % kMaxLength;
    const bool is_short = longest > 0 && (rest == 1 || rest == 2);
    if (is_short) --longest, rest += kMaxLength - 3;
    if (longest > 0) use(kMaxLength, longest);
    if (rest > 0) use(rest, 1u);
    if (is_short) use(3u, 1u);
}

/// The lengths of both codes, themselves coded (RFC 1951, 3.2.7).
void put_code_lengths(BitWriter& out, const LiteralCode& literals, const DistanceCode& distances) {
    constexpr std::array<std::uint8_t, 19> kOrder = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
    std::array<std::uint8_t, 286 + 30> lengths;
    std::copy_n(literals.lengths.begin(), 286, lengths.begin());
    std::copy(distances.lengths.begin(), distances.lengths.end(), lengths.begin() + 286);
    std::array<Symbol, 286 + 30> symbols;
    std::size_t count = 0;
    for (std::size_t i = 0; i < lengths.size();) {
        const std::uint8_t length = lengths[i];
        std::size_t run = 1;
        while (i + run < lengths.size() && lengths[i + run] == length) ++run;
        i += run;
        if (length != 0) symbols[count++] = {length, 0, 0}, --run;
        while (run > 0) {
            const std::size_t most = length != 0 ? 6 : 138;
            const std::size_t piece = std::min(run, most);
            const auto n = static_cast<std::uint32_t>(piece);
            if (piece < 3) {
                for (std::size_t k = 0; k < piece; ++k) symbols[count++] = {length, 0, 0};
            } else if (length != 0) {
                symbols[count++] = {16, 2, n - 3};
            } else if (piece < 11) {
                symbols[count++] = {17, 3, n - 3};
            } else {
                symbols[count++] = {18, 7, n - 11};
            }
            run -= piece;
        }
    }
    std::array<std::uint32_t, 19> frequencies{};
    for (std::size_t i = 0; i < count; ++i) ++frequencies[symbols[i].symbol];
    const HuffmanCode<19, 7> code(frequencies);
    std::uint32_t written = 19;
    while (written > 4 && code.lengths[kOrder[written - 1]] == 0) --written;
    out.put(286 - 257, 5);
    out.put(30 - 1, 5);
    out.put(written - 4, 4);
    for (std::uint32_t i = 0; i < written; ++i) {
        out.put(code.lengths[kOrder[i]], 3);
        out.flush();
    }
    for (std::size_t i = 0; i < count; ++i) {
        const Symbol& s = symbols[i];
        out.put(code.codes[s.symbol], code.lengths[s.symbol]);
        out.put(s.extra, s.extra_bits);
        out.flush();
    }
}

/// How many bits symbols take that occur as often as counted.
template <typename Counts, typename Code>
std::uint64_t bits_of(const Counts& counts, const Code& code) {
    std::uint64_t bits = 0;
    for (std::size_t s = 0; s < counts.size(); ++s) bits += std::uint64_t{counts[s]} * code.lengths[s];
    return bits;
}

/// How many bits symbols take at least with any code. It is in whole bits, so that rounding cannot make it more than a
/// code takes.
template <typename Counts>
std::uint64_t least_bits_of(const Counts& counts) {
    double all = 0, bits = 0;
    for (const std::uint32_t count : counts) all += count;
    for (const std::uint32_t count : counts) {
        if (count > 0) bits += count * std::log2(all / count);
    }
    return static_cast<std::uint64_t>(bits);
}

void put_stored(BitWriter& out, std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const std::span piece = bytes.first(std::min(bytes.size(), kMaxStored));
        const auto size = static_cast<std::uint32_t>(piece.size());
        const std::uint8_t lengths[] = {static_cast<std::uint8_t>(size), static_cast<std::uint8_t>(size >> 8),
                                        static_cast<std::uint8_t>(~size), static_cast<std::uint8_t>(~size >> 8)};
        out.put(kStored, 3);
        out.put_bytes(lengths);
        out.put_bytes(piece);
        bytes = bytes.subspan(piece.size());
    }
}

template <typename Codes>
void put_copy(BitWriter& out, const Codes& codes, std::uint32_t length, std::uint32_t distance) {
    const Symbol back = distance_symbol(distance);
    for_each_piece(length, [&](std::uint32_t piece, std::uint32_t times) {
        const Symbol symbol = length_symbol(piece);
        std::uint64_t bits = 0;
        std::uint32_t count = 0;
        const auto add = [&](std::uint64_t more, std::uint32_t more_bits) {
            bits |= more << count;
            count += more_bits;
        };
        add(codes.literals.codes[symbol.symbol], codes.literals.lengths[symbol.symbol]);
        add(symbol.extra, symbol.extra_bits);
        add(codes.distances.codes[back.symbol], codes.distances.lengths[back.symbol]);
        add(back.extra, back.extra_bits);
        for (; times > 0; --times) {
            out.put(bits, count);
            out.flush();
        }
    });
}

}  // namespace

/// The fixed codes of RFC 1951, 3.2.6.
const DeflateBlock::Codes& DeflateBlock::fixed_codes() {
    static const Codes codes = [] {
        std::array<std::uint8_t, 288> literals;
        std::array<std::uint8_t, 30> distances;
        literals.fill(8);
        std::fill_n(&literals[144], 112, std::uint8_t{9});
        std::fill_n(&literals[256], 24, std::uint8_t{7});
        distances.fill(5);
        return Codes{LiteralCode(literals), DistanceCode(distances)};
    }();
    return codes;
}

DeflateBlock::DeflateBlock(std::span<const DeflateSequence> sequences, const std::uint8_t* bytes)
    : sequences_(sequences), bytes_(bytes) {
    const std::uint8_t* p = bytes_;
    for (const DeflateSequence& s : sequences_) {
        if (s.literals < kManyLiterals) {
            for (std::uint32_t i = 0; i < s.literals; ++i) ++coded_[p[i]];
        } else {
            constexpr std::uint32_t kStep = 8;  // some of them tell enough
            for (std::uint32_t i = 0; i < s.literals; i += kStep) storable_[p[i]] += kStep;
            stored_bits_ += 8 * std::uint64_t{s.literals} + kStoredBlockBits;
        }
        p += s.literals + s.length;
        literals_ += s.literals;
        if (s.length == 0) continue;
        std::uint32_t& distances = distances_[distance_symbol(s.distance).symbol];
        for_each_piece(s.length, [&](std::uint32_t length, std::uint32_t times) {
            coded_[length_symbol(length).symbol] += times;
            distances += times;
            pieces_ += times;
        });
    }
    coded_[kEndOfBlock] = 1;
    end_ = p;
}

std::size_t DeflateBlock::most_bytes() const {
    constexpr std::size_t kCodesBytes = 640;
    // A literal takes up to 14 bits, or its byte and a share in what is beside stored ones; a piece up to 47 bits.
    return kCodesBytes + 2 * literals_ + 6 * pieces_;
}

void DeflateBlock::put(BitWriter& out) const {
    std::array<std::uint32_t, 288> all = coded_;
    if (stored_bits_ > 0) {  // they were counted in part: each has a code
        for (std::size_t i = 0; i < kEndOfBlock; ++i) all[i] += storable_[i] + 1;
    }
    const Codes& fixed = fixed_codes();
    const std::uint64_t fixed_bits =
        bits_of(coded_, fixed.literals) + bits_of(distances_, fixed.distances) + stored_bits_;
    // Storing is faster, for writers and readers.
    const auto is_little = [&](std::uint64_t own_bits) { return fixed_bits < own_bits + own_bits / 32; };
    const auto put_fixed = [&] {
        out.put(kFixedCodes, 3);
        put_sequences(out, fixed, kManyLiterals);
    };
    if (is_little(least_bits_of(all) + least_bits_of(distances_) + kOwnCodesBits)) {
        put_fixed();
        return;  // own codes, which take longer to make than to use, could not be better
    }
    const Codes own{LiteralCode(all), DistanceCode(distances_)};
    const std::uint64_t own_bits = bits_of(all, own.literals) + bits_of(distances_, own.distances) + kOwnCodesBits;
    if (is_little(own_bits)) {
        put_fixed();
    } else {
        out.put(kOwnCodes, 3);
        put_code_lengths(out, own.literals, own.distances);
        put_sequences(out, own, std::numeric_limits<std::uint32_t>::max());
    }
}

void DeflateBlock::put_sequences(BitWriter& out, const Codes& codes, std::uint32_t stored_from) const {
    struct Code {
        std::uint16_t bits, count;
    };
    std::array<Code, 256> literals;
    for (std::size_t i = 0; i < 256; ++i) literals[i] = {codes.literals.codes[i], codes.literals.lengths[i]};
    const auto put_literal = [&](std::uint8_t byte) { out.put(literals[byte].bits, literals[byte].count); };
    const auto put_end = [&] { out.put(codes.literals.codes[kEndOfBlock], codes.literals.lengths[kEndOfBlock]); };
    const std::uint8_t* from = bytes_;
    for (const DeflateSequence& s : sequences_) {
        const std::uint8_t* const copied = from + s.literals;
        if (s.literals >= stored_from) {
            put_end();
            put_stored(out, {from, copied});
            out.put(kFixedCodes, 3);
            from = copied;
        }
        for (; copied - from >= 4; from += 4) {
            for (int k = 0; k < 4; ++k) put_literal(from[k]);
            out.flush();
        }
        for (; from < copied; ++from) put_literal(*from);
        out.flush();
        from += s.length;
        if (s.length > 0) put_copy(out, codes, s.length, s.distance);
    }
    put_end();
    out.flush();
}

void DeflateBlock::put_last(BitWriter& out) {
    out.put(kLastBlock | kFixedCodes, 3);
    out.put(0, 7);  // its end
}

}  // namespace burin
