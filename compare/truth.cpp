#include "compare/truth.h"

#include "methods/method_table.h"

namespace burin {

const Method& truth_method() { return *find_method("reference"); }

const Plane& TruthCache::coverage(LineClassSet classes, double width_px, const ComparedView& view, int frame) {
    const Key key{classes.bits, width_px, frame};
    if (const auto it = planes_.find(key); it != planes_.end()) return it->second;
    return planes_.emplace(key, draw(classes, width_px, view).coverage).first->second;
}

LineRendering TruthCache::render(LineClassSet classes, double width_px, const ComparedView& view) {
    LineRendering rendering = draw(classes, width_px, view);
    planes_.emplace(Key{classes.bits, width_px, 0}, rendering.coverage);
    return rendering;
}

LineRendering TruthCache::draw(LineClassSet classes, double width_px, const ComparedView& view) {
    const LineSettings lines = scene_.lines;
    scene_.lines.classes = classes;
    scene_.lines.style.width_px = width_px;
    LineRendering rendering = render_lines(truth_method(), scene_, view, options_);
    scene_.lines = lines;
    return rendering;
}

}  // namespace burin
