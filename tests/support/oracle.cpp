#include "tests/support/oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/parallel.h"

namespace burin::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Thresholds with room on both sides of the definitions' 2 pixels.
constexpr double kSurelyApartPx = 3;
constexpr double kPerhapsApartPx = 0.7;
constexpr double kAngleMarginDeg = 3;

}  // namespace

Oracle::Oracle(const Scene& scene, const Camera& camera, int width, int height)
    : orthographic_(camera.orthographic),
      focal_px_(camera.orthographic ? height / camera.height
                                    : height / 2.0 / std::tan(glm::radians(camera.fov_deg) / 2)),
      center_(width / 2.0, height / 2.0) {
    const glm::dmat4 view = glm::inverse(camera.to_world);
    std::uint32_t first_vertex = 0;
    std::uint32_t first_polygon = 0;
    for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
        const Mesh& mesh = scene.meshes[scene.objects[o].mesh];
        const glm::dmat4 to_view = view * scene.objects[o].to_world;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            glm::dvec3 p[3];
            std::array<std::uint32_t, 3> numbers{};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v = mesh.triangles[t][k];
                p[k] = glm::dvec3(to_view * glm::dvec4(mesh.origin + glm::dvec3(mesh.positions[v]), 1));
                numbers[k] = first_vertex + v;
            }
            Triangle triangle{p[0], p[1] - p[0], p[2] - p[0], {}, {}, o, first_polygon + mesh.polygon_of(t), t};
            triangle.normal = glm::cross(triangle.e1, triangle.e2);
            triangles_.push_back(triangle);
            corners_.push_back(numbers);
        }
        // A polygon that is not flat has one normal: the mean over its area.
        std::vector<glm::dvec3> polygon_normals(mesh.polygon_count, glm::dvec3(0.0));
        const std::size_t first = triangles_.size() - mesh.triangles.size();
        for (std::size_t t = first; t < triangles_.size(); ++t) {
            polygon_normals[triangles_[t].polygon - first_polygon] += triangles_[t].normal;
        }
        for (std::size_t t = first; t < triangles_.size(); ++t) {
            triangles_[t].plane_normal = glm::normalize(triangles_[t].normal);
            triangles_[t].normal = glm::normalize(polygon_normals[triangles_[t].polygon - first_polygon]);
        }
        first_vertex += static_cast<std::uint32_t>(mesh.positions.size());
        first_polygon += mesh.polygon_count;
    }
    order_.resize(triangles_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(2 * triangles_.size() + 2);
    nodes_.emplace_back();
    build(0, 0, static_cast<std::uint32_t>(order_.size()));
}

void Oracle::build(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
    glm::dvec3 low(kInfinity), high(-kInfinity), center_low(kInfinity), center_high(-kInfinity);
    const auto center = [&](std::uint32_t t) { return triangles_[t].a + (triangles_[t].e1 + triangles_[t].e2) / 3.0; };
    for (std::uint32_t i = first; i < first + count; ++i) {
        const Triangle& t = triangles_[order_[i]];
        for (const glm::dvec3& p : {t.a, t.a + t.e1, t.a + t.e2}) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        center_low = glm::min(center_low, center(order_[i]));
        center_high = glm::max(center_high, center(order_[i]));
    }
    const glm::dvec3 margin = 1e-9 * (glm::abs(low) + glm::abs(high));
    nodes_[node] = {low - margin, high + margin, first, count};
    if (count <= 4) return;
    const glm::dvec3 size = center_high - center_low;
    const int axis = size.x > size.y && size.x > size.z ? 0 : (size.y > size.z ? 1 : 2);
    const std::uint32_t half = count / 2;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + half, begin + count,
                     [&](std::uint32_t a, std::uint32_t b) { return center(a)[axis] < center(b)[axis]; });
    const auto left = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].first = left;
    nodes_[node].count = 0;
    build(left, first, half);
    build(left + 1, first + half, count - half);
}

Oracle::Ray Oracle::ray(glm::dvec2 pixel) const {
    const glm::dvec2 at = (pixel - center_) / focal_px_;
    if (orthographic_) return {{at.x, -at.y, 0}, {0, 0, -1}};
    return {{0, 0, 0}, {at.x, -at.y, -1}};
}

