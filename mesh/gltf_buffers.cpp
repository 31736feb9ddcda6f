#include "mesh/gltf_buffers.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>

#include "mesh/gltf_meshopt.h"
#include "mesh/model_path.h"

namespace burin {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

constexpr std::uint64_t kMaxImplicitZeros = 1u << 20;

template <typename T>
T load(const char* p) {
    T value;
    std::memcpy(&value, p, sizeof(T));
    return value;
}

std::string decode_base64(const JsonPlace& place, std::string_view text) {
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        int value = 0;
        if (c >= 'A' && c <= 'Z')
            value = c - 'A';
        else if (c >= 'a' && c <= 'z')
            value = c - 'a' + 26;
        else if (is_digit(c))
            value = c - '0' + 52;
        else if (c == '+' || c == '-')
            value = 62;
        else if (c == '/' || c == '_')
            value = 63;
        else if (c == '=')
            break;
        else
            place.fail("the data URI is not base64");
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes += static_cast<char>(bits >> bit_count & 0xFF);
        }
    }
    return bytes;
}

std::size_t component_size(std::uint64_t type) {
    switch (type) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        case 5125:
        case 5126:
            return 4;
        default:
            return 0;
    }
}

double load_component(const char* p, std::uint64_t type, bool normalized) {
    switch (type) {
        case 5120: {
            const double v = load<std::int8_t>(p);
            return normalized ? std::max(v / 127.0, -1.0) : v;
        }
        case 5121:
            return load<std::uint8_t>(p) / (normalized ? 255.0 : 1.0);
        case 5122: {
            const double v = load<std::int16_t>(p);
            return normalized ? std::max(v / 32767.0, -1.0) : v;
        }
        case 5123:
            return load<std::uint16_t>(p) / (normalized ? 65535.0 : 1.0);
        case 5125:
            return load<std::uint32_t>(p);
        default:
            return static_cast<double>(load<float>(p));
    }
}

int component_count(std::string_view type) {
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4") return 4;
    return type == "MAT4" ? 16 : 1;
}

/// Whether the buffer is only there for programs that cannot decompress.
bool is_fallback_buffer(const JsonPlace& buffer) {
    if (!buffer.has_extension(kMeshoptExtension)) return false;
    const JsonPlace extension = buffer.extension(kMeshoptExtension);
    return extension.has("fallback") && extension.at("fallback").boolean();
}

}  // namespace

double GltfAccessor::number(std::uint64_t element, int component) const {
    if (data == nullptr) return 0;
    const char* const p =
        data + element * stride + static_cast<std::size_t>(component) * component_size(component_type);
    return load_component(p, component_type, normalized);
}

GltfBuffers::GltfBuffers(const std::string& path, const JsonPlace& root, std::string_view binary, ModelBudget& budget)
    : path_(path), root_(root) {
    for (std::size_t i = 0; i < root_.size_of("buffers"); ++i) {
        const JsonPlace buffer = root_.at("buffers").element(i);
        const std::uint64_t length = buffer.at("byteLength").integer();
        const bool is_fallback = is_fallback_buffer(buffer);
        const bool is_chunk = i == 0 && !binary.empty() && !buffer.has("uri");
        // What it stands for is compressed elsewhere in the file.
        if (is_fallback || (!is_chunk && !buffer.has("uri"))) {
            buffers_.emplace_back();
            continue;
        }
        const std::string_view bytes = is_chunk ? binary : load_uri(buffer.at("uri"));
        if (length > bytes.size()) {
            buffer.fail("byteLength is " + std::to_string(length) + ", but there are only " +
                        std::to_string(bytes.size()) + " bytes");
        }
        buffers_.emplace_back(bytes.substr(0, length));
        size_bytes_ += length;
    }
    std::uint64_t decompressed = 0;
    for (std::size_t i = 0; i < root_.size_of("bufferViews"); ++i) {
        const JsonPlace view = root_.at("bufferViews").element(i);
        if (!view.has_extension(kMeshoptExtension)) continue;
        const std::uint64_t size = meshopt_layout(view, view.extension(kMeshoptExtension)).size_bytes();
        decompressed += std::min(size, UINT64_MAX - decompressed);
    }
    budget.add(decompressed, path + ": what it has compressed");
    size_bytes_ += std::min(decompressed, UINT64_MAX - size_bytes_);
}

