#pragma once

#include <algorithm>

#include "tests/support/drawing.h"

namespace burin::test {

/// Ink of one picture where the other has none within a pixel.
inline double ink_apart(const Drawing& a, const Drawing& b) {
    double apart = 0;
    for (int y = 1; y + 1 < a.height(); ++y) {
        for (int x = 1; x + 1 < a.width(); ++x) {
            double near = 0;
            for (int v = y - 1; v <= y + 1; ++v) {
                for (int u = x - 1; u <= x + 1; ++u) near = std::max(near, b.line(u, v));
            }
            if (near < 0.1) apart += a.line(x, y);
        }
    }
    return apart;
}

}  // namespace burin::test
