#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "output/id_manifest.h"
#include "render/frame.h"
#include "render/mattes.h"

namespace burin {

/// One sample of a deep pixel.
struct DeepSample {
    float z = 0;
    float alpha = 0;
    glm::vec3 color{0.0f};                             ///< times alpha
    std::uint32_t line = 0, material = 0, object = 0;  ///< numbers of names; 0: none
    std::uint32_t invisibility = 0;                    ///< opaque surfaces in front
};

/// DeepSampler makes the samples of deep pixels, nearest first. Laid over each other they are the beauty; without those
/// of lines they are the surfaces alone (docs/pipeline/deep.md). One per thread.
class DeepSampler {
  public:
    /// It reads the frame now and not later.
    explicit DeepSampler(const Frame& frame);

    /// They are valid until the next call.
    std::span<const DeepSample> samples_of(const Mattes::DeepPixel& pixel);
    /// The names behind the numbers, channel by channel.
    std::vector<NamedIds> names() const;

  private:
    struct Names {
        std::vector<std::string> names;
        std::vector<std::uint32_t> ids;
        void add(std::string_view name);
        std::uint32_t id_of(std::uint32_t number) const { return number == 0 ? 0 : ids[number - 1]; }
    };
    /// A surface or a visible line, before its alpha is known.
    struct Part {
        const DeepSurface* surface = nullptr;
        const DeepLine* line = nullptr;
        float distance = 0;
        double share = 0;       // of the pixel: of a surface before lines are drawn, of a line as it is seen
        glm::dvec3 color{0.0};  // times the share
        /// Of a surface: share and colour without any line.
        double alone = 0;
        glm::dvec3 color_alone{0.0};
    };
    /// A sample of a part, rounded.
    struct Layer {
        const Part* part = nullptr;
        double alpha = 0;
        glm::dvec3 color{0.0};  // times alpha
    };
    void find_parts(const Mattes::DeepPixel& pixel);
    glm::dvec4 beauty() const;
    void lay_in_turns();
    glm::dvec4 find_surface_layers();
    /// Fills line_layers_ so that the classes and, over `surfaces`, the beauty have what the film has, as far as half
    /// precision allows.
    void find_line_layers(const glm::dvec4& surfaces);
    /// What lines are given besides their shares: the nearest one a share, the farthest one an alpha.
    struct More {
        double of_nearest = 0, of_farthest = 0;
    };
    /// The same with so much more. Gives how far a class or the beauty is off, at most.
    double find_line_layers(const glm::dvec4& surfaces, const glm::dvec4& whole, const More& more);
    void lay_lines_first();
    void add_hidden(const Mattes::DeepPixel& pixel);
    DeepSample& add_sample(const Part& part, double alpha, const glm::dvec3& color);
    float z_of(float distance) const;
    double rounded(double value) const;
    glm::dvec3 rounded(const glm::dvec3& color) const;

    bool is_float_, is_orthographic_;
    double nearest_ = 0;  // of an orthographic view: the scene's nearest point
    Names classes_, materials_, objects_;
    std::vector<Part> parts_;  // of a pixel, nearest first
    std::vector<Layer> line_layers_, surface_layers_;
    double left_ = 1;  // of surfaces, by lines
    bool has_line_behind_ = false;
    bool is_mean_ = false;
    std::vector<DeepSample> samples_;
    std::vector<const DeepLine*> hidden_;
};

}  // namespace burin
