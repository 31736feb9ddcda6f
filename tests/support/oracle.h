#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace burin::test {

/// Ground truth about lines by independent means: double-precision rays through a dense grid of
/// samples, and object-space reasoning about neighbouring hits. Shares no code with the rasterizer
/// or with the line decisions; it uses only the meshes' vertices, triangles and polygon numbers.
class Oracle {
  public:
    Oracle(const Scene& scene, const Camera& camera, int width, int height);

    struct Hit {
        static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
        std::uint32_t triangle = kNone;
        double distance = 0;  ///< along the view axis
    };
    /// The nearest surface through a position on the picture, in pixels.
    Hit cast(glm::dvec2 pixel) const;

    /// A place where there is, or may be, a line.
    struct LinePoint {
        glm::dvec2 pixel;
        /// True: by any reading of the definitions there is a line. False: there may be one (the
        /// gap or the angle is close to its threshold).
        bool certain = false;
    };
    /// Lines of the default classes within a rectangle of pixels, found at `density` samples per
    /// pixel and axis.
    std::vector<LinePoint> line_points(int x0, int y0, int x1, int y1, int density, double crease_angle_deg) const;

    std::uint32_t object_of(std::uint32_t triangle) const { return triangles_[triangle].object; }

  private:
    struct Triangle {
        glm::dvec3 a, e1, e2;     // view space
        glm::dvec3 normal;        // of the polygon, unit
        glm::dvec3 plane_normal;  // of the triangle, unit
        std::uint32_t object, polygon, mesh_triangle;
    };
    struct Node {
        glm::dvec3 low, high;
        std::uint32_t first, count;  // triangles of a leaf, or (count 0) the left child; right = left + 1
    };
    struct Judgement {
        bool possible = false, certain = false;
    };
    struct Ray {
        glm::dvec3 origin, direction;
    };

    Ray ray(glm::dvec2 pixel) const;
    void build(std::uint32_t node, std::uint32_t first, std::uint32_t count);
    double plane_distance(std::uint32_t triangle, const Ray& ray) const;
    Judgement judge(const Hit& a, glm::dvec2 at_a, const Hit& b, glm::dvec2 at_b, double crease_deg) const;
    /// Whether a line between two hits is still there when their distance is halved six times.
    bool persists(Hit a, glm::dvec2 at_a, Hit b, glm::dvec2 at_b, double crease_deg) const;
    /// Adds, as possible lines, the visible parts of all mesh edges that may be features.
    void add_edge_points(int x0, int y0, int x1, int y1, double crease_deg, std::vector<LinePoint>& points) const;
    void add_visible_points(const glm::dvec3& p, const glm::dvec3& q, int x0, int y0, int x1, int y1,
                            std::vector<LinePoint>& points) const;
    bool touches(const Hit& a, glm::dvec2 at_a, const Hit& b, glm::dvec2 at_b, double pixels) const;

    bool orthographic_;
    double focal_px_;
    glm::dvec2 center_;
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
    std::vector<std::array<std::uint32_t, 3>> corners_;  // per triangle: vertex numbers, global
};

/// How a drawing compares with the truth.
struct LineAgreement {
    double false_mass = 0;  ///< coverage in pixels farther than 1 px from any possible line
    double total_mass = 0;
    int missing = 0;  ///< certain line points farther than 1 px from any drawn pixel
    int certain = 0;
    std::vector<glm::ivec2> false_pixels;
    std::vector<glm::dvec2> missing_points;
};

/// `coverage` has a value per pixel of the rectangle, row by row.
LineAgreement compare_lines(const std::vector<Oracle::LinePoint>& truth, const std::vector<double>& coverage, int x0,
                            int y0, int x1, int y1);

}  // namespace burin::test