std::string_view GltfBuffers::load_uri(const JsonPlace& place) {
    const std::string uri = place.text();
    if (uri.starts_with("data:")) {
        const std::size_t comma = uri.find(',');
        if (comma == std::string::npos || uri.substr(0, comma).find(";base64") == std::string::npos) {
            place.fail("the data URI is not base64");
        }
        decoded_.push_back(
            std::make_unique<std::string>(decode_base64(place, std::string_view(uri).substr(comma + 1))));
        return *decoded_.back();
    }
    const std::string target = path_inside_model_folder(path_, decode_percent(uri));
    if (target.empty()) {
        place.fail("'" + printable(uri, 80) + "' leads out of the model's folder");
    }
    try {
        external_.push_back(std::make_unique<MappedFile>(target));
    } catch (const InputError& error) {
        // Without the buffer's path, which the URI stands for.
        const std::string reason = error.what();
        place.fail("'" + printable(uri, 80) + "'" + reason.substr(target.size()));
    }
    return external_.back()->bytes();
}

std::vector<std::string> GltfBuffers::files() const {
    std::vector<std::string> paths;
    for (const auto& file : external_) paths.push_back(file->path());
    return paths;
}

void GltfBuffers::check_are_whole() const {
    for (const auto& file : external_) file->check_is_whole();
}

/// The bytes that `view` names in its buffer.
std::string_view GltfBuffers::slice(const JsonPlace& view) const {
    const std::uint32_t number = view.at("buffer").index_below(buffers_.size(), "buffer");
    if (!buffers_[number]) {
        root_.at("buffers").element(number).fail(
            root_.at("buffers").element(number).has("uri")
                ? "the buffer is a fallback, but a view that is not compressed uses it"
                : "the buffer has neither a URI nor a binary chunk");
    }
    const std::string_view buffer = *buffers_[number];
    const std::uint64_t offset = view.integer_or("byteOffset", 0);
    const std::uint64_t length = view.at("byteLength").integer();
    if (offset > buffer.size() || length > buffer.size() - offset) {
        view.fail("the view reaches beyond its buffer of " + std::to_string(buffer.size()) + " bytes");
    }
    return buffer.substr(offset, length);
}

std::string_view GltfBuffers::view(const JsonPlace& place) {
    const std::uint32_t number = place.at("bufferView").index_below(root_.size_of("bufferViews"), "buffer view");
    const JsonPlace view = root_.at("bufferViews").element(number);
    if (!view.has_extension(kMeshoptExtension)) return slice(view);
    const auto known = decompressed_.find(number);
    if (known != decompressed_.end()) return known->second;
    const JsonPlace compressed = view.extension(kMeshoptExtension);
    const MeshoptLayout layout = meshopt_layout(view, compressed);
    return decompressed_[number] = decode_meshopt(compressed, layout, slice(compressed));
}

/// The bytes [offset, offset + size) of the view of `place`, checked.
const char* GltfBuffers::bytes_of(const JsonPlace& place, std::uint64_t offset, std::uint64_t size) {
    const std::string_view bytes = view(place);
    if (offset > bytes.size() || size > bytes.size() - offset) {
        place.fail("reaches beyond its buffer view of " + std::to_string(bytes.size()) + " bytes");
    }
    return bytes.data() + offset;
}

/// The stride that the view of `place` sets; 0: none.
std::uint64_t GltfBuffers::stride_of(const JsonPlace& place) const {
    const std::uint32_t number = place.at("bufferView").index_below(root_.size_of("bufferViews"), "buffer view");
    return root_.at("bufferViews").element(number).integer_or("byteStride", 0);
}

