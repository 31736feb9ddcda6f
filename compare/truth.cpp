#include "compare/truth.h"

#include "methods/method_table.h"

namespace burin {

const Method& truth_method() {
    const Method* const reference = find_method("reference");
    return reference != nullptr ? *reference : *find_method("patel");
}

const Plane& TruthCache::coverage(LineClassSet classes, double width_px, const View& view, int frame) {
    const Key key{classes.bits, width_px, frame};
    if (const auto it = planes_.find(key); it != planes_.end()) return it->second;
    if (frame == 0) {
        render(classes, width_px, view);
        return planes_.at(key);
    }
    const LineSettings lines = scene_.lines;
    scene_.lines.classes = classes;
    scene_.lines.style.width_px = width_px;
    Plane plane = render_lines(truth_method(), scene_, view, options_).coverage;
    scene_.lines = lines;
    return planes_.emplace(key, std::move(plane)).first->second;
}

LineRendering TruthCache::render(LineClassSet classes, double width_px, const View& view) {
    const LineSettings lines = scene_.lines;
    scene_.lines.classes = classes;
    scene_.lines.style.width_px = width_px;
    LineRendering rendering = render_lines(truth_method(), scene_, view, options_);
    scene_.lines = lines;
    planes_.emplace(Key{classes.bits, width_px, 0}, rendering.coverage);
    return rendering;
}

}  // namespace burin
