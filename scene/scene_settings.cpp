#include "scene/scene_settings.h"

#include <utility>

#include "scene/scene_tables.h"
#include "scene/sheet_library.h"
#include "scene/sheet_toml.h"

namespace burin {
namespace {

constexpr const char* kNoSettings[] = {"object", "material"};

/// Puts tables into others: a table goes into the one of its name, anything else replaces it.
void merge(toml::table& into, toml::table&& from) {
    for (auto&& [key, value] : from) {
        toml::table* const old = into[key].as_table();
        toml::table* const own = value.as_table();
        if (old != nullptr && own != nullptr) {
            merge(*old, std::move(*own));
        } else {
            into.insert_or_assign(key, std::move(value));
        }
    }
}

}  // namespace

struct SceneSettings::Tables {
    toml::table root;
    SheetWishes sheet{};
};

SceneSettings::SceneSettings() : tables_(std::make_unique<Tables>()) { change_to(std::make_unique<Tables>()); }
SceneSettings::~SceneSettings() = default;
SceneSettings::SceneSettings(const SceneSettings& other)
    : tables_(std::make_unique<Tables>(*other.tables_)), description_(other.description_) {}
SceneSettings::SceneSettings(SceneSettings&&) noexcept = default;
SceneSettings& SceneSettings::operator=(SceneSettings&&) noexcept = default;

void SceneSettings::change_to(std::unique_ptr<Tables> tables) {
    description_ = read_scene_tables(tables->root, {"settings", {}}, SceneParts::settings, tables->sheet);
    tables_ = std::move(tables);
}

void SceneSettings::set(const Override& override) {
    for (const std::string_view table : kNoSettings) {
        if (override.key.substr(0, override.key.find('.')) == table) {
            throw UsageError(override.key + ": an " +
                             std::string(table == kNoSettings[0] ? "object" : "object's material") +
                             " is no setting of the scene; write it in the scene that is loaded");
        }
    }
    auto changed = std::make_unique<Tables>(*tables_);
    if (is_of_sheet(override)) {
        changed->sheet.overrides.push_back(override);
    } else {
        apply_override(changed->root, override);
    }
    change_to(std::move(changed));
}

void SceneSettings::set_tables(std::string_view text, const std::string& name) {
    toml::table tables = parse_scene_text(text, name);
    const TomlReader reader(tables, "", name);
    for (const char* const table : kNoSettings) {
        if (reader.has(table)) reader.fail(table, "is no setting of a scene; load it with a scene's text");
    }
    auto changed = std::make_unique<Tables>(*tables_);
    merge(changed->root, std::move(tables));
    change_to(std::move(changed));
}

void SceneSettings::set_style(const std::string& text_or_name) {
    auto changed = std::make_unique<Tables>(*tables_);
    changed->sheet = {};
    if (text_or_name.empty()) {
        changed->root.erase("style");
    } else {
        NamedSheetText sheet = sheet_text_of(text_or_name);
        changed->sheet.style = std::move(sheet.name);
        changed->sheet.text = std::move(sheet.text);
    }
    change_to(std::move(changed));
}

SceneDescription SceneSettings::take(Tables scene, const std::string& name, const std::string& folder) {
    SceneDescription description = read_scene_tables(scene.root, {name, folder});
    // The settings stand in no folder.
    const auto style = scene.root["style"].value<std::string>();
    if (style && style->find('\n') == std::string::npos) {
        const auto source = find_sheet(*style, folder);
        if (source && !source->file.empty()) scene.root.insert_or_assign("style", source->file);
    }
    for (const char* const table : kNoSettings) scene.root.erase(table);
    auto changed = std::make_unique<Tables>(*tables_);
    merge(changed->root, std::move(scene.root));
    change_to(std::move(changed));
    return description;
}

SceneDescription SceneSettings::take_scene(std::string_view text, const std::string& name, const std::string& folder) {
    return take({parse_scene_text(text, name)}, name, folder);
}

SceneDescription SceneSettings::take_scene_file(const std::string& path) {
    return take({read_scene_toml(path)}, path, place_of_scene(path).folder.string());
}

}  // namespace burin
