#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "lines/line_class.h"
#include "shading/expression/ramp.h"
#include "shading/expression/symbols.h"
#include "shading/ink/inked_lines.h"
#include "shading/line_style.h"
#include "shading/surface_shader.h"

// A style sheet says which lines are drawn, and how: line sets choose lines, styles say how they look
// (docs/shading/sheets.md). Here is a sheet as it stands in its file, with everything checked that can be checked
// without a scene, and each style complete: keys of its base and defaults are filled in.

namespace burin {

constexpr std::size_t kMostSheetExpressions = 256;
/// Of work to compile all expressions of a sheet: about its characters and numbers that are computed, those of lets and
/// of inherited values wherever they are used.
constexpr std::size_t kMostSheetSteps = 200000;
constexpr std::size_t kMostSheetSets = 256;
constexpr std::size_t kMostSheetStyles = 64;
constexpr std::size_t kMostSheetNames = 256;  ///< of parameters, groups, lets and ramps: at most this many of each
constexpr std::size_t kMostGlobs = 256;       ///< in a list of patterns; plain names, which are looked up, may be more
constexpr std::size_t kMostPlainNames = 100000;

/// A text of a sheet, and how to find a character of it in the file.
struct SheetText {
    std::string text;
    SourcePosition where;          ///< of the value that it is part of
    std::string context;           ///< "[style.ink] width": what messages begin with
    std::size_t first_column = 0;  ///< of its first character in the file; 0: it has escapes or several lines
    std::size_t skipped = 0;       ///< characters of the value before the text: 1 for an "="
    bool is_from_command_line = false;

    /// Throws InputError, or UsageError for a text of the command line. `column`: of a character of the text, from 1.
    [[noreturn]] void fail(std::size_t column, const std::string& message) const;
    /// The same for the whole value.
    [[noreturn]] void fail(const std::string& message) const;
};

enum class SheetUnit : std::uint8_t { px, mm, pt, percent, world };

/// A value of a style: a constant, a ramp or an expression.
struct StyleValue {
    enum class Kind : std::uint8_t { number, color, ramp, expression };
    Kind kind = Kind::number;
    double number = 0;
    SheetUnit unit = SheetUnit::px;  ///< of a number, and of the values of a ramp
    std::array<float, 3> color{};    ///< linear RGB
    Ramp ramp;                       ///< without fault
    /// The expression, without its "="; what a ramp goes over; or where a constant stands, as written.
    SheetText source;

    static StyleValue of(double number) {
        StyleValue value;
        value.number = number;
        return value;
    }
    static StyleValue of_color(const std::array<float, 3>& color) {
        StyleValue value;
        value.kind = Kind::color;
        value.color = color;
        return value;
    }
};

enum class TaperShape : std::uint8_t { linear, round, sharp };
enum class TaperAt : std::uint8_t { free, all };

struct StyleTaper {
    StyleValue start, end;  ///< lengths
    TaperShape shape = TaperShape::round;
    TaperAt at = TaperAt::free;
};

enum class WobbleAnchor : std::uint8_t { object, chain };

struct StyleWobble {
    StyleValue amplitude = StyleValue::of(1), wavelength = StyleValue::of(40);
    int octaves = 1;
    WobbleAnchor anchor = WobbleAnchor::object;
    bool pin = true;
};

/// Settings of a style that do not vary.
struct StyleSettings {
    StrokeSide side = StrokeSide::both;
    StrokeCaps caps = StrokeCaps::round;
    InkBlend blend = InkBlend::over;
    int copies = 1;    ///< 1 to 8
    int priority = 0;  ///< higher lies above
    std::uint32_t seed = 0;
    int hold = 1;  ///< frames
    bool boil = false;
};

struct SheetStyle {
    std::string name;
    SourcePosition where;
    StyleValue width = StyleValue::of(1), opacity = StyleValue::of(1), offset = StyleValue::of(0);
    StyleValue color = StyleValue::of_color({0, 0, 0});
    std::optional<StyleTaper> taper;
    std::vector<StyleValue> dash;  ///< empty, or 2 to 8 lengths
    StyleValue dash_phase = StyleValue::of(0), overshoot = StyleValue::of(0), halo = StyleValue::of(0);
    std::array<StyleValue, 2> halo_depth{StyleValue::of(2), StyleValue::of(50)};
    std::array<StyleValue, 2> min_length{StyleValue::of(0), StyleValue::of(0)};  ///< equal: a threshold
    std::optional<StyleWobble> wobble;
    StyleValue smooth = StyleValue::of(0);  ///< a constant
    std::optional<SheetText> shader;        ///< the name of a LineShader
    StyleSettings settings;
};

/// Chooses lines.
struct LineSet {
    std::string name;
    SourcePosition where;
    LineClassSet classes;
    std::array<int, 2> qi{0, 0};  ///< from, to
    std::optional<SheetText> select;
    std::optional<SheetText> test;                ///< the name of a LineTest
    std::vector<std::string> objects, materials;  ///< globs; empty: all
    std::size_t style = 0;                        ///< number in StyleSheet::styles
    bool also = false;                            ///< the search for sets goes on after it
    bool is_enabled = true;
    std::string layer;  ///< of its own in the files; empty: none
};

/// A name for a value that the command line may change.
struct SheetParameter {
    std::string name;
    StyleValue value;  ///< a number or a colour
    std::optional<double> least, most;
    SheetUnit range_unit = SheetUnit::px;  ///< of `least` and `most`, whatever unit a value of the command line has
    SourcePosition where;
};

struct SheetLet {
    std::string name;
    SheetText text;
};

struct StyleSheet {
    std::string name;                                       ///< "technical"
    std::string file;                                       ///< its path; empty: it has none
    std::string summary;                                    ///< one line
    std::optional<std::array<double, 2>> crease_angle_deg;  ///< from where to where creases fade in; or twice the same
    std::optional<bool> smooth_contours;
    std::optional<PixelFilter> filter;
    std::optional<glm::dvec3> light;       ///< direction to the key light, in the camera's axes
    std::optional<SurfaceStyle> surfaces;  ///< for scenes that do not say how they are filled
    std::vector<SheetParameter> parameters;
    std::vector<ExpressionGroup> groups;
    std::vector<SheetLet> lets;
    std::vector<ExpressionRamp> ramps;
    std::vector<LineSet> sets;  ///< in the order in which they are asked
    std::vector<SheetStyle> styles;
};

/// The classes that enabled sets ask for.
LineClassSet classes_of(const StyleSheet& sheet);

}  // namespace burin
