#pragma once

#include "cli/arguments.h"
#include "cli/option_texts.h"

namespace burin {

/// Reads options as they were typed, for the command that `arguments` name. Throws UsageError.
void fill_arguments(const Texts& texts, Arguments& arguments);

}  // namespace burin
