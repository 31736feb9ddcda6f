#pragma once

#include <string>

#include "cli/arguments.h"

namespace burin {

/// Options of paper and pages as they were typed.
struct PageTexts {
    std::string dpi, paper, margin, scale, unit, page, views, projection;
};

/// Checks them. Throws UsageError. The other options have been checked.
void fill_page_options(const PageTexts& texts, Arguments& arguments);

/// Refuses an option of `restyle` that would change the view in which its lines were found. Throws UsageError.
void refuse_option_of_view(const std::string& name);

}  // namespace burin