GltfAccessor GltfBuffers::without_sparse(const JsonPlace& reference, std::string_view type, std::uint64_t known_count) {
    const std::uint32_t number = reference.index_below(root_.size_of("accessors"), "accessor");
    const JsonPlace place = root_.at("accessors").element(number);
    GltfAccessor accessor;
    accessor.count = place.at("count").integer();
    accessor.components = component_count(type);
    accessor.component_type = place.at("componentType").integer();
    accessor.normalized = place.has("normalized") && place.at("normalized").json() == true;
    const std::size_t size = component_size(accessor.component_type);
    if (size == 0) place.fail("unknown componentType");
    if (place.at("type").text() != type) place.fail("the type must be " + std::string(type));
    if (accessor.count > 0xFFFFFFFFu) place.fail("more than 4 billion elements");
    const std::uint64_t element_size = static_cast<std::uint64_t>(accessor.components) * size;
    accessor.stride = accessor.element_size = element_size;
    if (place.has("bufferView") && accessor.count > 0) {
        const std::uint64_t offset = place.integer_or("byteOffset", 0);
        bytes_of(place, offset, 0);
        const std::uint64_t stride = stride_of(place);
        if (stride != 0) {
            if (stride < element_size || stride > 0xFFFF) {
                place.fail("the byteStride is too small or large");
            }
            accessor.stride = stride;
        }
        accessor.data = bytes_of(place, offset, (accessor.count - 1) * accessor.stride + element_size);
    }
    // Elements without data must not let a small file fill the memory.
    if (accessor.data == nullptr && accessor.count > std::max(known_count, kMaxImplicitZeros)) {
        place.fail("has no data for its " + std::to_string(accessor.count) + " elements");
    }
    return accessor;
}

std::string GltfBuffers::type_of(const JsonPlace& reference) const {
    const std::uint32_t number = reference.index_below(root_.size_of("accessors"), "accessor");
    return root_.at("accessors").element(number).at("type").text();
}

GltfAccessor GltfBuffers::accessor(const JsonPlace& reference, std::string_view type, std::uint64_t known_count) {
    GltfAccessor result = without_sparse(reference, type, known_count);
    const std::uint32_t number = reference.index_below(root_.size_of("accessors"), "accessor");
    const JsonPlace place = root_.at("accessors").element(number);
    if (!place.has("sparse")) return result;
    if (sparse_number_ != number) {
        sparse_ = with_sparse_values(place, result);
        sparse_number_ = number;
    }
    return sparse_;
}

/// A copy of the accessor with the values of its "sparse" part put in.
GltfAccessor GltfBuffers::with_sparse_values(const JsonPlace& place, const GltfAccessor& base) {
    const JsonPlace sparse = place.at("sparse");
    const std::uint64_t count = sparse.at("count").integer();
    if (count > base.count) sparse.fail("more sparse values than elements");
    const JsonPlace indices = sparse.at("indices");
    const std::uint64_t index_type = indices.at("componentType").integer();
    const std::size_t index_size = component_size(index_type);
    if (index_size == 0 || index_type == kGltfFloat) indices.fail("unknown componentType");
    const char* const index_data = bytes_of(indices, indices.integer_or("byteOffset", 0), count * index_size);
    const std::uint64_t element_size = base.element_size;
    const JsonPlace values = sparse.at("values");
    const char* const value_data = bytes_of(values, values.integer_or("byteOffset", 0), count * element_size);

    auto copy = std::make_shared<std::string>(base.count * element_size, '\0');
    if (base.data != nullptr) {
        for (std::uint64_t i = 0; i < base.count; ++i) {
            std::memcpy(copy->data() + i * element_size, base.data + i * base.stride, element_size);
        }
    }
    for (std::uint64_t i = 0; i < count; ++i) {
        const double index = load_component(index_data + i * index_size, index_type, false);
        if (index < 0 || index >= static_cast<double>(base.count)) {
            indices.fail("a sparse index lies beyond the accessor");
        }
        std::memcpy(copy->data() + static_cast<std::uint64_t>(index) * element_size, value_data + i * element_size,
                    element_size);
    }
    GltfAccessor result = base;
    result.data = copy->data();
    result.stride = element_size;
    result.owned = std::move(copy);
    return result;
}

}  // namespace burin
