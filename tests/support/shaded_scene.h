#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "methods/abuffer.h"
#include "render/line_shading.h"
#include "scene/sheet_toml.h"
#include "shading/ink/ink_lines.h"
#include "shading/ink/line_columns.h"
#include "tests/scene/scene_text.h"
#include "tests/support/drawing.h"

// A scene and a style sheet, both as texts, become lines with their looks, and pictures.

namespace burin::test {

/// A view of a scene whose lines look as a sheet says.
class ShadedScene {
  public:
    ShadedScene(std::string_view scene, std::string_view sheet, int width = 200, int height = 160)
        : ShadedScene(SceneText(scene).read(), sheet, width, height) {}
    ShadedScene(SceneDescription scene, std::string_view sheet, int width, int height)
        : width_(width), height_(height) {
        use_sheet(scene, std::make_shared<const StyleSheet>(read_sheet_text(sheet, "sheet.toml")));
        scene_ = std::make_unique<Scene>(load_scene(std::move(scene)));
        see();
    }
    /// A scene whose lines look as it says itself.
    ShadedScene(SceneDescription scene, int width, int height)
        : scene_(std::make_unique<Scene>(load_scene(std::move(scene)))), width_(width), height_(height) {
        see();
    }
    /// A scene of meshes, seen in a way of their own.
    ShadedScene(std::vector<PolygonSoup> objects, const Camera& camera, std::string_view sheet, int width, int height)
        : width_(width), height_(height), camera_(camera) {
        SceneDescription looks = SceneText(kBox).read();
        use_sheet(looks, std::make_shared<const StyleSheet>(read_sheet_text(sheet, "sheet.toml")));
        scene_ = std::make_unique<Scene>(scene_of(std::move(objects)));
        scene_->lines = looks.lines;
        scene_->sheet = looks.sheet;
    }

    Scene& scene() { return *scene_; }
    Camera& camera() { return camera_; }
    PixelRect whole() const { return {0, 0, width_, height_}; }
    Frame frame(PixelRect crop) const { return make_frame(*scene_, camera_, width_, height_, crop); }

    Image draw(int threads = 1, std::uint64_t memory_bytes = 0) const { return draw(whole(), threads, memory_bytes); }
    Image draw(PixelRect crop, int threads = 1, std::uint64_t memory_bytes = 0) const {
        return draw(frame(crop), threads, memory_bytes);
    }
    Image draw(const Frame& frame, int threads = 1, std::uint64_t memory_bytes = 0) const {
        LayerSet layers{true, true, true, true, true, true, true, true};
        if (scene_->sheet) {
            for (const LineSet& set : scene_->sheet->sets) {
                if (!set.layer.empty()) layers.line_sets.push_back(set.layer);
            }
        }
        Film film(whole(), frame.crop, layers, frame.criteria.classes);
        RunOptions options;
        options.threads = threads;
        options.memory_bytes = memory_bytes;
        render_abuffer(frame, options, film);
        return film.image();
    }
    FoundLines found(int threads = 1) const { return found(whole(), threads); }
    FoundLines found(PixelRect crop, int threads = 1) const {
        const Frame seen = frame(crop);
        return found_lines(drawing(seen, threads), seen, threads);
    }
    InkedLines inked(int threads = 1) const { return inked(whole(), threads); }
    InkedLines inked(PixelRect crop, int threads = 1, std::vector<std::string>* notes = nullptr) const {
        const Frame seen = frame(crop);
        std::vector<std::string> all;
        InkedLines lines = ink_lines(found_lines(drawing(seen, threads), seen, threads), *seen.sheet, threads, all);
        lines.filter = scene_->lines.style.filter;
        if (notes != nullptr) *notes = all;
        return lines;
    }

  private:
    static LineDrawing drawing(const Frame& frame, int threads) {
        LayerSet layers{true, false, false, false, false, false, false, false};
        Film film({0, 0, frame.width, frame.height}, frame.crop, layers, frame.criteria.classes);
        RunOptions options;
        options.threads = threads;
        return find_drawing(frame, options, film);
    }
    void see() {
        camera_ = resolve_camera(scene_->cameras.front(), scene_points(*scene_), static_cast<double>(width_) / height_);
    }

    std::unique_ptr<Scene> scene_;
    int width_, height_;
    Camera camera_;
};

/// All variables at places of lines.
class ColumnsOfLines {
  public:
    explicit ColumnsOfLines(const FoundLines& lines, LineClassSet asked = LineClassSet::all())
        : lines_(lines), columns_(lines, asked, all()) {}

    float at(Variable v, const LineSample& sample, std::size_t component = 0, const SampleVariant& variant = {}) const {
        SampleColumns filled;
        columns_.fill(std::span(&sample, 1), all(), variant, filled);
        return *filled.of(v, component);
    }
    glm::dvec3 triple(Variable v, const LineSample& sample) const {
        return {at(v, sample, 0), at(v, sample, 1), at(v, sample, 2)};
    }
    /// Calls visit(sample, run, piece) for three places of each piece.
    template <typename Visit>
    void each(const Visit& visit) const {
        for (std::uint32_t r = 0; r < lines_.runs.runs.size(); ++r) {
            const LineRun& run = lines_.runs.runs[r];
            for (std::size_t i = run.first; i < run.first + run.count; ++i) {
                for (const double share : {0.1, 0.5, 0.8})
                    visit(LineSample{r, static_cast<std::uint32_t>(i), share}, run, lines_.runs.pieces[i].piece);
            }
        }
    }
    glm::dvec2 place(const LineSample& sample) const { return columns_.place_of(sample); }
    static VariableSet all() {
        VariableSet set;
        for (const VariableRow& row : variable_table()) set.add(row.variable);
        return set;
    }

  private:
    const FoundLines& lines_;
    LineColumns columns_;
};

inline double value_at(const Image& image, const std::string& channel, int x, int y) {
    const Channel* const c = image.find(channel);
    if (c == nullptr) ADD_FAILURE() << "no channel " << channel;
    return c == nullptr ? 0 : image.value(*c, x - image.data().x0, y - image.data().y0);
}

/// One set that draws all classes given with one style.
inline std::string sheet_of(const std::string& classes, const std::string& style, const std::string& set = "") {
    return "style_version = 1\n[[set]]\nname = \"all\"\nclasses = [" + classes + "]\nstyle = \"ink\"\n" + set +
           "\n[style.ink]\n" + style + "\n";
}

}  // namespace burin::test
