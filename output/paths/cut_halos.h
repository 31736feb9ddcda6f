#pragma once

#include "image/image.h"
#include "shading/ink/inked_lines.h"
#include "view/projection.h"

namespace burin {

/// Cuts strokes where the halos of others erase them: these are so much nearer, and so close. Ends of a round pen stay
/// outside of halos, too. What has no halos comes back as it was. `lines`: with origins.
InkedLines with_halos_cut(InkedLines lines, const Projection& projection, PixelRect picture);

}  // namespace burin
