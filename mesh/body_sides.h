#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "mesh/mesh.h"

// Faces of one plane are told apart by the side on which their body is, which is found from volumes, since winding
// carries no meaning.

namespace burin {

/// On which side of each triangle its body is, whichever way it is wound: -1 = behind the side from which it is seen
/// counterclockwise, 1 = in front of that side, 0 = the triangle belongs to no body, but to a sheet.
///
/// Triangles that share an edge of two are of one body; it lies where the volume that they enclose is. Where triangles
/// between edges of more than two enclose nothing, it lies behind the first one as that is wound. Time grows with the
/// number of triangles.
std::vector<std::int8_t> find_body_sides(const Mesh& mesh);

/// Whether two triangles are near each other on one body, and wound alike: then its side is the same for both. False
/// also where `b` is not among the `most` first triangles that are met from `a`.
bool are_wound_alike(const Mesh& mesh, std::uint32_t a, std::uint32_t b, std::size_t most = 64);

/// find_body_sides() of a mesh that stays, found when it is first asked for, by whichever thread.
class BodySides {
  public:
    explicit BodySides(const Mesh& mesh) : mesh_(mesh) {}
    int of(std::uint32_t triangle) const {
        std::call_once(is_found_, [this] {
            sides_ = find_body_sides(mesh_);
            are_known_.store(true, std::memory_order_release);
        });
        return sides_[triangle];
    }

    /// Whether the side is the same for both. Where the way from one triangle to the other over the mesh is short, only
    /// triangles on such ways are looked at, not the whole mesh.
    bool are_same(std::uint32_t a, std::uint32_t b) const;

  private:
    const Mesh& mesh_;
    mutable std::atomic<std::size_t> visited_ = 0;  // triangles on long ways that led nowhere
    mutable std::once_flag is_found_;
    mutable std::vector<std::int8_t> sides_;
    mutable std::atomic<bool> are_known_ = false;
};

}  // namespace burin
