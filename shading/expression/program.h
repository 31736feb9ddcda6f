#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "kernels/expression_kernels.h"
#include "shading/expression/graph.h"
#include "shading/expression/symbols.h"

namespace burin {

constexpr std::size_t kMostExpressionOperations = 1024;
constexpr std::size_t kExpressionRegisters = 64;
constexpr std::size_t kExpressionBlock = 256;  ///< samples

/// A column of numbers that a program reads: of a variable, or of a vertex attribute of the model.
struct ExpressionInput {
    std::string name;
    std::size_t component = 0;  ///< 0 to 2 of a colour or a vector
    bool is_attribute = false;
    bool operator==(const ExpressionInput&) const = default;
};

/// One result of a program: a number, or a colour of three numbers.
struct ExpressionOutput {
    std::array<ExpressionGraph::Index, 3> parts{};
    std::size_t components = 1;
    ValueRate rate = ValueRate::frame;  ///< the highest one of its variables
    float least = -std::numeric_limits<float>::infinity();
    float most = std::numeric_limits<float>::infinity();
};

/// Compiled expressions. A program is a value, and the same for all threads; nothing that it does can fail, or takes
/// memory.
class ExpressionProgram {
  public:
    ExpressionProgram() = default;
    /// Throws ExpressionError where a result needs more operations or registers than there are.
    ExpressionProgram(const ExpressionGraph& graph, std::vector<ExpressionInput> inputs,
                      std::vector<ExpressionOutput> outputs);

    /// Those that are read; evaluate() gets their columns in this order.
    const std::vector<ExpressionInput>& inputs() const { return inputs_; }
    const std::vector<ExpressionOutput>& outputs() const { return outputs_; }
    std::size_t operation_count() const { return code_.size(); }
    bool is_constant(std::size_t output) const;

    /// Computes all results for `count` samples. `columns`: one for each of inputs(). `values`: one for each component
    /// of each of outputs(). `not_numbers`, for each of outputs(): how many samples had NaN, which became 0 (a colour
    /// as a whole) before it was put into its range.
    void evaluate(std::span<const float* const> columns, std::size_t count, std::span<float* const> values,
                  std::span<NotNumbers> not_numbers,
                  const ExpressionKernels& kernels = best_expression_kernels()) const;

  private:
    /// Places of operands: registers, then constants, then columns.
    using Place = std::uint32_t;
    struct Instruction {
        ExpressionOperation operation;
        std::uint8_t to;
        std::array<Place, 3> from;
        std::uint32_t table;  ///< its number + 1; 0: none
    };
    /// Instructions and the results that they end with.
    struct Section {
        std::size_t end_of_code, end_of_outputs;
    };

    bool append(const ExpressionGraph& graph, std::size_t first_output, std::size_t end_output,
                std::vector<Place>& places);
    ExpressionOperand operand(Place place, const float* registers, std::span<const float* const> columns,
                              std::size_t first) const;

    std::vector<Instruction> code_;
    std::vector<Section> sections_;
    std::vector<float> constants_;  ///< kExpressionConstantWidth times each
    std::vector<ExpressionGraph::Table> tables_;
    std::vector<ExpressionInput> inputs_;
    std::vector<ExpressionOutput> outputs_;
    std::vector<std::array<Place, 3>> output_places_;
    std::size_t column_base_ = 0;
};

}  // namespace burin
