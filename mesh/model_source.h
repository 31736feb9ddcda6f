#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mesh/animation_choice.h"
#include "mesh/gltf.h"
#include "mesh/model.h"
#include "mesh/polygon_soup.h"

// The two halves of read_model(), for who reads one file after another.

namespace burin {

/// What a model file holds, before meshes are made of it.
struct ModelSource {
    std::string path;
    std::variant<PolygonSoup, GltfScene> content;
    OtherFiles other_files;  ///< but for those of glTF
};

/// Reads a file of the format that its extension says. Throws InputError.
ModelSource read_model_source(const std::string& path, const MeshOptions& options,
                              const AnimationWish& animations = {});

/// Makes a model of it. Throws InputError when no polygon with an area is in it.
Model make_model(ModelSource source, const MeshOptions& options);

/// A model between two whose polygons are the same: places in the world are `part` of the way from the first one's to
/// the second one's, all else is the first one's. nullopt: the polygons are not the same, or no such model has these
/// places.
std::optional<ModelSource> between(const ModelSource& first, const ModelSource& second, double part);

}  // namespace burin
