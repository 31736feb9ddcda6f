// Solids of one object that stand in one another with faces in one plane.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "mesh/shapes.h"
#include "methods/reference/reference.h"
#include "tests/support/ink_apart.h"
#include "tests/support/layers.h"
#include "tests/support/random.h"

namespace burin::flush_faces_test {
namespace {

using namespace test;

/// In units of a coarse grid, so that faces often lie in one plane.
struct Block {
    std::array<int, 3> low, high;

    bool has(int x, int y, int z) const {
        return low[0] <= x && x < high[0] && low[1] <= y && y < high[1] && low[2] <= z && z < high[2];
    }
    /// Apart, or with a volume in common: what merely touches is a contact.
    bool goes_with(const Block& b) const {
        bool is_apart = false, have_volume = true;
        for (std::size_t k = 0; k < 3; ++k) {
            is_apart = is_apart || high[k] < b.low[k] || b.high[k] < low[k];
            have_volume = have_volume && high[k] > b.low[k] && b.high[k] > low[k];
        }
        return is_apart || have_volume;
    }
    PolygonSoup soup() const {
        const glm::dvec3 a(low[0], low[1], low[2]), b(high[0], high[1], high[2]);
        return moved(make_box(b - a), 0.5 * (a + b));
    }
};

constexpr int kGrid = 6;

std::vector<Block> random_blocks(Random& random) {
    const int count = random.integer(2, 4);
    std::vector<Block> blocks;
    while (static_cast<int>(blocks.size()) < count) {
        Block block{};
        for (std::size_t k = 0; k < 3; ++k) {
            block.low[k] = random.integer(0, kGrid - 1);
            block.high[k] = random.integer(block.low[k] + 1, kGrid);
        }
        if (std::all_of(blocks.begin(), blocks.end(), [&](const Block& b) { return b.goes_with(block); }))
            blocks.push_back(block);
    }
    return blocks;
}

/// The surface of all together, of unit squares.
PolygonSoup union_of(const std::vector<Block>& blocks) {
    PolygonSoup soup;
    const auto is_in_any = [&](glm::ivec3 p) {
        return std::any_of(blocks.begin(), blocks.end(), [&](const Block& b) { return b.has(p.x, p.y, p.z); });
    };
    for (int i = 0; i < kGrid * kGrid * kGrid; ++i) {
        const glm::ivec3 cell(i % kGrid, i / kGrid % kGrid, i / kGrid / kGrid);
        if (!is_in_any(cell)) continue;
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 n(0), u(0), v(0);
            n[axis] = u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
            for (const int side : {0, 1}) {
                if (is_in_any(cell + (side == 0 ? -n : n))) continue;
                const auto first = static_cast<std::uint32_t>(soup.positions.size());
                for (const glm::ivec3 p : {glm::ivec3(0), u, u + v, v})
                    soup.positions.emplace_back(cell + side * n + p);
                soup.add_polygon(side == 1 ? std::vector{first, first + 1, first + 2, first + 3}
                                           : std::vector{first + 3, first + 2, first + 1, first});
            }
        }
    }
    return soup;
}

Camera camera_around(Random& random, double fov_deg) {
    const glm::dvec3 middle(0.5 * kGrid);
    return perspective_camera(middle + random.direction() * (1.3 * kGrid / std::tan(glm::radians(0.5 * fov_deg))),
                              middle, fov_deg);
}

constexpr int kPx = 160;

Drawing drawn(const PolygonSoup& soup, const Camera& camera, RenderFunction render, int samples = 0) {
    Scene scene = scene_of({soup});
    if (samples != 0) scene.abuffer.samples = samples;
    return Drawing(scene, camera, kPx, kPx, {0, 0, kPx, kPx}, 2, render);
}

/// Cuts each side into `parts` rows and columns.
PolygonSoup cut(const PolygonSoup& sides, int parts) {
    PolygonSoup soup;
    for (std::size_t i = 0; i < sides.polygon_count(); ++i) {
        const auto corner = [&](std::size_t k) { return sides.positions[sides.polygon(i)[k]]; };
        const auto at = [&](int u, int v) {
            const double s = static_cast<double>(u) / parts, t = static_cast<double>(v) / parts;
            return glm::mix(glm::mix(corner(0), corner(1), s), glm::mix(corner(3), corner(2), s), t);
        };
        for (int u = 0; u < parts; ++u) {
            for (int v = 0; v < parts; ++v) {
                const auto first = static_cast<std::uint32_t>(soup.positions.size());
                for (const glm::dvec3 p : {at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)})
                    soup.positions.push_back(p);
                soup.add_polygon(std::vector{first, first + 1, first + 2, first + 3});
            }
        }
    }
    return soup;
}

