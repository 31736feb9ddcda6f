#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

// What writer and reader of .lines files have in common (docs/shading/lines-files.md).

namespace burin {

static_assert(std::endian::native == std::endian::little, "the file is little-endian, and so are its arrays in memory");

constexpr std::string_view kLinesFormat = "burin-lines 1";
constexpr std::size_t kLinesAlignment = 64;
constexpr std::size_t kMostLinesAttributes = 256;
constexpr std::size_t kMostLinesDirectoryBytes = 16u << 20;
constexpr std::uint8_t kOccludes = 1, kFrontOnLeft = 2, kIsBeyond = 4;                            // of `flags`
constexpr std::uint8_t kHidden = 1, kClosed = 2, kChainClosed = 4, kFirstEnd = 8, kLastEnd = 32;  // of `chain_flags`

template <typename T>
constexpr std::string_view type_name() {
    if constexpr (std::is_same_v<T, double>) return "F64";
    if constexpr (std::is_same_v<T, std::uint64_t>) return "U64";
    if constexpr (std::is_same_v<T, float>) return "F32";
    if constexpr (std::is_same_v<T, std::uint32_t>) return "U32";
    if constexpr (std::is_same_v<T, std::uint16_t>) return "U16";
    if constexpr (std::is_same_v<T, std::uint8_t>) return "U8";
    if constexpr (std::is_same_v<T, std::int8_t>) return "I8";
}

}  // namespace burin
