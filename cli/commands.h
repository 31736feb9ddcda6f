#pragma once

#include "cli/arguments.h"

namespace burin {

/// The commands of the program. Each throws InputError, UsageError or Interrupted.
void run_render(const Arguments& arguments);
void run_info(const Arguments& arguments);
void run_explain(const Arguments& arguments);
void run_methods(const Arguments& arguments);
void run_styles(const Arguments& arguments);
void run_restyle(const Arguments& arguments);
void run_compare(const Arguments& arguments);
void run_assemble(const Arguments& arguments);
void run_submit(const Arguments& arguments);
void run_view(const Arguments& arguments);

}  // namespace burin
