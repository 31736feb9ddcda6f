#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "kernels/expression_kernels.h"

namespace burin {

/// Of one expression, before what nothing needs is left out.
constexpr std::size_t kMostGraphNodes = 8192;

/// A number of an expression. Operands stand before what is computed of them.
struct GraphNode {
    enum class Kind : std::uint8_t { constant, input, operation };
    Kind kind;
    ExpressionOperation operation{};
    std::array<std::uint32_t, 3> operands{};  ///< as many as the operation has
    std::uint32_t bits = 0;  ///< of a constant; the number of an input; of an operation: its table + 1, 0 = none
    bool operator==(const GraphNode&) const = default;
};

/// What expressions compute, number by number. Equal numbers are there once; what is computed of constants is one.
class ExpressionGraph {
  public:
    using Index = std::uint32_t;
    using Table = std::shared_ptr<const std::vector<float>>;

    /// From here on, kMostGraphNodes may be added.
    void begin_expression();
    Index constant(float value);
    Index input(std::uint32_t number);
    Index compute(ExpressionOperation operation, std::array<Index, 3> operands);
    Index compute(ExpressionOperation operation, Index a) { return compute(operation, {a, 0, 0}); }
    Index compute(ExpressionOperation operation, Index a, Index b) { return compute(operation, {a, b, 0}); }
    Index look_up(ExpressionOperation operation, Index x, std::vector<float> table);

    const std::vector<GraphNode>& nodes() const { return nodes_; }
    const std::vector<Table>& tables() const { return tables_; }
    bool is_constant(Index node) const { return nodes_[node].kind == GraphNode::Kind::constant; }
    float constant_value(Index node) const;
    /// Whether the expression needs more than kMostGraphNodes; what it has made means nothing then.
    bool is_full() const { return is_full_; }
    /// How much work it has been to make: what was put into it, and what was counted. The time that it takes is about
    /// proportional to that.
    std::size_t steps() const { return steps_; }
    void count_steps(std::size_t steps) { steps_ += steps; }

  private:
    struct Hash {
        std::size_t operator()(const GraphNode& node) const;
    };
    Index add(const GraphNode& node);

    std::vector<GraphNode> nodes_;
    std::vector<Table> tables_;
    std::unordered_map<GraphNode, Index, Hash> known_;
    std::size_t most_nodes_ = kMostGraphNodes;
    std::size_t steps_ = 0;
    bool is_full_ = false;
};

}  // namespace burin
