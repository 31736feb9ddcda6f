#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <numeric>
#include <vector>

#include "shading/sheet/compiled_sheet.h"

namespace burin {
namespace {

/// Pieces that are matched together: enough to pay for starting a program.
constexpr std::size_t kBatch = 4 * kExpressionBlock;

/// A column of numbers for each input of a program, of some pieces of a batch.
class GatheredColumns {
  public:
    void gather(const ExpressionProgram& program, const MatchInput& pieces, const std::vector<std::uint32_t>& chosen,
                LineClassSet asked) {
        const std::vector<ExpressionInput>& inputs = program.inputs();
        values_.resize(inputs.size() * chosen.size());
        pointers_.resize(inputs.size());
        for (std::size_t k = 0; k < inputs.size(); ++k) {
            float* const to = values_.data() + k * chosen.size();
            pointers_[k] = to;
            fill(*variable_named(inputs[k].name), inputs[k].component, pieces, chosen, asked, to);
        }
    }
    std::span<const float* const> columns() const { return pointers_; }

  private:
    static void fill(Variable v, std::size_t component, const MatchInput& pieces,
                     const std::vector<std::uint32_t>& chosen, LineClassSet asked, float* to) {
        const auto fill_by = [&](const auto& value_of) { std::transform(chosen.begin(), chosen.end(), to, value_of); };
        if (v == Variable::drawn_class) {
            fill_by([&](std::uint32_t i) { return static_cast<float>(*(pieces.classes[i] & asked).first()); });
        } else if (v == Variable::qi) {
            fill_by([&](std::uint32_t i) { return static_cast<float>(pieces.invisibility[i]); });
        } else if (const auto c = class_asked_by(v)) {
            fill_by([&](std::uint32_t i) { return pieces.classes[i].has(*c) ? 1.0f : 0.0f; });
        } else if (const float* const column = pieces.columns.of(v, component)) {
            fill_by([&](std::uint32_t i) { return column[i]; });
        } else {
            assert(false && "a column of select_variables() is missing");
            std::fill_n(to, chosen.size(), 0.0f);
        }
    }

    std::vector<float> values_;
    std::vector<const float*> pointers_;
};

bool is_taken(const std::vector<bool>& taken, const float* column, std::size_t piece) {
    if (column == nullptr) return false;
    const float number = column[piece];
    return number >= 0 && number < static_cast<float>(taken.size()) && taken[static_cast<std::size_t>(number)];
}

bool fits_globs(const CompiledSet& set, const VariableColumns& columns, std::size_t piece) {
    if (set.has_object_globs && !is_taken(set.objects, columns.of(Variable::object), piece) &&
        !is_taken(set.objects, columns.of(Variable::object2), piece))
        return false;
    return !set.has_material_globs || is_taken(set.materials, columns.of(Variable::material), piece) ||
           is_taken(set.materials, columns.of(Variable::material2), piece);
}

}  // namespace

SetMatches CompiledSheet::match(const MatchInput& pieces) const {
    assert(pieces.classes.size() == pieces.count && pieces.invisibility.size() == pieces.count);
    SetMatches result;
    result.first.reserve(pieces.count + 1);
    std::vector<std::uint32_t> open, chosen, later;
    std::vector<float> answers;
    std::vector<std::vector<std::uint16_t>> found(std::min(kBatch, pieces.count));
    GatheredColumns gathered;
    for (std::size_t begin = 0; begin < pieces.count; begin += kBatch) {
        const std::size_t end = std::min(pieces.count, begin + kBatch);
        open.resize(end - begin);
        std::iota(open.begin(), open.end(), static_cast<std::uint32_t>(begin));
        for (std::size_t s = 0; s < sets_.size() && !open.empty(); ++s) {
            const CompiledSet& set = sets_[s];
            if (!set.is_enabled) continue;
            chosen.clear();
            for (const std::uint32_t i : open) {
                const auto drawn_as = class_of(pieces.classes[i]);
                const int qi = pieces.invisibility[i];
                if (drawn_as && set.classes.has(*drawn_as) && qi >= set.qi[0] && qi <= set.qi[1] &&
                    fits_globs(set, pieces.columns, i))
                    chosen.push_back(i);
            }
            if (set.has_select && !chosen.empty()) {
                gathered.gather(set.select, pieces, chosen, needs_.classes);
                answers.resize(chosen.size());
                NotNumbers not_numbers;
                float* const to = answers.data();
                set.select.evaluate(gathered.columns(), chosen.size(), {&to, 1}, {&not_numbers, 1});
                std::size_t kept = 0;
                for (std::size_t k = 0; k < chosen.size(); ++k) {
                    if (answers[k] != 0.0f) chosen[kept++] = chosen[k];
                }
                chosen.resize(kept);
            }
            for (const std::uint32_t i : chosen) found[i - begin].push_back(static_cast<std::uint16_t>(s));
            if (set.also || chosen.empty()) continue;
            later.clear();
            std::set_difference(open.begin(), open.end(), chosen.begin(), chosen.end(), std::back_inserter(later));
            open.swap(later);
        }
        for (std::size_t i = begin; i < end; ++i) {
            std::vector<std::uint16_t>& sets = found[i - begin];
            result.first.push_back(static_cast<std::uint32_t>(result.sets.size()));
            result.sets.insert(result.sets.end(), sets.begin(), sets.end());
            sets.clear();
        }
    }
    result.first.push_back(static_cast<std::uint32_t>(result.sets.size()));
    return result;
}

}  // namespace burin
