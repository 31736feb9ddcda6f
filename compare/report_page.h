#pragma once

#include <string_view>

// The report's page is compiled into the program.

namespace burin {

/// The report's text, style and script (compare/page). The text has the marks {{style}},
/// {{script}},
/// {{data}} and {{pictures}} where the rest goes.
std::string_view report_text();
std::string_view report_style();
std::string_view report_script();

}  // namespace burin
