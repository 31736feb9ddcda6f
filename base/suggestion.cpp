#include "base/suggestion.h"

#include <algorithm>
#include <cstddef>

namespace burin {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        next[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                next[j] = std::min(next[j], before[j - 2] + 1);
        }
        before.swap(row);
        row.swap(next);
    }
    return row[b.size()];
}

std::optional<std::string> closest_word(std::string_view word, const std::vector<std::string>& known,
                                        std::size_t farthest) {
    std::optional<std::string> closest;
    std::size_t least = farthest + 1;
    for (const std::string& other : known) {
        // No fewer letters are put in or taken out than the lengths differ by; words of any length may come from a
        // file.
        const std::size_t longer = std::max(other.size(), word.size()), shorter = std::min(other.size(), word.size());
        if (longer - shorter >= least) continue;
        const std::size_t distance = edit_distance(other, word);
        if (distance >= least) continue;
        // Half of the letters are others: a word of its own, unless two of them changed places.
        if (distance > 1 && 2 * distance >= longer &&
            !std::is_permutation(other.begin(), other.end(), word.begin(), word.end()))
            continue;
        least = distance;
        closest = other;
    }
    return closest;
}

}  // namespace burin
