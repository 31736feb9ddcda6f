#include "mesh/gltf_meshopt.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace burin {
namespace {

template <typename T>
T load(const char* p) {
    T value;
    std::memcpy(&value, p, sizeof(T));
    return value;
}

template <typename T>
void store(char* p, T value) {
    std::memcpy(p, &value, sizeof(T));
}

// The filters are here, and not those of the library: its octahedral one takes reciprocal roots as
// the processor approximates them, which differ from maker to maker.

/// A number of -1..1 as a normalized integer of type T.
template <typename T>
T normalized(double value) {
    return static_cast<T>(std::lround(std::clamp(value, -1.0, 1.0) * std::numeric_limits<T>::max()));
}

/// Unit vectors from two coordinates on an octahedron and what stands for 1.
template <typename T>
void decode_octahedral(std::string& bytes) {
    for (std::size_t at = 0; at + 4 * sizeof(T) <= bytes.size(); at += 4 * sizeof(T)) {
        char* const p = bytes.data() + at;
        const double one = std::max<double>(1, load<T>(p + 2 * sizeof(T)));
        double x = load<T>(p) / one, y = load<T>(p + sizeof(T)) / one;
        const double z = 1 - std::abs(x) - std::abs(y), behind = std::min(z, 0.0);
        x += x >= 0 ? behind : -behind;
        y += y >= 0 ? behind : -behind;
        const double length = std::sqrt(x * x + y * y + z * z);
        const double scale = length > 0 ? 1 / length : 0;
        store(p, normalized<T>(x * scale));
        store(p + sizeof(T), normalized<T>(y * scale));
        store(p + 2 * sizeof(T), normalized<T>(z * scale));
    }
}

/// Unit quaternions from their three smaller numbers, and which the largest is.
void decode_quaternions(std::string& bytes) {
    for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
        char* const p = bytes.data() + at;
        const int last = load<std::int16_t>(p + 6);
        const double scale = std::sqrt(0.5) / std::max(1, last | 3);
        double rest = 1, part[3];
        for (int i = 0; i < 3; ++i) {
            part[i] = load<std::int16_t>(p + 2 * i) * scale;
            rest -= part[i] * part[i];
        }
        const auto put = [&](int place, double value) {
            store(p + 2 * ((last + place) & 3), normalized<std::int16_t>(value));
        };
        put(0, std::sqrt(std::max(0.0, rest)));
        for (int i = 0; i < 3; ++i) put(i + 1, part[i]);
    }
}

/// Floats from integers with 8 bits of exponent and 24 of mantissa.
void decode_exponential(std::string& bytes) {
    for (std::size_t at = 0; at + 4 <= bytes.size(); at += 4) {
        char* const p = bytes.data() + at;
        const auto word = load<std::uint32_t>(p);
        const int exponent = static_cast<std::int8_t>(word >> 24);
        const std::int32_t mantissa = static_cast<std::int32_t>(word << 8) / 256;
        store(p, static_cast<float>(std::ldexp(static_cast<double>(mantissa), exponent)));
    }
}

}  // namespace

MeshoptLayout meshopt_layout(const JsonPlace& view, const JsonPlace& compressed) {
    using Mode = MeshoptLayout::Mode;
    using Filter = MeshoptLayout::Filter;
    MeshoptLayout layout;
    layout.count = compressed.at("count").integer();
    layout.stride = compressed.at("byteStride").integer();
    const std::string mode = compressed.at("mode").text();
    if (mode == "TRIANGLES") {
        layout.mode = Mode::triangles;
    } else if (mode == "INDICES") {
        layout.mode = Mode::indices;
    } else if (mode != "ATTRIBUTES") {
        compressed.at("mode").fail("unknown mode '" + printable(mode, 40) + "'");
    }
    const std::string filter = compressed.text_or("filter", "NONE");
    if (filter == "OCTAHEDRAL") {
        layout.filter = Filter::octahedral;
    } else if (filter == "QUATERNION") {
        layout.filter = Filter::quaternion;
    } else if (filter == "EXPONENTIAL") {
        layout.filter = Filter::exponential;
    } else if (filter != "NONE") {
        compressed.at("filter").fail("unknown filter '" + printable(filter, 40) + "'");
    }
    const std::uint64_t stride = layout.stride;
    const bool has_indices = layout.mode != Mode::attributes;
    const bool fits = has_indices ? (stride == 2 || stride == 4) && layout.filter == Filter::none
                                  : stride > 0 && stride <= 256 && stride % 4 == 0;
    if (!fits || (layout.filter == Filter::octahedral && stride != 4 && stride != 8) ||
        (layout.filter == Filter::quaternion && stride != 8)) {
        compressed.at("byteStride").fail("does not fit the mode and the filter");
    }
    if (layout.mode == Mode::triangles && layout.count % 3 != 0) {
        compressed.at("count").fail("triangles have three numbers each");
    }
    if (view.integer_or("byteStride", stride) != stride || view.at("byteLength").integer() != layout.size_bytes()) {
        compressed.fail("count and byteStride do not fit those of the view");
    }
    return layout;
}

std::string decode_meshopt(const JsonPlace& compressed, const MeshoptLayout& layout, std::string_view bytes) {
    std::string result(layout.size_bytes(), '\0');
    const auto* const from = reinterpret_cast<const unsigned char*>(bytes.data());
    int status = 0;
    switch (layout.mode) {
        case MeshoptLayout::Mode::attributes:
            status = meshopt_decodeVertexBuffer(result.data(), layout.count, layout.stride, from, bytes.size());
            break;
        case MeshoptLayout::Mode::triangles:
            status = meshopt_decodeIndexBuffer(result.data(), layout.count, layout.stride, from, bytes.size());
            break;
        case MeshoptLayout::Mode::indices:
            status = meshopt_decodeIndexSequence(result.data(), layout.count, layout.stride, from, bytes.size());
            break;
    }
    if (status != 0) compressed.fail("the compressed data are broken");
    switch (layout.filter) {
        case MeshoptLayout::Filter::none:
            break;
        case MeshoptLayout::Filter::octahedral:
            layout.stride == 4 ? decode_octahedral<std::int8_t>(result) : decode_octahedral<std::int16_t>(result);
            break;
        case MeshoptLayout::Filter::quaternion:
            decode_quaternions(result);
            break;
        case MeshoptLayout::Filter::exponential:
            decode_exponential(result);
            break;
    }
    return result;
}

}  // namespace burin
