#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "shading/ink/line_columns.h"
#include "shading/sheet/compiled_sheet.h"

// A style's values at places on lines: expressions, then all that tapers, fades and moves them.

namespace burin {

/// Pieces of a run, one after the other, that one line set draws.
struct LineStretch {
    std::uint32_t run = 0;
    std::size_t first = 0, count = 0;  ///< in LineRuns::pieces
};

/// The ink at a place, and how far the line is moved there.
struct InkValues {
    float width_px = 0, opacity = 0;
    glm::vec3 color{0.0f};
    float offset_px = 0;  ///< across the line, to the right of its way
    bool operator==(const InkValues&) const = default;
};

/// What of a style is the same along a chain, in the order of ChainValue.
using ChainValues = std::array<float, kChainValueCount>;
inline float value_of(const ChainValues& values, ChainValue v) { return values[static_cast<std::size_t>(v)]; }

constexpr std::string_view key_of(InkValue value) {
    switch (value) {
        case InkValue::width:
            return "width";
        case InkValue::opacity:
            return "opacity";
        case InkValue::offset:
            return "offset";
        case InkValue::color:
            return "color";
    }
    return {};
}
constexpr std::string_view key_of(ChainValue value) {
    switch (value) {
        case ChainValue::taper_start:
            return "taper.start";
        case ChainValue::taper_end:
            return "taper.end";
        case ChainValue::dash_phase:
            return "dash_phase";
        case ChainValue::overshoot:
            return "overshoot";
        case ChainValue::wobble_amplitude:
            return "wobble.amplitude";
        case ChainValue::wobble_wavelength:
            return "wobble.wavelength";
        case ChainValue::halo:
            return "halo";
        case ChainValue::halo_depth_near:
        case ChainValue::halo_depth_far:
            return "halo_depth";
        case ChainValue::min_length_low:
        case ChainValue::min_length_high:
            return "min_length";
        case ChainValue::dash:
            break;
    }
    return "dash";
}

/// How often a value was not a number, and where first.
struct NotNumbersOfStyle {
    static constexpr std::size_t kStrength = kInkValueCount;     ///< of line tests, behind the values
    static constexpr std::size_t kFirstOfChain = kStrength + 1;  ///< then by ChainValue, for each stretch
    static constexpr std::size_t kCount = kFirstOfChain + kChainValueCount;
    /// The key of a style, or of one of its tables, whose value it is.
    static constexpr std::string_view key_of(std::size_t value) {
        if (value < kInkValueCount) return burin::key_of(static_cast<InkValue>(value));
        return value == kStrength ? "strength" : burin::key_of(static_cast<ChainValue>(value - kFirstOfChain));
    }
    std::array<std::size_t, kCount> counts{};  ///< by InkValue, for each sample
    std::array<glm::dvec2, kCount> places{};   ///< in pixels
};

/// Lines are moved away from the surface that ends there, else to the right: 1 where that is to the right of the
/// piece's way, -1 to the left.
inline float to_right(const LinePiece& piece) { return piece.occludes && !piece.front_on_left ? -1.0f : 1.0f; }

/// StrokeValues evaluates one style for stretches of lines. One thread uses it; buffers are used again.
class StrokeValues {
  public:
    /// `test`: of the line set; nullptr: none.
    StrokeValues(const LineColumns& lines, const CompiledStyle& style, const SampleVariant& variant,
                 const LineTest* test);

    /// For each stretch, what is the same along its chain.
    std::vector<ChainValues> chain_values(std::span<const LineStretch> stretches);
    /// For each sample the ink; `chains[i]`: the chain values of sample i's stretch.
    void evaluate(std::span<const LineSample> samples, std::span<const ChainValues* const> chains,
                  std::vector<InkValues>& values);
    /// What the width is multiplied by where the line tapers; 1: it does not.
    float taper_at(const LineSample& sample, const ChainValues& chain) const;
    /// What `min_length` multiplies the opacity of a run by.
    float length_strength(std::uint32_t run, const ChainValues& chain) const;
    /// What the opacity of a run is multiplied by where it is moved by that much. Crumbs, as lie where contours fold
    /// back, would be left alone far from their line, on either side of it.
    float moved_strength(std::uint32_t run, float offset_px) const;
    /// Whether anything changes along a piece, so that there must be samples between its ends.
    bool varies() const { return varies_; }
    /// Whether lines may be drawn beside their places.
    bool may_move() const { return style_.moves_lines() || style_.shader; }
    const CompiledStyle& style() const { return style_; }
    const NotNumbersOfStyle& not_numbers() const { return not_numbers_; }

  private:
    using Columns = std::vector<std::vector<float>>;
    void run(const ExpressionProgram& program, std::span<const LineSample> samples, std::size_t column_count);
    void note(std::size_t value, const NotNumbers& found, std::span<const LineSample> samples);
    void add_wobble(std::span<const LineSample> samples, std::span<const ChainValues* const> chains,
                    std::vector<InkValues>& values);
    float share_of_loop(const LineSample& sample) const;

    const LineColumns& lines_;
    const CompiledStyle& style_;
    SampleVariant variant_;
    const LineTest* test_;
    bool varies_;
    VariableSet ink_inputs_, chain_inputs_;
    SampleColumns columns_;
    std::vector<const float*> inputs_;
    Columns results_;
    std::vector<float*> result_places_;
    std::vector<NotNumbers> counts_;
    std::vector<float> strengths_;  // of the test
    NotNumbersOfStyle not_numbers_;
};

}  // namespace burin
