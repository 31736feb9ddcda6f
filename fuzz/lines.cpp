// Reads its input as a file of lines and draws them with a style sheet that reads what files have. Anything must end in
// a picture or in an InputError.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "fuzz/scratch_folder.h"
#include "methods/abuffer.h"
#include "output/lines_file.h"
#include "render/sheet_context.h"
#include "scene/sheet_toml.h"
#include "shading/ink/found_needs.h"
#include "shading/sheet/compiled_sheet.h"

namespace {

constexpr int kMostPixels = 4096;  // of a picture that is drawn

std::string all_classes() {
    std::string list;
    for (const std::string_view name : burin::kLineClassNames)
        list += (list.empty() ? "\"" : ", \"") + std::string(name) + "\"";
    return "classes = [" + list + "]\n";
}

/// Plain lines, and lines that all kinds of variables decide: the others need more than many files have.
const std::string kSheets[] = {"[[set]]\nname = \"all\"\n" + all_classes() + R"toml(
style = "ink"
[style.ink]
width = "=1 + 0.1 * depth"
dash = [3, 2]
halo = 2
)toml",
                               R"toml(
[[set]]
name = "all"
classes = ["border", "silhouette"]
qi = [0, 255]
style = "ink"
[style.ink]
width = "=2 * facing + gap_px / 100 + s / length"
opacity = "=0.5 + 0.5 * t"
color = "=mix(C, C2, rand_chain)"
taper = { start = 4, end = 4 }
overshoot = 2
copies = 2
wobble = { amplitude = 1, wavelength = 8 }
)toml",
                               "[[set]]\nname = \"all\"\nclasses = [\"border\", \"silhouette\"]\nstyle = \"ink\"\n"
                               "[style.ink]\nwidth = \"=1 + lit\"\n"};

void draw(const burin::FoundLines& lines, const std::string& text) {
    burin::Scene scene;
    scene.picture.width = lines.width_px;
    scene.picture.height = lines.height_px;
    for (const burin::ObjectOfLines& object : lines.objects) {
        burin::SceneObject named;
        named.name = object.name;
        scene.objects.push_back(named);
    }
    for (std::size_t i = 0; i < lines.materials.size(); ++i)
        scene.materials.push_back({lines.materials[i], lines.material_colors[i]});
    scene.sheet = std::make_shared<burin::StyleSheet>(burin::read_sheet_text(text, "s.toml"));
    scene.lines.style.filter = lines.filter;
    burin::Frame frame;
    frame.scene = &scene;
    frame.width = lines.width_px;
    frame.height = lines.height_px;
    frame.crop = {0, 0, frame.width, frame.height};
    frame.surfaces.projection = lines.projection;
    frame.sheet = std::make_shared<burin::CompiledSheet>(*scene.sheet, burin::sheet_context_of(frame));
    frame.criteria.classes = lines.classes;
    if (!burin::missing_for(*scene.sheet, frame.sheet->needs(), lines).empty()) return;
    burin::LayerSet layers;
    burin::Film film(frame.crop, frame.crop, layers, lines.classes);
    for (int y = 0; y < frame.height; ++y) film.put_background(0, frame.width, y);
    std::vector<std::string> notes;
    burin::draw_found_lines(frame, lines, 1, film, notes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const burin::fuzz::ScratchFolder folder;
    const std::string path = folder.write("input.lines", {data, size});
    try {
        const burin::LinesFile file = burin::read_lines_file(path);
        const bool is_small = file.lines.width_px <= kMostPixels && file.lines.height_px <= kMostPixels &&
                              file.lines.width_px * file.lines.height_px <= kMostPixels;
        if (!is_small) return 0;
        for (const std::string& sheet : kSheets) draw(file.lines, sheet);
    } catch (const burin::InputError&) {
    }
    return 0;
}
