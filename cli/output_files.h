#pragma once

#include <string>
#include <vector>

namespace burin {

/// A file that a command is going to write, and the option that asks for it.
struct OutputFile {
    std::string option;
    std::string path;
};

/// Whether two paths lead to one file, whatever links are between, or would if it existed.
bool is_one_file(const std::string& a, const std::string& b);

/// Throws UsageError if two of the files to be written are one.
void refuse_same_files(const std::vector<OutputFile>& outputs);

/// Throws UsageError if one of the files to be written is one of those that are read, under
/// whatever name.
void refuse_to_overwrite(const std::vector<OutputFile>& outputs, const std::vector<std::string>& inputs);

}  // namespace burin
