#include "mesh/draco_module.h"

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>

namespace {

/// Reads the first bytes of a Draco bitstream 2.2, up to the size of its mesh.
class HeaderReader {
  public:
    HeaderReader(const void* bytes, std::uint64_t size)
        : at_(static_cast<const unsigned char*>(bytes)), end_(at_ + size) {}

    /// Says what is wrong if the data do not claim to be a mesh of this many triangles (and, where the header tells,
    /// points).
    const char* check(std::uint64_t points, std::uint64_t triangles) {
        if (end_ - at_ < 11 || std::memcmp(at_, "DRACO", 5) != 0) return "this is not Draco's";
        if (at_[5] != 2 || at_[6] != 2) return "only version 2.2 of its format is read";
        if (at_[7] != 1) return "it is no mesh";
        const bool is_sequential = at_[8] == 0;
        const bool has_metadata = (at_[10] & 0x80) != 0;
        at_ += 11;
        if (has_metadata) skip_all_metadata();
        if (!is_sequential) skip(1);  // how its triangles are visited
        const std::uint64_t first = number(), second = number();
        if (!is_good_) return "it breaks off";
        if ((is_sequential ? first : second) != triangles) return "it has not as many triangles";
        if (is_sequential && second != points) return "it has not as many points";
        return nullptr;
    }

  private:
    void skip(std::uint64_t bytes) {
        is_good_ = is_good_ && bytes <= static_cast<std::uint64_t>(end_ - at_);
        at_ = is_good_ ? at_ + bytes : end_;
    }
    /// Reads a number of seven bits per byte, the lowest first.
    std::uint64_t number() {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 64 && at_ < end_; shift += 7) {
            const unsigned char byte = *at_++;
            value |= std::uint64_t{byte & 0x7Fu} << shift;
            if (byte < 0x80) return value;
        }
        is_good_ = false;
        return 0;
    }
    void skip_name() {
        if (at_ < end_) skip(1 + std::uint64_t{*at_});
    }
    /// Skips the metadata of attributes, each after its id, and those of the mesh.
    void skip_all_metadata() {
        for (std::uint64_t left = number(); left > 0 && is_good_; --left) {
            number();
            skip_metadata();
        }
        skip_metadata();
    }
    void skip_metadata() {
        std::uint64_t left = 1;  // with those inside others, which follow them with their names
        for (bool is_first = true; left > 0 && is_good_; is_first = false) {
            if (!is_first) skip_name();
            for (std::uint64_t entries = number(); entries > 0 && is_good_; --entries) {
                skip_name();
                skip(number());
            }
            left += number() - 1;
        }
    }

    const unsigned char* at_;
    const unsigned char* end_;
    bool is_good_ = true;
};

template <typename T>
bool copy_values(const draco::PointAttribute& from, std::uint32_t points, unsigned components, void* to) {
    auto* out = static_cast<T*>(to);
    for (std::uint32_t i = 0; i < points; ++i, out += components) {
        const draco::AttributeValueIndex value = from.mapped_index(draco::PointIndex(i));
        if (value.value() >= from.size()) return false;
        if (!from.ConvertValue<T>(value, static_cast<std::int8_t>(components), out)) return false;
    }
    return true;
}

bool copy_values(const draco::PointAttribute& from, std::uint32_t points, const BurinDracoAttribute& to) {
    switch (to.component_type) {
        case 5120:
            return copy_values<std::int8_t>(from, points, to.components, to.values);
        case 5121:
            return copy_values<std::uint8_t>(from, points, to.components, to.values);
        case 5122:
            return copy_values<std::int16_t>(from, points, to.components, to.values);
        case 5123:
            return copy_values<std::uint16_t>(from, points, to.components, to.values);
        case 5125:
            return copy_values<std::uint32_t>(from, points, to.components, to.values);
        case 5126:
            return copy_values<float>(from, points, to.components, to.values);
        default:
            return false;
    }
}

const char* decode(const void* bytes, std::uint64_t size, std::uint64_t points, std::uint64_t triangles,
                   unsigned* indices, BurinDracoAttribute* attributes, unsigned attribute_count) {
    if (const char* wrong = HeaderReader(bytes, size).check(points, triangles)) return wrong;
    draco::DecoderBuffer buffer;
    buffer.Init(static_cast<const char*>(bytes), size);
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) return "it cannot be decompressed";
    const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
    if (mesh->num_faces() != triangles) return "it has not as many triangles";
    if (mesh->num_points() != points) return "it has not as many points";
    for (std::uint32_t i = 0; i < mesh->num_faces(); ++i) {
        for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(i))) {
            if (corner.value() >= points) return "a triangle has a point that does not exist";
            *indices++ = corner.value();
        }
    }
    for (unsigned i = 0; i < attribute_count; ++i) {
        const draco::PointAttribute* const from = mesh->GetAttributeByUniqueId(attributes[i].id);
        if (from == nullptr) return "it has not all attributes";
        if (from->num_components() != static_cast<int>(attributes[i].components) ||
            !copy_values(*from, mesh->num_points(), attributes[i])) {
            return "an attribute is of another type";
        }
    }
    return nullptr;
}

}  // namespace

const char* burin_draco_decode(const void* bytes, unsigned long long size, unsigned long long points,
                               unsigned long long triangles, unsigned* indices, BurinDracoAttribute* attributes,
                               unsigned attribute_count) {
    try {
        return decode(bytes, size, points, triangles, indices, attributes, attribute_count);
    } catch (const std::exception&) {  // std::bad_alloc
        return "it needs too much memory";
    }
}
