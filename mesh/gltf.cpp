#include "mesh/gltf.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <memory>
#include <string_view>

#include "base/interrupt.h"
#include "base/mapped_file.h"
#include "mesh/gltf_json.h"
#include "mesh/model_path.h"

namespace burin {
namespace {

using Json = nlohmann::json;
static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

constexpr std::uint32_t kGlbMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kGlbJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kGlbBinaryChunk = 0x004E4942;
constexpr int kMaxJsonDepth = 256;

template <typename T>
T load(const char* p) {
    T value;
    std::memcpy(&value, p, sizeof(T));
    return value;
}

/// The two chunks of a GLB, or the text of a .gltf.
struct Container {
    std::string_view json;
    std::string_view binary;
};

Container split_container(const std::string& path, std::string_view bytes) {
    if (bytes.size() < 4 || load<std::uint32_t>(bytes.data()) != kGlbMagic) return {bytes, {}};
    if (bytes.size() < 12 || load<std::uint32_t>(bytes.data() + 4) != 2) {
        throw InputError(path + ": only GLB version 2 is read; re-export the model as glTF 2.0");
    }
    const std::uint32_t size = load<std::uint32_t>(bytes.data() + 8);
    if (size > bytes.size()) {
        throw InputError(path + ": the file is shorter than its header says; " +
                         "was it written completely?");
    }
    bytes = bytes.substr(0, std::max<std::size_t>(size, 12));
    Container container;
    std::size_t at = 12;
    while (bytes.size() - at >= 8) {
        const std::uint32_t length = load<std::uint32_t>(bytes.data() + at);
        const std::uint32_t type = load<std::uint32_t>(bytes.data() + at + 4);
        at += 8;
        if (length > bytes.size() - at) {
            throw InputError(path + ": a chunk is longer than the file; was it written completely?");
        }
        const std::string_view chunk = bytes.substr(at, length);
        if (type == kGlbJsonChunk && container.json.empty()) container.json = chunk;
        if (type == kGlbBinaryChunk && container.binary.empty()) container.binary = chunk;
        at += length;
    }
    if (container.json.empty()) throw InputError(path + ": the GLB has no JSON chunk; re-export it");
    return container;
}

/// How deep lists and objects stand in each other.
int nesting_depth(std::string_view text) {
    int depth = 0, deepest = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') ++i;
            in_string = c != '"';
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            deepest = std::max(deepest, ++depth);
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return deepest;
}

Json parse_json(const std::string& path, std::string_view text) {
    // Not by the parser's callback, which takes time in the square of a list's length.
    if (nesting_depth(text) > kMaxJsonDepth) throw InputError(path + ": the JSON is nested too deeply");
    try {
        return Json::parse(text.begin(), text.end());
    } catch (const Json::parse_error& error) {
        const std::size_t at = std::min<std::size_t>(error.byte, text.size());
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        throw InputError({path, static_cast<std::size_t>(line)},
                         "the JSON breaks off or is malformed at byte " + std::to_string(at) +
                             "; was the file written completely?");
    } catch (const Json::exception&) {
        throw InputError(path + ": the JSON holds a number that no computer can hold; repair the file");
    }
}

std::string decode_base64(const JsonPlace& place, std::string_view text) {
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        int value = 0;
        if (c >= 'A' && c <= 'Z') value = c - 'A';
        else if (c >= 'a' && c <= 'z') value = c - 'a' + 26;
        else if (is_digit(c)) value = c - '0' + 52;
        else if (c == '+' || c == '-') value = 62;
        else if (c == '/' || c == '_') value = 63;
        else if (c == '=') break;
        else place.fail("the data URI is not base64");
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes += static_cast<char>(bits >> bit_count & 0xFF);
        }
    }
    return bytes;
}

/// "a%20b" as "a b".
std::string decode_percent(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        if (text[i] == '%' && i + 2 < text.size() &&
            std::from_chars(text.data() + i + 1, text.data() + i + 3, value, 16).ptr ==
                text.data() + i + 3) {
            result += static_cast<char>(value);
            i += 2;
        } else {
            result += text[i];
        }
    }
    return result;
}