/// In one object.
PolygonSoup joined(const std::vector<Block>& blocks, bool backwards, int parts) {
    std::vector<PolygonSoup> soups;
    for (const Block& b : blocks) soups.push_back(parts == 1 ? b.soup() : cut(b.soup(), parts));
    if (backwards) std::reverse(soups.begin(), soups.end());
    return test::joined(soups);
}

void expect_union(const std::vector<Block>& blocks, const Camera& camera, RenderFunction render, int samples,
                  const std::string& what) {
    const Drawing expected = drawn(union_of(blocks), camera, render, samples);
    for (const int parts : {1, 3}) {
        for (const bool backwards : {false, true}) {
            const Drawing d = drawn(joined(blocks, backwards, parts), camera, render, samples);
            const std::string which = what + (backwards ? ", backwards" : "") + (parts > 1 ? ", cut" : "");
            EXPECT_LE(ink_apart(d, expected), 1.5) << which << ": false lines";
            EXPECT_LE(ink_apart(expected, d), 1.5) << which << ": missing lines";
        }
    }
}

/// Before the eye, all over the picture.
PolygonSoup curtain(const Camera& camera) {
    const glm::dmat4 to_world = glm::inverse(camera.to_view());
    const auto in_view = [&](double x, double y) { return glm::dvec3(to_world * glm::dvec4(x, y, -1, 1)); };
    return soup_of({in_view(-1, -1), in_view(1, -1), in_view(1, 1), in_view(-1, 1)}, {{0, 1, 2, 3}});
}

TEST(FlushFaces, SolidsInOneAnotherLookLikeTheirUnion) {
    struct Way {
        const char* name;
        RenderFunction render;
        int samples, trials;
    };
    for (const Way& way : {Way{"abuffer", render_abuffer, 0, 40},
                           {"abuffer, 2 samples", render_abuffer, 2, 40},
                           {"abuffer, 4 samples", render_abuffer, 4, 10},
                           {"patel", render_patel, 0, 10}}) {
        for (int seed = 0; seed < way.trials; ++seed) {
            Random random(static_cast<std::uint64_t>(seed));
            const std::vector<Block> blocks = random_blocks(random);
            const Camera camera = camera_around(random, seed % 3 == 0 ? 5 : 40);
            expect_union(blocks, camera, way.render, way.samples, way.name + (", seed " + std::to_string(seed)));
        }
    }
}

// In technical drawings walls are seen exactly edge-on, also those that are buried.
TEST(FlushFaces, InViewsAlongAxes) {
    const glm::dvec3 directions[] = {{0, 3, 4}, {4, 0, 3}, {-3, 4, 0}, {0, 0, 1}, {0.6, 0, -0.8}, {1, 1, 1}};
    for (int seed = 0; seed < 12; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const std::vector<Block> blocks = random_blocks(random);
        const glm::dvec3 middle(0.5 * kGrid);
        Camera camera = perspective_camera(middle + 4.0 * kGrid * directions[seed % 6], middle);
        if (seed % 4 != 0) {
            camera.orthographic = true;
            camera.height = 1.6 * kGrid;
        }
        for (const RenderFunction render : {render_abuffer, render_patel}) {
            expect_union(blocks, camera, render, 0,
                         (render == render_patel ? "patel, seed " : "abuffer, seed ") + std::to_string(seed));
        }
    }
}

// A wall that ends in a face from below is level with it at samples on its edge, where rounding would show it: a speck.
TEST(FlushFaces, HaveNoSpecksOnBuriedEdges) {
    const std::vector<Block> cross{{{0, 0, 2}, {6, 2, 4}}, {{2, 0, 0}, {4, 2, 6}}};
    for (int seed = 0; seed < 150; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const Camera camera = camera_around(random, 30);
        const Drawing expected = drawn(union_of(cross), camera, render_abuffer);
        for (const bool backwards : {false, true}) {
            EXPECT_LE(ink_apart(drawn(joined(cross, backwards, 1), camera, render_abuffer), expected), 0.2) << seed;
        }
    }
}