Oracle::Hit Oracle::cast(glm::dvec2 pixel) const {
    const Ray r = ray(pixel);
    const glm::dvec3 inverse = 1.0 / r.direction;
    Hit hit;
    double nearest = kInfinity;
    std::uint32_t stack[128];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
        const Node& node = nodes_[stack[--top]];
        const glm::dvec3 t0 = (node.low - r.origin) * inverse, t1 = (node.high - r.origin) * inverse;
        double enter = 0, leave = nearest;
        for (int axis = 0; axis < 3; ++axis) {
            if (r.direction[axis] == 0) {
                if (r.origin[axis] < node.low[axis] || r.origin[axis] > node.high[axis]) leave = -1;
                continue;
            }
            enter = std::max(enter, std::min(t0[axis], t1[axis]));
            leave = std::min(leave, std::max(t0[axis], t1[axis]));
        }
        if (enter > leave) continue;
        if (node.count == 0) {
            stack[top++] = node.first;
            stack[top++] = node.first + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            // Möller and Trumbore 1997.
            const Triangle& t = triangles_[order_[i]];
            const glm::dvec3 p = glm::cross(r.direction, t.e2);
            const double determinant = glm::dot(t.e1, p);
            if (determinant == 0) continue;
            const glm::dvec3 s = r.origin - t.a;
            const double u = glm::dot(s, p) / determinant;
            const glm::dvec3 q = glm::cross(s, t.e1);
            const double v = glm::dot(r.direction, q) / determinant;
            if (u < 0 || v < 0 || u + v > 1) continue;
            const double distance = glm::dot(t.e2, q) / determinant;
            if (distance > 0 && distance < nearest) {
                nearest = distance;
                hit = {order_[i], distance};
            }
        }
    }
    return hit;
}

double Oracle::plane_distance(std::uint32_t triangle, const Ray& r) const {
    const Triangle& t = triangles_[triangle];
    const double slope = glm::dot(t.plane_normal, r.direction);
    return slope == 0 ? kInfinity : glm::dot(t.plane_normal, t.a - r.origin) / slope;
}

bool Oracle::touches(const Hit& a, glm::dvec2 at_a, const Hit& b, glm::dvec2 at_b, double pixels) const {
    if (a.triangle == Hit::kNone || b.triangle == Hit::kNone) return a.triangle == b.triangle;
    const double pixel_size = orthographic_ ? 1 / focal_px_ : std::min(a.distance, b.distance) / focal_px_;
    const double gap_b = std::abs(plane_distance(a.triangle, ray(at_b)) - b.distance);
    const double gap_a = std::abs(plane_distance(b.triangle, ray(at_a)) - a.distance);
    return std::min({gap_a, gap_b, std::abs(a.distance - b.distance)}) <= pixels * pixel_size;
}

Oracle::Judgement Oracle::judge(const Hit& a, glm::dvec2 at_a, const Hit& b, glm::dvec2 at_b, double crease_deg) const {
    if (a.triangle == b.triangle) return {};
    if (a.triangle == Hit::kNone || b.triangle == Hit::kNone) return {true, true};
    const Triangle &ta = triangles_[a.triangle], &tb = triangles_[b.triangle];
    if (ta.polygon == tb.polygon) return {};
    if (!touches(a, at_a, b, at_b, kSurelyApartPx)) return {true, true};
    const bool maybe_apart = !touches(a, at_a, b, at_b, kPerhapsApartPx);
    if (ta.object != tb.object) return {true, !maybe_apart};

    // One object, in contact: a crease by angle, or a fold or an intersection that is hard to see.
    // Both polygons are seen from the side that their triangles turn to the eye.
    const glm::dvec3 na = glm::dot(ta.plane_normal, ray(at_a).direction) > 0 ? -ta.normal : ta.normal;
    const glm::dvec3 nb = glm::dot(tb.plane_normal, ray(at_b).direction) > 0 ? -tb.normal : tb.normal;
    const double angle = glm::degrees(std::acos(std::clamp(glm::dot(na, nb), -1.0, 1.0)));
    int shared = 0;
    for (const std::uint32_t v : corners_[a.triangle]) {
        for (const std::uint32_t w : corners_[b.triangle]) shared += v == w;
    }
    if (shared >= 2) {
        return {angle > crease_deg - kAngleMarginDeg || maybe_apart,
                angle > crease_deg + kAngleMarginDeg && !maybe_apart};
    }
    // Not neighbours: something may lie between them that the samples missed.
    const double suspicious = shared == 1 ? crease_deg - kAngleMarginDeg : crease_deg / 2;
    // Surfaces that pass through each other: either plane runs behind the other surface.
    const bool may_cross =
        plane_distance(a.triangle, ray(at_b)) >= b.distance && plane_distance(b.triangle, ray(at_a)) >= a.distance;
    return {angle > suspicious || maybe_apart || may_cross, false};
}

