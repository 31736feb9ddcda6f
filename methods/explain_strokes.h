#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lines/line_class.h"
#include "render/frame.h"
#include "shading/ink/stroke_values.h"

namespace burin {

/// A line set that did not take a line, and why.
struct RefusedSet {
    std::string set, reason;
};

/// The surface on a side of a line.
struct ExplainedSide {
    std::uint32_t object = 0, material = 0;  ///< their numbers; 0: background, none
    std::string object_name, material_name;
};

/// A variable that a style, its shader or its test reads, and its value at a place.
struct ExplainedVariable {
    std::string name;
    std::vector<std::pair<std::size_t, float>> components;  ///< those that are read; one of a number
    bool is_triple = false;
};

/// A stroke that a style sheet draws in a pixel.
struct ExplainedStroke {
    std::string set, style;
    std::vector<RefusedSet> earlier_sets;
    LineClass drawn_as = LineClass::silhouette;
    LineClassSet classes;                          ///< all that apply
    bool is_edge = false;                          ///< of a mesh; else two surfaces meet there
    double dihedral_deg = 0, crease_from_deg = 0;  ///< of an edge of two polygons, and where creases begin
    ExplainedSide front, other;
    bool other_is_behind = false;  ///< it is seen beside the line, behind it; else it touches the line
    int invisibility = 0;
    std::uint32_t chain = 0;
    std::uint32_t copy = 0;
    double s_px = 0, length_px = 0;  ///< way along the chain, and its length
    double covers = 0, shows = 0;    ///< shares of the pixel: with ink, and of that what other strokes leave to be seen
    InkValues ink;                   ///< where the line is nearest to the pixel
    /// How the values stand in the sheet: "=1 + t", "ramp over depth"; empty: constants.
    std::array<std::string, kInkValueCount> sources;
    std::string shader, test;  ///< that change them; empty: none
    std::vector<ExplainedVariable> variables;
};

/// What a frame's style sheet draws in one pixel, the topmost stroke first.
std::vector<ExplainedStroke> explain_strokes(const Frame& frame, int x, int y, int threads = 0);

/// The pixel with ink that is nearest to another one, and what is drawn in it.
struct ExplainedPlace {
    int x = 0, y = 0;
    std::vector<ExplainedStroke> strokes;
};

/// The same of the nearest pixel with ink, at most `reach_px` away; of equally near ones, of the first one in reading
/// order. If no ink is so near, it is the pixel itself.
ExplainedPlace explain_strokes_near(const Frame& frame, int x, int y, int reach_px, int threads = 0);

/// Why there are lines, in a sentence for each: their class, and what the surface does there. A line is told once,
/// whatever number of its strokes reach the pixel.
std::vector<std::string> reasons_of(const std::vector<ExplainedStroke>& strokes);

/// The same for readers, and for programs as JSON (docs/shading/sheets.md).
std::string text_of(const std::vector<ExplainedStroke>& strokes);
std::string json_of(const std::vector<ExplainedStroke>& strokes, int x, int y);

}  // namespace burin
