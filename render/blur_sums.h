#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "image/image.h"
#include "image/image_strip.h"
#include "render/film.h"

namespace burin {

/// The layers of a picture that have a mean: colours and coverages. The mean of depths, normals or ids is none.
LayerSet layers_with_mean(LayerSet layers);

/// Whether a channel is one of them.
bool has_mean(const ChannelFormat& channel);

/// BlurSums adds pictures, pixel by pixel, in single precision, in the order of the calls, and gives their mean. It
/// reads their channels that have a mean, which are of half precision, so that up to 2^13 equal pictures have exactly
/// their own values as mean.
class BlurSums {
  public:
    /// `rect`: the pixels that it sums. `channels`: those of the pictures.
    BlurSums(PixelRect rect, const std::vector<ChannelFormat>& channels);

    /// Adds some rows of a picture. Different threads may add different rows at the same time.
    void add(const ImageStrip& rows);
    /// Adds all rows of a picture.
    void add(const Image& picture, int threads);
    /// Puts the mean of so many pictures into the channels of these names; the others stay as they are.
    void put_mean(int count, Image& picture, int threads) const;

  private:
    struct Free {
        void operator()(float* memory) const;
    };
    struct Sum {
        std::string name;
        std::size_t channel;  // its number in the pictures
        std::unique_ptr<float[], Free> values;
    };
    void add_rows(const Image& picture, int y0, int y1);

    PixelRect rect_;
    std::vector<Sum> sums_;
};

}  // namespace burin
