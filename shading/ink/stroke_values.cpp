#include "shading/ink/stroke_values.h"

#include <algorithm>
#include <cmath>

#include "kernels/expression_kernels.h"
#include "shading/ink/run_shader.h"
#include "shading/line_shader.h"

namespace burin {
namespace {

VariableSet inputs_of(const ExpressionProgram& program) {
    VariableSet set;
    for (const ExpressionInput& input : program.inputs()) {
        if (!input.is_attribute) set.add(*variable_named(input.name), input.component);
    }
    return set;
}

/// Whether any variable changes along a piece.
bool any_varies(const VariableSet& variables) {
    const auto& table = variable_table();
    return std::any_of(table.begin(), table.end(), [&](const VariableRow& row) {
        return row.rate == ValueRate::sample && variables.has(row.variable);
    });
}

/// Shortens both lengths in proportion where a run has not room for them.
void fit(double& a, double& b, double room) {
    if (a + b <= room) return;
    const double scale = a + b > 0 ? std::max(room, 0.0) / (a + b) : 0;
    a *= scale;
    b *= scale;
}

float tapered(double distance_px, double length_px, TaperShape shape) {
    if (!(length_px > 0)) return 1;
    const double q = std::clamp(distance_px / length_px, 0.0, 1.0);
    switch (shape) {
        case TaperShape::linear:
            return static_cast<float>(q);
        case TaperShape::round:
            return static_cast<float>(std::sqrt(q * (2 - q)));
        default:
            return static_cast<float>(q * q);
    }
}

/// 0 up to the first edge, 1 from the second on; equal edges are a threshold, which passes.
float faded_in(double length_px, double low_px, double high_px) {
    if (length_px >= high_px) return 1;
    return length_px <= low_px || high_px <= low_px ? 0 : static_cast<float>((length_px - low_px) / (high_px - low_px));
}

void compute(ExpressionOperation operation, std::size_t count, float* to, const float* a, const float* b = nullptr,
             const float* c = nullptr) {
    const auto operand = [](const float* v) { return ExpressionOperand{v, v == nullptr ? 0 : ~std::size_t{0}}; };
    for (std::size_t first = 0; first < count; first += kExpressionBlock) {
        const auto at = [first](const float* v) { return v == nullptr ? nullptr : v + first; };
        const ExpressionBlock block{to + first,
                                    {operand(at(a)), operand(at(b)), operand(at(c))},
                                    std::min(kExpressionBlock, count - first),
                                    nullptr,
                                    0};
        best_expression_kernels().loops[static_cast<std::size_t>(operation)](block);
    }
}

}  // namespace

StrokeValues::StrokeValues(const LineColumns& lines, const CompiledStyle& style, const SampleVariant& variant,
                           const LineTest* test)
    : lines_(lines),
      style_(style),
      variant_(variant),
      test_(test),
      ink_inputs_(inputs_of(style.ink)),
      chain_inputs_(inputs_of(style.chain)) {
    varies_ = style.has_taper || style.has_wobble;
    for (std::size_t k = 0; k < kInkValueCount; ++k)
        varies_ = varies_ || style.rate_of(static_cast<InkValue>(k)) == ValueRate::sample;
    if (style.shader) ink_inputs_ |= style.shader->needs();
    if (test != nullptr) ink_inputs_ |= test->needs();
    if (style.shader || test != nullptr) varies_ = varies_ || any_varies(ink_inputs_);
}

void StrokeValues::run(const ExpressionProgram& program, std::span<const LineSample> samples,
                       std::size_t column_count) {
    const bool is_ink = &program == &style_.ink;
    const std::span<const std::string> attributes = is_ink ? std::span(style_.attributes) : std::span<std::string>();
    lines_.fill(samples, is_ink ? ink_inputs_ : chain_inputs_, variant_, columns_, attributes);
    inputs_.clear();
    std::size_t attribute = 0;  // the style has them in the order of the inputs
    for (const ExpressionInput& input : program.inputs())
        inputs_.push_back(input.is_attribute ? columns_.of_attribute(attribute++)
                                             : columns_.of(*variable_named(input.name), input.component));
    results_.resize(std::max(results_.size(), column_count));
    result_places_.clear();
    for (std::size_t k = 0; k < column_count; ++k) {
        results_[k].resize(std::max(results_[k].size(), samples.size()));
        result_places_.push_back(results_[k].data());
    }
    counts_.assign(program.outputs().size(), {});
    program.evaluate(inputs_, samples.size(), result_places_, counts_);
}

std::vector<ChainValues> StrokeValues::chain_values(std::span<const LineStretch> stretches) {
    std::vector<LineSample> samples;
    for (const LineStretch& s : stretches) samples.push_back({s.run, static_cast<std::uint32_t>(s.first), 0});
    run(style_.chain, samples, kChainValueCount);
    for (std::size_t k = 0; k < kChainValueCount; ++k) note(NotNumbersOfStyle::kFirstOfChain + k, counts_[k], samples);
    std::vector<ChainValues> values(stretches.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (std::size_t k = 0; k < kChainValueCount; ++k) values[i][k] = results_[k][i];
    }
    return values;
}

/// How far along its run a sample lies, 0 to 1, if that is a loop; else 0.
float StrokeValues::share_of_loop(const LineSample& sample) const {
    const LineRuns& runs = lines_.runs();
    const LineRun& run = runs.runs[sample.run];
    if (!run.is_closed) return 0;
    const double length = runs.length_px(run);
    return length > 0 ? static_cast<float>((lines_.at_of(sample) - runs.pieces[run.first].at_from_px) / length) : 0;
}

float StrokeValues::taper_at(const LineSample& sample, const ChainValues& chain) const {
    const LineRuns& runs = lines_.runs();
    const LineRun& run = runs.runs[sample.run];
    if (!style_.has_taper || run.is_closed) return 1;
    const double at = lines_.at_of(sample), from_begin_px = at - runs.pieces[run.first].at_from_px,
                 from_end_px = runs.pieces[run.first + run.count - 1].at_to_px - at;
    const auto length = [&](ChainValue v, std::size_t which) {
        const double share = style_.taper_at == TaperAt::all ? 1 : freedom(run.gaps_px[which]);
        return share * std::max(0.0, static_cast<double>(value_of(chain, v)));
    };
    double start = length(ChainValue::taper_start, 0), end = length(ChainValue::taper_end, 1);
    fit(start, end, from_begin_px + from_end_px);
    return tapered(from_begin_px, start, style_.taper_shape) * tapered(from_end_px, end, style_.taper_shape);
}

float StrokeValues::length_strength(std::uint32_t run, const ChainValues& chain) const {
    if (!style_.has_min_length) return 1;
    return faded_in(lines_.runs().length_px(lines_.runs().runs[run]),
                    static_cast<double>(value_of(chain, ChainValue::min_length_low)),
                    static_cast<double>(value_of(chain, ChainValue::min_length_high)));
}

float StrokeValues::moved_strength(std::uint32_t run, float offset_px) const {
    const double moved_px = std::abs(static_cast<double>(offset_px));
    return moved_px > 0 ? faded_in(lines_.runs().length_px(lines_.runs().runs[run]), moved_px / 8, moved_px / 4) : 1;
}

void StrokeValues::note(std::size_t value, const NotNumbers& found, std::span<const LineSample> samples) {
    if (found.count == 0) return;
    if (not_numbers_.counts[value] == 0) not_numbers_.places[value] = lines_.place_of(samples[found.first]);
    not_numbers_.counts[value] += found.count;
}

void StrokeValues::evaluate(std::span<const LineSample> samples, std::span<const ChainValues* const> chains,
                            std::vector<InkValues>& values) {
    run(style_.ink, samples, kInkColumnCount);
    for (std::size_t k = 0; k < kInkValueCount; ++k) note(k, counts_[k], samples);
    if (style_.shader) {
        const auto found = run_shader(style_, columns_.columns(), samples.size(), result_places_);
        for (std::size_t k = 0; k < kInkValueCount; ++k) note(k, found[k], samples);
    }
    if (test_ != nullptr) {
        strengths_.resize(samples.size());
        note(NotNumbersOfStyle::kStrength, run_test(*test_, style_, columns_.columns(), strengths_), samples);
        for (std::size_t i = 0; i < samples.size(); ++i) results_[column_of(InkValue::opacity)][i] *= strengths_[i];
    }
    const LineRuns& runs = lines_.runs();
    values.resize(samples.size());
    static_assert(kInkValueCount == 4, "each of them is taken from its columns here");
    const float* const width = results_[column_of(InkValue::width)].data();
    const float* const opacity = results_[column_of(InkValue::opacity)].data();
    const float* const offset = results_[column_of(InkValue::offset)].data();
    const std::vector<float>* const color = &results_[column_of(InkValue::color)];
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const LinePiece& piece = runs.pieces[samples[i].piece].piece;
        InkValues& value = values[i];
        value.width_px = width[i] * taper_at(samples[i], *chains[i]);
        value.opacity = opacity[i] * (static_cast<float>(piece.seen_opacity()) / 255.0f);
        value.opacity *= length_strength(samples[i].run, *chains[i]);
        value.offset_px = to_right(piece) * offset[i];
        value.color = {color[0][i], color[1][i], color[2][i]};
    }
    if (style_.has_wobble) add_wobble(samples, chains, values);
    if (!may_move()) return;
    for (std::size_t i = 0; i < samples.size(); ++i)
        values[i].opacity *= moved_strength(samples[i].run, values[i].offset_px);
}