/// One accessor, resolved to memory: `count` elements of `components` numbers.
struct AccessorView {
    const char* data = nullptr;  ///< nullptr: all zero
    std::uint64_t count = 0;
    std::uint64_t stride = 0;
    int components = 1;
    std::uint64_t component_type = 0;
    bool normalized = false;

    double number(std::uint64_t element, int component) const;
};

std::size_t component_size(std::uint64_t type) {
    switch (type) {
        case 5120: case 5121: return 1;
        case 5122: case 5123: return 2;
        case 5125: case 5126: return 4;
        default: return 0;
    }
}

double load_component(const char* p, std::uint64_t type, bool normalized) {
    switch (type) {
        case 5120: {
            const double v = load<std::int8_t>(p);
            return normalized ? std::max(v / 127.0, -1.0) : v;
        }
        case 5121: return load<std::uint8_t>(p) / (normalized ? 255.0 : 1.0);
        case 5122: {
            const double v = load<std::int16_t>(p);
            return normalized ? std::max(v / 32767.0, -1.0) : v;
        }
        case 5123: return load<std::uint16_t>(p) / (normalized ? 65535.0 : 1.0);
        case 5125: return load<std::uint32_t>(p);
        default: return static_cast<double>(load<float>(p));
    }
}

double AccessorView::number(std::uint64_t element, int component) const {
    if (data == nullptr) return 0;
    const char* const p = data + element * stride +
                          static_cast<std::size_t>(component) * component_size(component_type);
    return load_component(p, component_type, normalized);
}

class GltfReader {
  public:
    explicit GltfReader(const std::string& path)
        : path_(path),
          file_(path),
          container_(split_container(path, file_.bytes())),
          json_(parse_json(path, container_.json)),
          root_(path_, json_, "") {}

    GltfScene read() {
        if (!json_.is_object() || !root_.has("asset")) {
            throw InputError(path_ + ": this is no glTF file (it has no 'asset')");
        }
        const std::string version = root_.at("asset").text_or("version", "2.0");
        if (!version.starts_with("2")) {
            throw InputError(path_ + ": glTF version " + printable(version) +
                             " is not read; re-export the model as glTF 2.0");
        }
        check_extensions();
        read_buffers();
        read_materials();
        for (std::size_t i = 0; i < root_.size_of("meshes"); ++i) {
            read_mesh(root_.at("meshes").element(i));
        }
        walk_nodes();
        if (scene_.objects.empty()) {
            throw InputError(path_ + ": no node shows a mesh; burin draws the lines of surfaces");
        }
        return std::move(scene_);
    }

  private:
    /// Extensions that change the geometry must be known; those about looks may be ignored.
    void check_extensions() const {
        for (std::size_t i = 0; i < root_.size_of("extensionsRequired"); ++i) {
            const std::string name = root_.at("extensionsRequired").element(i).text();
            const bool harmless = name == "KHR_mesh_quantization" ||
                                  name.starts_with("KHR_materials_") ||
                                  name.starts_with("KHR_texture_") || name.starts_with("EXT_texture_") ||
                                  name.starts_with("KHR_lights_") || name == "EXT_lights_image_based";
            if (!harmless) {
                throw InputError(path_ + ": needs the glTF extension " + printable(name, 80) +
                                 ", which burin cannot read; re-export the model without it");
            }
        }
    }

    void read_buffers() {
        for (std::size_t i = 0; i < root_.size_of("buffers"); ++i) {
            const JsonPlace buffer = root_.at("buffers").element(i);
            const std::uint64_t length = buffer.at("byteLength").integer();
            std::string_view bytes = container_.binary;
            if (buffer.has("uri")) {
                bytes = load_uri(buffer.at("uri"));
            } else if (i != 0 || bytes.empty()) {
                buffer.fail("the buffer has neither a URI nor a binary chunk");
            }
            if (length > bytes.size()) {
                buffer.fail("byteLength is " + std::to_string(length) + ", but there are only " +
                            std::to_string(bytes.size()) + " bytes");
            }
            buffers_.push_back(bytes.substr(0, length));
        }
    }

