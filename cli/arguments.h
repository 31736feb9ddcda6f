#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "cli/page.h"
#include "lines/line_class.h"
#include "output/exr_layers.h"
#include "output/paths/vector_drawing.h"
#include "render/depth_limit.h"
#include "render/film.h"
#include "scene/scene_description.h"
#include "scene/standard_views.h"

namespace burin {

enum class Command : std::uint8_t { render, info, explain, methods, compare, styles, restyle, assemble, submit, view };

/// Arguments is what stands on the command line, checked as far as that is possible without the scene.
/// Everything optional overrides the scene when it is given.
struct Arguments {
    Command command = Command::render;
    std::string input;
    std::string output;
    std::vector<std::string> more_outputs;  ///< further pictures of the same frame
    std::string deep;                       ///< file for samples of all surfaces and lines of each pixel
    std::optional<std::array<int, 2>> size;
    bool size_is_longer_side = false;  ///< one number was given, which only paper makes a size of
    std::optional<glm::dvec3> eye, target, up;
    std::optional<double> fov_deg, ortho_height;
    std::string camera;
    std::string method;
    std::optional<int> mask_bits;
    std::optional<int> samples_per_pixel;
    std::optional<GBufferOperatorSet> gbuffer_operators;
    std::optional<int> supersample;
    std::optional<LineClassSet> lines;
    std::optional<double> line_width_px;
    std::string line_color;  ///< as typed, a colour
    std::string style;       ///< name or file of a style sheet; of `styles`: which one is shown
    std::string save_lines;  ///< file for the lines of the picture
    bool saves_surface = false, finds_all = false;
    std::optional<int> frame;
    std::optional<std::array<double, 2>> shutter;  ///< when it opens and closes
    bool has_blur_samples = false;
    std::optional<int> blur_samples;  ///< none: as many as the picture needs
    std::optional<double> lens_radius, focus;
    std::optional<double> dpi;
    PagePreset page = PagePreset::none;
    bool has_style_of_page = false;     ///< no other was given
    std::vector<StandardView> views;    ///< on one sheet; empty: one, through a camera
    std::vector<bool> hidden_in_views;  ///< of each: whether it has hidden lines, if the look draws any
    ViewProjection view_projection = ViewProjection::first;
    std::optional<glm::dvec2> paper_mm;
    std::optional<std::array<double, 4>> margin_mm;  ///< top, right, bottom, left
    std::optional<double> scale, unit_mm;
    std::optional<std::array<double, 2>> crease_angle_deg;  ///< from where to where creases fade in; or twice the same
    std::optional<HiddenStyle> hidden;
    LayerSet layers;
    bool names_layers = false;
    std::optional<std::array<int, 4>> crop;
    std::optional<std::array<int, 2>> pixel;
    std::string background;
    VectorGrouping grouping = VectorGrouping::line_class;
    double tolerance_px = 0.02, chord_sag_px = 0.02;
    bool cuts_dashes = false;         ///< of vector files; else dashes are left to the viewer
    bool names_paths = true;          ///< paths in vector files have ids and data-*
    bool merges_paths = false;        ///< in vector files, where ends meet
    bool has_vector_options = false;  ///< any of these was given
    ExrChoice exr;
    int overscan_px = 0;                   ///< around the picture
    std::vector<std::string> exr_options;  ///< those of EXR files that were given
    std::vector<Override> overrides;
    int bits = 8;
    int threads = 0;
    std::uint64_t memory_bytes = 0;  ///< 0: no cap
    DepthLimit depth_limit{2000, "--depth-complexity"};
    bool has_depth_limit = false;  ///< it was given
    ModelBudget model_budget{ModelBudget::kDefaultLimit, "--memory-model"};
    int repeat = 0;
    std::vector<std::string> methods;  ///< compare: names, in order; empty: all
    int frames = 0;                    ///< compare: how many the camera moves through
    std::vector<double> frame_list;    ///< render: --frames; empty: not given
    std::optional<double> fps;
    std::optional<int> turntable_frames;
    bool skips_existing = false, keeps_going = false;
    std::vector<std::string> bands;            ///< assemble: files to be joined
    int frames_of_a_task = 8, band_count = 1;  ///< submit
    int retries = 1;                           ///< submit: of a task that failed
    bool is_dry_run = false;                   ///< says what would be done
    std::vector<std::string> sbatch_options;
    std::vector<std::string> render_arguments;  ///< submit: what a task's `render` gets of the command line
    std::vector<std::string> submit_arguments;  ///< submit: the command line but for its frames
    /// All options of the command line that change the picture, as they were typed.
    std::string picture_options;
    std::string stats;
    bool json = false;
    bool strict = false;  ///< refuse what a reader would leave out of a model with a note
    bool verbose = false;
    bool quiet = false;
    bool alf_progress = false;
    std::uint16_t port = 0;  ///< view: 0 = a free one
    bool opens_browser = true;
};

/// Reads the command line. Throws UsageError. For --help and --version it prints and returns nothing.
std::optional<Arguments> parse_arguments(int argc, char** argv);

}  // namespace burin
