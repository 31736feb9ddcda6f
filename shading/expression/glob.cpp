#include "shading/expression/glob.h"

#include <cstddef>

namespace burin {

bool matches_glob(std::string_view pattern, std::string_view name) {
    std::size_t p = 0, n = 0, star = std::string_view::npos, star_name = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            star_name = n;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
            ++p, ++n;
        } else if (star != std::string_view::npos) {  // the last star stands for one character more
            p = star + 1;
            n = ++star_name;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

bool matches_globs(const std::vector<std::string>& patterns, std::string_view name) {
    bool is_in = !patterns.empty() && patterns.front().starts_with('!');
    for (const std::string_view pattern : patterns) {
        const bool takes_away = pattern.starts_with('!');
        if (matches_glob(takes_away ? pattern.substr(1) : pattern, name)) is_in = !takes_away;
    }
    return is_in;
}

}  // namespace burin