    std::string_view load_uri(const JsonPlace& place) {
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

    void read_materials() {
        for (std::size_t i = 0; i < root_.size_of("materials"); ++i) {
            const JsonPlace place = root_.at("materials").element(i);
            Material material;
            material.name = place.text_or("name", "material" + std::to_string(i));
            material.color = glm::vec3(1.0f);
            if (place.has("pbrMetallicRoughness") &&
                place.at("pbrMetallicRoughness").has("baseColorFactor")) {
                const JsonPlace color = place.at("pbrMetallicRoughness").at("baseColorFactor");
                for (int c = 0; c < 3; ++c) {
                    const double value = color.element(static_cast<std::size_t>(c)).number();
                    material.color[c] = static_cast<float>(std::clamp(value, 0.0, 1.0));
                }
                if (place.text_or("alphaMode", "OPAQUE") == "BLEND" && color.size() > 3) {
                    material.opacity =
                        static_cast<float>(std::clamp(color.element(3).number(), 0.0, 1.0));
                }
            }
            scene_.materials.push_back(material);
        }
        scene_.materials.push_back(Material{.name = "default"});
    }

    /// The bytes [offset, offset + size) of a view, checked.
    const char* view_bytes(const JsonPlace& place, std::uint64_t offset, std::uint64_t size,
                           std::uint64_t* stride) {
        const std::uint32_t number =
            place.at("bufferView").index_below(root_.size_of("bufferViews"), "buffer view");
        const JsonPlace view = root_.at("bufferViews").element(number);
        const std::uint32_t buffer = view.at("buffer").index_below(buffers_.size(), "buffer");
        const std::uint64_t view_offset = view.integer_or("byteOffset", 0);
        const std::uint64_t view_length = view.at("byteLength").integer();
        const std::uint64_t available = buffers_[buffer].size();
        if (view_offset > available || view_length > available - view_offset) {
            view.fail("the view reaches beyond its buffer of " + std::to_string(available) + " bytes");
        }
        if (offset > view_length || size > view_length - offset) {
            place.fail("reaches beyond its buffer view of " + std::to_string(view_length) + " bytes");
        }
        if (stride != nullptr) *stride = view.integer_or("byteStride", 0);
        return buffers_[buffer].data() + view_offset + offset;
    }

    AccessorView accessor(const JsonPlace& reference, int components) {
        const std::uint32_t number = reference.index_below(root_.size_of("accessors"), "accessor");
        const JsonPlace place = root_.at("accessors").element(number);
        AccessorView view;
        view.count = place.at("count").integer();
        view.components = components;
        view.component_type = place.at("componentType").integer();
        view.normalized = place.has("normalized") && place.at("normalized").json() == true;
        const std::size_t size = component_size(view.component_type);
        if (size == 0) place.fail("unknown componentType");
        if (place.at("type").text() != (components == 1 ? "SCALAR" : "VEC3")) {
            place.fail(std::string("the type must be ") + (components == 1 ? "SCALAR" : "VEC3"));
        }
        if (view.count > 0xFFFFFFFFu) place.fail("more than 4 billion elements");
        const std::uint64_t element_size = static_cast<std::uint64_t>(components) * size;
        view.stride = element_size;
        if (place.has("bufferView") && view.count > 0) {
            std::uint64_t stride = 0;
            const std::uint64_t offset = place.integer_or("byteOffset", 0);
            view_bytes(place, offset, 0, &stride);
            if (stride != 0) {
                if (stride < element_size || stride > 0xFFFF) place.fail("the byteStride is too small or large");
                view.stride = stride;
            }
            view.data = view_bytes(place, offset, (view.count - 1) * view.stride + element_size, nullptr);
        }
        if (place.has("sparse")) return with_sparse_values(place, view);
        if (view.data == nullptr) count_implicit_zeros(place, view.count);
        return view;
    }

    /// Elements without data must not let a small file fill the memory.
    void count_implicit_zeros(const JsonPlace& place, std::uint64_t count) {
        if (count > kMaxImplicitZeros - implicit_zeros_) {
            place.fail("has no data for its " + std::to_string(count) + " elements");
        }
        implicit_zeros_ += count;
    }

    /// A copy of the accessor as floats, with the values of its "sparse" part put in.
    AccessorView with_sparse_values(const JsonPlace& place, const AccessorView& base) {
        const JsonPlace sparse = place.at("sparse");
        const std::uint64_t count = sparse.at("count").integer();
        if (count > base.count) sparse.fail("more sparse values than elements");
        if (base.data == nullptr) count_implicit_zeros(place, base.count);
        const JsonPlace indices = sparse.at("indices");
        const std::uint64_t index_type = indices.at("componentType").integer();
        const std::size_t index_size = component_size(index_type);
        if (index_size == 0 || index_type == 5126) indices.fail("unknown componentType");
        const char* const index_data =
            view_bytes(indices, indices.integer_or("byteOffset", 0), count * index_size, nullptr);
        const std::size_t size = component_size(base.component_type);
        const std::uint64_t element_size = static_cast<std::uint64_t>(base.components) * size;
        const JsonPlace values = sparse.at("values");
        const char* const value_data =
            view_bytes(values, values.integer_or("byteOffset", 0), count * element_size, nullptr);

        auto copy = std::make_unique<std::string>(base.count * element_size, '\0');
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
            std::memcpy(copy->data() + static_cast<std::uint64_t>(index) * element_size,
                        value_data + i * element_size, element_size);
        }
        AccessorView view = base;
        view.data = copy->data();
        view.stride = element_size;
        decoded_.push_back(std::move(copy));
        return view;
    }

