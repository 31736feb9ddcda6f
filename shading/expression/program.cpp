#include "shading/expression/program.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "shading/expression/error.h"

namespace burin {
namespace {

using Kind = GraphNode::Kind;

std::span<const std::uint32_t> operands_of(const GraphNode& node) {
    const std::size_t count =
        node.kind == Kind::operation ? static_cast<std::size_t>(operand_count(node.operation)) : 0;
    return std::span(node.operands).first(count);
}

/// What some results need. Operands have lower numbers than what is computed of them.
std::vector<bool> needed_nodes(const ExpressionGraph& graph, std::span<const ExpressionOutput> outputs) {
    std::vector<bool> needed(graph.nodes().size());
    for (const ExpressionOutput& output : outputs) {
        for (std::size_t k = 0; k < output.components; ++k) needed[output.parts[k]] = true;
    }
    for (std::size_t i = needed.size(); i-- > 0;) {
        if (!needed[i]) continue;
        for (const std::uint32_t operand : operands_of(graph.nodes()[i])) needed[operand] = true;
    }
    return needed;
}

}  // namespace

ExpressionProgram::ExpressionProgram(const ExpressionGraph& graph, std::vector<ExpressionInput> inputs,
                                     std::vector<ExpressionOutput> outputs)
    : tables_(graph.tables()), outputs_(std::move(outputs)), output_places_(outputs_.size()) {
    const std::vector<GraphNode>& nodes = graph.nodes();
    const std::vector<bool> needed = needed_nodes(graph, outputs_);
    std::vector<Place> places(nodes.size());
    std::size_t next = kExpressionRegisters;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!needed[i] || nodes[i].kind != Kind::constant) continue;
        places[i] = static_cast<Place>(next++);
        constants_.insert(constants_.end(), kExpressionConstantWidth,
                          graph.constant_value(static_cast<ExpressionGraph::Index>(i)));
    }
    column_base_ = next;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!needed[i] || nodes[i].kind != Kind::input) continue;
        places[i] = static_cast<Place>(next++);
        inputs_.push_back(inputs[nodes[i].bits]);
    }
    // Together, so that what results share is computed once; one by one if that takes too many registers.
    if (append(graph, 0, outputs_.size(), places)) return;
    code_.clear();
    for (std::size_t k = 0; k < outputs_.size(); ++k) {
        if (!append(graph, k, k + 1, places))
            throw ExpressionError(1, "the expression needs more than 64 values at once: make it shorter");
    }
}

bool ExpressionProgram::append(const ExpressionGraph& graph, std::size_t first_output, std::size_t end_output,
                               std::vector<Place>& places) {
    const std::vector<GraphNode>& nodes = graph.nodes();
    const auto results = std::span<const ExpressionOutput>(outputs_).subspan(first_output, end_output - first_output);
    const std::vector<bool> needed = needed_nodes(graph, results);
    const std::size_t never = nodes.size();
    std::vector<std::size_t> last_use(nodes.size(), 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!needed[i]) continue;
        for (const std::uint32_t operand : operands_of(nodes[i])) last_use[operand] = i;
    }
    for (const ExpressionOutput& output : results) {
        for (std::size_t k = 0; k < output.components; ++k) last_use[output.parts[k]] = never;
    }
    std::array<bool, kExpressionRegisters> is_taken{};
    const std::size_t first_instruction = code_.size();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const GraphNode& node = nodes[i];
        if (!needed[i] || node.kind != Kind::operation) continue;
        Instruction instruction{node.operation, 0, {}, node.bits};
        const auto operands = operands_of(node);
        for (std::size_t k = 0; k < operands.size(); ++k) {
            instruction.from[k] = places[operands[k]];
            // Loops read a sample before they write it, so the result may lie where an operand did.
            if (last_use[operands[k]] == i && instruction.from[k] < kExpressionRegisters)
                is_taken[instruction.from[k]] = false;
        }
        const auto free = std::find(is_taken.begin(), is_taken.end(), false);
        if (free == is_taken.end()) return false;
        *free = true;
        instruction.to = static_cast<std::uint8_t>(free - is_taken.begin());
        places[i] = instruction.to;
        code_.push_back(instruction);
    }
    if (results.size() == 1 && code_.size() - first_instruction > kMostExpressionOperations)
        throw ExpressionError(1, "the expression has more than 1024 operations: make it shorter");
    for (std::size_t k = first_output; k < end_output; ++k) {
        for (std::size_t c = 0; c < outputs_[k].components; ++c) output_places_[k][c] = places[outputs_[k].parts[c]];
    }
    sections_.push_back({code_.size(), end_output});
    return true;
}

bool ExpressionProgram::is_constant(std::size_t output) const {
    for (std::size_t c = 0; c < outputs_[output].components; ++c) {
        const Place place = output_places_[output][c];
        if (place < kExpressionRegisters || place >= column_base_) return false;
    }
    return true;
}

ExpressionOperand ExpressionProgram::operand(Place place, const float* registers, std::span<const float* const> columns,
                                             std::size_t first) const {
    if (place < kExpressionRegisters) return {registers + place * kExpressionBlock, ~std::size_t{0}};
    if (place < column_base_) return {&constants_[(place - kExpressionRegisters) * kExpressionConstantWidth], 0};
    return {columns[place - column_base_] + first, ~std::size_t{0}};
}

void ExpressionProgram::evaluate(std::span<const float* const> columns, std::size_t count,
                                 std::span<float* const> values, std::span<NotNumbers> not_numbers,
                                 const ExpressionKernels& kernels) const {
    assert(columns.size() == inputs_.size() && not_numbers.size() == outputs_.size());
    alignas(64) float registers[kExpressionRegisters * kExpressionBlock];
    std::fill(not_numbers.begin(), not_numbers.end(), NotNumbers{});
    for (std::size_t first = 0; first < count; first += kExpressionBlock) {
        const std::size_t block = std::min(kExpressionBlock, count - first);
        std::size_t next_instruction = 0, next_output = 0, next_value = 0;
        for (const Section& section : sections_) {
            for (; next_instruction < section.end_of_code; ++next_instruction) {
                const Instruction& i = code_[next_instruction];
                ExpressionBlock work{registers + i.to * kExpressionBlock, {}, block, nullptr, 0};
                const auto operands = static_cast<std::size_t>(operand_count(i.operation));
                for (std::size_t k = 0; k < operands; ++k) work.from[k] = operand(i.from[k], registers, columns, first);
                if (i.table != 0) {
                    work.table = tables_[i.table - 1]->data();
                    work.table_size = tables_[i.table - 1]->size();
                }
                kernels.loops[static_cast<std::size_t>(i.operation)](work);
            }
            for (; next_output < section.end_of_outputs; ++next_output) {
                const ExpressionOutput& output = outputs_[next_output];
                ExpressionDelivery delivery{{}, {}, output.components, block, output.least, output.most};
                for (std::size_t c = 0; c < output.components; ++c) {
                    delivery.from[c] = operand(output_places_[next_output][c], registers, columns, first);
                    delivery.to[c] = values[next_value++] + first;
                }
                const NotNumbers found = kernels.deliver(delivery);
                NotNumbers& all = not_numbers[next_output];
                if (all.count == 0 && found.count != 0) all.first = first + found.first;
                all.count += found.count;
            }
        }
    }
}

}  // namespace burin
