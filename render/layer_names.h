#pragma once

#include <string_view>

#include "render/film.h"

namespace burin {

/// The layers that a list such as "beauty,lines,Z" names. Throws UsageError.
LayerSet layers_named(std::string_view list);

}  // namespace burin
