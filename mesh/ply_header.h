#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace burin {

enum class PlyEncoding : std::uint8_t { ascii, little_endian, big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

constexpr std::size_t size_of(PlyType type) {
    constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    bool is_list = false;
    PlyType count_type = PlyType::uint8;  ///< of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// Index of the first property with one of these names (in capitals only if there is none in small letters), or -1.
    int find(std::string_view name_a, std::string_view name_b = {}) const;
    bool has_lists() const;
    /// Bytes of one item in a binary file, or the fewest possible if it has lists.
    std::uint64_t smallest_binary_size() const;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    std::size_t size = 0;   ///< bytes of the header, with its last line end
    std::size_t lines = 0;  ///< lines of the header
};

/// Reads the header of a PLY file. `path` is for messages. Throws InputError.
PlyHeader read_ply_header(const std::string& path, std::string_view bytes);

}  // namespace burin
