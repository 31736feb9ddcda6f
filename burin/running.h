#pragma once

#include <optional>
#include <string>

#include "base/error.h"
#include "base/limit_error.h"
#include "base/progress.h"
#include "burin/failure.h"
#include "burin/scene_for_frame.h"
#include "burin/view_input.h"
#include "render/method.h"

namespace burin {

/// Tells a caller's progress function how far a call is, and stops the scene's work when the function says so.
class RunProgress {
  public:
    RunProgress(const OptionsInput& options, burin_scene& scene) {
        if (options.progress == nullptr) return;
        progress_.emplace([&options, &scene](double done) {
            if (options.progress(done, options.user) != 0) scene.stop.store(true);
        });
    }
    /// nullptr where nobody is told.
    Progress* get() { return progress_ ? &*progress_ : nullptr; }

  private:
    std::optional<Progress> progress_;
};

/// Runs what draws. Says which option a limit is that was too small.
template <typename Work>
auto with_option_names(const Work& work) {
    try {
        return work();
    } catch (const LimitError& error) {
        throw InputError("options.memory_bytes: " + std::string(error.what()));
    }
}

/// A call that finds or draws one view of a scene: all that its work needs, checked and made ready.
class FrameCall {
  public:
    /// Throws InputError, UsageError and Interrupted.
    FrameCall(burin_scene* scene, const burin_view* view, const burin_options* options)
        : call_(required(scene, "scene")),
          given_(checked_options(read_struct_or_default(options, "options"))),
          ready_(*scene, read_struct_or_default(view, "view"), given_),
          scene_(*scene),
          progress_(given_, *scene),
          run_{given_.threads, progress_.get(), given_.memory_bytes} {
        scene_.late_film.wait();  // what is drawn now may need its memory
    }

    const OptionsInput& given() const { return given_; }
    const SceneForFrame& ready() const { return ready_; }
    const RunOptions& run() const { return run_; }
    /// Runs what draws on a film. Says which option a limit is that was too small; has a film that is not drawn to its
    /// end freed later.
    template <typename Work>
    auto draw(Film& film, const Work& work) const {
        try {
            return with_option_names(work);
        } catch (const Interrupted&) {
            scene_.late_film.take(std::move(film));
            throw;
        }
    }

  private:
    StoppableCall call_;
    OptionsInput given_;
    SceneForFrame ready_;
    burin_scene& scene_;
    RunProgress progress_;
    RunOptions run_;
};

}  // namespace burin
