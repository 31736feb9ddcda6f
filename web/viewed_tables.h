#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/scene_description.h"
#include "web/view_message.h"

namespace burin {

/// A style sheet that a page may choose.
struct ChosenSheet {
    std::string name;  ///< built in or of the user's folders; or the file that the scene or the command line names
    std::string file;  ///< absolute path; empty: it is a part of the program
    std::string summary;
    std::string text;
};

/// What is viewed, as it is typed.
struct ViewedInput {
    std::string path;   ///< a model or a scene file
    std::string style;  ///< as --style has it; empty: the scene's own, or none
    std::vector<Override> overrides;
};

/// ViewedTables are the tables of a scene file, or those of a bare model, and what looks and views make of them: the
/// description that is drawn and the scene file that draws the same come from the same tables.
class ViewedTables {
  public:
    /// Throws InputError and UsageError.
    explicit ViewedTables(ViewedInput input);
    ~ViewedTables();
    ViewedTables(const ViewedTables&) = delete;
    ViewedTables& operator=(const ViewedTables&) = delete;

    /// How it looks before anybody changes anything.
    const Look& first_look() const { return first_look_; }
    const std::vector<ChosenSheet>& sheets() const { return sheets_; }
    /// Where the camera is described that is used; or the input, if it describes none.
    const SourcePosition& camera_place() const { return camera_place_; }
    /// Sheets of the user that are left out because they are wrong.
    const std::vector<std::string>& notes() const { return notes_; }

    /// The scene with a look. Throws InputError and UsageError; what is wrong in Look::sheet begins with "sheet:".
    SceneDescription described(const Look& look) const;
    /// A scene file that draws a view of the scene with a look, the same to the bit. Throws as described().
    std::string scene_text(const Look& look, const View& view) const;
    /// The command that draws the same; nothing if only a scene file can say it.
    std::optional<std::string> command(const Look& look, const View& view) const;

  private:
    struct Tables;

    const ChosenSheet& sheet_named(const std::string& name) const;
    std::string folder() const;
    bool is_plain() const;

    ViewedInput input_;
    std::unique_ptr<const Tables> tables_;
    std::vector<ChosenSheet> sheets_;
    std::vector<std::string> notes_;
    SourcePosition camera_place_;
    Look plain_look_;  ///< of the scene without a sheet
    Look first_look_;
};

}  // namespace burin
