#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

// Text that is nested too deeply, or has too many values, is found before it is parsed.

namespace burin {

/// How deep tables and lists may be nested: scenes need six levels. toml++ builds and frees trees
/// with calls that are nested as deep, so that a limit for the text saves the stack.
constexpr std::size_t kMaxTomlDepth = 64;
constexpr const char* kTomlTooDeep = "tables and lists are nested more than 64 deep; scenes need six levels";
static_assert(kMaxTomlDepth == 64);

/// The first line on which the tree that a TOML text stands for gets deeper than kMaxTomlDepth, whatever makes it so:
/// parts of dotted keys, headers, inline tables, lists, or all of them together. If the text is no TOML, the part up to
/// its first error counts; what follows may be judged wrongly. Nothing if there is no such line.
std::optional<std::size_t> line_nested_too_deep(std::string_view text);

/// As how many values of a list a key, a table or a list counts: it takes that much longer to read.
constexpr std::size_t kValuesPerTable = 4;
/// The first line on which a TOML text has more than `most` values. Nothing if there is no such line.
std::optional<std::size_t> line_with_too_many_values(std::string_view text, std::size_t most);

}  // namespace burin
