#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "lines/line_class.h"
#include "lines/line_id.h"

namespace burin {

/// The side of the blocks within which pieces are merged. Blocks are those of the whole picture, so that a crop of it
/// merges the same pieces.
constexpr int kMergeBlockPx = 8;

/// A LinePiece is a straight piece of one line on the screen, seen or hidden: all that drawing gets. It says which line
/// it is and what is in front of it; all else that can be known of a line follows from these and the surfaces. A piece
/// is a fragment: its ends are no ends of the line.
struct LinePiece {
    glm::dvec2 from{0.0}, to{0.0};  ///< in pixels
    LineId line;
    float nearness_from = 0, nearness_to = 0;  ///< at either end, of the surface that the line lies on
    std::uint32_t block = 0;                   ///< pieces that are seen are merged within one block of the picture only
    /// The triangle, by its number through all instances, that is seen on the other side of a visible line where a
    /// surface ends. Only if DrawingNeeds::surfaces_beyond asks for it.
    std::uint32_t beyond = kNoSurface;
    static constexpr std::uint32_t kNoSurface = ~0u;  ///< the background, or not known
    LineClassSet classes;                             ///< all that apply somewhere on it, among those asked for
    LineClass drawn_as = LineClass::silhouette;
    std::uint8_t opacity = 255;       ///< of the line itself, 255 = full; less where it fades
    std::uint8_t transmission = 255;  ///< what transparent surfaces in front let through, 255 = all
    /// Quantitative invisibility (Appel 1967): how many opaque surfaces are in front. 255: that many or more.
    std::uint8_t invisibility = 0;
    bool is_drawn : 1 = true;        ///< else it only hides strokes
    bool occludes : 1 = false;       ///< a surface ends here; else the line lies on one, or between two in contact
    bool front_on_left : 1 = false;  ///< of the way from `from` to `to`, as seen on the screen

    bool is_hidden() const { return invisibility > 0; }
    /// The opacity of the line as it is seen.
    std::uint8_t seen_opacity() const { return static_cast<std::uint8_t>((opacity * transmission + 127) / 255); }
};
static_assert(sizeof(LinePiece) == 64, "a line of the cache");

/// Makes a piece end where another one ends that goes on from it.
inline void extend(LinePiece& piece, const LinePiece& by) {
    piece.to = by.to;
    piece.nearness_to = by.nearness_to;
}

/// Whether a piece behind surfaces begins where another piece of its line ends and looks like it, however many opaque
/// surfaces are in front of either.
inline bool goes_on_alike(const LinePiece& before, const LinePiece& next) {
    return before.line == next.line && before.to == next.from && before.is_hidden() == next.is_hidden() &&
           before.transmission == next.transmission && before.opacity == next.opacity &&
           before.drawn_as == next.drawn_as;
}

}  // namespace burin
