#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Messages about an unknown word name the known one that was probably meant.

namespace burin {

/// How many characters must be put in, taken out or exchanged, or change places with their neighbours, to make one word
/// of another (Damerau 1964; none is touched twice).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// What somebody may have meant who wrote a word: the known one that is nearest, if it is no farther than `farthest`,
/// and shares more than half of its letters.
std::optional<std::string> closest_word(std::string_view word, const std::vector<std::string>& known,
                                        std::size_t farthest = 2);

}  // namespace burin
