#pragma once

#include "shading/ink/inked_lines.h"

namespace burin {

/// Makes one stroke of strokes of one run that follow each other, where their width varies: it may jump where they
/// meet, their colour and opacity hardly change there. Strokes of one constant width stay as they are. `lines`: with
/// origins.
InkedLines with_runs_merged(InkedLines lines);

}  // namespace burin
