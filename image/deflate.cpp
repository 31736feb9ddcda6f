#include "image/deflate.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <algorithm>
#include <bit>
#include <cstring>

namespace burin {
namespace {

constexpr std::ptrdiff_t kMaxDistance = 32768;
constexpr std::ptrdiff_t kLongRun = 512;       // is not summed byte by byte
constexpr std::size_t kBlockSequences = 8192;  // that are coded together
/// After this many misses bytes are taken for noise, and only searched for runs. Not sooner: planes of noise may be
/// copies of each other, as those of grey lines are, which are met only if enough places in a plane are entered into
/// the table and searched.
constexpr std::uint32_t kMissesOfNoise = 64;

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
    // Long runs are compared 32 bytes at a time.
    while (end - p >= 32 &&
           (differ(p, q) | differ(p + 8, q + 8) | differ(p + 16, q + 16) | differ(p + 24, q + 24)) == 0) {
        p += 32;
        q += 32;
    }
    for (; end - p >= 8; p += 8, q += 8) {
        const std::uint64_t difference = load_eight(p) ^ load_eight(q);
        if (difference != 0) return static_cast<std::size_t>(p - start + std::countr_zero(difference) / 8);
    }
    while (p < end && *p == *q) ++p, ++q;
    return static_cast<std::size_t>(p - start);
}

/// How many bytes from `p` on repeat the two before; the first eight do.
std::size_t run_length(const std::uint8_t* p, const std::uint8_t* end) {
    const std::uint8_t* const start = p;
    const std::uint64_t pairs = load_eight(p);
#ifdef __SSE2__
    const __m128i all = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(p));
    const __m128i wanted = _mm_unpacklo_epi64(all, all);
    const auto equal = [&](std::ptrdiff_t at) {
        return _mm_cmpeq_epi8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p + at)), wanted);
    };
    while (end - p >= 64 && _mm_movemask_epi8(_mm_and_si128(_mm_and_si128(equal(0), equal(16)),
                                                            _mm_and_si128(equal(32), equal(48)))) == 0xFFFF) {
        p += 64;
    }
#endif
    for (; end - p >= 8; p += 8) {
        const std::uint64_t difference = load_eight(p) ^ pairs;
        if (difference != 0) return static_cast<std::size_t>(p - start + std::countr_zero(difference) / 8);
    }
    while (p < end && *p == p[-2]) ++p;
    return static_cast<std::size_t>(p - start);
}

/// The next place from `p` on where 12 bytes are those two before, of windows of 16 bytes; shorter runs in noise are
/// not worth what is between stored blocks.
const std::uint8_t* find_run(const std::uint8_t* p, const std::uint8_t* end) {
    for (; end - p >= 16; p += 16) {
        std::uint32_t same = 0;  // a bit for each byte
#ifdef __SSE2__
        const __m128i here = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
        same = static_cast<std::uint32_t>(
            _mm_movemask_epi8(_mm_cmpeq_epi8(here, _mm_loadu_si128(reinterpret_cast<const __m128i*>(p - 2)))));
#else
        for (int i = 0; i < 16; ++i) same |= (p[i] == p[i - 2] ? 1u : 0u) << i;
#endif
        same &= same >> 1;
        same &= same >> 2;
        same &= same >> 4;  // eight at once
        same &= same >> 4;
        if (same != 0) return p + std::countr_zero(same);
    }
    return end;
}

}  // namespace

void Deflater::add(std::size_t literals, std::size_t length, std::size_t distance) {
    sequences_.push_back({static_cast<std::uint32_t>(literals), static_cast<std::uint32_t>(length),
                          static_cast<std::uint32_t>(distance)});
}

void Deflater::find_sequences(std::span<const std::uint8_t> bytes, std::span<const Run> runs) {
    sequences_.clear();
    sum_ = Adler32();
    newest_.fill(0);
    const std::uint8_t* const begin = bytes.data();
    const std::uint8_t* const end = begin + bytes.size();
    const std::uint8_t* literals = begin;  // those before are in sequences
    const std::uint8_t* summed = begin;    // those before are in the sum
    const std::uint8_t* p = begin;
    std::uint32_t misses = 0;
    // run_length(), begun near the end of a run that is known.
    const auto behind_run = [&](const std::uint8_t* at) {
        const auto place = static_cast<std::size_t>(at - begin);
        while (!runs.empty() && runs.front().end < place + 8) runs = runs.subspan(1);
        if (!runs.empty() && runs.front().begin <= place) at += (runs.front().end - place - 8) & ~std::size_t{1};
        return at + run_length(at, end);
    };
    while (end - p >= 8) {
        const std::uint64_t here = load_eight(p);
        const std::uint8_t* from = nullptr;
        const bool is_run = p - begin >= 2 && here == load_eight(p - 2);
        if (is_run) {
            from = p - 2;
        } else if (misses < kMissesOfNoise) {
            // The hash is of six bytes: shorter copies are found in noise, and coding them takes longer than it saves.
            const auto hash = static_cast<std::uint32_t>((here << 16) * 0x9E3779B97F4A7C15u >> (64 - kHashBits));
            const std::uint32_t place = newest_[hash];
            newest_[hash] = static_cast<std::uint32_t>(p - begin) + 1;
            const std::uint8_t* const candidate = begin + place - 1;
            if (place != 0 && p - candidate <= kMaxDistance && (load_eight(candidate) ^ here) << 16 == 0) {
                from = candidate;
            }
        }
        if (from == nullptr) {
            if (misses < kMissesOfNoise) {
                p += std::min<std::ptrdiff_t>(end - p, 1 + misses++);  // ever larger steps
            } else {
                p = find_run(p + 1, end);
            }
            continue;
        }
        misses /= 2;
        const std::size_t distance = static_cast<std::size_t>(p - from);
        const std::uint8_t* const behind = is_run ? behind_run(p) : p + common_length(p, from, end);
        while (p > literals && from > begin && p[-1] == from[-1]) --p, --from;
        add(static_cast<std::size_t>(p - literals), static_cast<std::size_t>(behind - p), distance);
        if (is_run && behind - p >= kLongRun) {
            sum_.add({summed, p});
            sum_.add_pairs(p, static_cast<std::size_t>(behind - p));
            summed = behind;
        }
        literals = p = behind;
    }
    add(static_cast<std::size_t>(end - literals), 0, 0);
    sum_.add({summed, end});
}

std::span<const std::uint8_t> Deflater::compress(std::span<const std::uint8_t> bytes, std::span<const Run> runs) {
    find_sequences(bytes, runs);
    constexpr std::size_t kRest = 64;  // what is put before, between and behind blocks
    out_.resize(std::max(out_.size(), kRest));
    BitWriter out(out_.data());
    out.put(0x0178, 16);  // a window of 32 KB, fastest compression
    const std::uint8_t* from = bytes.data();
    for (std::size_t first = 0; first < sequences_.size(); first += kBlockSequences) {
        const std::size_t count = std::min(kBlockSequences, sequences_.size() - first);
        const auto sequences = std::span(sequences_).subspan(first, count);
        const DeflateBlock block(sequences, from);
        // There is no more memory than is needed, for it is fresh at first.
        const auto used = static_cast<std::size_t>(out.place() - out_.data());
        out_.resize(std::max(out_.size(), used + block.most_bytes() + kRest));
        out.move_to(out_.data() + used);
        block.put(out);
        from = block.end();
    }
    DeflateBlock::put_last(out);
    std::uint8_t* const end = out.finish();
    const std::uint32_t sum = sum_.value();
    for (int i = 0; i < 4; ++i) end[i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    return {out_.data(), end + 4};
}

}  // namespace burin
