#pragma once

#include <functional>

// Methods are compared at equal width, so each is asked for the width at which its lines have it.

namespace burin {

/// Which width to ask a method for so that its strokes have the width that is wanted.
struct WidthMatch {
    double asked_px = 0;     ///< ask for this
    double measured_px = 0;  ///< and the strokes have this integrated width
    bool matches = false;    ///< measured is wanted, up to 2 %
};

/// `measure(asked)` draws with a width and measures the strokes; it is called a few times at most.
/// Methods may draw only certain widths, or always the same: then the match says so, and stays at
/// the width that was wanted.
WidthMatch match_width(double wanted_px, const std::function<double(double asked_px)>& measure);

}  // namespace burin
