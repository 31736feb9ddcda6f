#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "image/deflate.h"
#include "image/image.h"
#include "scene/scene.h"

namespace burin {

/// A picture as it is sent to a page.
struct PictureBytes {
    std::string_view format;  ///< "png", where all colours are grey; else "qoi"
    std::vector<std::uint8_t> bytes;
};

/// PictureEncoder makes of films what a page shows, with the values that a PNG of `burin render` has, in little time: a
/// PNG of one channel where all is grey, else a QOI (qoiformat.org), which a page unpacks itself.
class PictureEncoder {
  public:
    /// `image`: with channels R, G, B, A of half precision, premultiplied, for all pixels of the picture.
    PictureBytes encode(const Image& image, const PictureSettings& picture);

  private:
    std::vector<std::uint8_t> rows_;    ///< of a PNG: each behind the number of its filter, which is none
    std::vector<std::uint32_t> codes_;  ///< of each pixel: red, green, blue, from the lowest byte on
    Deflater deflater_;
};

}  // namespace burin