bool Oracle::persists(Hit a, glm::dvec2 at_a, Hit b, glm::dvec2 at_b, double crease_deg) const {
    for (int i = 0; i < 6; ++i) {
        const glm::dvec2 middle = 0.5 * (at_a + at_b);
        const Hit m = cast(middle);
        // Go on where the larger jump is.
        const auto jump = [](const Hit& x, const Hit& y) {
            if (x.triangle == y.triangle) return -1.0;
            if (x.triangle == Hit::kNone || y.triangle == Hit::kNone) return kInfinity;
            return std::abs(x.distance - y.distance);
        };
        if (jump(a, m) >= jump(m, b)) {
            b = m;
            at_b = middle;
        } else {
            a = m;
            at_a = middle;
        }
    }
    return judge(a, at_a, b, at_b, crease_deg).certain;
}

void Oracle::add_edge_points(int x0, int y0, int x1, int y1, double crease_deg, std::vector<LinePoint>& points) const {
    struct Side {
        std::uint32_t a, b, triangle;
        bool operator<(const Side& o) const { return std::tie(a, b, triangle) < std::tie(o.a, o.b, o.triangle); }
    };
    std::vector<Side> sides;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t u = corners_[t][k], v = corners_[t][(k + 1) % 3];
            sides.push_back({std::min(u, v), std::max(u, v), t});
        }
    }
    std::sort(sides.begin(), sides.end());
    const auto corner = [&](std::uint32_t t, std::uint32_t vertex) {
        const Triangle& triangle = triangles_[t];
        if (corners_[t][0] == vertex) return triangle.a;
        return corners_[t][1] == vertex ? triangle.a + triangle.e1 : triangle.a + triangle.e2;
    };
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].a == sides[i].a && sides[end].b == sides[i].b) ++end;
        bool feature = end - i != 2;
        const glm::dvec3 p = corner(sides[i].triangle, sides[i].a), q = corner(sides[i].triangle, sides[i].b);
        if (end - i == 2) {
            const Triangle &s = triangles_[sides[i].triangle], &t = triangles_[sides[i + 1].triangle];
            const glm::dvec3 view = orthographic_ ? glm::dvec3(0, 0, -1) : 0.5 * (p + q);
            const bool fold = (glm::dot(s.plane_normal, view) > 0) != (glm::dot(t.plane_normal, view) > 0);
            const double cosine = std::abs(glm::dot(s.normal, t.normal));
            const double sharp = std::cos(glm::radians(std::min(90.0, crease_deg - kAngleMarginDeg)));
            feature = fold || (s.polygon != t.polygon && cosine < sharp);
        }
        if (feature) add_visible_points(p, q, x0, y0, x1, y1, points);
        i = end;
    }
}

void Oracle::add_visible_points(const glm::dvec3& p, const glm::dvec3& q, int x0, int y0, int x1, int y1,
                                std::vector<LinePoint>& points) const {
    constexpr double kNear = 1e-6;
    if (!orthographic_ && (-p.z < kNear || -q.z < kNear)) return;  // the tests have none that matter
    const auto pixel = [&](const glm::dvec3& v) {
        const double scale = orthographic_ ? focal_px_ : focal_px_ / -v.z;
        return glm::dvec2(center_.x + v.x * scale, center_.y - v.y * scale);
    };
    const double length = glm::distance(pixel(p), pixel(q));
    const int steps = static_cast<int>(std::min(length * 4, 1e5)) + 1;
    for (int k = 0; k <= steps; ++k) {
        const glm::dvec3 v = glm::mix(p, q, static_cast<double>(k) / steps);
        const glm::dvec2 at = pixel(v);
        if (at.x < x0 - 1 || at.y < y0 - 1 || at.x > x1 + 1 || at.y > y1 + 1) continue;
        const Hit hit = cast(at);
        const double pixel_size = orthographic_ ? 1 / focal_px_ : -v.z / focal_px_;
        if (hit.triangle == Hit::kNone || hit.distance > -v.z - 4 * pixel_size) points.push_back({at, false});
    }
}

