#include "image/deflate.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "image/adler32.h"
#include "image/huffman.h"

namespace burin {
namespace {

constexpr std::size_t kMaxDistance = 32768, kMaxLength = 258;
constexpr std::uint32_t kEndOfBlock = 256;
constexpr std::size_t kBlockSequences = 8192;  // one set of codes for as many

std::uint64_t load_eight(const std::uint8_t* p) {
    std::uint64_t bytes;
    std::memcpy(&bytes, p, 8);
    if constexpr (std::endian::native == std::endian::big) bytes = __builtin_bswap64(bytes);
    return bytes;
}

/// How many bytes at `p` are those at `q`.
std::size_t common_length(const std::uint8_t* p, const std::uint8_t* q, const std::uint8_t* end) {
    const std::uint8_t* const start = p;
    const auto differ = [](const std::uint8_t* a, const std::uint8_t* b) { return load_eight(a) ^ load_eight(b); };
    // Long runs, 32 bytes at a time.
    while (end - p >= 32 && (differ(p, q) | differ(p + 8, q + 8) | differ(p + 16, q + 16) | differ(p + 24, q + 24)) == 0) {
        p += 32;
        q += 32;
    }
    for (; end - p >= 8; p += 8, q += 8) {
        const std::uint64_t difference = load_eight(p) ^ load_eight(q);
        if (difference != 0)
            return static_cast<std::size_t>(p - start + std::countr_zero(difference) / 8);
    }
    while (p < end && *p == *q) ++p, ++q;
    return static_cast<std::size_t>(p - start);
}

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

/// Calls use(length) for the pieces, each of 3 to 258 bytes, of a copy of any length.
template <typename Use>
void for_each_piece(std::size_t length, const Use& use) {
    while (length > 0) {
        std::size_t piece = std::min(length, kMaxLength);
        if (length > piece && length - piece < 3) piece = length - 3;
        use(static_cast<std::uint32_t>(piece));
        length -= piece;
    }
}

/// Bits from the lowest on, into memory that is large enough.
class BitWriter {
  public:
    explicit BitWriter(std::uint8_t* out) : out_(out) {}
    /// At most 57 bits between two calls of flush().
    void put(std::uint64_t bits, std::uint32_t count) {
        pending_ |= bits << count_;
        count_ += count;
    }
    void flush() {
        std::uint64_t bytes = pending_;
        if constexpr (std::endian::native == std::endian::big) bytes = __builtin_bswap64(bytes);
        std::memcpy(out_, &bytes, 8);
        out_ += count_ / 8;
        pending_ >>= count_ & ~7u;
        count_ &= 7;
    }
    /// The byte behind all; the rest of the last one is filled with zeros.
    std::uint8_t* finish() {
        flush();
        return out_ + (count_ > 0 ? 1 : 0);
    }

