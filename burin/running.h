#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/progress.h"
#include "burin/scene_state.h"
#include "burin/view_input.h"
#include "render/film.h"
#include "render/frame.h"

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

/// Runs what draws. What it throws names options as the program does: here it names those of the interface.
template <typename Work>
auto with_option_names(const Work& work) {
    try {
        return work();
    } catch (const InputError& error) {
        const std::string_view text = error.what(), option = "--memory: ";
        if (!text.starts_with(option)) throw;
        throw InputError("options.memory_bytes: " + std::string(text.substr(option.size())));
    }
}

/// A film with the layers that options ask for. Throws UsageError where it would have no channel.
Film film_of(const Frame& frame, const OptionsInput& options);

}  // namespace burin
