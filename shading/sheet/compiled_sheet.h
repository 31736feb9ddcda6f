#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lines/line_class.h"
#include "shading/expression/program.h"
#include "shading/expression/remarks.h"
#include "shading/sheet/style_sheet.h"
#include "shading/sheet/surface_needs.h"
#include "shading/sheet/variables.h"

// A style sheet made ready for the lines of a picture: texts become programs, globs become bits per object.

namespace burin {

class LineShader;
class LineTest;
struct LineShaders;

/// What compiling a sheet must know of the picture.
struct SheetContext {
    std::vector<std::string> objects, materials;  ///< names; the first one has the number 1
    int width_px = 1920, height_px = 1080;        ///< of the whole picture
    double px_per_mm = 96 / 25.4;
    double frame = 0;
    double fps = 24;
    const LineShaders* shaders = nullptr;  ///< that the sheet may name; nullptr: the program has none
};

/// Results of CompiledStyle::ink, in this order; `color`, the last one, has three components.
enum class InkValue : std::uint8_t { width, opacity, offset, color };
constexpr std::size_t kInkValueCount = static_cast<std::size_t>(InkValue::color) + 1;
constexpr std::size_t kInkColumnCount = kInkValueCount + 2;
/// Where the columns of a value begin.
constexpr std::size_t column_of(InkValue value) { return static_cast<std::size_t>(value); }

/// Results of CompiledStyle::chain, in this order, all of them numbers, lengths in pixels.
enum class ChainValue : std::uint8_t {
    taper_start,
    taper_end,
    dash_phase,
    overshoot,
    wobble_amplitude,
    wobble_wavelength,
    halo,
    halo_depth_near,
    halo_depth_far,
    min_length_low,
    min_length_high,
    dash,  ///< and up to seven more, for the lengths that follow
};
constexpr std::size_t kMostDashLengths = 8;
constexpr std::size_t kChainValueCount = static_cast<std::size_t>(ChainValue::dash) + kMostDashLengths;

/// A style as it is evaluated.
struct CompiledStyle {
    std::string name;
    StyleSettings settings;
    bool has_taper = false;
    TaperShape taper_shape = TaperShape::round;
    TaperAt taper_at = TaperAt::free;
    bool has_wobble = false;
    int wobble_octaves = 1;
    WobbleAnchor wobble_anchor = WobbleAnchor::object;
    bool wobble_pin = true;
    std::size_t dash_lengths = 0;  ///< 0: solid
    bool has_overshoot = false, has_offset = false, has_halo = false, has_min_length = false;
    float smooth_px = 0;

    /// For each sample: InkValue. Width is 0 to 4096 px, opacity 0 to 1, colour at least 0, nothing is NaN.
    ExpressionProgram ink;
    /// For each chain: ChainValue, kChainValueCount numbers. None of its inputs varies along a chain.
    ExpressionProgram chain;
    std::shared_ptr<const LineShader> shader;  ///< changes what `ink` computes; nullptr: none

