#include "shading/expression/glob.h"

#include <algorithm>

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

bool are_plain_names(const std::vector<std::string>& patterns) {
    return std::none_of(patterns.begin(), patterns.end(), [](const std::string& pattern) {
        return pattern.starts_with('!') || pattern.find_first_of("*?") != std::string::npos;
    });
}

GlobList::GlobList(const std::vector<std::string>& patterns)
    : patterns_(patterns), is_plain_(are_plain_names(patterns)) {
    if (!is_plain_) return;
    names_.assign(patterns.begin(), patterns.end());
    std::sort(names_.begin(), names_.end());
}

bool GlobList::takes(std::string_view name) const {
    return is_plain_ ? std::binary_search(names_.begin(), names_.end(), name) : matches_globs(patterns_, name);
}

}  // namespace burin
