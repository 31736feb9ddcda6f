#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace burin {

/// Whether a name is what a pattern says: '*' stands for any characters, '?' for one byte, all others for themselves.
/// Takes at most their lengths' product in steps.
bool matches_glob(std::string_view pattern, std::string_view name);

/// Whether a list of patterns takes a name. It is read from left to right: a pattern adds names, one that begins with
/// '!' takes names away. A list that begins with '!' begins with all names.
bool matches_globs(const std::vector<std::string>& patterns, std::string_view name);

/// The same list, made ready for many names; it refers to the patterns. Plain names, without '*', '?' and '!', are
/// looked up, so there may be as many of them as a scene has objects.
class GlobList {
  public:
    explicit GlobList(const std::vector<std::string>& patterns);

    /// As matches_globs.
    bool takes(std::string_view name) const;
    /// How many patterns a name is compared with.
    std::size_t comparisons() const { return is_plain_ ? 1 : patterns_.size(); }

  private:
    const std::vector<std::string>& patterns_;
    bool is_plain_;
    std::vector<std::string_view> names_;  // of a plain list, sorted
};

/// Whether patterns are plain names, without '*', '?' and '!'.
bool are_plain_names(const std::vector<std::string>& patterns);

}  // namespace burin
