#pragma once

#include <span>
#include <string>
#include <vector>

// What a shell offers when the Tab key is pressed. `burin --complete WORD...` prints it for the shells' scripts, which
// `cmake --install` installs, so they know what the program knows: commands, options, and values.

namespace burin {

/// An option, as the command line declares it, or the input of a command.
struct CompletedOption {
    std::vector<std::string> names;  ///< "-o", "--output"; one without a dash is a positional argument
    std::string help;
    bool takes_value = false;
};

struct CompletedCommand {
    std::string name, help;
    std::vector<CompletedOption> options;
};

/// What may stand in place of the last of `words`, which follow `burin` and may end in an unfinished or empty one.
/// One candidate per line: the whole word, a tab and what it means, if that is known.
/// A line ":files A B" stands for the names of files with the suffixes A and B, and of folders; ":files" for all files,
/// ":folders" for folders alone.
/// `commands`: the program's own options first, as a command without a name.
std::string completions(std::span<const CompletedCommand> commands, std::span<const std::string> words);

}  // namespace burin
