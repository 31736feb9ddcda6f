#pragma once

#include <cassert>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "shading/sheet/variables.h"

// Looks of lines that code computes instead of expressions. A style sheet names them; the program that draws brings
// them along.

namespace burin {

constexpr std::size_t kMostShaderSamples = 1024;

/// Places on lines that one style draws, with what is known there.
class StrokeSamples {
  public:
    /// Samples `first` to `first + count` of the columns, which must live as long as this.
    StrokeSamples(const VariableColumns& columns, std::size_t first, std::size_t count, std::string_view style)
        : columns_(columns), first_(first), count_(count), style_(style) {}

    std::size_t count() const { return count_; }
    /// The values of a variable, or of one component of a triple, that needs() has: one for each sample.
    std::span<const float> column(Variable v, std::size_t component = 0) const {
        const float* const values = columns_.of(v, component);
        assert(values != nullptr && "a variable that needs() does not have");
        return values == nullptr ? std::span<const float>() : std::span(values + first_, count_);
    }
    /// The name of the style that they are drawn with.
    std::string_view style() const { return style_; }

  private:
    const VariableColumns& columns_;
    std::size_t first_, count_;
    std::string_view style_;
};

/// The ink of samples: it has the values that the style says, and gets those that are drawn.
struct StrokeInk {
    std::span<float> width_px;          ///< full width
    std::span<float> offset_px;         ///< across, as `offset` of a style
    std::span<float> opacity;           ///< 0 to 1
    std::span<float> red, green, blue;  ///< linear
};

/// A LineShader computes the ink of lines. What it returns is brought to the ranges of the style's keys; NaN counts as
/// 0 and is noted.
class LineShader {
  public:
    virtual ~LineShader() = default;
    virtual VariableSet needs() const = 0;
    /// At most kMostShaderSamples samples of one style. The same sample gets the same answer, whatever the batch.
    /// Called by several threads. What it throws ends the drawing.
    virtual void shade(const StrokeSamples& in, StrokeInk& out) const = 0;
};

/// A LineTest says how much of a line there is: a strength from 0 (none) to 1, by which the opacity is multiplied.
class LineTest {
  public:
    virtual ~LineTest() = default;
    virtual VariableSet needs() const = 0;
    /// As LineShader::shade(). `strength`: one for each sample; they are 1 before.
    virtual void test(const StrokeSamples& in, std::span<float> strength) const = 0;
};

/// Shaders and tests by the names that style sheets have for them.
struct LineShaders {
    std::map<std::string, std::shared_ptr<const LineShader>, std::less<>> shaders;
    std::map<std::string, std::shared_ptr<const LineTest>, std::less<>> tests;
};

}  // namespace burin
