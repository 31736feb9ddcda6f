#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/model_budget.h"
#include "mesh/gltf_json.h"

// Buffer views that meshoptimizer compressed are decoded here, with filters of our own, which give the same bits
// everywhere.

namespace burin {

inline constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";

/// What a buffer view that meshoptimizer compressed holds once it is decompressed.
struct MeshoptLayout {
    enum class Mode : std::uint8_t { attributes, triangles, indices };
    enum class Filter : std::uint8_t { none, octahedral, quaternion, exponential };

    Mode mode = Mode::attributes;
    Filter filter = Filter::none;
    std::uint64_t count = 0;   ///< elements
    std::uint64_t stride = 0;  ///< bytes per element

    std::uint64_t size_bytes() const { return saturating_product(count, stride); }
};

/// Reads and checks the extension object of `view`.
MeshoptLayout meshopt_layout(const JsonPlace& view, const JsonPlace& compressed);

/// Decompresses `bytes`. Throws InputError at `compressed` if they are broken.
std::string decode_meshopt(const JsonPlace& compressed, const MeshoptLayout& layout, std::string_view bytes);

}  // namespace burin
