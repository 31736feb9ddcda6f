#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

namespace burin::test {

/// Polygons to draw, convex, in this order; every edge of every polygon is a line.
struct GlMesh {
    std::vector<glm::vec3> positions;  ///< view space
    std::vector<std::vector<std::uint32_t>> polygons;
};

enum class GlMethod : std::uint8_t {
    single_pass,   ///< a geometry shader hands heights to the fragment shader: exp2(-2 d^2)
    simple,        ///< fills, then lines over them
    slope_offset,  ///< the same, fills pushed back by glPolygonOffset(1, 1)
    stencil,       ///< the edging plane as a stencil bit, polygon by polygon
};

/// Draws lines over surfaces with OpenGL itself, for comparison: off the screen, no window system
/// needed, with a 24-bit depth and an 8-bit stencil buffer. Row 0 is the top.
class GlRenderer {
  public:
    /// Throws std::runtime_error if there is no OpenGL 4.5.
    GlRenderer();
    ~GlRenderer();

    /// Which OpenGL this is.
    std::string description() const;

    /// How much line each pixel has, row by row. `to_clip` takes view space to clip space.
    std::vector<float> line_alpha(const GlMesh& mesh, const glm::mat4& to_clip, int width, int height, GlMethod method);

  private:
    struct Context;
    std::unique_ptr<Context> context_;
};

}  // namespace burin::test
