#include "mesh/gltf_marks.h"

#include "base/interrupt.h"

namespace burin {
namespace {

class MarkAppender {
  public:
    MarkAppender(const GltfPrimitive& primitive, const GltfCorners& corners, const GltfVertices& vertices,
                 GltfBuffers& buffers, std::vector<std::array<std::uint32_t, 2>>& marks)
        : primitive_(primitive), corners_(corners), vertices_(vertices), buffers_(buffers), marks_(marks) {}

    void add_segments() {
        const bool are_pairs = primitive_.mode == 1;
        for (std::uint64_t i = 0; i < primitive_.line_segments(); ++i) {
            if ((i & 0xFFFF) == 0) throw_if_interrupted();
            const std::uint64_t from = are_pairs ? 2 * i : i;
            add(corners_[from], corners_[(from + 1) % corners_.count()]);
        }
    }

    void add_visible_edges() {
        if (!primitive_.place.has_extension(kEdgeVisibilityExtension)) return;
        const JsonPlace extension = primitive_.place.extension(kEdgeVisibilityExtension);
        if (extension.has("visibility")) add_by_visibility(extension.at("visibility"));
        for (std::size_t i = 0; i < extension.size_of("lineStrings"); ++i) {
            add_line_string(extension.at("lineStrings").element(i).at("indices"));
        }
    }

    void add_outline() {
        if (!primitive_.place.has_extension(kOutlineExtension)) return;
        const JsonPlace extension = primitive_.place.extension(kOutlineExtension);
        if (!extension.has("indices")) return;
        const JsonPlace place = extension.at("indices");
        const GltfAccessor indices = vertex_numbers(place);
        if (indices.count % 2 != 0) place.fail("an outline needs two vertices per edge");
        for (std::uint64_t i = 0; i < indices.count; i += 2) {
            add(element(indices, i, place), element(indices, i + 1, place));
        }
    }

  private:
    /// Two bits per edge of each triangle; 2 and 3 are edges that are always seen.
    void add_by_visibility(const JsonPlace& place) {
        GltfAccessor bits = buffers_.accessor(place, "SCALAR");
        bits.normalized = false;
        if (bits.component_type != kGltfUnsignedByte) place.fail("must be unsigned bytes");
        const std::uint64_t triangles = primitive_.triangles();
        const std::uint64_t bytes = (6 * triangles + 7) / 8;
        if (bits.count != bytes) {
            place.fail("has " + std::to_string(bits.count) + " bytes; " + std::to_string(triangles) +
                       " triangles need " + std::to_string(bytes));
        }
        for (std::uint64_t t = 0; t < triangles; ++t) {
            if ((t & 0xFFFF) == 0) throw_if_interrupted();
            const std::array<std::uint64_t, 3> corner = gltf_triangle(primitive_.mode, t);
            for (std::uint64_t k = 0; k < 3; ++k) {
                const std::uint64_t at = 2 * (3 * t + k);
                const auto byte = static_cast<unsigned>(bits.number(at / 8, 0));
                if ((byte >> at % 8 & 3u) < 2) continue;
                add(corners_[corner[k]], corners_[corner[(k + 1) % 3]]);
            }
        }
    }

    /// Runs of vertices, with the largest number of its type between them.
    void add_line_string(const JsonPlace& place) {
        const GltfAccessor indices = vertex_numbers(place);
        const double between = indices.component_type == kGltfUnsignedByte    ? 0xFF
                               : indices.component_type == kGltfUnsignedShort ? 0xFFFF
                                                                              : 0xFFFFFFFF;
        for (std::uint64_t i = 1; i < indices.count; ++i) {
            if (indices.number(i - 1, 0) == between || indices.number(i, 0) == between) continue;
            add(element(indices, i - 1, place), element(indices, i, place));
        }
    }

    GltfAccessor vertex_numbers(const JsonPlace& place) {
        GltfAccessor indices = buffers_.accessor(place, "SCALAR");
        indices.normalized = false;
        const std::uint64_t type = indices.component_type;
        if (type != kGltfUnsignedByte && type != kGltfUnsignedShort && type != kGltfUnsignedInt) {
            place.fail("must be unsigned integers");
        }
        return indices;
    }

    std::uint64_t element(const GltfAccessor& indices, std::uint64_t i, const JsonPlace& place) const {
        const double index = indices.number(i, 0);
        if (index >= static_cast<double>(primitive_.vertices)) {
            place.fail("vertex " + std::to_string(static_cast<std::uint64_t>(index)) + " does not exist (there are " +
                       std::to_string(primitive_.vertices) + ")");
        }
        return static_cast<std::uint64_t>(index);
    }

    void add(std::uint64_t a, std::uint64_t b) {
        if (a != b) marks_.push_back({vertices_.vertex_of(a), vertices_.vertex_of(b)});
    }

    const GltfPrimitive& primitive_;
    const GltfCorners& corners_;
    const GltfVertices& vertices_;
    GltfBuffers& buffers_;
    std::vector<std::array<std::uint32_t, 2>>& marks_;
};

}  // namespace

GltfCorners::GltfCorners(const GltfPrimitive& primitive, const DracoGeometry* draco, GltfBuffers& buffers)
    : primitive_(primitive), draco_(draco), count_(primitive.corners) {
    if (draco != nullptr) {
        count_ = draco->indices.size();
    } else if (primitive.index_size > 0) {
        indices_ = buffers.accessor(primitive.place.at("indices"), "SCALAR");
        indices_.normalized = false;  // means nothing here
    }
}

std::uint64_t GltfCorners::operator[](std::uint64_t i) const {
    if (draco_ != nullptr) return draco_->indices[i];
    if (primitive_.index_size == 0) return i;
    const double index = indices_.number(i, 0);
    if (index < 0 || index >= static_cast<double>(primitive_.vertices)) {
        primitive_.place.at("indices").fail("vertex " + std::to_string(static_cast<std::int64_t>(index)) +
                                            " does not exist (there are " + std::to_string(primitive_.vertices) + ")");
    }
    return static_cast<std::uint64_t>(index);
}

std::array<std::uint64_t, 3> gltf_triangle(std::uint64_t mode, std::uint64_t t) {
    if (mode == 4) return {3 * t, 3 * t + 1, 3 * t + 2};
    if (mode == 5) return {t, t + 1 + t % 2, t + 2 - t % 2};
    return {t + 1, t + 2, 0};
}

void append_gltf_marks(const GltfPrimitive& primitive, const GltfCorners& corners, const GltfVertices& vertices,
                       GltfBuffers& buffers, std::vector<std::array<std::uint32_t, 2>>& marks) {
    MarkAppender appender(primitive, corners, vertices, buffers, marks);
    if (primitive.has_lines()) return appender.add_segments();
    appender.add_visible_edges();
    appender.add_outline();
}

}  // namespace burin
