#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/unfilled_vector.h"
#include "image/deflate.h"
#include "image/image_strip.h"

// EXR compresses bytes in an order of its own, into which rows of a film are brought here.

namespace burin {

/// Rows of a strip as an EXR has them in a chunk: one after the other, each of them channel by channel.
class RowPacker {
  public:
    /// Rows [first_row, end_row) of the strip. `order`: of the channels, whose types are given.
    RowPacker(const ImageStrip& strip, std::span<const PixelType> types, std::span<const std::size_t> order,
              int first_row, int end_row);

    /// How many bytes they are.
    std::size_t size() const { return row_size_ * rows_; }
    /// The bytes as they are.
    void raw(std::vector<std::uint8_t>& bytes) const;
    /// Puts the bytes in the order in which they are compressed (OpenEXR's "zip" with its predictor): first all bytes
    /// of even number and then the others, each as the difference to the byte before, plus 128. `runs` are those of
    /// missing blocks.
    void packed(UnfilledVector<std::uint8_t>& bytes, std::vector<Deflater::Run>& runs) const;

  private:
    /// A block, or missing ones side by side.
    struct Part {
        const Image* block;
        std::size_t x, width;
    };
    struct Plane {  // of one channel
        std::size_t channel, pixel_size;
        std::size_t place;  // of its first byte in a row
    };
    /// What a part has in a plane.
    struct PartRows {
        const std::uint8_t* first;
        std::size_t stride, size;  // 0 and a pixel's if the part is missing
        std::span<const std::uint8_t> row(std::size_t y) const { return {first + y * stride, size}; }
    };
    PartRows rows_of(const Part& part, const Plane& plane) const;
    /// The part of a row that is before another one, in the order of bytes.
    std::span<const std::uint8_t> row_before(std::size_t part, std::size_t plane, std::size_t y) const;

    const ImageStrip& strip_;
    std::size_t first_row_, rows_;
    std::vector<Part> parts_;    // from the left
    std::vector<Plane> planes_;  // in order
    std::size_t row_size_ = 0;
};

}  // namespace burin
