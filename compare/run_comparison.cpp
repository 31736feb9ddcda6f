#include "compare/run_comparison.h"

#include <cmath>

#include "base/parallel.h"
#include "compare/chart_metrics.h"
#include "compare/difference_picture.h"
#include "compare/method_notes.h"
#include "compare/metrics_temporal.h"
#include "compare/moving_frames.h"
#include "compare/picture_metrics.h"
#include "compare/svg_method.h"
#include "compare/truth.h"
#include "compare/width_match.h"

namespace burin {
namespace {

/// Rough costs of the parts, for the progress bar.
constexpr std::uint64_t kTruthWeight = 40, kSceneWeight = 4, kChartWeight = 6, kFrameWeight = 1;

/// Drawings quicker than this are repeated, because their times scatter.
constexpr double kQuick_s = 0.5;

/// Motion is measured in a part of the picture: the truth of many frames takes time.
constexpr int kMovingWidth = 320, kMovingHeight = 240;

/// Truths at a method's own width are drawn at widths rounded to this, so that methods share them.
constexpr double kOwnWidthStep_px = 0.05;

class ComparisonRunner {
  public:
    ComparisonRunner(Scene& scene, const ComparedView& view, const ComparisonOptions& options)
        : scene_(scene),
          view_(view),
          options_(options),
          run_{options.threads, options.progress},
          truths_(scene, run_),
          width_px_(scene.lines.style.width_px) {
        if (width_px_ <= kWidestChartLine_px) chart_ = make_test_chart(width_px_);
        if (chart_) copy_method_settings();
    }

    Comparison run(const std::string& input, const std::function<void(const Comparison&)>& done) {
        describe(input);
        if (run_.progress != nullptr) run_.progress->plan(total_weight());
        next_part("truth", kTruthWeight);
        const LineRendering truth = truths_.render(c_.classes, width_px_, view_);
        c_.truth_time_s = truth.time_s;
        c_.truth_picture = "truth.png";
        write_picture(c_.truth_picture, picture_of(truth.image));
        const PixelRect busy = busiest_part(truth.coverage, view_.crop, 40, 40);
        c_.focus = {(busy.x0 + busy.x1) / 2 - view_.crop.x0, (busy.y0 + busy.y1) / 2 - view_.crop.y0};
        if (c_.frames > 1) move_truth(truth.coverage);
        for (const Method* const method : options_.methods) {
            c_.methods.push_back(measure(*method));
            c_.complete = c_.methods.size() == options_.methods.size();
            done(c_);
        }
        next_part("report", total_weight());  // whatever parts were left out
        if (run_.progress != nullptr) run_.progress->advance();
        return std::move(c_);
    }

  private:
    void describe(const std::string& input) {
        c_.input = input;
        c_.width = view_.width;
        c_.height = view_.height;
        c_.crop = view_.crop;
        c_.classes = scene_.lines.classes;
        c_.line_width_px = width_px_;
        for (const SceneObject& object : scene_.objects) c_.triangles += scene_.meshes[object.mesh].triangles.size();
        c_.frames = options_.frames;
        c_.threads = resolve_thread_count(options_.threads);
        c_.truth_method = truth_method().name;
        c_.chart_width_px = chart_ ? width_px_ : 0;
    }

    /// The chart is drawn with the scene's settings, but for what the scene says about itself.
    void copy_method_settings() {
        Scene& chart = chart_->scene;
        chart.abuffer = scene_.abuffer;
        chart.patel = scene_.patel;
        chart.reference = scene_.reference;
        chart.gbuffer = scene_.gbuffer;
        chart.wire = scene_.wire;
        chart.zbuffer = scene_.zbuffer;
        chart.zbuffer.depth_range.reset();
        chart.zbuffer.highlight_objects.clear();
        chart.zbuffer.highlight_classes = LineClassSet();
    }

    std::uint64_t total_weight() const {
        const auto frames = static_cast<std::uint64_t>(options_.frames);
        const std::uint64_t per_method = kTruthWeight + 2 * kSceneWeight + kChartWeight + frames * kFrameWeight;
        return kTruthWeight + frames * kTruthWeight / 6 + per_method * options_.methods.size();
    }
    void next_part(const std::string& label, std::uint64_t weight) {
        if (run_.progress != nullptr) run_.progress->next_part(label, weight);
    }

    DisplayImage picture_of(const Image& image) const {
        const PictureSettings& picture = scene_.picture;
        std::optional<glm::vec3> background = picture.background;
        if (!background && !picture.transparent) background = glm::vec3(1.0f);
        return cropped(to_display(image, background));
    }
    /// The pictures of a comparison show the part that was rendered.
    DisplayImage cropped(const DisplayImage& whole) const {
        const PixelRect r = view_.crop;
        DisplayImage part;
        part.width = r.width();
        part.height = r.height();
        part.channels = whole.channels;
        for (int y = r.y0; y < r.y1; ++y) {
            const auto row = static_cast<std::ptrdiff_t>(y) * whole.width;
            part.pixels.insert(part.pixels.end(), whole.pixels.begin() + (row + r.x0) * whole.channels,
                               whole.pixels.begin() + (row + r.x1) * whole.channels);
        }
        return part;
    }
    void write_picture(const std::string& name, const DisplayImage& picture) const {
        write_display_image(options_.folder + "/" + name, picture, 8);
    }

