#include "shading/expression/graph.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

namespace burin {

std::size_t ExpressionGraph::Hash::operator()(const GraphNode& node) const {
    std::uint64_t hash = static_cast<std::uint64_t>(node.kind) << 8 | static_cast<std::uint64_t>(node.operation);
    for (const std::uint32_t word : {node.operands[0], node.operands[1], node.operands[2], node.bits})
        hash = (std::rotl(hash, 27) ^ word) * 0x9E3779B97F4A7C15u;
    return static_cast<std::size_t>(hash ^ hash >> 32);
}

ExpressionGraph::Index ExpressionGraph::add(const GraphNode& node) {
    ++steps_;
    const auto [place, is_new] = known_.try_emplace(node, static_cast<Index>(nodes_.size()));
    if (!is_new) return place->second;
    if (nodes_.size() == most_nodes_) {
        known_.erase(place);
        is_full_ = true;
        return 0;
    }
    nodes_.push_back(node);
    return place->second;
}

void ExpressionGraph::begin_expression() {
    most_nodes_ = nodes_.size() + kMostGraphNodes;
    is_full_ = false;
}

ExpressionGraph::Index ExpressionGraph::constant(float value) {
    return add({.kind = GraphNode::Kind::constant, .bits = std::bit_cast<std::uint32_t>(value)});
}

ExpressionGraph::Index ExpressionGraph::input(std::uint32_t number) {
    return add({.kind = GraphNode::Kind::input, .bits = number});
}

float ExpressionGraph::constant_value(Index node) const { return std::bit_cast<float>(nodes_[node].bits); }

ExpressionGraph::Index ExpressionGraph::compute(ExpressionOperation operation, std::array<Index, 3> operands) {
    const auto count = static_cast<std::size_t>(operand_count(operation));
    std::fill(operands.begin() + static_cast<std::ptrdiff_t>(count), operands.end(), 0);
    const auto used = std::span(operands).first(count);
    if (!std::all_of(used.begin(), used.end(), [&](Index operand) { return is_constant(operand); }))
        return add({.kind = GraphNode::Kind::operation, .operation = operation, .operands = operands});
    // By the same code as samples, so that the bits are the same.
    float values[3] = {}, result = 0;
    ExpressionBlock block{&result, {}, 1, nullptr, 0};
    for (std::size_t k = 0; k < count; ++k) {
        values[k] = constant_value(operands[k]);
        block.from[k] = {&values[k], ~std::size_t{0}};
    }
    baseline_expression_kernels().loops[static_cast<std::size_t>(operation)](block);
    return constant(result);
}

ExpressionGraph::Index ExpressionGraph::look_up(ExpressionOperation operation, Index x, std::vector<float> table) {
    if (is_constant(x)) {
        const float value = constant_value(x);
        float result = 0;
        const ExpressionBlock block{&result, {{&value, ~std::size_t{0}}, {}, {}}, 1, table.data(), table.size()};
        baseline_expression_kernels().loops[static_cast<std::size_t>(operation)](block);
        return constant(result);
    }
    if (is_full_) return 0;
    auto place = std::find_if(tables_.begin(), tables_.end(), [&](const Table& known) { return *known == table; });
    if (place == tables_.end())
        place = tables_.insert(tables_.end(), std::make_shared<const std::vector<float>>(std::move(table)));
    const auto number = static_cast<std::uint32_t>(place - tables_.begin());
    return add({.kind = GraphNode::Kind::operation, .operation = operation, .operands = {x, 0, 0}, .bits = number + 1});
}

}  // namespace burin
