#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/vertex_attributes.h"
#include "shading/expression/program.h"
#include "shading/sheet/compiled_sheet.h"
#include "shading/surface/surface_recipe.h"

// How surfaces look, made ready for a picture: expressions become programs, ramps become curves.

namespace burin {

/// What expressions may read of a place on a surface.
enum class SurfaceVariable : std::uint8_t {
    x,
    y,
    depth,
    distance,
    px_size,
    P,
    PO,
    N,
    facing,
    light,
    lit,
    C,
    object,
    material,
    kr,
    u,
    v,
    Cv,
    attribute  ///< attr("name") of a file
};
constexpr std::size_t kSurfaceVariableCount = static_cast<std::size_t>(SurfaceVariable::attribute) + 1;

using SurfaceVariables = std::bitset<kSurfaceVariableCount>;
constexpr std::size_t number_of(SurfaceVariable v) { return static_cast<std::size_t>(v); }

/// A column of numbers that a program reads.
struct SurfaceInput {
    SurfaceVariable variable;
    std::size_t component;  ///< 0 to 2 of a colour or a vector
    std::size_t layer = 0;  ///< of a value of files: its number in the layers of the look
};

/// Values of files that a look reads: texture coordinates, colours, or numbers of a name.
struct SurfaceLayer {
    AttributeKind kind;
    std::string name;  ///< of numbers
    bool operator==(const SurfaceLayer&) const = default;
};

/// Tones over the light of a place.
class ToneCurve {
  public:
    ToneCurve() = default;
    explicit ToneCurve(const Ramp& ramp);

    bool is_color() const { return is_color_; }
    /// The tone at a place. `spread`: by how much light changes over the width in which a step is made smooth.
    glm::vec3 at(double light, double spread) const;

  private:
    glm::vec3 stop_value(std::size_t stop) const;
    std::size_t stops_ = 0;
    bool is_color_ = false, has_steps_ = false;
    std::array<std::vector<float>, 3> tables_;  // see kRampColumns
};

/// How surfaces look in a picture. The same for all threads.
struct SurfaceLook {
    /// Throws InputError, or UsageError for a text of the command line.
    SurfaceLook(SurfaceShading shading, const SurfaceRecipe& recipe, const SheetContext& context);

    SurfaceShading shading;
    bool has_smooth_normals, has_shadows;
    ToneCurve tones, detail_tones;
    bool has_detail = false;
    double softness_px = 1;
    glm::vec3 cool, warm;
    HatchSpace hatch_space;
    double hatch_spacing_px = 6, hatch_angle_deg = 45;
    glm::dvec3 hatch_axis;
    int hatch_levels = 3;

    /// Its results, by shading: `expression`: the colour; `toon` with detail: how much of it; `hatch`: tone, ink and
    /// ground; else none.
    ExpressionProgram program;
    std::vector<std::string> notes;    ///< on what is probably a mistake
    std::vector<SurfaceInput> inputs;  ///< of the program
    SurfaceVariables variables;        ///< that it reads
    std::vector<SurfaceLayer> layers;  ///< the values of files that it reads, or the hatching
    std::size_t hatch_layer = 0;       ///< of a hatching in texture coordinates: their layer
    bool needs_lit = false;            ///< whether shadows are to be known

  private:
    /// The number of a layer, which is added if it is not there.
    std::size_t layer_number(const SurfaceLayer& layer);
};

}  // namespace burin
