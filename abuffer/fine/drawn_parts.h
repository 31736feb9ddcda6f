#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "lines/line_class.h"
#include "lines/whole_line.h"

// Parts of lines that lie behind drawn ones on the same straight line of the picture are left out, for their strokes
// would be the same.

namespace burin {

/// Parts of lines that are drawn in one block, to leave out what lies behind them on the same straight line of the
/// picture. A wall that is seen exactly edge-on has all its edges there, and their strokes would be the same.
class DrawnParts {
  public:
    /// What strokes must have in common so that one stands for the other.
    struct Kind {
        LineClass drawn_as;
        bool occludes;
        bool front_on_left;  ///< of the way from left to right, or downwards
        bool operator==(const Kind&) const = default;
    };

    void clear() { parts_.clear(); }
    void add(const WholeLine& line, double begin, double end, Kind kind);
    /// Whether parts of one kind that are nearer than a part of a line, or by at most `level` farther, lie on all of
    /// it.
    bool cover(const WholeLine& line, double begin, double end, Kind kind, double level) const;

  private:
    /// A part of a line, from a place to another one along x or y, whichever changes more.
    struct Part {
        glm::dvec2 from, to;  ///< of the whole line
        double begin, end;
        double nearness_begin, nearness_end;
        Kind kind;
    };
    static Part part_of(const WholeLine& line, double begin, double end, Kind kind);
    static bool is_behind(const Part& part, const Part& other, double level);

    std::vector<Part> parts_;
};

}  // namespace burin
