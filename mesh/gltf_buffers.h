#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/mapped_file.h"
#include "mesh/gltf_json.h"

namespace burin {

/// One accessor (glTF 2.0, 3.6.2), resolved to memory: `count` elements of `components` numbers.
struct GltfAccessor {
    const char* data = nullptr;  ///< nullptr: all zero
    std::uint64_t count = 0;
    std::uint64_t stride = 0;    ///< bytes from one element to the next
    int components = 1;
    std::uint64_t component_type = 0;  ///< as in the file
    bool normalized = false;

    double number(std::uint64_t element, int component) const;
};

/// The buffers of a glTF file: its binary chunk, data URIs, and files in the model's own folder. All
/// accesses are checked; what is wrong throws InputError with the place in the file.
class GltfBuffers {
  public:
    /// `root` is the whole JSON, `binary` the GLB's chunk; both must outlive this.
    GltfBuffers(const std::string& path, const JsonPlace& root, std::string_view binary);

    /// The paths of the files among the buffers.
    std::vector<std::string> files() const;
    /// Throws InputError if one of them has become shorter since it was opened.
    void check_are_whole() const;

    /// The accessor that `reference` names. 1 component: SCALAR; 3: VEC3.
    GltfAccessor accessor(const JsonPlace& reference, int components);

  private:
    std::string_view load_uri(const JsonPlace& place);
    const char* view_bytes(const JsonPlace& place, std::uint64_t offset, std::uint64_t size, std::uint64_t* stride) const;
    GltfAccessor with_sparse_values(const JsonPlace& place, const GltfAccessor& base);
    void count_implicit_zeros(const JsonPlace& place, std::uint64_t count);

    const std::string& path_;
    const JsonPlace& root_;
    std::vector<std::string_view> buffers_;
    std::vector<std::unique_ptr<std::string>> decoded_;
    std::vector<std::unique_ptr<MappedFile>> external_;
    std::uint64_t implicit_zeros_ = 0;  // elements without data so far
};

}  // namespace burin
