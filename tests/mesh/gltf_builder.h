#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace burin::test {

std::string base64(std::string_view bytes);
/// `bytes` as a glTF data URI.
std::string data_uri(std::string_view bytes);
/// A GLB of a JSON chunk and, unless it is empty, a binary chunk.
std::string glb(std::string json, std::string binary);

/// Four corners of the unit square, as floats: 48 bytes.
std::string square_positions();
/// Two triangles on them, as 16-bit numbers: 12 bytes.
std::string square_indices();

/// A glTF file in parts, each of which a test may replace. As it stands: one node that shows the
/// unit square in the XY plane, its buffer (positions, then indices) in a data URI. Parts that are
/// empty are left out.
struct GltfParts {
    std::string asset = R"({"version": "2.0"})";
    std::string scene = "0";
    std::string scenes = R"([{"nodes": [0]}])";
    std::string nodes = R"([{"mesh": 0, "name": "square"}])";
    std::string meshes = R"([{"name": "quad", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}])";
    std::string accessors = R"([{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},)"
                            R"( {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}])";
    std::string buffer_views = R"([{"buffer": 0, "byteLength": 48},)"
                               R"( {"buffer": 0, "byteOffset": 48, "byteLength": 12}])";
    std::string buffers;  ///< empty: `binary` in a data URI
    std::string materials, cameras, skins, animations, required;

    std::string binary = square_positions() + square_indices();

    std::string json() const;
    /// The file as a GLB, with the buffer in the binary chunk.
    std::string as_glb() const;
};

/// The buffer, views and accessors of a glTF file, one after the other.
class GltfAccessors {
  public:
    /// Adds an accessor over bytes of its own. `more`: further members of its object, as
    /// R"("normalized": true)". Returns its number.
    int add(const std::string& bytes, const char* type, int component_type, std::size_t count,
            const std::string& more = "");
    int add_positions(std::initializer_list<float> numbers);
    /// Three numbers each, as floats.
    int add_vectors(std::initializer_list<float> numbers) { return add_positions(numbers); }
    int add_indices(std::initializer_list<std::uint16_t> numbers);
    /// Adds an accessor as text.
    int add_object(const std::string& object);
    /// Returns the number of the view.
    int add_view(const std::string& bytes);

    void put_into(GltfParts& parts) const;

  private:
    std::string binary_;
    std::string views_, accessors_;
    int view_count_ = 0, accessor_count_ = 0;
};

/// A glTF file of one node that shows a mesh of the given primitives (as JSON, without brackets).
GltfParts gltf_of(const GltfAccessors& accessors, const std::string& primitives);

}  // namespace burin::test
