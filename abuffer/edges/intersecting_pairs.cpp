#include "abuffer/edges/intersecting_pairs.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "abuffer/edges/box_tree.h"
#include "base/parallel.h"
#include "mesh/box.h"

namespace burin {
namespace {

using Triangle = IntersectionTest::Triangle;

constexpr std::size_t kMostTriangles = std::size_t{1} << 23, kMostPairs = std::size_t{1} << 24;
// Pairs whose boxes overlap: scans have one for each triangle, assemblies a few dozen. The boxes of long slanted facets
// may all overlap.
constexpr std::uint64_t kMostTestsPerTriangle = 64, kLeastTests = 1 << 20;
constexpr double kLargestExtent = 1e30;  // boxes have single precision
// How far a coordinate may be off, as a part of the scene's extent.
constexpr double kPairRounding = 0x1p-50;

/// How far the corners of a triangle are on one side or the other of another one's plane, multiplied by the length
/// of the plane's normal.
struct Sides {
    glm::dvec3 normal;
    std::array<double, 3> of_corner;
    double slack;

    /// `rounding`: of a coordinate.
    Sides(const Triangle& plane, const Triangle& corners, double rounding) {
        const glm::dvec3 u = plane[1] - plane[0], v = plane[2] - plane[0];
        normal = glm::cross(u, v);
        double farthest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 away = corners[k] - plane[0];
            of_corner[k] = glm::dot(normal, away);
            farthest = std::max(farthest, length_of(away));
        }
        // The normal of a sliver may be wrong by more than its length.
        slack = 4 * rounding * (length_of(normal) + (length_of(u) + length_of(v)) * farthest);
    }

    static double length_of(const glm::dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }
    double lowest() const { return std::min({of_corner[0], of_corner[1], of_corner[2]}); }
    double highest() const { return std::max({of_corner[0], of_corner[1], of_corner[2]}); }
    bool is_cut() const { return lowest() < -slack && highest() > slack; }
    /// Two corners in the plane and the third one behind it: of the two triangles at an edge, this one stands for both.
    bool has_edge_in_plane() const {
        return lowest() < -slack && highest() <= slack &&
               std::count_if(of_corner.begin(), of_corner.end(), [&](double side) { return side >= -slack; }) == 2;
    }
};

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
};

/// Where a triangle passes through a plane, along a direction in both; no smaller for rounding.
Range passage(const Triangle& corners, const Sides& sides, const glm::dvec3& along) {
    Range range;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t n = k == 2 ? 0 : k + 1;
        const double from = sides.of_corner[k], to = sides.of_corner[n];
        if ((from > sides.slack && to > sides.slack) || (from < -sides.slack && to < -sides.slack)) continue;
        const double begin = glm::dot(along, corners[k]), end = glm::dot(along, corners[n]);
        const double difference = std::abs(from - to), share = difference > 0 ? std::abs(from) / difference : 0.5;
        const double error = difference > 0 ? 2 * sides.slack / difference : 1.0;
        const double a = begin + (end - begin) * std::clamp(share - error, 0.0, 1.0);
        const double b = begin + (end - begin) * std::clamp(share + error, 0.0, 1.0);
        range.low = std::min({range.low, a, b});
        range.high = std::max({range.high, a, b});
    }
    return range;
}

bool overlap(const ScreenBox& a, const ScreenBox& b) {
    return a.x0 <= b.x1 && a.x1 >= b.x0 && a.y0 <= b.y1 && a.y1 >= b.y0 && a.low < b.high && a.high > b.low;
}

/// All triangles of a scene, numbered through.
struct Triangles {
    using Corners = std::array<std::uint32_t, 3>;
    std::vector<glm::dvec3> positions;  // of all vertices, numbered likewise
    std::vector<Corners> corners;
    std::vector<std::uint32_t> first;  // triangle of each object, and one more