std::vector<Oracle::LinePoint> Oracle::line_points(int x0, int y0, int x1, int y1, int density,
                                                   double crease_angle_deg) const {
    // One pixel more on every side, so that lines at the border of the rectangle are known.
    const int columns = (x1 - x0 + 2) * density, rows = (y1 - y0 + 2) * density;
    const auto position = [&](int row, int column) {
        // A fixed irrational offset keeps samples off the edges of axis-parallel scenes.
        return glm::dvec2(x0 - 1 + (column + 0.4871) / density, y0 - 1 + (row + 0.5113) / density);
    };
    std::vector<Hit> hits(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    parallel_for(static_cast<std::size_t>(rows), 0, [&](std::size_t row, int) {
        for (int column = 0; column < columns; ++column) {
            hits[row * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)] =
                cast(position(static_cast<int>(row), column));
        }
    });
    const auto hit = [&](int row, int column) -> const Hit& {
        return hits[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(column)];
    };
    std::vector<LinePoint> points;
    const auto visit = [&](int row, int column, int down, int right) {
        const glm::dvec2 at_a = position(row, column), at_b = position(row + down, column + right);
        Judgement j = judge(hit(row, column), at_a, hit(row + down, column + right), at_b, crease_angle_deg);
        if (!j.possible) return;
        // What is thinner than a few samples (a crack of the mesh, a chamfer) need not be drawn.
        constexpr int kThin = 3;
        const int row_before = row - kThin * down, column_before = column - kThin * right;
        const int row_after = row + (kThin + 1) * down, column_after = column + (kThin + 1) * right;
        if (row_before < 0 || column_before < 0 || row_after >= rows || column_after >= columns) {
            j.certain = false;
        } else if (j.certain) {
            const auto same = [&](int r0, int c0, int r1, int c1) {
                const Hit &x = hit(r0, c0), &y = hit(r1, c1);
                if (!touches(x, position(r0, c0), y, position(r1, c1), kSurelyApartPx)) return false;
                return x.triangle == Hit::kNone ||
                       std::abs(glm::dot(triangles_[x.triangle].normal, triangles_[y.triangle].normal)) > 0.94;
            };
            for (int k = 1; k <= kThin; ++k) {
                j.certain = j.certain && same(row - k * down, column - k * right, row, column) &&
                            same(row + (k + 1) * down, column + (k + 1) * right, row + down, column + right);
            }
            // Nor, across, what is part of a thin strip along the pair.
            const auto wide = [&](int r, int c) {
                const auto beside = [&](int k) {
                    const int r1 = r + k * right, c1 = c + k * down;
                    return r1 >= 0 && c1 >= 0 && r1 < rows && c1 < columns && same(r, c, r1, c1);
                };
                return beside(-2) || beside(2);
            };
            j.certain = j.certain && wide(row, column) && wide(row + down, column + right);
        }
        j.certain =
            j.certain && persists(hit(row, column), at_a, hit(row + down, column + right), at_b, crease_angle_deg);
        points.push_back({0.5 * (at_a + at_b), j.certain});
    };
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            if (column + 1 < columns) visit(row, column, 0, 1);
            if (row + 1 < rows) visit(row, column, 1, 0);
        }
    }
    add_edge_points(x0, y0, x1, y1, crease_angle_deg, points);
    return points;
}

LineAgreement compare_lines(const std::vector<Oracle::LinePoint>& truth, const std::vector<double>& coverage, int x0,
                            int y0, int x1, int y1) {
    LineAgreement result;
    const int width = x1 - x0, height = y1 - y0;
    const auto covered = [&](int x, int y) {
        if (x < x0 || y < y0 || x >= x1 || y >= y1) return -1.0;
        return coverage[static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(x - x0)];
    };
    // Distance from a point to the square of a pixel.
    const auto distance = [](glm::dvec2 p, int x, int y) {
        const glm::dvec2 d = glm::max(glm::max(glm::dvec2(x, y) - p, p - glm::dvec2(x + 1, y + 1)), glm::dvec2(0.0));
        return glm::length(d);
    };
    std::vector<bool> near(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), false);
    for (const Oracle::LinePoint& point : truth) {
        const int px = static_cast<int>(std::floor(point.pixel.x)), py = static_cast<int>(std::floor(point.pixel.y));
        bool drawn = false, complete = true;
        for (int y = py - 1; y <= py + 1; ++y) {
            for (int x = px - 1; x <= px + 1; ++x) {
                if (distance(point.pixel, x, y) > 1) continue;
                const double c = covered(x, y);
                if (c < 0) {
                    complete = false;
                    continue;
                }
                drawn = drawn || c > 0;
                near[static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x - x0)] = true;
            }
        }
        if (!point.certain || !complete) continue;
        ++result.certain;
        if (drawn) continue;
        ++result.missing;
        result.missing_points.push_back(point.pixel);
    }
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            const double c = covered(x, y);
            result.total_mass += c;
            if (c > 0 && !near[static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x - x0)]) {
                result.false_mass += c;
                result.false_pixels.emplace_back(x, y);
            }
        }
    }
    return result;
}

}  // namespace burin::test
