#include <string>
#include <string_view>

#include "burin/failure.h"
#include "burin/running.h"
#include "mesh/text_scan.h"
#include "methods/explain_strokes.h"

using namespace burin;

const char* burin_explain(burin_scene* scene, const burin_view* view, const burin_options* options, int x, int y,
                          const char* format) {
    return guarded_pointer([&] {
        const std::string_view wanted = &required(format, "format");
        if (wanted != "text" && wanted != "json")
            throw UsageError("format: must be \"text\" or \"json\", not '" + printable(wanted) + "'");
        const FrameCall call(scene, view, options);
        const Frame& frame = call.ready().frame();
        if (!frame.sheet) throw UsageError("the scene has no style sheet; burin_set_style() gives it one");
        const PixelRect& crop = frame.crop;
        if (x < crop.x0 || x >= crop.x1 || y < crop.y0 || y >= crop.y1)
            throw UsageError("x, y: must be a pixel of the picture, within its crop");
        const ExplainedPlace place = explain_strokes(frame, x, y, call.given().threads);
        scene->explanation = wanted == "json" ? json_of(place) : text_of(place);
        return scene->explanation.c_str();
    });
}