    Triangles(const Scene& scene, const IntersectionTest& test, int threads) {
        first.push_back(0);
        for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
            const Mesh& mesh = scene.meshes[scene.objects[o].mesh];
            const std::size_t offset = positions.size();
            positions.resize(offset + mesh.positions.size());
            parallel_for_each(mesh.positions.size(), threads, [&](std::size_t v) {
                positions[offset + v] = test.position(o, static_cast<std::uint32_t>(v));
            });
            corners.resize(first.back() + mesh.triangles.size());
            parallel_for_each(mesh.triangles.size(), threads, [&](std::size_t t) {
                const Corners& c = mesh.triangles[t];
                const auto shift = static_cast<std::uint32_t>(offset);
                corners[first.back() + t] = {c[0] + shift, c[1] + shift, c[2] + shift};
            });
            first.push_back(static_cast<std::uint32_t>(corners.size()));
        }
    }
    Triangle triangle(const Corners& c) const { return {positions[c[0]], positions[c[1]], positions[c[2]]}; }
    SurfaceId surface(std::uint32_t number) const {
        const auto o =
            static_cast<std::uint32_t>(std::upper_bound(first.begin(), first.end(), number) - first.begin()) - 1;
        return {o, number - first[o]};
    }
};

}  // namespace

IntersectionTest::IntersectionTest(const Scene& scene) {
    std::vector<Box> mesh_boxes;
    for (const Mesh& mesh : scene.meshes) mesh_boxes.push_back(burin::box_of(mesh));
    Box all;
    for (const SceneObject& object : scene.objects) {
        const Mesh& mesh = scene.meshes[object.mesh];
        const Place place{&mesh, glm::dmat3(object.to_world),
                          glm::dvec3(object.to_world * glm::dvec4(mesh.origin, 1.0))};
        places_.push_back(place);
        const Box& box = mesh_boxes[object.mesh];
        if (box.is_empty()) continue;
        box.for_each_corner([&](const glm::dvec3& corner) { all.add(place.axes * corner + place.origin); });
    }
    if (all.is_empty()) return;
    const glm::dvec3 middle = 0.5 * (all.low + all.high);
    for (Place& p : places_) p.origin -= middle;
    extent_ = glm::distance(all.low, all.high);
}

IntersectionTest::Triangle IntersectionTest::triangle(SurfaceId s) const {
    const auto& t = places_[s.instance].mesh->triangles[s.triangle];
    return {position(s.instance, t[0]), position(s.instance, t[1]), position(s.instance, t[2])};
}

ScreenBox IntersectionTest::box_of(const Triangle& t) {
    const glm::vec3 low(glm::min(glm::min(t[0], t[1]), t[2])), high(glm::max(glm::max(t[0], t[1]), t[2]));
    const auto below = [](float v) { return v - std::abs(v) * 0x1p-23f; };
    const auto above = [](float v) { return v + std::abs(v) * 0x1p-23f; };
    return {below(low.x), below(low.y), above(high.x), above(high.y), below(low.z), above(high.z)};
}

IntersectionTest::Meeting IntersectionTest::meeting(const Triangle& p, const Triangle& q) const {
    const Sides of_q(p, q, kPairRounding * extent_);
    if (!of_q.is_cut() && !of_q.has_edge_in_plane()) return Meeting::none;
    const Sides of_p(q, p, kPairRounding * extent_);
    if (!of_p.is_cut() && !of_p.has_edge_in_plane()) return Meeting::none;
    // Each passes through the other's plane along one line (Moller 1997); do they meet there?
    const glm::dvec3 along = glm::cross(of_q.normal, of_p.normal);
    const Range one = passage(q, of_q, along), other = passage(p, of_p, along);
    const double slack = kPairRounding * extent_ * Sides::length_of(along);
    const bool meet = one.low <= other.high + slack && other.low <= one.high + slack && overlap(box_of(p), box_of(q));
    if (!meet) return Meeting::none;
    return of_q.is_cut() && of_p.is_cut() ? Meeting::through : Meeting::along_edge;
}

