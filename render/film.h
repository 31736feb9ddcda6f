#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "image/image.h"
#include "image/image_strip.h"
#include "kernels/tile_kernels.h"
#include "lines/line_class.h"
#include "render/crypto_layers.h"
#include "render/drawn_spans.h"

namespace burin {

class Mattes;

/// The layers that an output file can have.
struct LayerSet {
    bool beauty = true;         ///< R G B A: surfaces and lines together
    bool lines = true;          ///< lines.R G B A
    bool depth = true;          ///< Z
    bool normal = true;         ///< N.X N.Y N.Z
    bool ids = true;            ///< id.object id.material id.polygon
    bool coverage = false;      ///< coverage.silhouette, ... one per class drawn
    bool surface = false;       ///< surface.R G B A
    bool lines_hidden = false;  ///< lines_hidden.R G B A
    /// NAME of each lines_NAME.R G B A: the strokes of one line set alone.
    std::vector<std::string> line_sets = {};
    CryptoLayerSet crypto = {};  ///< CryptoObject00.R ...
    int crypto_ranks = 6;        ///< how many names a pixel has room for, in each of them
    bool line = false;           ///< line.object ...: the line that covers most of a pixel
    bool motion = false;         ///< forward.u forward.v
    bool deep = false;           ///< samples of a deep file, beside all channels
    bool deep_hidden = false;    ///< hidden lines among them
};

/// What a method finds out about one pixel. Colours are linear and premultiplied.
struct PixelResult {
    glm::vec4 beauty{0.0f};
    glm::vec4 lines{0.0f};  ///< a = coverage of all lines drawn
    glm::vec4 surface{0.0f};
    std::array<float, kLineClassCount> coverage{};
    float distance;          ///< along the view axis, world units; infinite for the background
    glm::vec3 normal{0.0f};  ///< world space, towards the eye
    std::uint32_t object_id = 0;
    std::uint32_t material_id = 0;
    std::uint32_t polygon_id = 0;
};

/// A colour as it is kept: half precision, linear, premultiplied.
using HalfColor = std::array<std::uint16_t, 4>;

/// Lines of one pixel, to be drawn over what is there.
struct LinePixel {
    glm::vec4 color{0.0f};  ///< linear, premultiplied; a = coverage of all lines
    std::array<float, kLineClassCount> coverage{};
};

/// Lines of one pixel in the form in which a film keeps them. Many pixels have the same lines, so it is made once for
/// them.
struct LineInk {
    LineInk() = default;
    explicit LineInk(const LinePixel& lines);
    /// Of one class.
    LineInk(const glm::vec4& color, LineClass its_class, float coverage);

    glm::vec4 color{0.0f};
    HalfColor half_color{};
    std::array<std::uint16_t, kLineClassCount> coverage{};
};

/// Hidden lines of one pixel, in the same way: `seen` is the part of them that no visible line will cover, as share of
/// what will be left.
struct HiddenInk {
    HiddenInk(const glm::vec4& color, const glm::vec4& seen_part);

    HalfColor half_color;
    glm::vec4 seen;
};

/// Lines of one pixel that do not simply cover what is there. What is there, a colour c with alpha a, becomes `color +
/// through * c + (1 - a) * tint`, and as little of 1 - a is left as `left` says.
struct InkOver {
    glm::vec3 color{0.0f};
    glm::vec3 through{1.0f};
    glm::vec3 tint{0.0f};
    float left = 1;
};

/// Film collects pixels into the channels of the chosen layers. Different threads may put different pixels at the same
/// time.
///
/// A film lies in memory as a whole, or in blocks, of which there are only those that something was put into, until
/// their band, a row of blocks, is closed: so a picture whose rows are written as they are finished takes no more than
/// some of them, and its background nothing.
class Film {
  public:
    static constexpr int kBandRows = 32;  ///< whole chunks of an EXR
    static constexpr int kBlockColumns = 32;

