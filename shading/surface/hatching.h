#pragma once

#include <glm/glm.hpp>

namespace burin {

/// How much of a place parallel lines cover.
///
/// A hatching has levels of lines, each of another direction, that come one after the other: a level's lines grow from
/// nothing to a share of the area, then the next level begins. Lines of levels cross without heed of each other, so
/// what they leave free together is the product of what each leaves free; this is the tone.
struct HatchLevels {
    int count = 1;
    /// The share of the area that the lines of a level cover where the tone is so.
    double coverage(int level, double tone) const;
};

/// The part of an interval that lines cover: lines lie around the whole numbers and have this width. `place`: the
/// middle of the interval; `length`: its length, greater than 0. The mean over all places is the width, exactly.
double covered_by_lines(double place, double length, double width);

/// The same of lines that are drawn at a distance which doubles and doubles again, as places get denser on the screen:
/// `place` counts lines of a distance of 1, `per_px` is by how much it changes over a pixel. Every other line
/// comes and goes as they do; those that are there are from half of `spacing_px` to all of it apart.
double covered_by_adaptive_lines(double place, double per_px, double spacing_px, double width);

}  // namespace burin
