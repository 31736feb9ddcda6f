#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

/// Small scenes that each decide one question about a way to draw lines. Unless said otherwise they
/// are seen in an orthographic view in which a world unit is a pixel, positions are pixels with y
/// down, and depths z are those of a z-buffer: 0 at the near and 1 at the far end of a range that is
/// as deep as the picture is high.
namespace burin::test {

/// A line on the screen, and the z of its ends.
struct ScreenSegment {
    glm::dvec2 a, b;
    double za = 0.5, zb = 0.5;
};

struct MinimalScene {
    Scene scene;  ///< all line classes are asked for
    Camera camera;
    int size_px = 256;                 ///< width and height
    std::vector<ScreenSegment> lines;  ///< the lines that the scene is about, where it has such
    double units_per_z = 256;          ///< world units between z = 0 and z = 1
};

/// S-SIL: one triangle before the background.
MinimalScene scene_sil();
/// S-SLOPE: a square cut in two by a line of slope .37 through its middle, class polygon, in a plane
/// with dz/dy = b (per pixel, y down); 200 pixels high, or as many as depth allows.
MinimalScene scene_slope(double b);
/// S-SLOPE with only one half: the one below the line, or the one above. The line is a border.
MinimalScene scene_half_slope(double b, bool below);
/// S-GAP: a grid of polygons at z = .5, hidden by a plane without visible edges at .5 - gap.
MinimalScene scene_gap(double gap);
/// S-DILEMMA: a 40-pixel S-SLOPE square with b = .02 beside, and one behind, a cover at a gap of .005.
/// lines[0] is to be seen, lines[1] is hidden. The cover is parallel to what it covers.
MinimalScene scene_dilemma();
/// S-SPHERE: a sphere of 32 x 64 polygons without marks, and a pixel within it a second one with
/// all edges marked: of class mark, nothing may be seen.
MinimalScene scene_sphere();
/// S-STEP: a square at z = .3 before a wall at .6, with an edge at x = 100.37.
MinimalScene scene_step();
/// S-FLAT: a square at z = .5 before one at .501, of different objects, with equal normals.
MinimalScene scene_flat();
/// S-GRAZE: a floor of 10 x 10 polygons under 2 degrees.
MinimalScene scene_graze();
/// S-CURV: 64 spheres with a radius of 6 pixels.
MinimalScene scene_curv();
/// S-THIN: an upright bar .3 pixels wide, moved to the right by `shift_px`.
MinimalScene scene_thin(double shift_px);
/// S-CONCAVE: an L-shaped hexagon.
MinimalScene scene_concave();
/// S-NOTCH: one rectangle of 64 x 16 pixels.
MinimalScene scene_notch();
/// S-SLIVER: a disc cut into 720 triangles, lower than a pixel near its middle; class border only.
MinimalScene scene_sliver();
/// S-NEAR: in perspective, a triangle with `behind` (1, 2) corners behind the eye, or (0) one corner
/// in the eye's plane.
MinimalScene scene_near(int behind);
/// S-INTERSECT: two triangles that pass through each other; lines[0] is where.
MinimalScene scene_intersect();
/// S-TJUNC: a polygon beside two that share a vertex in the middle of its edge.
MinimalScene scene_tjunc();
/// S-CUT: a line, lines[0] its visible part, that runs under an occluder's edge at this angle.
MinimalScene scene_cut(double angle_deg);
/// S-PAIR and S-DIR: two tilted faces of one mesh with a common edge, lines[0], whose outlines run
/// along it in the same direction or in opposite ones (as consistent winding has it).
/// Pixel centres lie exactly between rows on every second column of it.
MinimalScene scene_pair(bool same_direction, double b = 4e-3);
/// S-UNEDGED: the halves of S-SLOPE as two objects. The upper one has marked edges, the lower one,
/// which is drawn later, has none; class mark only. (A plane through a box that is drawn with edges
/// has this where it touches them.)
MinimalScene scene_unedged(double b);
/// S-BACK: a wedge, 1e-4 thick on the right and 5e-6 on the left; the back has marked edges, and of
/// class mark nothing may be seen. Tilted by b.
MinimalScene scene_back(double b = 0);
/// S-HILITE: two tilted triangles with a common edge; lines are all five edges, the common one first.
MinimalScene scene_hilite();
/// S-3LAYER: three stacked squares, each smaller one before the larger.
MinimalScene scene_three_layers();
/// S-STAR: 180 lines of 14 pixels, class mark, at 0 to 179 degrees, at odd positions.
MinimalScene scene_star();
/// S-DENSE: a grid with cells of 1.5 pixels.
MinimalScene scene_dense();

}  // namespace burin::test
