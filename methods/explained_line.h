#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lines/line_class.h"
#include "render/frame.h"
#include "shading/ink/line_sides.h"
#include "shading/sheet/compiled_sheet.h"

// What explanations say of a line, whether it is drawn or not.

namespace burin {

/// A line set that did not take a line, and why.
struct RefusedSet {
    std::string set, reason;
    bool operator==(const RefusedSet&) const = default;
};

/// The surface on a side of a line.
struct ExplainedSide {
    std::uint32_t object = 0, material = 0;  ///< their numbers; 0: background, none
    std::string object_name, material_name;
    bool operator==(const ExplainedSide&) const = default;
};

struct ExplainedLine {
    LineClass drawn_as = LineClass::silhouette;
    LineClassSet classes;                          ///< all that apply
    bool is_edge = false;                          ///< of a mesh; else two surfaces meet there
    double dihedral_deg = 0, crease_from_deg = 0;  ///< of an edge of two polygons, and where creases begin
    ExplainedSide front, other;
    bool other_is_behind = false;  ///< it is seen beside the line, behind it; else it touches the line
    int invisibility = 0;
};

/// LineTeller says what lines of a frame with a style sheet are, and why sets do not take them.
class LineTeller {
  public:
    explicit LineTeller(const Frame& frame);

    ExplainedLine told(const LinePiece& piece, const LineSides& sides) const;
    /// Why a set does not take a piece that it does not take.
    std::string refusal(const CompiledSet& set, const LinePiece& piece, const LineSides& sides) const;

  private:
    LineClass class_of(const LinePiece& piece) const;
    ExplainedSide side_of(std::uint32_t object, std::uint32_t material) const;

    const Frame& frame_;
};

}  // namespace burin
