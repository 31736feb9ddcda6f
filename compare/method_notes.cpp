#include "compare/method_notes.h"

#include <algorithm>
#include <iterator>

namespace burin {
namespace {

constexpr MethodNote kNotes[] = {
    {"abuffer", 1,
     "Every pixel keeps the surfaces that reach it as a list of coverage masks, after L. "
     "Carpenter, The A-buffer, SIGGRAPH 1984 (Computer Graphics 18(3)), and M. Patel, 2000. "
     "The masks decide what is visible and where surfaces meet; a stroke is the set of all "
     "points within w/2 of the boundary found, taken from the geometry of its edge, and a "
     "pixel's line is the area of that set in it.",
     "Needs lists of fragments, whose size depends on the scene."},
    {"patel", 1,
     "Every pixel keeps a list of coverage masks that reach a little beyond it. halo(m) is "
     "what one step of dilation adds to a mask, dilate(m) & ~m; where the visible masks of two "
     "surfaces meet, (halo(front) & back) | (halo(back) & front) is the stroke. M. Patel, "
     "Hidden Line Rendering with a Modified A-Buffer, 27 March 2000.",
     "Few levels of grey for small masks; only certain line widths; strokes are thinner on "
     "diagonals."},
    {"gbuffer", 2,
     "Depth, normals and numbers are drawn as images first; operators on 3x3 samples A B C / D "
     "X E / F G H then find where they jump or bend: g = (|A + 2B + C - F - 2G - H| + |C + 2E "
     "+ H - A - 2D - F|) / 8, its variation (profiles), l = (8X - A - B - C - D - E - F - G - "
     "H) / 3 (internal edges), and numbers that differ. T. Saito and T. Takahashi, "
     "Comprehensible Rendering of 3-D Shapes, Computer Graphics 24(4) (SIGGRAPH 1990), "
     "197-206.",
     "Not anti-aliased without supersampling; lines of two samples at least, in other directions "
     "1.4 to 2.8: asked for 1 px, creases are 1.6 to 2.1 px wide and silhouettes 2.6 on average; "
     "misses flat steps, and invents lines on grazing and strongly curved surfaces; knows no line "
     "classes: a border is a silhouette to it, an intersection a crease."},
    {"single-pass", 1,
     "While a polygon is filled, every pixel computes the distance d to the nearest of the "
     "polygon's edges, and I(d) = exp2(-2 d^2) of it is line, the rest fill. J. A. Baerentzen, "
     "S. L. Nielsen, M. Gjoel, B. D. Larsen and N. J. Christensen, Single-pass Wireframe "
     "Rendering, SIGGRAPH 2006 sketches.",
     "Only the half of a stroke that lies on a visible polygon is drawn: silhouettes are half "
     "as wide, and end in an aliased edge."},
    {"solid-wireframe", 1,
     "As the single-pass method, with I(d) = exp2(-2 u^2), u = clamp(d - (W/2 - 1), 0, 2), and "
     "edges that stay correct for polygons that reach behind the eye. S. Gateau, Solid "
     "Wireframe, NVIDIA white paper WP-03014-001, 2007.",
     "Half-width silhouettes, as the single-pass method; narrower than the width W asked for."},
    {"id-buffer", 2,
     "Numbers of the visible polygons are drawn first; then every edge is drawn as a wide, "
     "smooth line, the I(d) of the single-pass method, in the pixels that belong to one of its "
     "own polygons or to the background, or where the edge is nearer. J. A. Baerentzen, S. L. "
     "Nielsen, M. Gjoel and B. D. Larsen, Two Methods for Antialiased Wireframe Drawing with "
     "Hidden Line Removal, Proceedings of SCCG 2008.",
     "A cut where another surface hides a line is aliased; hidden lines show on one side "
     "behind steep surfaces that are close; no line at intersections."},
    {"simple", 2,
     "Polygons are drawn into a z-buffer, then their outlines one pixel wide where z_edge <= "
     "z. Herrell, Baldwin and Wilcox, High-Quality Polygon Edging, IEEE Computer "
     "Graphics and Applications 15(4), 1995: what they set out to improve.",
     "Stippled lines on slopes, because pixels of line and polygon differ in depth; aliased."},
    {"offset", 2,
     "As simple, with the outlines pulled towards the eye by a constant: z_edge - eps <= z, "
     "eps = .001 of the range of z by default. The z-adjust of Herrell, Baldwin and Wilcox, "
     "IEEE Computer Graphics and Applications 15(4), 1995.",
     "Hidden lines leak through where surfaces are closer than the constant, and steep slopes "
     "still stipple."},
    {"slope-offset", 2,
     "As simple, with the fill pushed away by o = factor m + units r, m = max(|dz/dx|, "
     "|dz/dy|) of the polygon and r the smallest step of z. glPolygonOffset, The OpenGL "
     "Graphics System, version 1.1, 1997.",
     "Leaks most at the limbs of round objects, where slopes are steepest."},
    {"decal", 2,
     "Polygon by polygon: colour of the fill where it is visible, then the outline with the "
     "depths from before it, then the depth of the fill. Herrell, Baldwin and Wilcox, IEEE "
     "Computer Graphics and Applications 15(4), 1995.",
     "Aliased; the order of drawing shows where polygons share an edge."},
    {"edging-plane", 3,
     "Polygon by polygon with one more bit per pixel, that says where the polygon was drawn: "
     "the outline is drawn there, whatever its depth, elsewhere with the depth test. Herrell, "
     "Baldwin and Wilcox, IEEE Computer Graphics and Applications 15(4), 1995.",
     "Aliased; a polygon at a time."},
    {"virgin-plane", 3,
     "As the edging plane, with a bit that hardware clears when the pixel is first written. "
     "Herrell, Baldwin and Wilcox, IEEE Computer Graphics and Applications 15(4), 1995.",
     "Aliased; a polygon at a time."},
    {"stencil", 3,
     "The edging plane with the stencil buffer of today's hardware: REPLACE where the fill "
     "passes, EQUAL for the outline. After Herrell, Baldwin and Wilcox, IEEE Computer Graphics "
     "and Applications 15(4), 1995.",
     "Aliased; a polygon at a time."},
    {"reference", 1,
     "Rays through a dense grid of n x n samples in every pixel, and exact strokes around the "
     "visible parts of every line: a pixel's line is the area of all points within w/2 of "
     "them. It shares no code with the rasterizers.",
     "Slow."},
    {"svg", 1,
     "The lines that method abuffer finds, joined to paths, with curves fitted to them, and "
     "written as SVG; rsvg-convert, a program of the library librsvg, draws them with four times "
     "as many pixels along each side, and the mean alpha of these is a pixel's line.",
     "Times and memory are not measured: most of them are the other program's. Surfaces are not "
     "drawn. Strokes that cross add up as the other program mixes them."},
};

}  // namespace

const MethodNote* find_method_note(std::string_view name) {
    const auto it =
        std::find_if(std::begin(kNotes), std::end(kNotes), [&](const MethodNote& n) { return n.name == name; });
    return it == std::end(kNotes) ? nullptr : &*it;
}

}  // namespace burin