    /// Draws the scene's lines of some classes in some width.
    LineRendering draw(const Method& method, LineClassSet classes, double width_px, WireWidth wire,
                       const ComparedView& view) {
        const LineSettings lines = scene_.lines;
        const WireWidth wire_width = scene_.wire.width;
        scene_.lines.classes = classes;
        scene_.lines.style.width_px = width_px;
        scene_.wire.width = wire;
        LineRendering rendering = render(method, scene_, view);
        scene_.lines = lines;
        scene_.wire.width = wire_width;
        return rendering;
    }
    Plane draw_chart(const Method& method, double width_px, WireWidth wire) {
        chart_->scene.wire.width = wire;
        chart_->scene.lines.classes = chart_classes(method.draws);
        chart_->scene.lines.style.width_px = width_px;
        const ComparedView view{chart_->camera, chart_->width, chart_->height, {0, 0, chart_->width, chart_->height}};
        return render(method, chart_->scene, view).coverage;
    }
    LineRendering render(const Method& method, Scene& scene, const ComparedView& view) {
        const bool has_paths = &method == &svg_method();
        if (has_paths) draw_as_paths(scene);
        LineRendering rendering = render_lines(method, scene, view, run_);
        if (has_paths) draw_as_pixels(scene);
        return rendering;
    }

    MethodResult measure(const Method& method) {
        const std::string name(method.name);
        MethodResult result;
        result.method = &method;
        result.drawn = c_.classes & method.draws;
        result.truth = result.drawn;
        if (method.also_finds != nullptr) result.truth |= method.also_finds(result.drawn);
        result.not_drawn = LineClassSet::from_bits(c_.classes.bits & ~result.truth.bits);
        result.published.asked_width_px = result.published.truth_width_px = width_px_;
        if (const MethodNote* const note = find_method_note(method.name)) {
            result.published.values[Metric::passes] = note->passes;
        }
        next_part(name, kSceneWeight);
        std::optional<LineRendering> drawing;
        if (!result.drawn.empty()) {
            drawing = draw(method, result.drawn, width_px_, WireWidth::published, view_);
            // What another program takes to draw an SVG says nothing about Burin.
            if (&method != &svg_method()) measure_costs(method, result.drawn, *drawing, result.published.values);
        }
        next_part(name, kChartWeight);
        const EqualWidth equal_width = measure_on_chart(method, result);
        next_part(name + ", truth", kTruthWeight);
        if (drawing) {
            measure_on_scene(method, equal_width, *drawing, result);
            if (c_.frames > 1) measure_in_motion(method, equal_width, result);
        }
        return result;
    }

    /// Quick methods run three times, and the median times count.
    void measure_costs(const Method& method, LineClassSet classes, const LineRendering& first, MetricValues& values) {
        std::vector<double> wall{first.time_s}, cpu{first.cpu_time_s};
        for (int i = 0; i < 2 && first.time_s < kQuick_s; ++i) {
            const LineRendering again = draw(method, classes, width_px_, WireWidth::published, view_);
            wall.push_back(again.time_s);
            cpu.push_back(again.cpu_time_s);
        }
        values[Metric::time_s] = median_of(wall);
        values[Metric::cpu_time_s] = median_of(cpu);
        if (first.memory_bytes) {
            values[Metric::memory] =
                *first.memory_bytes / (static_cast<double>(view_.crop.width()) * view_.crop.height());
        }
    }

    /// How the row "at equal width" is drawn.
    struct EqualWidth {
        double asked_px = 0;
        bool same_drawing = false;  ///< as the row "as published"
        bool is_known = false;      ///< else there is no such row: the chart would tell the widths
    };

    /// Measures the chart metrics of both rows.
    EqualWidth measure_on_chart(const Method& method, MethodResult& result) {
        ComparisonRow& published = result.published;
        ComparisonRow& equal = result.equal_width;
        equal = published;
        for (const Metric m : {Metric::time_s, Metric::cpu_time_s, Metric::memory})
            equal.values[m].reset();  // measured once only
        const LineClassSet classes = chart_classes(method.draws);
        if (!chart_ || !(classes.has(LineClass::crease) || classes.has(LineClass::polygon))) return {};
        const Plane as_published = draw_chart(method, width_px_, WireWidth::published);
        measure_chart(*chart_, as_published, method.draws, width_px_, published);

        std::vector<std::pair<double, Plane>> drawings;
        const WidthMatch match = match_width(width_px_, [&](double asked) {
            drawings.emplace_back(asked, draw_chart(method, asked, WireWidth::matched));
            return star_width_px(*chart_, drawings.back().second);
        });
        equal.asked_width_px = match.asked_px;
        if (!match.matches && match.measured_px > 0) {
            equal.truth_width_px = std::max(1.0, std::round(match.measured_px / kOwnWidthStep_px)) * kOwnWidthStep_px;
        }
        const auto drawn =
            std::find_if(drawings.begin(), drawings.end(), [&](const auto& d) { return d.first == match.asked_px; });
        measure_chart(*chart_, drawn->second, method.draws, equal.truth_width_px, equal);
        return {match.asked_px, match.asked_px == width_px_ && drawn->second.values == as_published.values, true};
    }

