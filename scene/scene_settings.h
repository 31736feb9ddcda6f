#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "scene/scene_description.h"

namespace burin {

/// The tables of a scene file but for its objects and materials, which may change one after the other: what comes later
/// replaces what it names, and leaves the rest as it was.
class SceneSettings {
  public:
    SceneSettings();
    ~SceneSettings();
    SceneSettings(const SceneSettings& other);
    SceneSettings(SceneSettings&&) noexcept;
    SceneSettings& operator=(SceneSettings&&) noexcept;

    /// What they say: a description without objects and materials.
    const SceneDescription& description() const { return description_; }

    // What throws InputError or UsageError changes nothing.

    /// "lines.width=2".
    void set(const Override& override);
    /// Tables of a text; a list of cameras replaces the one before. An object or a material is an error. `name`: of the
    /// text, in messages.
    void set_tables(std::string_view text, const std::string& name);
    /// A style sheet takes the place of all looks of lines, and of the one before with its overrides: a text of several
    /// lines, or a name or a file, which is read now. An empty one takes the sheet away, that of the scene's file, too.
    void set_style(const std::string& text_or_name);
    /// Tables of a scene's text. Returns its description, objects, materials and all. `folder`: what the models' paths
    /// are relative to.
    SceneDescription take_scene(std::string_view text, const std::string& name, const std::string& folder);
    /// The same of a scene file.
    SceneDescription take_scene_file(const std::string& path);

  private:
    struct Tables;
    SceneDescription take(Tables scene, const std::string& name, const std::string& folder);
    void change_to(std::unique_ptr<Tables> tables);

    std::unique_ptr<Tables> tables_;
    SceneDescription description_;
};

}  // namespace burin
