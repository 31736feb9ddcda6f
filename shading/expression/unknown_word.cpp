#include "shading/expression/unknown_word.h"

#include <algorithm>
#include <utility>

#include "base/suggestion.h"
#include "shading/expression/function_table.h"

namespace burin {

bool is_word_of(const std::vector<std::string>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

std::string suggestion_of(std::string_view word, const std::vector<std::string>& known) {
    // A short word is near to any other short word.
    const std::size_t farthest = word.size() <= 3 ? 1 : 2;
    const auto closest = closest_word(word, known, farthest);
    return closest ? ", did you mean '" + *closest + "'?" : "";
}

std::vector<std::string> all_names(const ExpressionSymbols& symbols) {
    std::vector<std::string> names;
    for (const ExpressionVariable& variable : symbols.variables) names.push_back(variable.name);
    for (const ExpressionParameter& parameter : symbols.parameters) names.push_back(parameter.name);
    for (const ExpressionLet& let : symbols.lets) names.push_back(let.name);
    return names;
}

std::string_view hint_for_function(std::string_view name) {
    constexpr std::pair<std::string_view, std::string_view> kHints[] = {
        {"sin", "angles are in degrees here: use sind()"},
        {"cos", "angles are in degrees here: use cosd()"},
        {"tan", "angles are in degrees here: use sind(x) / cosd(x)"},
        {"tand", "there is no tand(): use sind(x) / cosd(x)"},
        {"atan", "angles are in degrees here: use atan2d(y, x)"},
        {"atan2", "angles are in degrees here: use atan2d(y, x)"},
        {"atand", "there is no atand(): use atan2d(y, x)"},
        {"asin", "angles are in degrees here: use atan2d(x, sqrt(1 - x^2))"},
        {"acos", "angles are in degrees here: use atan2d(sqrt(1 - x^2), x)"},
        {"lerp", "there is no lerp(): use mix(a, b, t)"},
        {"saturate", "there is no saturate(): use clamp(x, 0, 1)"},
        {"log", "there is no log(): use log2(x), or log2(x) / log2(10)"},
        {"ln", "there is no ln(): use log2(x) * 0.693147"},
        {"log10", "there is no log10(): use log2(x) / log2(10)"},
        {"trunc", "there is no trunc(): use sign(x) * floor(abs(x))"},
        {"between", "use between_objects(a, b) or between_materials(a, b)"},
    };
    for (const auto& [word, hint] : kHints) {
        if (word == name) return hint;
    }
    return {};
}

std::optional<std::string> fault_of_name(std::string_view name, const ExpressionSymbols& symbols) {
    const auto is_part = [](char c) { return is_letter(c) || is_digit(c); };
    if (name.empty() || !is_letter(name.front()) || !std::all_of(name.begin(), name.end(), is_part))
        return "a name has letters, digits and _, and begins with a letter";
    for (const std::string_view word : {"and", "or", "not", "in", "true", "false", "px", "mm", "pt", "world"}) {
        if (name == word) return "'" + std::string(name) + "' is a word of expressions";
    }
    for (const ExpressionVariable& variable : symbols.variables) {
        if (variable.name == name) return "'" + std::string(name) + "' is a variable";
    }
    if (find_function(name) != nullptr) return "'" + std::string(name) + "' is a function";
    if (is_word_of(symbols.later, name)) return "'" + std::string(name) + "' is a word that later versions use";
    return std::nullopt;
}

}  // namespace burin
