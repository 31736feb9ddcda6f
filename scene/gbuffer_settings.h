#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

// Method `gbuffer` reads these settings of a scene.

namespace burin {

/// The image operators of method `gbuffer`; docs/methods/gbuffer.md says what each computes.
enum class GBufferOperator : std::uint8_t {
    first,      ///< first-order differential of depth (Saito & Takahashi)
    second,     ///< second-order differential of depth, as it is
    profile,    ///< profile image: how much the first-order differential varies
    internal,   ///< internal edge image: second order, without the profiles
    sobel,      ///< Sobel on depth and normals, and differing numbers
    roberts,    ///< Roberts' cross on depth and normals, and differing numbers
    id,         ///< differing numbers of objects, materials, polygons
    normal,     ///< difference to the normals of four neighbours
    decaudin,   ///< squared profile of depth and of the components of the normal
    hertzmann,  ///< Sobel on depth and normals
};
constexpr int kGBufferOperatorCount = 10;
constexpr std::array<std::string_view, kGBufferOperatorCount> kGBufferOperatorNames = {
    "first", "second", "profile", "internal", "sobel", "roberts", "id", "normal", "decaudin", "hertzmann"};

/// A set of operators, one bit each.
struct GBufferOperatorSet {
    std::uint16_t bits = 0;

    constexpr bool has(GBufferOperator o) const { return (bits >> static_cast<int>(o) & 1) != 0; }
    constexpr void add(GBufferOperator o) { bits = static_cast<std::uint16_t>(bits | 1u << static_cast<int>(o)); }
    constexpr bool operator==(const GBufferOperatorSet&) const = default;
    static constexpr GBufferOperatorSet of(std::initializer_list<GBufferOperator> members) {
        GBufferOperatorSet set;
        for (const GBufferOperator o : members) set.add(o);
        return set;
    }
};

/// The operator with this name, if there is one.
std::optional<GBufferOperator> gbuffer_operator_named(std::string_view name);

/// How numbers of neighbours are compared; only `differs` answers on both sides of a border.
enum class IdComparison : std::uint8_t { differs, less, greater };

/// How strengths of lines that fall on one sample add up.
enum class LineComposition : std::uint8_t {
    multiply,  ///< each line darkens what the others left: 1 - (1 - p)(1 - e)
    maximum,   ///< the strongest one counts
};

/// What contour lines are lines of equal value of.
enum class ContourField : std::uint8_t { none, x, y, z, distance };

/// What only the method `gbuffer` looks at. Depth is in samples: a face turned by an angle has the
/// slope tan(angle) per sample at the reference distance.
struct GBufferSettings {
    GBufferOperatorSet operators =
        GBufferOperatorSet::of({GBufferOperator::profile, GBufferOperator::internal, GBufferOperator::id});
    int supersample = 1;  ///< samples per pixel and axis: 1, 2, 4 or 8
    bool dilate = true;   ///< widen lines that are thinner than the line width
    bool smooth = false;  ///< blur along the lines afterwards, as FXAA does
    LineComposition composition = LineComposition::multiply;

    double depth_scale = 1;         ///< multiplies depth
    double reference_distance = 0;  ///< where depth is in samples, world units; 0: middle of the scene
    int depth_bits = 0;             ///< depth is stored in 8, 16 or 24 bits; 0: as it is

    double jump_limit = 4;           ///< k_g: first-order differential that is a depth jump
    double profile_limit = 2;        ///< k_p: variation of it that makes a line black
    double profile_power = 1;        ///< e
    bool gate = true;                ///< profiles: only the two columns beside a jump, none at creases
    double crease_limit = 0.5;       ///< k_e: second-order differential that makes a line black
    double relative_jump = 0.02;     ///< Roberts: jump relative to the distance
    double relative_jump_slope = 1;  ///< Roberts: how much more grazing faces may jump
    IdComparison id_comparison = IdComparison::differs;
    int id_neighbours = 8;  ///< 4 or 8

    ContourField contours = ContourField::none;
    double contour_step = 0.1;                         ///< world units
    double contour_width_px = 1;                       ///< of hatching: where it is darkest
    bool hatching = false;                             ///< contours as wide as the surface is dark
    ContourField cross_hatching = ContourField::none;  ///< a second family, where it is darker
    double cross_darkness = 0.5;                       ///< than this, 0..1
};

}  // namespace burin
