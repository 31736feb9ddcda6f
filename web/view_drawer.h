#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/film.h"
#include "render/frame.h"
#include "render/prepared.h"
#include "web/picture_bytes.h"
#include "web/viewed_scene.h"

namespace burin {

/// A picture for a page.
struct DrawnView {
    PictureBytes picture;
    std::vector<std::string> notes;
    double draw_s = 0, encode_s = 0;
};

/// Why a pixel looks as it does, for readers.
struct ExplainedPixel {
    int x = 0, y = 0;
    std::vector<std::string> reasons;  ///< why there are the lines that are drawn there, the topmost first
    std::string lines;                 ///< how a style sheet draws them; empty: none does
    std::string fragments;             ///< which surfaces are there, and what decided
};

/// ViewDrawer draws views of a scene with a look of its own; others may draw the same scene with theirs. What all its
/// views have in common is made once per look. Everything throws InputError, UsageError and Interrupted.
class ViewDrawer {
  public:
    explicit ViewDrawer(ViewedScene& scene);

    /// From now on lines look like that. What throws changes nothing.
    void set_look(const Look& look);
    const Look& look() const { return look_; }
    /// The sheet of the look; nullptr: there is none.
    const StyleSheet* sheet() const { return settings_.sheet.get(); }

    /// `is_full`: as `burin render` draws it; else a preview, for while a view moves.
    DrawnView draw(const View& view, bool is_full);
    /// Of the nearest pixel with a line, at most `reach_px` away; if none is, of the pixel itself.
    ExplainedPixel explain(const View& view, int x, int y, int reach_px);
    /// The files that `burin render` writes of the same.
    std::string png(const View& view);
    std::string svg(const View& view, std::vector<std::string>& notes);

  private:
    struct Wishes {
        bool is_preview = false;
        bool is_for_paths = false;
    };
    using Use = std::function<void(const Frame& frame)>;

    void with_frame(const View& view, const Wishes& wishes, const Use& use);
    void put_look_into(Scene& scene, const View& view, const Wishes& wishes) const;
    Film& film_for(const Frame& frame);

    ViewedScene& viewed_;
    Look look_;
    SceneDescription settings_;  ///< without objects
    std::optional<PreparedScene> prepared_;
    std::optional<Film> film_;
    PictureEncoder encoder_;
};

}  // namespace burin
