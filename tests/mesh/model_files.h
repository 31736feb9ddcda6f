#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "mesh/polygon_soup.h"

namespace burin::test {

/// Succeeds if `read(path)` throws an InputError of one line that starts with the path and has all
/// the given parts.
template <typename Read>
testing::AssertionResult refuses(const Read& read, const std::string& path,
                                 std::initializer_list<std::string_view> parts) {
    try {
        read(path);
    } catch (const InputError& error) {
        const std::string message = error.what();
        if (!message.starts_with(path + ":")) {
            return testing::AssertionFailure() << "does not start with the path: " << message;
        }
        if (message.find('\n') != std::string::npos) {
            return testing::AssertionFailure() << "more than one line: " << message;
        }
        for (const std::string_view part : parts) {
            if (message.find(part, path.size()) == std::string::npos) {
                return testing::AssertionFailure() << "no '" << part << "' in: " << message;
            }
        }
        return testing::AssertionSuccess();
    }
    return testing::AssertionFailure() << "it was read without an error";
}

/// The polygons of a soup as lists of vertex numbers.
inline std::vector<std::vector<std::uint32_t>> polygons_of(const PolygonSoup& soup) {
    std::vector<std::vector<std::uint32_t>> polygons;
    for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
        const auto polygon = soup.polygon(i);
        polygons.emplace_back(polygon.begin(), polygon.end());
    }
    return polygons;
}

using Polygons = std::vector<std::vector<std::uint32_t>>;

/// Numbers as they stand in memory, or with the bytes of each turned round.
class ByteWriter {
  public:
    explicit ByteWriter(bool big_endian = false) : big_endian_(big_endian) {}

    template <typename T>
    ByteWriter& add(std::initializer_list<T> values) {
        for (const T value : values) {
            char bytes[sizeof(T)];
            std::memcpy(bytes, &value, sizeof(T));
            if (big_endian_) std::reverse(bytes, bytes + sizeof(T));
            bytes_.append(bytes, sizeof(T));
        }
        return *this;
    }
    const std::string& bytes() const { return bytes_; }

  private:
    bool big_endian_;
    std::string bytes_;
};

}  // namespace burin::test