    /// `display` is the whole picture, `crop` the part that pixels are put for: each of them must be. Throws InputError
    /// when this machine has not enough memory for it.
    Film(PixelRect display, PixelRect crop, const LayerSet& layers, LineClassSet classes);
    /// Makes a film in blocks. What is not put is background. Putting throws InputError when this machine has not
    /// enough memory for the blocks that are there.
    static Film in_bands(PixelRect display, PixelRect crop, const LayerSet& layers, LineClassSet classes);
    ~Film();
    Film(Film&&) noexcept;
    Film& operator=(Film&&) noexcept;

    /// A copy of a whole film, so that one can be drawn on and the other kept.
    Film copy() const;

    /// Whether the film lies in memory as a whole.
    bool is_whole() const { return blocks_.size() == 1 && row_shift_ == kWholeShift; }
    PixelRect display() const { return display_; }
    PixelRect crop() const { return crop_; }
    /// Those that have pixels here. What is made of mattes() comes beside them.
    std::vector<ChannelFormat> channels() const;
    /// Whose pixels are, for layers that ask for it; nullptr: none does. They are as constant as a pointer is.
    Mattes* mattes() const { return mattes_.get(); }
    /// The rows of one band of a film in blocks.
    ImageStrip band(std::size_t number) const;
    /// Gives up the memory of a band that was read, to be used for others.
    void close(std::size_t number);

    /// Calls use(part) for the parts of a rectangle, within the crop, that lie in one block each.
    template <typename Use>
    void for_parts(PixelRect rect, const Use& use) const {
        for (int y = rect.y0, y1; y < rect.y1; y = y1) {
            y1 = std::min(rect.y1, first_of_next(y, crop_.y0, row_shift_));
            for (int x = rect.x0, x1; x < rect.x1; x = x1) {
                x1 = std::min(rect.x1, first_of_next(x, crop_.x0, column_shift_));
                use(PixelRect{x, y, x1, y1});
            }
        }
    }

    /// Says that all pixels of a part of one block will be put, with surfaces or without: where the part is the whole
    /// block, this need not begin as background. Due before put_color() and put_colors().
    void expect_all_of(PixelRect part);
    void put(int x, int y, const PixelResult& pixel);
    /// Whether any layer of depth, normals or ids is kept.
    bool has_geometry() const;
    /// Puts the colours of pixels [x0, x1) of a row without lines, one for all or one for each, channel by channel.
    void put_color(int x0, int x1, int y, const HalfColor& color);
    void put_colors(int x0, int x1, int y, const std::array<const std::uint16_t*, 4>& colors);
    /// Has the memory of beauty and lines fetched that either will write: another core may have it. The pixels lie in
    /// one block; where that is not made yet, nothing happens.
    void prefetch_color(int x0, int x1, int y) const;
    /// Puts depth, normals and ids of pixels [x0, x1) of a row, if has_geometry(). Before other threads read these,
    /// finish_stream_stores() is due.
    void put_geometry(int x0, int x1, int y, const GeometryRow& row);
    /// Where put_geometry() would copy a row of a film in blocks to, one that begins with this pixel and lies in one
    /// block: so that the row may be made there. Layers that are not kept have their place in `spare`.
    GeometryRow geometry_place(int x, int y, const GeometryRow& spare);
    /// Puts where the surfaces of pixels [x0, x1) of a row are one frame later, in pixels to the right and up.
    void put_motion(int x0, int x1, int y, const float* right, const float* up);
    /// Puts the background into pixels [x0, x1) of a row that nothing else is put into; then finish_stream_stores() is
    /// due, too.
    void put_background(int x0, int x1, int y);
    /// Has the memory fetched that draw_over() will change of a pixel and of those to its right, up to 32 pixels in
    /// all.
    void prefetch(int x, int y) const;
    /// Draws lines over a pixel that was put without any.
    void draw_over(int x, int y, const LinePixel& lines) { draw_over(x, y, LineInk(lines)); }
    void draw_over(int x, int y, const LineInk& lines);
    /// A number in the form in which colours are kept. Half precision holds 0..1 well; what is beyond its range becomes
    /// its largest number.
    static std::uint16_t to_half(float value);
    /// Replaces the surface of a pixel that was put without lines.
    void replace_surface(int x, int y, const glm::vec4& color);
    /// Puts the hidden lines' own channels, and draws what is seen of them over the pixel. Due before draw_over().
    void draw_hidden(int x, int y, const HiddenInk& lines);
    /// Draws lines over the beauty of a pixel alone.
    void draw_over_beauty(int x, int y, const InkOver& ink);
    /// Puts the channels of visible lines, of hidden ones, and of one of the sets with a layer, and nothing else.
    void put_lines(int x, int y, const LineInk& lines);
    void put_hidden(int x, int y, const glm::vec4& color);
    void put_line_set(int x, int y, std::size_t set, const glm::vec4& color);
    const LayerSet& layers() const { return layers_; }
    /// Adds to the line channels, but not to the beauty. Due after draw_over().
    void add_lines(int x, int y, const LinePixel& lines);
    /// Says that every pixel was put and all was drawn. Another picture may be put then, for which background is not
    /// cleared again where there was nothing else. Without this call another one may be put, too.
    void end_picture() { drawn_.end_picture(); }
    /// All pixels of a whole film.
    const Image& image() const { return block_of(0)->image; }
    Image& image() { return block_of(0)->image; }

