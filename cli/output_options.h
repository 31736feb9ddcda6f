#pragma once

#include <string>
#include <vector>

#include "cli/arguments.h"
#include "output/film_files.h"

namespace burin {

/// The picture file that a command line asks for. Throws UsageError.
OutputOptions output_options(const Arguments& arguments);
/// All files of a frame: pictures, then a deep one. There is at least one. Throws UsageError.
std::vector<OutputOptions> output_list(const Arguments& arguments);

bool writes_stats_file(const Arguments& arguments);
/// Writes what --stats asks for to its file, or to standard output if that is "-".
void write_stats(const std::string& path, const std::string& text);

}  // namespace burin