/// Noise that lines are moved across by. On the object, its waves keep their place and, within a factor of two, their
/// length on the screen: of two noises with wavelengths that are powers of two in the object's units, the one fades
/// into the other while the camera comes nearer. Along a loop, noise fades into the same noise a turn earlier, so that
/// it has no seam.
void StrokeValues::add_wobble(std::span<const LineSample> samples, std::span<const ChainValues* const> chains,
                              std::vector<InkValues>& values) {
    const LineRuns& runs = lines_.runs();
    const std::size_t n = samples.size();
    std::vector<float> octave(n), log_octave(n), x(n), y(n), z(n), noise(n), sum(n, 0.0f);
    std::vector<LineColumns::InObject> places(n);
    const bool is_on_object = style_.wobble_anchor == WobbleAnchor::object;
    for (std::size_t i = 0; i < n; ++i) {
        const double wavelength =
            std::max(static_cast<double>(value_of(*chains[i], ChainValue::wobble_wavelength)), 0.25);
        if (is_on_object) places[i] = lines_.in_object(samples[i]);
        octave[i] = static_cast<float>(wavelength * places[i].px_size);
    }
    compute(ExpressionOperation::logarithm2, n, log_octave.data(), octave.data());
    for (int o = 0; o < style_.wobble_octaves; ++o) {
        const float strength = std::ldexp(1.0f, -o);
        for (const int step : {0, 1}) {
            for (std::size_t i = 0; i < n; ++i) {
                const LineRun& run = runs.runs[samples[i].run];
                const LineHash hash =
                    is_on_object ? lines_.object_hash(samples[i].piece, variant_) : lines_.chain_hash(run, variant_);
                if (!is_on_object) {
                    const double at = lines_.at_of(samples[i]) - (step == 0 ? 0.0 : runs.length_px(run));
                    x[i] = static_cast<float>(at) / std::ldexp(octave[i], -o);
                    y[i] = LineHash(hash).add(std::uint64_t(1)).unit() * 64;
                    z[i] = LineHash(hash).add(std::uint64_t(2)).unit() * 64;
                    continue;
                }
                const int k = static_cast<int>(std::floor(log_octave[i])) + step - o;
                const double size = std::ldexp(1.0, -k);
                const double shift = 31.7 * (k & 63);
                const auto coordinate = [&](double p, std::uint64_t axis) {
                    return static_cast<float>(p * size + shift +
                                              static_cast<double>(LineHash(hash).add(axis).unit()) * 64);
                };
                x[i] = coordinate(places[i].position.x, 1);
                y[i] = coordinate(places[i].position.y, 2);
                z[i] = coordinate(places[i].position.z, 3);
            }
            compute(ExpressionOperation::noise3, n, noise.data(), x.data(), y.data(), z.data());
            for (std::size_t i = 0; i < n; ++i) {
                const float b = is_on_object ? log_octave[i] - std::floor(log_octave[i]) : share_of_loop(samples[i]);
                const float share = (step == 0 ? 1 - b : b) / std::sqrt((1 - b) * (1 - b) + b * b);
                sum[i] += strength * share * noise[i];
            }
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        const LineRun& run = runs.runs[samples[i].run];
        float strength = value_of(*chains[i], ChainValue::wobble_amplitude);
        if (style_.wobble_pin && !run.is_closed) {
            const double at = lines_.at_of(samples[i]);
            const double to_end =
                std::min(at - runs.pieces[run.first].at_from_px, runs.pieces[run.first + run.count - 1].at_to_px - at);
            const double half =
                0.5 * std::max(static_cast<double>(value_of(*chains[i], ChainValue::wobble_wavelength)), 0.25);
            strength *= static_cast<float>(std::clamp(to_end / half, 0.0, 1.0));
        }
        values[i].offset_px += to_right(runs.pieces[samples[i].piece].piece) * strength * sum[i];
    }
}

}  // namespace burin