    ValueRate rate_of(InkValue value) const { return ink.outputs()[static_cast<std::size_t>(value)].rate; }
    bool is_constant(InkValue value) const { return ink.is_constant(static_cast<std::size_t>(value)); }
    /// Whether width, opacity and colour are the same everywhere.
    bool has_constant_ink() const {
        return !shader && is_constant(InkValue::width) && is_constant(InkValue::opacity) &&
               is_constant(InkValue::color);
    }
    /// Whether all its lines are drawn beside their places; a shader may move some.
    bool moves_lines() const { return has_offset || has_wobble; }
    VariableSet variables;                ///< of both programs and the shader, and what carrying out the style reads
    std::vector<std::string> attributes;  ///< that the ink reads
    ExpressionRemarks remarks;            ///< on both programs
    bool needs_chains = false;
    bool needs_ends = false;  ///< what stops lines at their ends is read
    float most_reach_px = 0;  ///< how far from a line its ink may be: half its width, and what moves it
};

/// What the enabled sets ask of finding lines and of what is known about them.
struct SheetNeeds {
    LineClassSet classes;
    int most_invisibility = 0;
    bool tells_invisibility = false;  ///< more must be known than whether a line is hidden
    bool tells_transmission = false;  ///< what transparent surfaces let through is read
    VariableSet variables;            ///< of selects and styles
    SurfaceNeeds surface;             ///< curvature (tier 3), and values of the file (tier 5)
    bool sides = false;               ///< something of the surfaces beside and behind a line (tier 1)
    bool chains = false;              ///< chains (tier 2, or strokes are moved or cut)
    bool hidden_chains = false;       ///< the same of hidden lines: sets of visible ones may do without
    bool ends = false;                ///< what stops lines at their ends
    bool one_sided = false;           ///< strokes are drawn on one side of their lines
    float most_reach_px = 0;
};

/// Values of pieces for matching. Each span and column has `count` of them.
struct MatchInput {
    std::size_t count = 0;
    std::span<const LineClassSet> classes;  ///< all that apply to a piece
    std::span<const std::uint8_t> invisibility;
    /// Of the variables in CompiledSheet::select_variables(); `class`, `is_...` and `qi` follow from the spans above.
    VariableColumns columns;
};

/// Which sets draw which pieces.
struct SetMatches {
    std::vector<std::uint32_t> first;  ///< for each piece, and one more: where its sets begin
    std::vector<std::uint16_t> sets;   ///< numbers in StyleSheet::sets, in the order of the sheet

    std::span<const std::uint16_t> of(std::size_t piece) const {
        return std::span(sets).subspan(first[piece], first[piece + 1] - first[piece]);
    }
};

/// A set as it is matched.
struct CompiledSet {
    std::string name, layer;
    std::size_t style = 0;
    LineClassSet classes;
    std::array<int, 2> qi{0, 0};
    bool also = false, is_enabled = true;
    bool has_object_globs = false, has_material_globs = false, has_select = false;
    std::vector<bool> objects, materials;  ///< for each number, from 0 = background: whether the globs take it
    ExpressionRemarks remarks;             ///< on `select`
    ExpressionProgram select;              ///< one number: 0 = no
    std::shared_ptr<const LineTest> test;  ///< weakens its lines; nullptr: none
};

class CompiledSheet {
  public:
    /// Throws InputError with file, line and column for a text that is wrong, UsageError if it is from the command
    /// line.
    CompiledSheet(const StyleSheet& sheet, const SheetContext& context);

    const std::vector<CompiledSet>& sets() const { return sets_; }
    const std::vector<CompiledStyle>& styles() const { return styles_; }
    const CompiledStyle& style_of(std::size_t set) const { return styles_[sets_[set].style]; }
    const SheetNeeds& needs() const { return needs_; }
    /// What match() reads.
    const VariableSet& select_variables() const { return select_variables_; }

    /// A note for each set that draws nothing since none of the picture's names fits its patterns, for each group that
    /// is empty for the same reason, and for names and colours in expressions that are probably mistakes.
    const std::vector<std::string>& notes_on_names() const { return notes_on_names_; }
    /// A note for each style whose wobble jumps as the view changes.
    std::vector<std::string> notes_on_wobble() const;

    /// The class that a piece is drawn as: of its classes, the first one that any enabled set asks for.
    std::optional<LineClass> class_of(LineClassSet classes) const { return (classes & needs_.classes).first(); }
    /// Finds the sets that draw each piece: the first one that takes it, and those before it with `also` that do.
    /// May be called from several threads.
    SetMatches match(const MatchInput& pieces) const;

  private:
    std::vector<CompiledSet> sets_;
    std::vector<CompiledStyle> styles_;
    SheetNeeds needs_;
    VariableSet select_variables_;
    std::vector<std::string> notes_on_names_;
};

}  // namespace burin
