#include "web/viewed_tables.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/error.h"
#include "base/lower_extension.h"
#include "mesh/model.h"
#include "mesh/text_scan.h"
#include "scene/scene_tables.h"
#include "scene/sheet_library.h"
#include "scene/sheet_toml.h"
#include "web/command_text.h"
#include "web/sheet_values.h"
#include "web/toml_text.h"

namespace burin {

struct ViewedTables::Tables {
    toml::table root;
    ScenePlace place;
    std::vector<Override> overrides;  ///< those that are no values of a sheet: they are in `root`
    bool had_turntable = false;       ///< a page's camera turns as its user turns it
};

namespace {

namespace fs = std::filesystem;

constexpr const char* kSheetInMessages = "sheet";
constexpr const char* kLooksOfLines[] = {"draw", "width", "color", "colors", "dash", "side", "hidden"};

toml::table read_tables(const std::string& path) {
    if (lower_extension(path) == ".toml") return read_scene_toml(path);
    if (is_model_file(path)) return bare_model_tables(path);
    throw InputError(path + ": unknown kind of input; burin reads .toml scenes and " + kModelExtensions + " models");
}

toml::table& table_in(toml::table& root, std::string_view name) {
    if (root[name].as_table() == nullptr) root.insert_or_assign(name, toml::table{});
    return *root[name].as_table();
}

Look look_of(const LineSettings& lines) {
    Look look;
    look.classes = lines.classes;
    look.crease_angle_deg = lines.crease_angle_deg;
    look.width_px = lines.style.width_px;
    look.hidden = lines.style.hidden.style;
    return look;
}

toml::array array_of(const glm::dvec3& v) { return toml::array{v.x, v.y, v.z}; }

std::string absolute_path(const std::string& file, const fs::path& folder) {
    return fs::absolute(folder / file).lexically_normal().string();
}

/// Puts what a look changes into the tables of a scene.
void apply_look(const Look& look, const Look& plain, toml::table& root) {
    if (look.has_sheet()) {
        if (toml::table* const lines = root["lines"].as_table()) {
            for (const char* const key : kLooksOfLines) lines->erase(key);
        }
    } else {
        root.erase("style");
        if (look.classes != plain.classes) {
            toml::array names;
            for (int i = 0; i < kLineClassCount; ++i) {
                const auto line_class = static_cast<LineClass>(i);
                if (look.classes.has(line_class)) names.push_back(std::string(name_of(line_class)));
            }
            if (names.empty()) names.push_back("none");
            table_in(root, "lines").insert_or_assign("draw", std::move(names));
        }
        if (look.width_px != plain.width_px) table_in(root, "lines").insert_or_assign("width", look.width_px);
        if (look.hidden != plain.hidden)
            table_in(table_in(root, "lines"), "hidden").insert_or_assign("style", word_of(look.hidden));
    }
    if (look.crease_angle_deg != plain.crease_angle_deg)
        table_in(root, "lines").insert_or_assign("crease_angle", look.crease_angle_deg);
    if (!look.shading.empty()) root.insert_or_assign("surfaces", toml::table{{"shading", look.shading}});
}

/// Puts a view into the tables of a scene, in the place of its cameras and its paper. `shift`: of its camera's lens.
void apply_view(const View& view, const glm::dvec2& shift, double dpi, toml::table& root) {
    toml::table camera{
        {"name", "view"}, {"eye", array_of(view.eye)}, {"target", array_of(view.target)}, {"up", array_of(view.up)}};
    if (view.height_of_view) {
        camera.insert("height", *view.height_of_view);
    } else {
        camera.insert("fov", view.fov_deg);
    }
    if (shift != glm::dvec2(0.0)) camera.insert("shift", toml::array{shift.x, shift.y});
    root.insert_or_assign("camera", toml::array{std::move(camera)});
    root.erase("shutter");
    toml::table& picture = table_in(root, "picture");
    if (picture.contains("paper")) picture.insert_or_assign("dpi", dpi);
    for (const char* const key : {"paper", "margin", "scale", "unit"}) picture.erase(key);
    picture.insert_or_assign("size", toml::array{view.width, view.height});
}

/// Has the paths of models hold wherever the file is kept.
void make_paths_absolute(const fs::path& folder, toml::table& root) {
    const auto change = [&](toml::table* object) {
        if (object == nullptr) return;
        if (const auto file = (*object)["file"].value<std::string>())
            object->insert_or_assign("file", absolute_path(*file, folder));
    };
    change(root["object"].as_table());
    if (toml::array* const objects = root["object"].as_array()) {
        for (toml::node& object : *objects) change(object.as_table());
    }
}

}  // namespace

ViewedTables::ViewedTables(ViewedInput input) : input_(std::move(input)) {
    auto tables = std::make_unique<Tables>(Tables{read_tables(input_.path), place_of_scene(input_.path), {}, false});
    std::vector<std::pair<std::string, std::string>> parameters;
    SheetWishes wishes;
    wishes.style = input_.style;
    for (const Override& o : input_.overrides) {
        if (is_of_sheet(o)) {
            wishes.overrides.push_back(o);
            parameters.emplace_back(o.key.substr(std::string_view("style.").size()), o.value);
        } else {
            apply_override(tables->root, o);
            tables->overrides.push_back(o);
        }
    }
    // Copies of tables do not know where they stand in the file: what is wrong is found before there are any.
    const SceneDescription first = read_scene_tables(tables->root, tables->place, SceneParts::all, wishes);
    camera_place_ = first.cameras.empty() ? SourcePosition{input_.path} : first.cameras.front().where;
    tables->had_turntable = tables->root.erase("turntable") > 0;
    std::string style = tables->root["style"].value<std::string>().value_or("");
    const fs::path style_folder = input_.style.empty() ? tables->place.folder : fs::path();
    if (!input_.style.empty()) style = input_.style;
    tables_ = std::move(tables);

    for (const SheetSource& source : all_sheets()) {
        try {
            sheets_.push_back({source.name, source.file.empty() ? "" : absolute_path(source.file, {}),
                               read_sheet(source).summary, text_of_sheet(source)});
        } catch (const InputError& error) {
            notes_.push_back("left out, because " + std::string(error.what()));
        }
    }
    const bool is_text = style.find('\n') != std::string::npos;
    const auto is_its_name = [&](const ChosenSheet& sheet) { return sheet.name == style; };
    if (!style.empty() && !is_text && std::none_of(sheets_.begin(), sheets_.end(), is_its_name)) {
        const auto source = find_sheet(style, style_folder);
        if (!source) throw UsageError(no_such_sheet(style));
        sheets_.push_back(
            {style, absolute_path(source->file, {}), read_sheet(*source).summary, text_of_sheet(*source)});
    }

    toml::table plain = tables_->root;
    plain.erase("style");
    const SceneDescription description = read_scene_tables(plain, tables_->place);
    plain_look_ = look_of(description.lines);
    first_look_ = plain_look_;
    (is_text ? first_look_.sheet : first_look_.style) = style;
    first_look_.parameters = std::move(parameters);
    described(first_look_);  // says what is wrong before anybody looks
}

ViewedTables::~ViewedTables() = default;

const ChosenSheet& ViewedTables::sheet_named(const std::string& name) const {
    const auto found =
        std::find_if(sheets_.begin(), sheets_.end(), [&](const ChosenSheet& sheet) { return sheet.name == name; });
    if (found == sheets_.end()) throw UsageError("there is no style sheet '" + printable(name) + "' here");
    return *found;
}

SceneDescription ViewedTables::described(const Look& look) const {
    toml::table root = tables_->root;
    apply_look(look, plain_look_, root);
    SheetWishes wishes;
    for (const auto& [key, value] : look.parameters) {
        if (look.has_sheet()) wishes.overrides.push_back({"style." + key, value});
    }
    if (!look.sheet.empty()) {
        wishes.style = kSheetInMessages;
        wishes.text = look.sheet;
    } else if (!look.style.empty()) {
        const ChosenSheet& sheet = sheet_named(look.style);
        wishes.style = sheet.file.empty() ? sheet.name : sheet.file;
    }
    return read_scene_tables(root, tables_->place, SceneParts::all, wishes);
}

std::string ViewedTables::scene_text(const Look& look, const View& view) const {
    const SceneDescription description = described(look);
    toml::table root = tables_->root;
    apply_look(look, plain_look_, root);
    const glm::dvec2 shift = description.cameras.empty() ? glm::dvec2(0.0) : description.cameras.front().shift;
    apply_view(view, shift, description.picture.dpi, root);
    make_paths_absolute(tables_->place.folder, root);
    root.erase("style");
    std::string text;
    if (look.has_sheet() && look.sheet.empty() && look.parameters.empty()) {
        const ChosenSheet& sheet = sheet_named(look.style);
        text = text_of_toml(toml::table{{"style", sheet.file.empty() ? sheet.name : sheet.file}}) + "\n";
    } else if (look.has_sheet()) {
        const std::string& sheet = look.sheet.empty() ? sheet_named(look.style).text : look.sheet;
        std::string with_values = sheet_with_values(sheet, look.parameters);
        if (with_values.empty() || with_values.back() != '\n') with_values += '\n';
        text = text_in_toml("style", with_values) + "\n";
    }
    return text + text_of_toml(root) + "\n";
}

bool ViewedTables::is_plain() const {
    const toml::table& root = tables_->root;
    if (root.contains("shutter") || tables_->had_turntable) return false;
    if (const toml::table* const picture = root["picture"].as_table()) {
        for (const char* const key : {"paper", "margin", "scale"}) {
            if (picture->contains(key)) return false;
        }
    }
    const auto is_simple = [](const toml::table* camera) {
        for (const char* const key : {"lens_radius", "key", "projection", "height"}) {
            if (camera != nullptr && camera->contains(key)) return false;
        }
        return true;
    };
    const toml::array* const cameras = root["camera"].as_array();
    return is_simple(root["camera"].as_table()) &&
           (cameras == nullptr || cameras->empty() || is_simple(cameras->get(0)->as_table()));
}

std::optional<std::string> ViewedTables::command(const Look& look, const View& view) const {
    if (!is_plain() || !look.sheet.empty()) return std::nullopt;
    if (!look.shading.empty() && tables_->root.contains("surfaces")) return std::nullopt;
    CommandText command;
    command.add(input_.path);
    command.add("--eye", view.eye);
    command.add("--target", view.target);
    command.add("--up", view.up);
    command.add(view.height_of_view ? "--ortho" : "--fov", view.height_of_view.value_or(view.fov_deg));
    command.add("--size", std::to_string(view.width) + "x" + std::to_string(view.height));
    const SceneDescription description = described(look);
    const bool has_own_crease = description.sheet && description.sheet->crease_angle_deg;
    if (look.crease_angle_deg != plain_look_.crease_angle_deg && !has_own_crease)
        command.add("--crease-angle", look.crease_angle_deg);
    if (look.has_sheet()) {
        const bool is_of_scene = input_.style.empty() && look.style == first_look_.style;
        if (!is_of_scene)
            command.add("--style", sheet_named(look.style).file.empty() ? look.style : sheet_named(look.style).file);
        for (const auto& [key, value] : look.parameters) command.add("--set", "style." + key + "=" + value);
    } else {
        if (!first_look_.style.empty() && input_.style.empty()) return std::nullopt;  // the scene has a sheet
        if (look.classes != plain_look_.classes)
            command.add("--lines", look.classes.empty() ? "none" : to_string(look.classes));
        if (look.width_px != plain_look_.width_px) command.add("--line-width", look.width_px);
        if (look.hidden != plain_look_.hidden) command.add("--hidden", word_of(look.hidden));
    }
    if (!look.shading.empty()) command.add("--set", "surfaces.shading=" + look.shading);
    for (const Override& o : tables_->overrides) command.add("--set", o.key + "=" + o.value);
    return command.text() + " -o " + in_shell(fs::path(input_.path).stem().string() + ".png");
}

}  // namespace burin
