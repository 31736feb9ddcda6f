#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "shading/surface/shaded_surfaces.h"
#include "shading/surface/shaded_triangle.h"

namespace burin {

/// Samples of a pixel: of side x side ones, bit row * side + column for each.
struct PixelSamples {
    std::uint8_t side = 0;   ///< 1 to 8; 0: the place alone, or with no bit all of the pixel
    std::uint64_t bits = 0;  ///< 0: all of the pixel
    static constexpr PixelSamples place_alone() { return {0, 1}; }
};

/// What one triangle has of a pixel: the middle of its samples there. Or of several pixels of a row, whole ones.
struct SurfaceFragment {
    SurfaceId surface;
    glm::dvec2 place;         ///< in pixels; of the first one
    std::uint32_t count = 1;  ///< of pixels
    PixelSamples samples{};   ///< where shadows are looked for
};

/// Linear RGB of fragments, part by part.
struct FragmentColors {
    std::array<std::vector<float>, 3> parts;  ///< with room behind them, for loops of PlaceKernels

    void resize(std::size_t count) {
        for (std::vector<float>& part : parts) part.resize(count + kRoomBehindHalves);
    }
    glm::vec3 operator[](std::size_t i) const { return {parts[0][i], parts[1][i], parts[2][i]}; }
};

/// FragmentShader gives places on surfaces their colours, some hundred at a time. One per thread; buffers are used
/// again.
class FragmentShader {
  public:
    explicit FragmentShader(const ShadedSurfaces& surfaces);

    /// Linear RGB, pixel by pixel, of a surface as if it were opaque. What a colour is depends on its place alone.
    void shade(std::span<const SurfaceFragment> fragments, FragmentColors& colors);

  private:
    static constexpr std::size_t kBlock = 256;
    static constexpr std::size_t kColumn = kBlock + kRoomBehindPlaces;
    static constexpr std::size_t kSlots = 1024;  ///< of the table of triangles, a power of two

    /// Light at a place: N · L of the brightest light, from -1, and by how much it changes over a pixel.
    struct Light {
        double value, change_per_px;
    };

    /// Places on one triangle that follow each other in a block.
    struct Run {
        std::size_t begin, end;
        std::uint16_t triangle;
    };

    void begin_block();
    /// Adds places on a triangle, as many as there is room for. Returns how many.
    std::size_t add_places(const SurfaceFragment& fragment, std::size_t first);
    /// Shades the block. `colors`: of its places.
    void shade_block(const std::array<float*, 3>& colors);
    void find_places();
    PlaceView view(std::size_t begin, std::size_t end);
    glm::dvec2 pixel(std::size_t i) const { return {x_[i], y_[i]}; }
    SurfacePlace place(std::size_t i) const {
        return {{position_[0][i], position_[1][i], position_[2][i]}, {normal_[0][i], normal_[1][i], normal_[2][i]}};
    }
    std::uint16_t triangle_number(SurfaceId id);
    /// `colors`: where an expression's go.
    void evaluate(const std::array<float*, 3>& colors);
    void fill_column(const SurfaceInput& input, float* to);
    /// A number of a layer of values of files.
    float file_value(std::size_t i, std::size_t layer, std::size_t component) const;
    /// With `in_shadow`: where the key light is hidden.
    Light light_at(std::size_t i, bool in_shadow) const;
    /// By how much the cosine towards a light changes over a pixel.
    double change_per_px(std::size_t i, const ViewLight& light) const;
    /// The share of a pixel's part that the key light reaches.
    float lit_share(std::size_t i) const;
    /// The share that no caster hides.
    float free_share(std::size_t i) const;
    glm::vec3 toon(std::size_t i, bool in_shadow) const;
    glm::vec3 gooch(std::size_t i, bool in_shadow) const;
    glm::vec3 hatch(std::size_t i, glm::dvec2 pixel) const;
    /// What the lines of a level leave free of a place when they cover so much.
    double free_of_level(std::size_t i, std::size_t level, double width, glm::dvec2 pixel) const;
    /// What planes across an axis of the object cover.
    double covered_on_object(std::size_t i, const glm::dvec3& axis, double width) const;
    /// What lines across a direction of the texture cover.
    double covered_on_texture(std::size_t i, const glm::dvec2& across, double width, glm::dvec2 pixel) const;
    glm::dvec3 axis_in_view(std::size_t i, const glm::dvec3& axis) const;
    const ShadedTriangle& triangle_of(std::size_t i) const { return triangles_[triangle_at_[i]]; }

    const ShadedSurfaces& surfaces_;
    const SurfaceLook& look_;
    const Projection& projection_;
    const PlaceKernels& kernels_;
    bool needs_places_, needs_changes_, needs_shares_;
    std::vector<glm::dvec2> hatch_directions_;  // on the screen, or in texture coordinates, per level
    std::vector<glm::dvec3> hatch_axes_;        // in the object, per level
    std::vector<glm::dvec3> other_axes_;        // across these, for surfaces that lie in their planes

    // Of the block at work.
    std::vector<ShadedTriangle> triangles_;
    std::array<std::uint16_t, kSlots> slots_{};  // number of a triangle + 1
    std::array<std::uint16_t, kBlock> triangle_at_{};
    std::size_t count_ = 0;  // of places
    std::vector<Run> runs_;
    using Column = std::array<double, kBlock + kRoomBehindPlaces>;
    Column x_{}, y_{};                             // in pixels
    std::array<Column, 3> position_{}, normal_{};  // in view space
    std::array<SurfaceChanges, kBlock> changes_{};
    std::array<PixelSamples, kBlock> samples_{};
    std::array<float, kBlock> lit_{};
    std::array<std::array<double, 3>, kBlock> shares_{};  // of a triangle's corners
    std::vector<const float*> column_list_;
    std::vector<float> columns_;  // of the program's inputs, each with room behind it
    std::vector<float> values_;   // of its results
};

}  // namespace burin