  private:
    struct HalfPlanes {
        std::uint16_t* of[4] = {};
    };
    struct Planes {  // channel data, nullptr where a layer is not wanted
        std::uint16_t* beauty[4] = {};
        std::uint16_t* lines[4] = {};
        std::uint16_t* surface[4] = {};
        std::uint16_t* lines_hidden[4] = {};
        std::array<std::uint16_t*, kLineClassCount> coverage{};
        std::vector<HalfPlanes> line_sets;
        float* depth = nullptr;
        float* normal[3] = {};
        std::uint32_t* ids[3] = {};
        float* motion[2] = {};
    };
    struct Block {
        Image image;
        Planes planes;
    };
    struct Pool;

    /// Blocks have 2^`column_shift` columns and 2^`row_shift` rows.
    Film(PixelRect display, PixelRect crop, const LayerSet& layers, LineClassSet classes, int column_shift,
         int row_shift);
    /// The first pixel of the next block, along one axis.
    static int first_of_next(int at, int origin, int shift) {
        const std::int64_t next = ((std::int64_t{at} - origin) >> shift) + 1;
        return static_cast<int>(std::min<std::int64_t>(origin + (next << shift), std::numeric_limits<int>::max()));
    }
    PixelRect rect_of(std::size_t block) const;
    std::unique_ptr<Block> make_block(PixelRect rect) const;
    void fill_with_background(Block& block) const;
    void check_memory(std::size_t pixels) const;
    Block& add_block(std::size_t number, bool all_is_put = false);
    /// The block with this number, nullptr where it is missing.
    Block* block_of(std::size_t number) const { return blocks_[number].load(std::memory_order_acquire); }
    std::size_t number_of(int x, int y) const {
        const auto column = static_cast<std::size_t>(x - crop_.x0) >> column_shift_;
        return (static_cast<std::size_t>(y - crop_.y0) >> row_shift_) * columns_ + column;
    }
    /// The block with a pixel, and the pixel's place in it.
    struct Place {
        const Planes& planes;
        std::size_t index;
    };
    Place place_of(int x, int y);
    void note_drawn(int x, int y) { drawn_.note(x - crop_.x0, y - crop_.y0); }
    /// Calls use(planes, first place, count, pixels before) for the parts of pixels [x0, x1) of a row.
    template <typename Use>
    void for_row(int x0, int x1, int y, const Use& use);

    static constexpr int kWholeShift = 31;  // one block has all

    PixelRect display_, crop_;
    LayerSet layers_;
    LineClassSet classes_;
    int column_shift_, row_shift_;
    std::size_t columns_;  // of blocks
    std::size_t bytes_per_pixel_ = 0;
    std::vector<std::atomic<Block*>> blocks_;
    std::unique_ptr<Pool> pool_;
    DrawnSpans drawn_;  // of a whole film
    std::unique_ptr<Mattes> mattes_;
};

}  // namespace burin
