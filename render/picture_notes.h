#pragma once

#include <string>
#include <vector>

#include "render/frame.h"

// Notes on a picture: what its user should know before it surprises. Empty texts: there is nothing to say.

namespace burin {

/// Lines of the input that are missing since the class mark is not drawn.
std::string note_on_missing_marks(const Frame& frame);
/// Keys of [lines], "width", that nothing reads beside a style sheet.
std::string note_on_unread_keys(const std::vector<std::string>& keys);
/// What is said where scene and sheet have [surfaces].
constexpr const char* kSheetSurfacesAreUnread =
    "the scene's own [surfaces] stay; those of the style sheet change nothing; take them out of the scene to have the "
    "sheet's";
/// A blur that the scene has, and that `who` ("burin explain") does not draw.
std::string note_on_missing_blur(bool has_shutter, const Camera& camera, const std::string& who);
/// What a picture of a scene is that the camera does not look at.
constexpr const char* kNoSurfaceIsSeen = "no sample of the picture sees a surface; does the camera look at the scene?";

}  // namespace burin
