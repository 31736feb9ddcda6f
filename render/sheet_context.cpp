#include "render/sheet_context.h"

namespace burin {

SheetContext sheet_context_of(const Frame& frame) {
    const Scene& scene = *frame.scene;
    SheetContext context;
    for (const SceneObject& object : scene.objects) context.objects.push_back(object.name);
    for (const Material& material : scene.materials) context.materials.push_back(material.name);
    context.width_px = frame.width;
    context.height_px = frame.height;
    context.px_per_mm = scene.picture.dpi / 25.4;
    context.frame = scene.frame.number;
    context.fps = scene.frame.fps;
    context.shaders = scene.line_shaders.get();
    return context;
}

}  // namespace burin
