#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lines/line_class.h"
#include "methods/explained_line.h"
#include "methods/explained_names.h"
#include "methods/undrawn_lines.h"
#include "render/frame.h"
#include "shading/ink/stroke_values.h"

namespace burin {

/// A variable that a style, its shader or its test reads, and its value at a place.
struct ExplainedVariable {
    std::string name;
    std::vector<std::pair<std::size_t, float>> components;  ///< those that are read; one of a number
    bool is_triple = false;
};

/// A stroke whose halo erases others, and what it erases of one.
struct ErasingStroke {
    std::string set;
    LineClass drawn_as = LineClass::silhouette;
    ExplainedSide front;
    std::uint32_t chain = 0;
    double share = 0;  ///< of the pixel, by itself
};

/// A stroke that a style sheet draws in a pixel.
struct ExplainedStroke : ExplainedLine {
    std::string set, style;
    std::vector<RefusedSet> earlier_sets;
    std::uint32_t chain = 0;
    std::uint32_t copy = 0;
    double s_px = 0, length_px = 0;  ///< way along the chain, and its length
    double area = 0;                 ///< share of the pixel that it would cover if its ink were opaque
    double covers = 0, shows = 0;    ///< shares of the pixel: with ink, and of that what is left to be seen
    double erased = 0;               ///< share of the pixel that halos take from `covers`
    std::vector<ErasingStroke> erased_by;
    InkValues ink;     ///< where the line is nearest to the pixel
    double taper = 1;  ///< what the width has been multiplied by
    /// The opacity: by `min_length`, a fading crease, what is in front, and for a short run that is moved far.
    double min_length = 1, fade = 1, seen = 1, moved = 1;
    /// How the values stand in the sheet: "=1 + t", "ramp over depth"; empty: constants.
    std::array<std::string, kInkValueCount> sources;
    std::string shader, test;          ///< that change them; empty: none
    std::vector<ExplainedName> names;  ///< parameters and lets in `sources`
    std::vector<ExplainedVariable> variables;
};

/// What a frame's style sheet draws in one pixel.
struct ExplainedPlace {
    int x = 0, y = 0;
    int width = 0, height = 0;             ///< of the whole picture
    std::vector<ExplainedStroke> strokes;  ///< the topmost first
    std::vector<UndrawnLine> undrawn;      ///< lines near the pixel of which no ink is in it
};

ExplainedPlace explain_strokes(const Frame& frame, int x, int y, int threads = 0);

/// The strokes of the pixel with ink that is nearest to another one, at most `reach_px` away; of equally near ones, of
/// the first one in reading order. If no ink is so near, it is the pixel itself. It has no undrawn lines.
ExplainedPlace explain_strokes_near(const Frame& frame, int x, int y, int reach_px, int threads = 0);

/// Why there are lines, in a sentence for each: their class, and what the surface does there. A line is told once,
/// whatever number of its strokes reach the pixel.
std::vector<std::string> reasons_of(const std::vector<ExplainedStroke>& strokes);

/// What is known of a pixel for readers, and for programs as JSON (docs/shading/sheets.md).
std::string text_of(const ExplainedPlace& place);
std::string json_of(const ExplainedPlace& place);

}  // namespace burin