// Parts that were mirrored, or come from several programs; turned, and written with four decimals.
TEST(FlushFaces, MayBeWoundEitherWay) {
    for (int seed = 0; seed < 40; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const std::vector<Block> blocks = random_blocks(random);
        const Camera camera = camera_around(random, seed % 3 == 0 ? 5 : 40);
        const glm::dvec3 middle(0.5 * kGrid), x = random.direction(),
                                              z = glm::normalize(glm::cross(x, random.direction()));
        const glm::dmat3 rotation(x, glm::cross(z, x), z);
        std::vector<PolygonSoup> alike, either_way;
        for (const Block& block : blocks) {
            alike.push_back(transformed(block.soup(), [&](glm::dvec3 p) {
                return glm::round(1e4 * (middle + rotation * (p - middle))) / 1e4;
            }));
            either_way.push_back(random.integer(0, 1) == 0 ? alike.back() : turned(alike.back()));
        }
        const Drawing expected = drawn(test::joined(alike), camera, render_abuffer),
                      d = drawn(test::joined(either_way), camera, render_abuffer);
        EXPECT_LE(ink_apart(d, expected), 0.2) << seed;
        EXPECT_LE(ink_apart(expected, d), 0.2) << seed;
    }
}

// Where a ray passes a wall's edge within its rounding, it may see the wall; a whole seam has 60 pixels and more.
TEST(FlushFaces, InTheReference) {
    const Camera camera = perspective_camera({11, 13, 17}, {3, 3, 3}, 30);
    const std::vector<Block> bar{{{0, 0, 0}, {4, 3, 3}}, {{2, 0, 0}, {6, 3, 3}}},
        cross{{{0, 0, 2}, {6, 2, 4}}, {{2, 0, 0}, {4, 2, 6}}};
    for (const auto& blocks : {bar, cross}) {
        const Drawing expected = drawn(union_of(blocks), camera, render_reference);
        for (const bool backwards : {false, true}) {
            const Drawing d = drawn(joined(blocks, backwards, 1), camera, render_reference);
            EXPECT_LE(ink_apart(d, expected), 5) << backwards;
            EXPECT_LE(ink_apart(expected, d), 1.5) << backwards;
        }
    }
}

// Faces so narrow on the screen, or walls so low, that all beside a line is nearly level with it.
TEST(FlushFaces, OfSlenderSidesAndOfThinPlates) {
    const auto lid = [](double radius, double low, double high, int sides) {
        return transformed(make_cylinder(radius, radius, 1, sides),
                           [=](glm::dvec3 p) { return glm::dvec3(p.x, p.y > 0 ? high : low, p.z); });
    };
    const auto box = [](glm::dvec3 low, glm::dvec3 high) { return moved(make_box(high - low), 0.5 * (low + high)); };
    for (int k = 0; k < 12; ++k) {
        const Camera camera =
            perspective_camera({6.6 * std::cos(0.5 * k), 1.6 + 0.3 * k, 6.6 * std::sin(0.5 * k)}, {0, 1.5, 0}, 40);
        const auto compare = [&](PolygonSoup one, PolygonSoup other, const PolygonSoup& both, const char* what) {
            const Drawing expected = drawn(both, camera, render_abuffer);
            for (const bool backwards : {false, true}) {
                const Drawing d = drawn(test::joined({one, other}), camera, render_abuffer);
                EXPECT_LE(ink_apart(d, expected), 1.5) << what << ' ' << k << (backwards ? ", backwards" : "");
                EXPECT_LE(ink_apart(expected, d), 1.5) << what << ' ' << k << (backwards ? ", backwards" : "");
                std::swap(one, other);
            }
        };
        compare(lid(1, 0, 2, 96), lid(1, 1.3, 3, 96), lid(1, 0, 3, 96), "coaxial cylinders");
        const PolygonSoup base = box({-2, 0, -2}, {2, 1, 2});
        for (const double thickness : {0.002, 0.05})
            compare(box({-0.7, 1 - thickness, -1.1}, {1.3, 1, 0.4}), base, base, "a plate");
    }
}

