#pragma once

#include "scene/scene.h"

namespace burin {

/// Has a camera see what is within the margins of its picture's paper, at the height that its scale says. Throws
/// InputError (message without a place) for a scale of a perspective view, and for margins that leave nothing.
void see_on_paper(const PictureSettings& picture, CameraSettings& camera);

}  // namespace burin
