#pragma once

#include <cstdint>

// A pass is the state of the z-buffered machine while polygons or edges are drawn.

namespace burin {

/// A fragment passes if its z compares like this with the stored one.
enum class DepthTest : std::uint8_t { never, less, less_equal, always };
/// How the pixel's bit must compare with the pass's reference.
enum class BitTest : std::uint8_t { always, equal, not_equal };
/// What becomes of the pixel's bit.
enum class BitOp : std::uint8_t { keep, replace };  // replace: by the reference

/// The state of the machine during one pass. Each pixel has one bit beside colour and z: the
/// stencil of OpenGL, the edging plane or the virgin bit of Herrell, Baldwin and Wilcox.
struct Pass {
    DepthTest depth_test = DepthTest::less;
    bool writes_depth = true;
    bool writes_frame = true;

    BitTest bit_test = BitTest::always;
    bool reference = true;  ///< of the test and of the operations
    BitOp on_bit_fail = BitOp::keep;
    BitOp on_depth_fail = BitOp::keep;
    BitOp on_pass = BitOp::keep;
    /// Where the bit is set, the depth test passes whatever is stored.
    bool bit_passes_depth = false;
};

/// Added to z before it is compared and stored: constant + factor * slope + units * smallest step,
/// but no more than the clamp; see glPolygonOffset.
struct DepthOffset {
    double constant = 0;
    double factor = 0;  ///< of max(|dz/dx|, |dz/dy|) of the polygon
    double units = 0;   ///< of the smallest step of z
    double limit = 1;   ///< of the magnitude
    double sign = 1;    ///< -1: towards the eye
};

}  // namespace burin