// What is behind a curtain with one layer in front is what is seen without the curtain.
TEST(FlushFaces, AmongHiddenLines) {
    for (int seed = 0; seed < 30; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const std::vector<Block> blocks = random_blocks(random);
        const glm::dvec3 middle(0.5 * kGrid), eye = middle + random.direction() * (4.0 * kGrid);
        const Camera camera = perspective_camera(eye, middle, 30);
        const Drawing seen(scene_of({union_of(blocks)}), camera, kSize, kSize, {0, 0, kSize, kSize}, 2, render_abuffer);
        for (const bool backwards : {false, true}) {
            Scene scene = scene_of({joined(blocks, backwards, 1), curtain(camera)});
            scene.lines.style.hidden.style = HiddenStyle::solid;
            const Layers layers(scene, camera);
            double not_seen_px = 0;
            std::vector<char> is_near(kSize * kSize, 0);
            for (const LinePart& piece : layers.pass.parts()) {
                const WholeLine& line = layers.pass.lines()[piece.line];
                if (piece.invisibility != 1) continue;
                const double length = (piece.end - piece.begin) * line.length_px();
                const int steps = 1 + static_cast<int>(2 * length);
                for (int k = 0; k < steps; ++k) {
                    const glm::dvec2 at =
                        glm::mix(line.from, line.to, glm::mix(piece.begin, piece.end, (k + 0.5) / steps)) / 256.0;
                    double ink = 0;
                    for (int y = static_cast<int>(at.y) - 1; y <= static_cast<int>(at.y) + 1; ++y) {
                        for (int x = static_cast<int>(at.x) - 1; x <= static_cast<int>(at.x) + 1; ++x) {
                            ink = std::max(ink, seen.line(x, y));
                            is_near[static_cast<std::size_t>(y * kSize + x)] = 1;
                        }
                    }
                    if (ink < 0.1) not_seen_px += length / steps;
                }
            }
            double not_hidden_px = 0;
            for (int y = 0; y < kSize; ++y) {
                for (int x = 0; x < kSize; ++x) {
                    if (is_near[static_cast<std::size_t>(y * kSize + x)] == 0) not_hidden_px += seen.line(x, y);
                }
            }
            EXPECT_LE(not_seen_px, 2) << "seed " << seed << (backwards ? ", backwards" : "");
            EXPECT_LE(not_hidden_px, 2) << "seed " << seed << (backwards ? ", backwards" : "");
        }
    }
}

// Where a leg ends under a board its faces and the board's face different ways: that is no flush face, but a contact.
TEST(FlushFaces, ALegUnderABoardHasItsOutline) {
    const Camera camera = perspective_camera({9, 15, 13}, {3, 3, 3}, 30);
    const auto hidden_px = [&](double gap) {
        const PolygonSoup board = Block{{0, 4, 0}, {6, 5, 6}}.soup(),
                          leg = moved(Block{{2, 0, 2}, {4, 4, 4}}.soup(), {0, -gap, 0});
        Scene scene = scene_of({test::joined({board, leg})});
        scene.lines.classes = LineClass::crease;
        scene.lines.style.hidden.style = HiddenStyle::solid;
        return Layers(scene, camera).all_hidden_px();
    };
    EXPECT_NEAR(hidden_px(0), hidden_px(0.01), 2);
}

// Its foot lies in the floor, and a wall on it is in front of the floor, however low.
TEST(FlushFaces, AWallWithItsFootInAFloor) {
    const PolygonSoup floor = soup_of({{0, 0, 0}, {6, 0, 0}, {6, 0, 6}, {0, 0, 6}}, {{3, 2, 1, 0}});
    const Camera camera = perspective_camera({5, 9, 13}, {3, 0, 3}, 35);
    for (const double height : {0.02, 0.05, 1.0}) {  // 0.02 are a third of a pixel
        // The foot is nearer to the eye than the wall, or behind it: then its crease is hidden.
        for (const double foot : {1.0, -1.0}) {
            const PolygonSoup bracket =
                soup_of({{1, 0, 3 + foot}, {5, 0, 3 + foot}, {5, 0, 3}, {1, 0, 3}, {5, height, 3}, {1, height, 3}},
                        {{0, 1, 2, 3}, {3, 2, 4, 5}});
            // The wall stands here without its foot.
            const PolygonSoup wall = soup_of({{1, 0, 3}, {5, 0, 3}, {5, height, 3}, {1, height, 3}}, {{0, 1, 2, 3}});
            const auto hidden_px = [&](const PolygonSoup& standing) {
                Scene scene = scene_of({test::joined({floor, standing}), curtain(camera)});
                scene.lines.style.hidden.style = HiddenStyle::solid;
                return Layers(scene, camera).hidden_px(1);
            };
            EXPECT_NEAR(hidden_px(bracket), hidden_px(wall), 2) << height << ", " << foot;
            for (const int samples : {0, 2}) {
                const Drawing expected = drawn(test::joined({floor, wall}), camera, render_abuffer, samples);
                for (const std::vector<PolygonSoup>& parts :
                     {std::vector{floor, bracket}, std::vector{bracket, floor}}) {
                    const Drawing d = drawn(test::joined(parts), camera, render_abuffer, samples);
                    EXPECT_LE(ink_apart(expected, d), 1.5) << height << ", " << foot << ", " << samples;
                    EXPECT_LE(ink_apart(d, expected), 1.5) << height << ", " << foot << ", " << samples;
                    if (samples != 0 && height < 0.05)
                        continue;  // a preview has a line or two where the wall is lower than a sample
                    EXPECT_NEAR(d.sum("lines.A"), expected.sum("lines.A"), 0.03 * expected.sum("lines.A"))
                        << height << ", " << foot << ", " << samples;
                }
            }
        }
    }
}

