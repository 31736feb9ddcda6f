#pragma once

#include <optional>
#include <string_view>

#include "render/film.h"
#include "scene/scene.h"

namespace burin {

/// The layers that a list such as "beauty,lines,Z" names. Throws UsageError.
LayerSet layers_named(std::string_view list);

/// The layers of a picture of a scene: those that were named, or the usual ones, those of hidden lines and of sets of a
/// style sheet among them. Throws UsageError for a named one of a set that the scene has not.
LayerSet layers_of(const Scene& scene, const std::optional<LayerSet>& named);

}  // namespace burin
