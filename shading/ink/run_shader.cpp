#include "shading/ink/run_shader.h"

#include <algorithm>
#include <cmath>

#include "shading/line_shader.h"

namespace burin {
namespace {

void count_one(NotNumbers& found, std::size_t sample) {
    if (found.count++ == 0) found.first = sample;
}

/// Calls work(first, count) for batches of samples.
template <typename Work>
void in_batches(std::size_t count, const Work& work) {
    for (std::size_t first = 0; first < count; first += kMostShaderSamples)
        work(first, std::min(kMostShaderSamples, count - first));
}

}  // namespace

std::array<NotNumbers, kInkValueCount> run_shader(const CompiledStyle& style, const VariableColumns& variables,
                                                  std::size_t count, std::span<float* const> ink) {
    in_batches(count, [&](std::size_t first, std::size_t size) {
        const auto part = [&](InkValue value, std::size_t component = 0) {
            return std::span(ink[column_of(value) + component] + first, size);
        };
        static_assert(kInkValueCount == 4, "each of them is a span of StrokeInk");
        StrokeInk out{part(InkValue::width),    part(InkValue::offset),   part(InkValue::opacity),
                      part(InkValue::color, 0), part(InkValue::color, 1), part(InkValue::color, 2)};
        style.shader->shade(StrokeSamples(variables, first, size, style.name), out);
    });
    std::array<NotNumbers, kInkValueCount> found;
    std::size_t column = 0;
    for (std::size_t value = 0; value < kInkValueCount; ++value) {
        const ExpressionOutput& output = style.ink.outputs()[value];
        const std::span<float* const> parts = ink.subspan(column, output.components);
        for (std::size_t i = 0; i < count; ++i) {
            if (std::any_of(parts.begin(), parts.end(), [i](const float* part) { return std::isnan(part[i]); })) {
                count_one(found[value], i);
                for (float* const part : parts) part[i] = 0;
            }
            for (float* const part : parts) part[i] = std::clamp(part[i], output.least, output.most);
        }
        column += output.components;
    }
    return found;
}

NotNumbers run_test(const LineTest& test, const CompiledStyle& style, const VariableColumns& variables,
                    std::span<float> strength) {
    std::fill(strength.begin(), strength.end(), 1.0f);
    in_batches(strength.size(), [&](std::size_t first, std::size_t size) {
        test.test(StrokeSamples(variables, first, size, style.name), strength.subspan(first, size));
    });
    NotNumbers found;
    for (std::size_t i = 0; i < strength.size(); ++i) {
        if (std::isnan(strength[i])) {
            count_one(found, i);
            strength[i] = 0;
        }
        strength[i] = std::clamp(strength[i], 0.0f, 1.0f);
    }
    return found;
}

}  // namespace burin