/// Whether a triangle is cut by the plane of another one, or has an edge in it and its neighbour there on the other
/// side.
bool IntersectionTest::goes_on_beyond(SurfaceId s, SurfaceId plane) const {
    const Triangle own = triangle(s), other = triangle(plane);
    const Sides sides(other, own, kPairRounding * extent_);
    if (sides.is_cut()) return true;
    const auto third = static_cast<HalfEdge>(std::min_element(sides.of_corner.begin(), sides.of_corner.end()) -
                                             sides.of_corner.begin());
    const Mesh& mesh = *places_[s.instance].mesh;
    const HalfEdge edge = 3 * s.triangle + (third + 1) % 3, partner = mesh.next_on_edge[edge];
    if (partner == edge || mesh.next_on_edge[partner] != edge) return false;
    const Sides beyond(other, triangle({s.instance, partner / 3}), kPairRounding * extent_);
    return beyond.highest() > beyond.slack;
}

std::optional<std::vector<SurfacePair>> find_intersecting_pairs(const Scene& scene, const TileKernels& kernels,
                                                                int threads) {
    std::size_t count = 0;
    for (const SceneObject& o : scene.objects) count += scene.meshes[o.mesh].triangles.size();
    if (count > kMostTriangles) return std::nullopt;
    threads = resolve_thread_count(threads);
    const IntersectionTest test(scene);
    if (!(test.extent() < kLargestExtent)) return std::nullopt;
    Triangles triangles(scene, test, threads);
    std::vector<ScreenBox> boxes(count);
    parallel_for_each(count, threads, [&](std::size_t i) {
        boxes[i] = IntersectionTest::box_of(triangles.triangle(triangles.corners[i]));
    });
    const BoxTree tree(boxes, kernels, threads);
    boxes = std::vector<ScreenBox>();
    std::array<std::vector<std::uint32_t>, 3> corners;  // in the tree's order, and what kernels may read too far
    for (auto& of_all : corners) of_all.resize(count + 7);
    parallel_for_each(count, threads, [&](std::size_t i) {
        for (std::size_t k = 0; k < 3; ++k) corners[k][i] = triangles.corners[tree.order()[i]][k];
    });
    const std::uint32_t* const corner_lists[3] = {corners[0].data(), corners[1].data(), corners[2].data()};
    triangles.corners = std::vector<Triangles::Corners>();
    const auto tasks = tree.tasks();
    if (!tasks) return std::nullopt;
    std::vector<std::vector<SurfacePair>> found(tasks->size());
    std::atomic<std::uint64_t> found_count{0}, test_count{0};
    const std::uint64_t most_tests = kLeastTests + kMostTestsPerTriangle * count;
    const auto are_too_many = [&] { return found_count > kMostPairs || test_count > most_tests; };
    parallel_for(tasks->size(), threads, [&](std::size_t task, int) {
        if (are_too_many()) return;
        const auto triangle = [&](std::uint32_t i) {
            return triangles.triangle({corners[0][i], corners[1][i], corners[2][i]});
        };
        std::uint64_t tests = 0;
        tree.for_leaf_pairs((*tasks)[task], [&](std::uint32_t first, std::uint32_t second, std::uint64_t overlapping) {
            const std::uint64_t pairs = kernels.intersect.find_unconnected(corner_lists, first, second, overlapping);
            tests += static_cast<std::uint64_t>(std::popcount(pairs));
            BoxTree::for_bits(pairs, [&](std::uint32_t i, std::uint32_t k) {
                const auto meeting = test.meeting(triangle(first + i), triangle(second + k));
                if (meeting == IntersectionTest::Meeting::none) return;
                const auto [a, b] = std::minmax(tree.order()[first + i], tree.order()[second + k]);
                const SurfacePair pair{triangles.surface(a), triangles.surface(b)};
                if (meeting == IntersectionTest::Meeting::through || test.may_intersect(pair.first, pair.second))
                    found[task].push_back(pair);
            });
        });
        test_count += tests;
        found_count += found[task].size();
    });
    if (are_too_many()) return std::nullopt;
    std::vector<SurfacePair> pairs;
    pairs.reserve(found_count);
    for (const auto& list : found) pairs.insert(pairs.end(), list.begin(), list.end());
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace burin
