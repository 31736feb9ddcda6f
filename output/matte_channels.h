#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "image/exr_options.h"
#include "image/image.h"
#include "render/film.h"
#include "render/frame.h"
#include "render/matte_names.h"
#include "render/mattes.h"

namespace burin {

/// A layer of Cryptomatte as it stands in the header of a file.
struct CryptoAttributes {
    std::string layer;
    std::vector<ExrAttribute> attributes;
};

/// MatteChannels makes the channels of a file that tell whose pixels are, of a film's mattes: those of Cryptomatte, and
/// the layer `line`. May be used by several threads.
class MatteChannels {
  public:
    /// The film must outlive it, and has mattes.
    MatteChannels(const Frame& frame, const Film& film);

    std::vector<ChannelFormat> formats() const;
    std::vector<CryptoAttributes> attributes() const;
    /// Adds the channels to an image that has all columns of the film and whole rows of its blocks.
    void add_to(Image& image) const;
    /// How often a name had no room in a pixel, in all rows so far.
    std::uint64_t dropped() const { return dropped_; }

  private:
    struct Layer {
        CryptoLayer layer;
        MatteNames names;
    };
    struct Share {
        std::uint32_t id;
        float share;
    };
    void find_shares(const Layer& layer, const Mattes::Pixel& pixel, std::vector<Share>& shares) const;

    const Mattes& mattes_;
    std::size_t ranks_;
    bool has_line_;
    std::vector<Layer> layers_;
    mutable std::atomic<std::uint64_t> dropped_ = 0;
};

}  // namespace burin