  private:
    std::uint8_t* out_;
    std::uint64_t pending_ = 0;
    std::uint32_t count_ = 0;
};

/// The lengths of both codes, themselves coded (RFC 1951, 3.2.7).
void put_code_lengths(BitWriter& out, const LiteralCode& literals, const DistanceCode& distances) {
    constexpr std::array<std::uint8_t, 19> kOrder = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                     11, 4,  12, 3, 13, 2, 14, 1, 15};
    std::array<std::uint8_t, 286 + 30> lengths;
    std::copy(literals.lengths.begin(), literals.lengths.end(), lengths.begin());
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

}  // namespace

void Deflater::add(std::size_t literals, std::size_t length, std::size_t distance) {
    sequences_.push_back({static_cast<std::uint32_t>(literals), static_cast<std::uint32_t>(length),
                          static_cast<std::uint32_t>(distance)});
}

void Deflater::find_sequences(std::span<const std::uint8_t> bytes) {
    sequences_.clear();
    newest_.fill(0);
    const std::uint8_t* const begin = bytes.data();
    const std::uint8_t* const end = begin + bytes.size();
    const std::uint8_t* literals = begin;  // those before are in sequences
    const std::uint8_t* p = begin;
    std::uint32_t misses = 0;
    while (end - p >= 8) {
        const std::uint64_t here = load_eight(p);
        const std::uint8_t* from = nullptr;
        if (p - begin >= 2 && here == load_eight(p - 2)) {
            from = p - 2;
        } else {
            // Of six bytes: shorter copies are found in noise, and coding them takes longer than it saves.
            const auto hash = static_cast<std::uint32_t>((here << 16) * 0x9E3779B97F4A7C15u >> (64 - kHashBits));
            const std::uint32_t place = newest_[hash];
            newest_[hash] = static_cast<std::uint32_t>(p - begin) + 1;
            const std::uint8_t* const candidate = begin + place - 1;
            if (place != 0 && p - candidate <= static_cast<std::ptrdiff_t>(kMaxDistance) &&
                (load_eight(candidate) ^ here) << 16 == 0) {
                from = candidate;
            }
        }
        if (from == nullptr) {
            p += std::min<std::ptrdiff_t>(end - p, 1 + (misses++ >> 5));  // in noise, ever larger steps
            continue;
        }
        misses /= 2;
        const std::size_t distance = static_cast<std::size_t>(p - from);
        const std::uint8_t* const behind = p + common_length(p, from, end);
        while (p > literals && from > begin && p[-1] == from[-1]) --p, --from;
        add(static_cast<std::size_t>(p - literals), static_cast<std::size_t>(behind - p), distance);
        literals = p = behind;
    }
    add(static_cast<std::size_t>(end - literals), 0, 0);
}

std::span<const std::uint8_t> Deflater::compress(std::span<const std::uint8_t> bytes) {
    find_sequences(bytes);
    // No literal takes more than 15 bits, no copy of six bytes or more takes more than 48, and no
    // block has more than 640 bytes of codes.
    out_.resize(2 * bytes.size() + 640 * (sequences_.size() / kBlockSequences + 1) + 64);
    BitWriter out(out_.data());
    out.put(0x0178, 16);  // a window of 32 KB, fastest compression
    const std::uint8_t* from = bytes.data();
    for (std::size_t first = 0; first < sequences_.size(); first += kBlockSequences) {
        const std::size_t count = std::min(kBlockSequences, sequences_.size() - first);
        const std::span block = std::span(sequences_).subspan(first, count);
        std::array<std::uint32_t, 286> literal_counts{};
        std::array<std::uint32_t, 30> distance_counts{};
        const std::uint8_t* p = from;
        for (const Sequence& s : block) {
            for (std::uint32_t i = 0; i < s.literals; ++i) ++literal_counts[p[i]];
            p += s.literals + s.length;
            if (s.length == 0) continue;
            std::uint32_t pieces = 0;
            for_each_piece(s.length, [&](std::uint32_t n) {
                ++literal_counts[length_symbol(n).symbol];
                ++pieces;
            });
            distance_counts[distance_symbol(s.distance).symbol] += pieces;
        }
        literal_counts[kEndOfBlock] = 1;
        const LiteralCode literals(literal_counts);
        const DistanceCode distances(distance_counts);
        const bool is_last = first + count == sequences_.size();
        out.put(is_last ? 1 : 0, 1);
        out.put(2, 2);  // codes of its own
        put_code_lengths(out, literals, distances);
        for (const Sequence& s : block) {
            const std::uint8_t* const copied = from + s.literals;
            for (; copied - from >= 3; from += 3) {
                for (int k = 0; k < 3; ++k)
                    out.put(literals.codes[from[k]], literals.lengths[from[k]]);
                out.flush();
            }
            for (; from < copied; ++from) out.put(literals.codes[*from], literals.lengths[*from]);
            out.flush();
            from += s.length;
            const Symbol distance = s.length > 0 ? distance_symbol(s.distance) : Symbol{};
            for_each_piece(s.length, [&](std::uint32_t n) {
                const Symbol length = length_symbol(n);
                out.put(literals.codes[length.symbol], literals.lengths[length.symbol]);
                out.put(length.extra, length.extra_bits);
                out.put(distances.codes[distance.symbol], distances.lengths[distance.symbol]);
                out.put(distance.extra, distance.extra_bits);
                out.flush();
            });
        }
        out.put(literals.codes[kEndOfBlock], literals.lengths[kEndOfBlock]);
        out.flush();
    }
    std::uint8_t* const end = out.finish();
    const std::uint32_t sum = adler32(bytes);
    for (int i = 0; i < 4; ++i) end[i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    return {out_.data(), end + 4};
}

}  // namespace burin
