#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "shading/expression/symbols.h"

// What messages about an unknown word say.

namespace burin {

bool is_word_of(const std::vector<std::string>& words, std::string_view word);
/// ", did you mean 'depth'?", or nothing.
std::string suggestion_of(std::string_view word, const std::vector<std::string>& known);
/// Of variables, parameters and lets.
std::vector<std::string> all_names(const ExpressionSymbols& symbols);
/// What to use instead of a function that other languages have; nothing where there is no such function.
std::string_view hint_for_function(std::string_view name);

}  // namespace burin