// Its outline is a line between objects where its wall would face the eye and is buried, however low that is.
TEST(FlushFaces, AnInlayHasOneClassPerEdge) {
    const auto box = [](glm::dvec3 low, glm::dvec3 high) { return moved(make_box(high - low), 0.5 * (low + high)); };
    for (int k = 0; k < 8; ++k) {
        const double a = 0.2 + 0.1 * k;
        const Camera camera = perspective_camera({6 * std::cos(a), 4.5, 6 * std::sin(a)}, {0, 0, 0}, 30);
        const auto inlay = [&](double thickness) {
            return Drawing(scene_of({box({-0.7, -thickness, -0.8}, {0.6, 0, 0.9}), box({-2, -1, -2}, {2, 0, 2})}),
                           camera, kPx, kPx, {0, 0, kPx, kPx}, 2, render_abuffer);
        };
        const Drawing thick = inlay(0.5);
        const double object_px = thick.sum(LineClass::object);
        EXPECT_GT(object_px, 60) << k;
        for (const double thickness : {0.004, 0.02, 0.05, 0.1})
            EXPECT_NEAR(inlay(thickness).sum(LineClass::object), object_px, 3) << thickness << ' ' << k;
    }
}

TEST(FlushFaces, OfTwoObjectsMeetInALine) {
    const Camera camera = perspective_camera({11, 13, 17}, {3, 3, 3}, 30);
    const Block a{{0, 0, 0}, {4, 3, 3}}, b{{2, 0, 0}, {6, 3, 3}};
    const Drawing d(scene_of({a.soup(), b.soup()}), camera, kPx, kPx, {0, 0, kPx, kPx}, 2, render_abuffer);
    const Drawing truth(scene_of({a.soup(), b.soup()}), camera, kPx, kPx, {0, 0, kPx, kPx}, 2, render_reference);
    EXPECT_GT(d.sum("lines.A") - drawn(union_of({a, b}), camera, render_abuffer).sum("lines.A"), 60);
    double largest_error = 0;  // one line, at the first one's edge
    for (int y = 0; y < kPx; ++y) {
        for (int x = 0; x < kPx; ++x) {
            if (d.line(x, y) > 0) largest_error = std::max(largest_error, std::abs(d.line(x, y) - truth.line(x, y)));
        }
    }
    EXPECT_LT(largest_error, 0.1);
}

// A mark is drawn wherever its edge is, be the wall beside it turned to the eye or away.
TEST(FlushFaces, MarksStay) {
    const Camera camera = perspective_camera({11, 13, 17}, {3, 3, 3}, 30);
    const std::vector<Block> bars{{{0, 0, 0}, {4, 3, 3}}, {{2, 0, 0}, {6, 3, 3}}};
    for (const double end : {2.0, 4.0}) {  // of the one within the other
        PolygonSoup soup = joined(bars, end == 2, 1);
        const auto vertex_at = [&](glm::dvec3 p) {
            return static_cast<std::uint32_t>(std::find(soup.positions.begin(), soup.positions.end(), p) -
                                              soup.positions.begin());
        };
        soup.marked_edges.push_back({vertex_at({end, 3, 0}), vertex_at({end, 3, 3})});
        Scene scene = scene_of({soup}), hidden = scene_of({soup, curtain(camera)});
        scene.lines.classes = hidden.lines.classes = LineClass::mark;
        hidden.lines.style.hidden.style = HiddenStyle::solid;
        const double expected = Layers(hidden, camera).hidden_px(1);
        EXPECT_GT(expected, 40);
        for (const int samples : {0, 2}) {
            if (samples != 0) scene.abuffer.samples = samples;
            const Drawing d(scene, camera, kSize, kSize, {0, 0, kSize, kSize}, 2, render_abuffer);
            EXPECT_NEAR(d.sum(LineClass::mark), expected, 2) << end << ", " << samples;
        }
    }
}

}  // namespace
}  // namespace burin::flush_faces_test
