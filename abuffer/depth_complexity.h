#pragma once

#include "abuffer/screen/triangle_bins.h"
#include "image/image.h"
#include "render/depth_limit.h"

// A picture that would take very long, since surfaces lie over each other by the thousand, is refused before it is
// made.

namespace burin {

/// Adds up the depth complexity of a picture, slice by slice.
class DepthComplexity {
  public:
    DepthComplexity(const DepthLimit& limit, PixelRect picture) : limit_(limit), picture_(picture) {}

    /// Counts the triangles of a slice, as far as they are in the picture. Throws InputError with the depth
    /// complexity up to there if that is more than the limit.
    void add(const ScreenSurfaces& screen, const TriangleBins& bins, PixelRect region, int threads);

  private:
    DepthLimit limit_;
    PixelRect picture_;
    double covered_px_ = 0;
};

}  // namespace burin
