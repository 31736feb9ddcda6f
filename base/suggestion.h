#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Messages about an unknown word name the known one that was probably meant.

namespace burin {

/// How many characters must be put in, taken out or exchanged to make one word of another (Levenshtein 1966).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// What somebody may have meant who wrote a word: the known one that is nearest, if it is no farther than `farthest`,
/// and shares more than half of its letters.
std::optional<std::string> closest_word(std::string_view word, const std::vector<std::string>& known,
                                        std::size_t farthest = 2);

}  // namespace burin
