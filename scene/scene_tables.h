#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene_description.h"
#include "scene/toml_depth.h"
#include "scene/toml_reader.h"

namespace burin {

// The steps from a scene file's text to its description: text, tables, overrides, description. Only the sources that
// read scene files include this header.

/// Where a scene stands.
struct ScenePlace {
    std::string name;              ///< in messages: the path of its file
    std::filesystem::path folder;  ///< what the models' paths are relative to
};
inline ScenePlace place_of_scene(const std::string& path) { return {path, std::filesystem::path(path).parent_path()}; }

/// What tables have to hold.
enum class SceneParts : std::uint8_t {
    all,       ///< at least one object
    settings,  ///< any
};

/// The tables of a scene's text. Throws InputError with line and column.
toml::table parse_scene_text(std::string_view text, const std::string& name);
/// The same of a scene file.
toml::table read_scene_toml(const std::string& path);
/// Those of a scene that has one model and nothing else.
toml::table bare_model_tables(const std::string& path);

/// Puts an override's value in its place, making tables on the way as needed. A number in the key
/// counts into an array: object.0.subdivide. Throws UsageError.
void apply_override(toml::table& root, const Override& o);
/// The same with another place than the key says.
void apply_override(toml::table& root, const Override& o, std::string_view place);

/// What the command line says about the style sheet.
struct SheetWishes {
    std::string style;                ///< its name or file, instead of the scene's; empty: nothing
    std::string text;                 ///< its text, instead of both; then `style` is its name in messages
    std::vector<Override> overrides;  ///< of its values: their keys begin with "style."
};

/// The description that the tables give. Throws InputError and UsageError.
SceneDescription read_scene_tables(const toml::table& tables, const ScenePlace& place,
                                   SceneParts parts = SceneParts::all, const SheetWishes& wishes = {});

}  // namespace burin
