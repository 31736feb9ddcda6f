#include "cli/sheet_views.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/stream_store.h"
#include "cli/job.h"
#include "cli/sheet_wishes.h"
#include "methods/abuffer.h"
#include "methods/seen_surfaces.h"
#include "output/paths/view_sheet.h"

namespace burin {
namespace {

PixelRect cell_of(const ViewArea& area, int width, int height) {
    const auto pixel = [](double share, int side) {
        return std::clamp(static_cast<int>(std::lround(share * side)), 0, side);
    };
    return {pixel(area.low.x, width), pixel(area.low.y, height), pixel(area.high.x, width), pixel(area.high.y, height)};
}

/// While it lives, a scene's look draws no hidden lines, if a view has none.
class LookOfView {
  public:
    LookOfView(Scene& scene, const ViewOnSheet& view)
        : scene_(scene), sheet_(scene.sheet), hidden_(scene.lines.style.hidden.style) {
        if (view.has_hidden_lines) return;
        scene.lines.style.hidden.style = HiddenStyle::none;
        if (!sheet_) return;
        StyleSheet visible = *sheet_;
        take_hidden_lines_away(visible);
        scene.sheet = std::make_shared<StyleSheet>(std::move(visible));
    }
    ~LookOfView() {
        scene_.sheet = std::move(sheet_);
        scene_.lines.style.hidden.style = hidden_;
    }
    LookOfView(const LookOfView&) = delete;
    LookOfView& operator=(const LookOfView&) = delete;

  private:
    Scene& scene_;
    std::shared_ptr<const StyleSheet> sheet_;
    HiddenStyle hidden_;
};

}  // namespace

RenderStats SheetViews::draw(const Method& method, const RunOptions& run, Film& film) const {
    const PixelRect whole = film.crop();
    for (int y = whole.y0; y < whole.y1; ++y) film.put_background(whole.x0, whole.x1, y);
    finish_stream_stores();
    RenderStats sum;
    for (const ViewOnSheet& view : views) {
        const LookOfView look(scene, view);
        Frame frame = frame_of(scene, view.camera, arguments, prepared);
        frame.crop = cell_of(view.camera.area, frame.width, frame.height);
        if (frame.crop.width() > 0 && frame.crop.height() > 0) add(method.render(frame, run, film), sum);
    }
    return sum;
}

RenderStats SheetViews::draw_as_paths(const RunOptions& run, Film& film, VectorDrawing& drawing,
                                      VectorStats& stats) const {
    RenderStats sum;
    drawing = {};
    for (const ViewOnSheet& view : views) {
        const LookOfView look(scene, view);
        const Frame frame = frame_of(scene, view.camera, arguments, prepared);
        RenderStats found;
        const FoundLines lines = find_styled_lines(frame, run, film, found);
        VectorStats paths;
        VectorDrawing own = draw_paths(lines, frame, arguments, paths, found.notes, run.progress);
        const PixelRect cell = cell_of(view.camera.area, frame.width, frame.height);
        if (draws_regions(scene, arguments))
            draw_regions(seen_surfaces(scene, view.camera, cell, run), own, paths, found.notes);
        add_view(std::move(own), std::string(kStandardViewNames[static_cast<std::size_t>(view.view)]), drawing);
        add(found, sum);
        stats.strokes += paths.strokes;
        stats.chained += paths.chained;
        stats.mean_inks += paths.mean_inks;
        stats.chain_s += paths.chain_s;
        stats.clean_s += paths.clean_s;
        stats.fit_s += paths.fit_s;
        stats.regions_s += paths.regions_s;
    }
    return sum;
}

}  // namespace burin