    void measure_on_scene(const Method& method, const EqualWidth& equal_width, const LineRendering& drawing,
                          MethodResult& result) {
        const std::string name(method.name);
        const Plane& truth = truths_.coverage(result.truth, width_px_, view_, 0);
        measure_picture(drawing.coverage, truth, c_.threads, result.published.values);
        result.picture = name + ".png";
        result.difference = name + "_diff.png";
        write_picture(result.picture, picture_of(drawing.image));
        write_picture(result.difference, difference_picture(drawing.coverage, truth));

        next_part(name + ", equal width", kSceneWeight);
        if (!equal_width.is_known) return;
        ComparisonRow& equal = result.equal_width;
        const Plane coverage =
            equal_width.same_drawing
                ? drawing.coverage
                : draw(method, result.drawn, equal_width.asked_px, WireWidth::matched, view_).coverage;
        const Plane& equal_truth = truths_.coverage(result.truth, equal.truth_width_px, view_, 0);
        measure_picture(coverage, equal_truth, c_.threads, equal.values);
    }

    ComparedView frame_view(int j) const {
        ComparedView view = moved_view(scene_, view_, j);
        view.crop = c_.frames_crop;
        return view;
    }
    /// The truth of all frames, for the classes and width of the scene.
    void move_truth(const Plane& coverage) {
        c_.frames_crop = busiest_part(coverage, view_.crop, kMovingWidth, kMovingHeight);
        next_part("truth, moving", static_cast<std::uint64_t>(c_.frames) * kTruthWeight / 6);
        const std::vector<Plane> truth = true_frames(c_.classes, width_px_);
        c_.truth_frame_coverage = relative_coverage(truth, truth);
    }
    std::vector<Plane> true_frames(LineClassSet classes, double width_px) {
        std::vector<Plane> frames;
        for (int j = 0; j < c_.frames; ++j) {
            frames.push_back(truths_.coverage(classes, width_px, frame_view(j), j + 1));
        }
        return frames;
    }
    static std::vector<double> relative_coverage(const std::vector<Plane>& frames, const std::vector<Plane>& truth) {
        double mean = 0;
        for (const Plane& plane : truth) mean += total_coverage(plane) / static_cast<double>(truth.size());
        std::vector<double> result;
        for (const Plane& plane : frames) result.push_back(mean > 0 ? total_coverage(plane) / mean : 0);
        return result;
    }
    void measure_in_motion(const Method& method, const EqualWidth& equal_width, MethodResult& result) {
        next_part(std::string(method.name) + ", moving", static_cast<std::uint64_t>(c_.frames) * kFrameWeight);
        for (ComparisonRow* const row : {&result.published, &result.equal_width}) {
            const bool is_equal = row == &result.equal_width;
            if (is_equal && !equal_width.is_known) continue;
            if (is_equal && equal_width.same_drawing && row->truth_width_px == result.published.truth_width_px) {
                for (const Metric m : {Metric::flicker_sd, Metric::energy_sd, Metric::pop}) {
                    row->values[m] = result.published.values[m];
                }
                row->frame_coverage = result.published.frame_coverage;
                continue;
            }
            std::vector<Plane> frames;
            for (int j = 0; j < c_.frames; ++j) {
                frames.push_back(draw(method, result.drawn, row->asked_width_px,
                                      is_equal ? WireWidth::matched : WireWidth::published, frame_view(j))
                                     .coverage);
            }
            const std::vector<Plane> truth = true_frames(result.truth, row->truth_width_px);
            row->frame_coverage = relative_coverage(frames, truth);
            if (const auto f = flicker(frames, truth)) {
                row->values[Metric::flicker_sd] = f->flicker_sd;
                row->values[Metric::energy_sd] = f->energy_sd;
                row->values[Metric::pop] = f->pop;
            }
        }
    }

    Scene& scene_;
    ComparedView view_;
    const ComparisonOptions& options_;
    RunOptions run_;
    TruthCache truths_;
    double width_px_;
    std::optional<TestChart> chart_;
    Comparison c_;
};

}  // namespace

Comparison run_comparison(Scene& scene, const std::string& input, const ComparedView& view,
                          const ComparisonOptions& options, const std::function<void(const Comparison&)>& done) {
    return ComparisonRunner(scene, view, options).run(input, done);
}

}  // namespace burin
