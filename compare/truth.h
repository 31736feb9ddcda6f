#pragma once

#include <map>
#include <tuple>

#include "compare/render_lines.h"

// One method stands for the truth; its pictures are drawn once and remembered.

namespace burin {

/// The method that the others are compared with.
const Method& truth_method();

/// Draws truths, and remembers them: several methods may need the same.
class TruthCache {
  public:
    /// `scene` is changed while a truth is drawn, and is as it was afterwards.
    TruthCache(Scene& scene, RunOptions options) : scene_(scene), options_(options) {}

    /// The coverage of the true lines of these classes. `frame` stands for the view; 0 is the
    /// picture itself.
    const Plane& coverage(LineClassSet classes, double width_px, const ComparedView& view, int frame);

    /// The scene's own truth, with its colours and its time.
    LineRendering render(LineClassSet classes, double width_px, const ComparedView& view);

  private:
    LineRendering draw(LineClassSet classes, double width_px, const ComparedView& view);

    using Key = std::tuple<unsigned, double, int>;
    Scene& scene_;
    RunOptions options_;
    std::map<Key, Plane> planes_;
};

}  // namespace burin
