#pragma once

#include <string>

#include "base/error.h"
#include "scene/scene.h"

namespace burin {

/// Only the A-buffer draws by style sheets. `what`: why not here. Throws UsageError.
inline void refuse_sheet(const Scene& scene, const std::string& what) {
    if (scene.sheet) throw UsageError("--style: " + what + "; draw with method abuffer, or remove the style sheet");
}

}  // namespace burin