    void read_mesh(const JsonPlace& place) {
        PolygonSoup soup;
        const std::string name =
            place.text_or("name", "mesh" + std::to_string(scene_.meshes.size()));
        soup.object_names = {name};
        const JsonPlace primitives = place.at("primitives");
        known_positions_.clear();
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            throw_if_interrupted();
            read_primitive(primitives.element(i), soup);
        }
        scene_.mesh_names.push_back(name);
        scene_.meshes.push_back(std::move(soup));
    }

    void read_primitive(const JsonPlace& place, PolygonSoup& soup) {
        const std::uint64_t mode = place.integer_or("mode", 4);
        if (mode > 6) place.fail("unknown mode " + std::to_string(mode));
        if (mode < 4 || !place.at("attributes").has("POSITION")) {
            ++scene_.skipped_primitives;
            return;
        }
        const PositionRange positions = read_positions(place.at("attributes").at("POSITION"), soup);
        const std::uint32_t material =
            place.has("material")
                ? place.at("material").index_below(scene_.materials.size() - 1, "material")
                : static_cast<std::uint32_t>(scene_.materials.size() - 1);
        add_triangles(place, mode, positions, soup);
        soup.polygon_material.resize(soup.polygon_count(), material);
    }

    /// Vertices [first, first + count) of a mesh.
    struct PositionRange {
        std::size_t first = 0;
        std::uint64_t count = 0;
    };

    /// Appends an accessor's vertices. Primitives of one mesh often share an accessor: then its
    /// vertices are there already.
    PositionRange read_positions(const JsonPlace& attribute, PolygonSoup& soup) {
        const std::uint32_t number = attribute.index_below(root_.size_of("accessors"), "accessor");
        const auto known = known_positions_.find(number);
        if (known != known_positions_.end()) return known->second;
        const AccessorView positions = accessor(attribute, 3);
        const std::size_t first = soup.positions.size();
        if (first + positions.count > 0xFFFFFFFFu) attribute.fail("more than 4 billion vertices");
        soup.positions.reserve(first + positions.count);
        for (std::uint64_t i = 0; i < positions.count; ++i) {
            const glm::dvec3 p(positions.number(i, 0), positions.number(i, 1), positions.number(i, 2));
            if (!(std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate &&
                  std::abs(p.z) <= kLargestCoordinate)) {
                attribute.fail("vertex " + std::to_string(i) + " is not finite or beyond 1e30");
            }
            soup.positions.push_back(p);
        }
        return known_positions_[number] = {first, positions.count};
    }

    void add_triangles(const JsonPlace& place, std::uint64_t mode, const PositionRange& vertices,
                       PolygonSoup& soup) {
        AccessorView indices;
        const bool indexed = place.has("indices");
        if (indexed) {
            indices = accessor(place.at("indices"), 1);
            indices.normalized = false;  // means nothing here
            if (indices.component_type == 5126) place.at("indices").fail("indices must be integers");
        }
        const std::uint64_t count = indexed ? indices.count : vertices.count;
        const auto vertex = [&](std::uint64_t i) {
            const double index = indexed ? indices.number(i, 0) : static_cast<double>(i);
            if (index < 0 || index >= static_cast<double>(vertices.count)) {
                place.at("indices").fail("vertex " + std::to_string(static_cast<std::int64_t>(index)) +
                                         " does not exist (there are " +
                                         std::to_string(vertices.count) + ")");
            }
            return static_cast<std::uint32_t>(vertices.first + static_cast<std::uint64_t>(index));
        };
        const std::uint64_t triangles = mode == 4 ? count / 3 : (count < 3 ? 0 : count - 2);
        if (soup.corners.size() + 3 * triangles > PolygonSoup::kMaxCorners) {
            place.fail("more than 4 billion polygon corners");
        }
        for (std::uint64_t t = 0; t < triangles; ++t) {
            std::array<std::uint64_t, 3> corner{};
            if (mode == 4) {
                corner = {3 * t, 3 * t + 1, 3 * t + 2};
            } else if (mode == 5) {  // strip: every second triangle is turned
                corner = {t + t % 2, t + 1 - t % 2, t + 2};
            } else {  // fan
                corner = {0, t + 1, t + 2};
            }
            for (const std::uint64_t c : corner) soup.corners.push_back(vertex(c));
        }
    }

    glm::dmat4 local_matrix(const JsonPlace& node) const {
        if (node.has("matrix")) {
            const JsonPlace numbers = node.at("matrix");
            if (numbers.size() != 16) numbers.fail("a matrix has 16 numbers");
            glm::dmat4 matrix;
            for (std::size_t i = 0; i < 16; ++i) {
                matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = numbers.element(i).number();
            }
            return matrix;
        }
        const auto vector = [&](const char* key, glm::dvec4 value, std::size_t size) {
            if (!node.has(key)) return value;
            const JsonPlace numbers = node.at(key);
            if (numbers.size() != size) numbers.fail("needs " + std::to_string(size) + " numbers");
            for (std::size_t i = 0; i < size; ++i) value[static_cast<int>(i)] = numbers.element(i).number();
            return value;
        };
        const glm::dvec4 t = vector("translation", glm::dvec4(0.0), 3);
        const glm::dvec4 r = vector("rotation", glm::dvec4(0.0, 0.0, 0.0, 1.0), 4);
        const glm::dvec4 s = vector("scale", glm::dvec4(1.0), 3);
        glm::dmat4 matrix = glm::mat4_cast(glm::dquat(r.w, r.x, r.y, r.z));
        for (int axis = 0; axis < 3; ++axis) matrix[axis] *= s[axis];
        matrix[3] = glm::dvec4(t.x, t.y, t.z, 1.0);
        return matrix;
    }

    /// Visits the nodes of the default scene. Each node has one place in the tree: a second visit
    /// is a cycle, or a node with two parents, which glTF forbids.
    void walk_nodes() {
        const std::size_t node_count = root_.size_of("nodes");
        std::vector<bool> visited(node_count, false);
        struct Pending {
            std::uint32_t node;
            glm::dmat4 parent;
        };
        std::vector<Pending> pending;
        const auto push_list = [&](const JsonPlace& list, const glm::dmat4& parent) {
            for (std::size_t i = list.size(); i-- > 0;) {  // the first one ends up on top
                pending.push_back({list.element(i).index_below(node_count, "node"), parent});
            }
        };
        push_roots(push_list, node_count, pending);
        while (!pending.empty()) {
            const Pending next = pending.back();
            pending.pop_back();
            const JsonPlace node = root_.at("nodes").element(next.node);
            if (visited[next.node]) {
                node.fail("the node is reached twice: it is its own ancestor or has two parents");
            }
            visited[next.node] = true;
            const glm::dmat4 to_world = next.parent * local_matrix(node);
            for (int i = 0; i < 16; ++i) {
                if (std::abs(to_world[i / 4][i % 4]) <= kLargestCoordinate) continue;
                node.fail("its transform, with those of its parents, is not finite or beyond 1e30");
            }
            const std::string name = node.text_or("name", "node" + std::to_string(next.node));
            if (node.has("mesh")) {
                const std::uint32_t mesh = node.at("mesh").index_below(scene_.meshes.size(), "mesh");
                scene_.objects.push_back({name, mesh, to_world});
            }
            if (node.has("camera")) read_camera(node, name, to_world);
            if (node.has("children")) push_list(node.at("children"), to_world);
        }
    }

    template <typename PushList, typename Pending>
    void push_roots(const PushList& push_list, std::size_t node_count, std::vector<Pending>& pending) {
        const std::size_t scene_count = root_.size_of("scenes");
        if (scene_count > 0) {
            const std::uint32_t number =
                root_.has("scene") ? root_.at("scene").index_below(scene_count, "scene") : 0;
            const JsonPlace scene = root_.at("scenes").element(number);
            if (scene.has("nodes")) push_list(scene.at("nodes"), glm::dmat4(1.0));
            return;
        }
        // Without scenes, every node without a parent is a root.
        std::vector<bool> is_child(node_count, false);
        for (std::size_t i = 0; i < node_count; ++i) {
            const JsonPlace node = root_.at("nodes").element(i);
            for (std::size_t k = 0; k < node.size_of("children"); ++k) {
                is_child[node.at("children").element(k).index_below(node_count, "node")] = true;
            }
        }
        for (std::size_t i = node_count; i-- > 0;) {
            if (!is_child[i]) pending.push_back({static_cast<std::uint32_t>(i), glm::dmat4(1.0)});
        }
    }

    void read_camera(const JsonPlace& node, const std::string& node_name, const glm::dmat4& to_world) {
        const std::uint32_t number =
            node.at("camera").index_below(root_.size_of("cameras"), "camera");
        const JsonPlace place = root_.at("cameras").element(number);
        GltfCamera camera;
        camera.name = place.text_or("name", node_name);
        camera.to_world = to_world;
        if (place.at("type").text() == "orthographic") {
            camera.orthographic = true;
            camera.height = 2 * place.at("orthographic").at("ymag").number();
        } else {
            camera.fov_deg = glm::degrees(place.at("perspective").at("yfov").number());
        }
        scene_.cameras.push_back(camera);
    }

    static constexpr std::uint64_t kMaxImplicitZeros = 1u << 20;

    std::string path_;
    MappedFile file_;
    Container container_;
    Json json_;
    JsonPlace root_;
    std::vector<std::string_view> buffers_;
    std::vector<std::unique_ptr<std::string>> decoded_;
    std::vector<std::unique_ptr<MappedFile>> external_;
    std::map<std::uint32_t, PositionRange> known_positions_;  // by accessor; of the mesh being read
    std::uint64_t implicit_zeros_ = 0;  // elements without data so far
    GltfScene scene_;
};

}  // namespace

GltfScene read_gltf(const std::string& path) { return GltfReader(path).read(); }

}  // namespace burin
