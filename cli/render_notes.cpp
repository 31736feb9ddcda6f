#include "cli/render_notes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/vector_output.h"
#include "methods/gbuffer/gbuffer.h"
#include "methods/patel/patel.h"
#include "methods/seen_surfaces.h"
#include "output/vector_layers.h"
#include "render/picture_notes.h"
#include "shading/sheet/style_sheet.h"

namespace burin {
namespace {

/// Notes lines of the input that are not drawn.
void note_loose_edges(const Frame& frame, const Method& method) {
    if (const std::string missing = note_on_missing_marks(frame); !missing.empty()) {
        const std::string draw_it =
            frame.scene->sheet
                ? ""
                : "; --lines " + to_string(frame.scene->lines.classes | LineClass::mark) + " has it, too";
        std::fprintf(stderr, "burin: note: %s%s\n", missing.c_str(), draw_it.c_str());
        return;
    }
    std::uint64_t count = 0;
    for (const SurfaceInstance& instance : frame.surfaces.instances) count += instance.mesh->loose_edges.size();
    if (count > 0 && !method.draws_loose_edges && method.draws.has(LineClass::mark)) {
        const std::string lines = count == 1 ? "1 line" : std::to_string(count) + " lines";
        std::fprintf(
            stderr,
            "burin: note: method %s draws edges of polygons only, and leaves out %s of the input; abuffer draws them\n",
            std::string(method.name).c_str(), lines.c_str());
    }
}

/// Notes a sheet whose colour is hardly seen on the paper, where nothing else lies below its lines.
void note_pale_ink(const Frame& frame) {
    const Scene& scene = *frame.scene;
    if (!scene.sheet || scene.picture.transparent || surfaces_have_look(scene)) return;
    for (const SheetParameter& p : scene.sheet->parameters) {
        if (p.name != "color" || p.value.kind != StyleValue::Kind::color) continue;
        const glm::vec3 paper = scene.picture.background.value_or(glm::vec3(1.0f));
        const glm::ivec3 off =
            glm::abs(srgb_codes({p.value.color[0], p.value.color[1], p.value.color[2]}) - srgb_codes(paper));
        if (std::max({off.r, off.g, off.b}) >= kHardlySeen) continue;
        std::fprintf(stderr,
                     "burin: note: the color of the style sheet is about as pale as the paper, or as dark, so that "
                     "little is seen; choose another --background or --color\n");
    }
}

}  // namespace

void note_limits(const Arguments& a, const Frame& frame, const Method& method, bool has_hidden_lines,
                 const std::vector<OutputOptions>& outputs) {
    if (a.quiet) return;
    const auto count = [&](const auto& is_it) {
        return static_cast<std::size_t>(
            std::count_if(outputs.begin(), outputs.end(), [&](const OutputOptions& o) { return is_it(o.format); }));
    };
    const std::size_t paths = count(is_vector), exrs = count([](OutputFormat f) { return f == OutputFormat::exr; });
    const bool are_paths = paths == outputs.size(), are_exr = exrs == outputs.size();
    if (a.names_layers && exrs == 0) {
        std::fputs("burin: note: only an EXR has --layers; this file gets the beauty layer\n", stderr);
    }
    if (a.has_vector_options && paths == 0) {
        std::fputs("burin: note: --tolerance, --chord-sag, --dashes, --group, --ids and --merge are for vector files\n",
                   stderr);
    }
    if (are_paths && a.bits != Arguments().bits)
        std::fputs("burin: note: --bits is for PNG and TIFF; paths have no bits per value\n", stderr);
    if (a.page == PagePreset::laser && a.line_width_px && paths > 0) {
        std::fputs("burin: note: --page laser makes all lines 0.01 mm wide; --line-width changes nothing here\n",
                   stderr);
    }
    if (are_exr && (a.bits != Arguments().bits || !a.background.empty())) {
        std::fputs(
            "burin: note: --bits and --background are for PNG and TIFF; an EXR is half precision without paper\n",
            stderr);
    }
    if (paths > 0 && surfaces_have_look(*frame.scene) && !draws_regions(*frame.scene, a)) {
        std::fprintf(stderr, "burin: note: --page %s has lines only; the surfaces are left out\n",
                     std::string(page_of(a.page).name).c_str());
    }
    const auto note_if_unused = [&](bool is_given, const char* option, std::string_view user) {
        if (!is_given || method.name == user) return;
        std::fprintf(stderr, "burin: note: %s is for method %s and changes nothing here\n", option,
                     std::string(user).c_str());
    };
    note_if_unused(a.mask_bits.has_value(), "--mask", "patel");
    note_if_unused(a.samples_per_pixel.has_value(), "--samples", "abuffer");
    note_if_unused(a.gbuffer_operators.has_value(), "--operator", "gbuffer");
    note_if_unused(a.supersample.has_value(), "--supersample", "gbuffer");
    note_if_unused(has_hidden_lines, "lines.hidden", "abuffer");
    note_if_unused(has_transparent_surfaces(*frame.scene), "the opacity of materials", "abuffer");
    const LineSettings& lines = frame.scene->lines;
    note_loose_edges(frame, method);
    if (paths + exrs < outputs.size()) note_pale_ink(frame);
    const auto missing = LineClassSet::from_bits(lines.classes.bits & ~unsigned{method.draws.bits});
    if (!missing.empty()) {
        std::fprintf(stderr, "burin: note: method %s cannot draw %s\n", std::string(method.name).c_str(),
                     to_string(missing).c_str());
    }
    if (lines.style.side != StrokeSide::both && method.name != "abuffer" && method.name != "patel" &&
        method.name != "reference") {
        std::fprintf(
            stderr,
            "burin: note: method %s draws strokes on both sides; lines.side is for abuffer, patel and reference\n",
            std::string(method.name).c_str());
    }
    note_if_unused(lines.style.filter != PixelFilter::box, "lines.filter", "abuffer");
    note_if_unused(lines.style.dash_px.has_value(), "lines.dash", "abuffer");
    note_if_unused(lines.contours != Contours::mesh, "lines.contours", "abuffer");
    if (lines.crease_fade_deg > 0 && method.name != "abuffer") {
        std::fprintf(stderr, "burin: note: method %s fades no creases; it draws them from %.4g degrees on\n",
                     std::string(method.name).c_str(), lines.crease_angle_deg);
    }
    const double wanted = lines.style.width_px;
    const double drawn = patel_line_width_px(frame.scene->patel.mask_bits, wanted);
    if (method.name == "patel" && std::abs(drawn - wanted) > 0.01 * wanted) {
        std::fprintf(stderr, "burin: note: method patel draws lines %.3g px wide with %d-bit masks, not %.3g px\n",
                     drawn, frame.scene->patel.mask_bits, wanted);
    }
    const double gbuffer_px = gbuffer_line_width_px(*frame.scene);
    if (method.name == "gbuffer" && std::abs(gbuffer_px - wanted) > 0.01 * wanted) {
        std::fprintf(stderr,
                     "burin: note: method gbuffer draws lines about %.3g px wide, by direction %.2g to %.2g px, "
                     "with --supersample %d, not %.3g px\n",
                     gbuffer_px, gbuffer_px / std::sqrt(2.0), gbuffer_px * std::sqrt(2.0),
                     frame.scene->gbuffer.supersample, wanted);
    }
}

}  // namespace burin
