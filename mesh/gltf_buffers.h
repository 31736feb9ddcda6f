#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/mapped_file.h"
#include "base/model_budget.h"
#include "mesh/gltf_json.h"

// Accessors of a glTF file become checked numbers in memory, whatever their type, sparse or compressed.

namespace burin {

/// One accessor (glTF 2.0, 3.6.2), resolved to memory: `count` elements of `components` numbers.
struct GltfAccessor {
    const char* data = nullptr;  ///< nullptr: all zero
    std::uint64_t count = 0;
    std::uint64_t stride = 0;        ///< bytes from one element to the next
    std::uint64_t element_size = 0;  ///< bytes of an element
    int components = 1;
    std::uint64_t component_type = 0;  ///< as in the file
    bool normalized = false;
    std::shared_ptr<const std::string> owned;  ///< where `data` lies, if in no buffer of the file

    double number(std::uint64_t element, int component) const;
};

/// The components of a number in an accessor, by glTF's name of the type.
constexpr std::uint64_t kGltfByte = 5120, kGltfUnsignedByte = 5121, kGltfShort = 5122, kGltfUnsignedShort = 5123,
                        kGltfUnsignedInt = 5125, kGltfFloat = 5126;

/// The buffers of a glTF file: its binary chunk, data URIs, and files in the model's own folder. All
/// accesses are checked; what is wrong throws InputError with the place in the file.
class GltfBuffers {
  public:
    /// `root` is the whole JSON, `binary` the GLB's chunk; both must outlive this. What compressed
    /// views take is counted in `budget`; each is decompressed when it is needed.
    GltfBuffers(const std::string& path, const JsonPlace& root, std::string_view binary, ModelBudget& budget);

    /// The paths of the files among the buffers.
    std::vector<std::string> files() const;
    /// Throws InputError if one of them has become shorter since it was opened.
    void check_are_whole() const;

    /// The accessor that `reference` names, as if it had no "sparse" part. `type`: SCALAR, VEC2, VEC3, VEC4 or MAT4. It
    /// may have up to `known_count` elements that the file has no data for: the caller has memory for these.
    GltfAccessor without_sparse(const JsonPlace& reference, std::string_view type, std::uint64_t known_count = 0);
    /// The accessor as it is.
    GltfAccessor accessor(const JsonPlace& reference, std::string_view type, std::uint64_t known_count = 0);
    /// The type of the accessor that `reference` names: "VEC2".
    std::string type_of(const JsonPlace& reference) const;
    /// The content of the view that `place.bufferView` names.
    std::string_view view(const JsonPlace& place);

    /// How many bytes the file and those beside it have for accessors, decompressed.
    std::uint64_t size_bytes() const { return size_bytes_; }

  private:
    std::string_view load_uri(const JsonPlace& place);
    std::string_view slice(const JsonPlace& view) const;
    const char* bytes_of(const JsonPlace& place, std::uint64_t offset, std::uint64_t size);
    std::uint64_t stride_of(const JsonPlace& place) const;
    GltfAccessor with_sparse_values(const JsonPlace& place, const GltfAccessor& base);

    const std::string& path_;
    const JsonPlace& root_;
    std::vector<std::optional<std::string_view>> buffers_;  // none: a place for decompressed data
    std::vector<std::unique_ptr<std::string>> decoded_;
    std::vector<std::unique_ptr<MappedFile>> external_;
    std::map<std::uint32_t, std::string> decompressed_;  // by number of the view
    std::optional<std::uint32_t> sparse_number_;         // of the accessor in sparse_
    GltfAccessor sparse_;                                // the last one that had values put in
    std::uint64_t size_bytes_ = 0;
};

}  // namespace burin
