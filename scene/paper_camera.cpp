#include "scene/paper_camera.h"

namespace burin {

void see_on_paper(const PictureSettings& picture, CameraSettings& camera) {
    camera.area = area_within_margins(picture);
    const PaperSettings& paper = picture.paper;
    if (camera.pixel_aspect != 1 && (paper.size_mm || paper.scale)) {
        throw InputError("pixels on paper are square; remove the camera's pixel_aspect, or the paper");
    }
    if (!paper.scale) return;
    if (!camera.orthographic) {
        throw InputError(
            "only an orthographic view has a scale; make the camera one (--set camera.projection=orthographic), or "
            "remove the scale");
    }
    camera.height = size_within_margins_mm(picture).y / (*paper.scale * paper.unit_mm.value_or(1));
}

}  // namespace burin
