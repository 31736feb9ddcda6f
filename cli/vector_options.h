#pragma once

#include <string>

#include "cli/arguments.h"

namespace burin {

/// Options of vector files as they were typed.
struct VectorTexts {
    std::string tolerance, chord_sag, dashes, group, ids;
    bool merge = false;
};

/// Checks them; the page is known. Throws UsageError.
void fill_vector_options(const VectorTexts& texts, Arguments& arguments);

}  // namespace burin
