#include "cli/commands.h"

#include <cstdio>
#include <string>

#include "base/json_writer.h"
#include "cli/blur.h"
#include "cli/job.h"
#include "cli/sheet_refusal.h"
#include "mesh/model.h"
#include "methods/abuffer.h"
#include "methods/explain_strokes.h"
#include "methods/patel/explain.h"
#include "render/close_cracks.h"
#include "render/copied_objects.h"

namespace burin {

void run_explain(const Arguments& a) {
    if (!a.method.empty() && a.method != "abuffer" && a.method != "patel") {
        throw UsageError("--method: only the masks of abuffer and patel can be explained, not those of " + a.method);
    }
    Still still = load_still(a);
    Scene& scene = still.scene;
    if (a.method == "patel") refuse_sheet(scene, "method patel draws no style sheets");
    const Camera& camera = still.camera;
    note_missing_blur(scene, camera, a, "burin explain");
    empty_copied_objects(scene);
    close_cracks(scene, camera, scene.picture.width, scene.picture.height, a.threads);
    const Frame frame = frame_of(scene, camera, a);
    const auto [x, y] = *a.pixel;
    if (x < 0 || y < 0 || x >= frame.width || y >= frame.height) {
        throw UsageError("--pixel: must lie within the image of " + std::to_string(frame.width) + "x" +
                         std::to_string(frame.height) + " pixels");
    }
    if (a.json) {
        if (!frame.sheet) throw UsageError("--json: has the strokes of a style sheet; give one with --style");
        std::fputs(json_of(explain_strokes(frame, x, y, a.threads)).c_str(), stdout);
        return;
    }
    const bool is_model = !a.size && !a.paper_mm && a.page == PagePreset::none && is_model_file(a.input);
    if (frame.sheet || is_model)
        std::printf("pixel %d,%d of a picture of %dx%d pixels%s\n", x, y, frame.width, frame.height,
                    is_model ? "; --size WxH asks for another one" : "");
    if (frame.sheet) std::printf("%s\n", text_of(explain_strokes(frame, x, y, a.threads)).c_str());
    std::fputs(explain_pixel(frame, x, y).c_str(), stdout);
    if (!frame.sheet && a.method != "patel") std::fputs(drawn_by_abuffer(frame, x, y).c_str(), stdout);
}

void run_methods(const Arguments& a) {
    if (!a.json) {
        for (const Method& m : methods()) {
            std::printf("%-16s %s\n%-16s draws %s\n", std::string(m.name).c_str(), std::string(m.source).c_str(), "",
                        to_string(m.draws).c_str());
        }
        return;
    }
    JsonWriter json;
    json.begin_object().key("methods").begin_array();
    for (const Method& m : methods()) {
        json.begin_object();
        json.key("name").value(m.name);
        json.key("source").value(m.source);
        json.key("draws").begin_array();
        for (std::size_t c = 0; c < kLineClassCount; ++c) {
            if (m.draws.has(static_cast<LineClass>(c))) json.value(kLineClassNames[c]);
        }
        json.end_array().end_object();
    }
    json.end_array().end_object();
    std::fputs(json.text().c_str(), stdout);
}

}  // namespace burin
