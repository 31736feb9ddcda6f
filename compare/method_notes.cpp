#include "compare/method_notes.h"

#include <algorithm>
#include <iterator>

namespace burin {
namespace {

constexpr MethodNote kNotes[] = {
    {"abuffer", 1,
     "An A-buffer of coverage masks decides per pixel which surfaces are visible and where they "
     "meet; the strokes are "
     "drawn from the geometry of the edges found.",
     "Needs lists of fragments, whose size depends on the scene."},
    {"patel", 1,
     "Every pixel keeps a list of coverage masks that reach a little beyond it. Where the visible "
     "masks of two "
     "surfaces meet, the halo of one within the other is the stroke.",
     "Few levels of grey for small masks; only certain line widths; strokes are thinner on "
     "diagonals."},
    {"gbuffer", 2,
     "Depth, normals and numbers are drawn as images first; operators on neighbouring pixels then "
     "find where they jump "
     "or bend.",
     "Not anti-aliased without supersampling; lines of one or two pixels only; misses flat steps, "
     "and invents lines "
     "on grazing and strongly curved surfaces."},
    {"single-pass", 1,
     "While a polygon is filled, every pixel computes its distance to the polygon's edges, and a "
     "smooth function of "
     "that distance is its line.",
     "Only the half of a stroke that lies on a visible polygon is drawn: silhouettes are half as "
     "wide, and end in "
     "an aliased edge."},
    {"solid-wireframe", 1,
     "As the single-pass method, with edges that stay correct for polygons that reach behind the "
     "eye.",
     "Half-width silhouettes, as the single-pass method."},
    {"id-buffer", 2,
     "Numbers of the visible polygons are drawn first; then every edge is drawn as a wide, smooth "
     "line where one of "
     "its own polygons is visible in the pixels beside it.",
     "A cut where another surface hides a line is aliased; no line at intersections."},
    {"simple", 2,
     "Polygons are drawn into a z-buffer, then their outlines with the same depth test.",
     "Stippled lines on slopes, because pixels of line and polygon differ in depth; aliased."},
    {"offset", 2, "As simple, with the outlines pulled towards the eye by a constant.",
     "Hidden lines leak through where surfaces are closer than the constant, and steep slopes "
     "still stipple."},
    {"slope-offset", 2,
     "As offset, by an amount that grows with the polygon's slope, as glPolygonOffset does.",
     "Leaks most at the limbs of round objects, where slopes are steepest."},
    {"decal", 2, "Polygon by polygon: the outline is drawn where the polygon itself is visible.",
     "Aliased; the order of drawing shows where polygons share an edge."},
    {"edging-plane", 3,
     "Polygon by polygon with one more bit per pixel, that says where the polygon was drawn: the "
     "outline is drawn "
     "there, whatever its depth.",
     "Aliased; a polygon at a time."},
    {"virgin-plane", 3,
     "As the edging plane, with a bit that hardware clears when the pixel is first written.",
     "Aliased; a polygon at a time."},
    {"stencil", 3, "The edging plane with the stencil buffer of today's hardware.",
     "Aliased; a polygon at a time."},
    {"reference", 1,
     "Rays through a dense grid of samples in every pixel, and exact strokes around the visible "
     "parts of every line. "
     "It shares no code with the rasterizers.",
     "Slow."},
};

}  // namespace

const MethodNote* find_method_note(std::string_view name) {
    const auto it = std::find_if(std::begin(kNotes), std::end(kNotes),
                                 [&](const MethodNote& n) { return n.name == name; });
    return it == std::end(kNotes) ? nullptr : &*it;
}

}  // namespace burin
