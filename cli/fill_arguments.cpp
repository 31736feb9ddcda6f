#include "cli/fill_arguments.h"

#include <cmath>
#include <utility>

#include "cli/option_values.h"
#include "mesh/text_scan.h"
#include "methods/method_table.h"
#include "scene/color.h"

namespace burin {
namespace {

using namespace option_values;

void fill_input_options(const Texts& t, Arguments& a) {
    a.input = t.input;
    if (!t.model_memory.empty())
        a.model_budget = ModelBudget(byte_count("--memory-model", t.model_memory), "--memory-model");
}

void fill_overrides(const Texts& t, Arguments& a) {
    for (const std::string& set : t.sets) {
        const std::size_t equals = set.find('=');
        if (equals == std::string::npos || equals == 0) {
            fail("--set", "must be KEY=VALUE, got '" + printable(set) + "'");
        }
        a.overrides.push_back({set.substr(0, equals), set.substr(equals + 1)});
    }
}

void fill_view_options(const Texts& t, Arguments& a) {
    fill_input_options(t, a);
    fill_overrides(t, a);
    a.style = t.style;
    if (!t.port.empty()) a.port = static_cast<std::uint16_t>(integer("--port", t.port, 1, 65535));
    a.opens_browser = !t.no_browser;
    if (!t.threads.empty()) a.threads = integer("--threads", t.threads, 0, 1024);
    a.quiet = t.quiet;
}

void fill_scene_options(const Texts& t, Arguments& a) {
    fill_input_options(t, a);
    if (!t.size.empty()) {
        a.size_is_longer_side = to_integer(t.size, a.size.emplace()[0]);
        a.size->back() = a.size->front();
        if (!a.size_is_longer_side) a.size = integers<2>("--size", t.size, 'x', "WIDTHxHEIGHT in pixels");
        for (const int side : *a.size) {
            if (side < 1 || side > 65535) fail("--size", "width and height must be from 1 to 65535");
        }
    }
    if (!t.eye.empty()) a.eye = vector("--eye", t.eye);
    if (!t.target.empty()) a.target = vector("--target", t.target);
    if (!t.up.empty()) a.up = vector("--up", t.up);
    if (!t.fov.empty()) {
        a.fov_deg = number("--fov", t.fov);
        if (!(*a.fov_deg > 0 && *a.fov_deg < 180)) fail("--fov", "must lie between 0 and 180 degrees");
    }
    if (!t.ortho.empty()) {
        a.ortho_height = number("--ortho", t.ortho);
        if (!(*a.ortho_height > 0)) fail("--ortho", "must be positive");
        if (a.fov_deg) fail("--ortho", "cannot stand beside --fov; remove one");
    }
    a.camera = t.camera;
    if (!t.camera.empty() && (a.eye || a.target || a.up || a.fov_deg || a.ortho_height)) {
        fail("--camera", "cannot stand beside --eye, --target, --up, --fov or --ortho; remove one");
    }
    if (!t.method.empty() && find_method(t.method) == nullptr) {
        fail("--method", "unknown method '" + printable(t.method) + "'; burin methods lists them");
    }
    a.method = t.method;
    if (!t.mask.empty()) {
        a.mask_bits = integer("--mask", t.mask, 16, 256);
        if (*a.mask_bits != 16 && *a.mask_bits != 64 && *a.mask_bits != 256) {
            fail("--mask", "must be 16, 64 or 256");
        }
    }
    if (!t.samples.empty()) {
        a.samples_per_pixel = integer("--samples", t.samples, 2, 8);
        if (*a.samples_per_pixel % 2 != 0 || *a.samples_per_pixel == 6) fail("--samples", "must be 2, 4 or 8");
    }
    if (!t.operators.empty()) a.gbuffer_operators = gbuffer_operators(t.operators);
    if (!t.supersample.empty()) {
        a.supersample = integer("--supersample", t.supersample, 1, 8);
        if (*a.supersample != 1 && *a.supersample != 2 && *a.supersample != 4 && *a.supersample != 8) {
            fail("--supersample", "must be 1, 2, 4 or 8");
        }
    }
    if (!t.lines.empty()) a.lines = line_classes(t.lines);
    if (!t.width.empty()) {
        const bool has_unit =
            t.width.ends_with("mm") || t.width.ends_with("pt") || t.width.ends_with("px") || t.width.ends_with('%');
        if (has_unit)
            fail("--line-width", "'" + printable(t.width) +
                                     "' is no finite number: it is in pixels; with a style sheet, --set style.width=" +
                                     printable(t.width) + " takes units");
        a.line_width_px = number("--line-width", t.width);
        if (!(*a.line_width_px > 0 && *a.line_width_px <= 1024)) {
            fail("--line-width", "must be greater than 0 and at most 1024 pixels");
        }
    }
    if (!t.crease.empty()) {
        const auto parts = split(t.crease, ',');
        const double from = number("--crease-angle", parts.front()), to = number("--crease-angle", parts.back());
        if (!(parts.size() <= 2 && from >= 0 && from <= to && to <= 180)) {
            fail("--crease-angle", "must be from 0 to 180 degrees, or two such angles, the smaller one first");
        }
        a.crease_angle_deg = {from, to};
    }
    if (!t.hidden.empty()) {
        const std::pair<std::string_view, HiddenStyle> styles[] = {
            {"none", HiddenStyle::none}, {"solid", HiddenStyle::solid}, {"dashed", HiddenStyle::dashed}};
        for (const auto& [name, style] : styles) {
            if (t.hidden == name) a.hidden = style;
        }
        if (!a.hidden) fail("--hidden", "must be none, solid or dashed");
    }
    if (!t.color.empty() && !color_from_hex(t.color)) fail("--color", "must be a colour like #c0d0ff");
    a.line_color = t.color;
    a.style = t.style;
    if (!t.frame.empty()) a.frame = integer("--frame", t.frame, -1000000000, 1000000000);
    fill_overrides(t, a);
    if (!t.threads.empty()) a.threads = integer("--threads", t.threads, 0, 1024);
    a.verbose = t.verbose > 0;
    a.quiet = t.quiet;
    if (a.verbose && a.quiet) fail("-v", "cannot stand beside -q; remove one");
}

void fill_render_options(const Texts& t, Arguments& a) {
    a.output = t.outputs.empty() ? t.output : t.outputs.front();
    if (!t.outputs.empty()) a.more_outputs.assign(t.outputs.begin() + 1, t.outputs.end());
    if (!t.layers.empty()) a.layers = layer_set(t.layers);
    a.names_layers = !t.layers.empty();
    if (!t.crop.empty()) a.crop = integers<4>("--crop", t.crop, ',', "X0,Y0,X1,Y1 in pixels");
    if (!t.bits.empty()) {
        a.bits = integer("--bits", t.bits, 8, 16);
        if (a.bits != 8 && a.bits != 16) fail("--bits", "must be 8 or 16");
    }
    a.background = t.background;
    if (!t.background.empty() && t.background != "transparent" && !color_from_hex(t.background)) {
        fail("--background", "must be a colour like #c0d0ff, or transparent");
    }
    if (!t.memory.empty()) a.memory_bytes = byte_count("--memory", t.memory);
    if (!t.depth_complexity.empty()) {
        const double most = number("--depth-complexity", t.depth_complexity);
        if (!(most >= 1 && most <= 1e9)) fail("--depth-complexity", "must be between 1 and 1000000000");
        a.depth_limit.surfaces_per_px = most;
        a.has_depth_limit = true;
    }
    a.stats = t.stats;
    if (!t.repeat.empty()) a.repeat = integer("--repeat", t.repeat, 1, 1000000);
    if (!t.progress.empty() && t.progress != "alf") fail("--progress", "must be alf");
    a.alf_progress = t.progress == "alf";
    a.deep = t.deep;
    a.save_lines = t.save_lines;
    a.saves_surface = t.save_surface;
    if (a.saves_surface && a.save_lines.empty()) fail("--save-surface", "needs --save-lines");
    if (a.saves_surface && a.crop) fail("--save-surface", "cannot stand beside --crop; remove one");
    if (!t.find.empty() && t.find != "sheet" && t.find != "all") fail("--find", "must be sheet or all");
    a.finds_all = t.find == "all";
}

void fill_compare_options(const Texts& t, Arguments& a) {
    if (!t.methods.empty()) a.methods = words(t.methods);
    if (!t.compare_frames.empty()) a.frames = integer("--frames", t.compare_frames, 2, 1024);
}

}  // namespace

void fill_arguments(const Texts& t, Arguments& a) {
    a.json = t.json;
    a.strict = t.strict;
    switch (a.command) {
        case Command::methods:
            return;
        case Command::styles:
            a.style = t.style;
            a.quiet = t.quiet;
            return;
        case Command::info:
            return fill_input_options(t, a);
        case Command::assemble:
            a.output = t.output;
            a.bands = t.farm.band_files;
            a.quiet = t.quiet;
            return;
        case Command::view:
            return fill_view_options(t, a);
        case Command::render:
        case Command::restyle:
        case Command::compare:
        case Command::explain:
        case Command::submit:
            break;
    }
    fill_scene_options(t, a);
    fill_render_options(t, a);
    fill_page_options(t.page, a);
    fill_vector_options(t.vector, a);
    fill_frame_options(t.frames, a);
    fill_exr_options(t.exr, a);
    fill_farm_options(t.farm, a);
    if (a.command == Command::compare) fill_compare_options(t, a);
    if (a.command == Command::explain) a.pixel = integers<2>("--pixel", t.pixel, ',', "X,Y");
}

}  // namespace burin
