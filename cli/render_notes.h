#pragma once

#include "cli/arguments.h"
#include "output/film_files.h"
#include "render/frame.h"
#include "render/method.h"

namespace burin {

/// Notes what a user should know before the picture surprises. `has_hidden_lines`: the scene asks for some.
void note_limits(const Arguments& arguments, const Frame& frame, const Method& method, bool has_hidden_lines,
                 const std::vector<OutputOptions>& outputs);

}  // namespace burin
