// Features that samples miss: thinner than a sample, or several to a sample.

#include <gtest/gtest.h>

#include "tests/abuffer/fine_drawings.h"

namespace burin::fine_lines_test {
namespace {

using namespace test;

TEST(FineLines, ARodThinnerThanASampleHasNoDropouts) {
    for (const double angle : kAngles_deg) {
        for (const double width : {0.2, 0.1}) {
            const Scene scene = scene_of({placed(make_box({30, width, width}), angle), wall()});
            const Camera camera = pixel_camera(kFineSize, kFineSize);
            const Drawing drawn = draw_fine(scene, camera, kFineSize);
            EXPECT_LT(largest_error(drawn, truth(scene, camera, kFineSize)), 0.15)
                << angle << " deg, " << width << " px";
            const double a = glm::radians(angle);
            const glm::dvec2 middle(22.13, kFineSize - 21.86), along(std::cos(a), -std::sin(a));
            EXPECT_EQ(drawn.drawn_share(middle - 14.0 * along, middle + 14.0 * along, 0), 1.0) << angle;
        }
    }
}

// Facets beside a contour are narrower than the grid of corners: rounding turns them over.
TEST(FineLines, ARoundWireThinnerThanASampleHasNoDropouts) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const double radius = random.real(0.05, 0.2), turn = random.real(0, 6), angle = random.real(0, 180);
        const int sides = random.integer(6, 48);
        std::vector<glm::dvec2> section;
        for (int i = 0; i < sides; ++i) {
            const double a = turn + 2 * M_PI * i / sides;
            section.emplace_back(radius * std::cos(a), radius * std::sin(a));
        }
        const Scene scene = scene_of({placed(prism(section, 15), angle), wall()});
        const Drawing drawn = draw_fine(scene, pixel_camera(kFineSize, kFineSize), kFineSize);
        const double a = glm::radians(angle);
        const glm::dvec2 middle(22.13, kFineSize - 21.86), along(std::cos(a), -std::sin(a));
        EXPECT_EQ(drawn.drawn_share(middle - 14.0 * along, middle + 14.0 * along, 0), 1.0)
            << "seed " << seed << ": " << radius << " px, " << sides << " sides, " << angle << " deg";
    }
}

TEST(FineLines, BothEdgesOfANarrowChamferAreDrawn) {
    for (const double angle : kAngles_deg) {
        const double c = 0.1;
        const Scene scene =
            scene_of({placed(prism({{-10, -6}, {10, -6}, {10, -5.5}, {0, 5}, {-c, 5}, {-c - 10, -5.5}}, 14), angle)});
        const Camera camera = pixel_camera(kFineSize, kFineSize);
        const Drawing drawn = draw_fine(scene, camera, kFineSize), expected = truth(scene, camera, kFineSize);
        EXPECT_LT(largest_error(drawn, expected), 0.15) << angle;
        EXPECT_NEAR(drawn.sum("lines.A") / expected.sum("lines.A"), 1, 0.01) << angle;
    }
}

// One of them is the box's contour, the other one a crease that samples see in places.
TEST(FineLines, BothEdgesOfANarrowRimAreDrawn) {
    for (const double rim_px : {0.14, 0.2, 0.26}) {
        for (const double angle : {11.0, 40.0, 75.0}) {
            const double tilt = std::asin(rim_px / 3);
            const PolygonSoup box = transformed(make_box({26, 24, 3}), [=](glm::dvec3 p) {
                return glm::dvec3(std::cos(tilt) * p.x + std::sin(tilt) * p.z, p.y,
                                  std::cos(tilt) * p.z - std::sin(tilt) * p.x);
            });
            Scene scene = scene_of({placed(box, angle)});
            scene.lines.style.width_px = 0.3;
            const Camera camera = pixel_camera(kFineSize, kFineSize);
            const Drawing drawn = draw_fine(scene, camera, kFineSize), expected = truth(scene, camera, kFineSize, 32);
            EXPECT_LT(largest_error(drawn, expected), 0.1) << rim_px << " px, " << angle << " deg";
            EXPECT_NEAR(drawn.sum("lines.A") / expected.sum("lines.A"), 1, 0.01)
                << rim_px << " px, " << angle << " deg";
        }
    }
}

// Surfaces have two sides: it does not matter which way the faces beside an edge are wound.
TEST(FineLines, BothEdgesOfANarrowChamferAreDrawnHoweverItIsWound) {
    const auto chamfer = [](bool is_turned) {
        const std::vector<std::uint32_t> wide =
            is_turned ? std::vector<std::uint32_t>{2, 1, 0} : std::vector<std::uint32_t>{0, 1, 2};
        return soup_of({{-0.1016, -1.2852, -0.3555},
                        {0.6328, -1.2852, 1.2695},
                        {-0.1016, -1.2852, 1.2695},
                        {-0.1172, -1.2695, -0.3555}},
                       {wide, {3, 0, 2}});
    };
    for (int k = 0; k < 8; ++k) {
        // Seen nearly from beside: the chamfer is half a pixel high.
        const Camera camera =
            perspective_camera({-3.5156, -1.3125 - 0.004 * k, -6.2969}, {0.2344, -0.3594, 0.3281}, 22.1875);
        const auto drawn = [&](bool is_turned) {
            return Drawing(scene_of({chamfer(is_turned)}), camera, 320, 240, {0, 0, 320, 240}, 2, render_abuffer);
        };
        EXPECT_LT(largest_error(drawn(false), drawn(true)), 0.01) << k;
    }
}

TEST(FineLines, AStepLowerThanASampleIsDrawn) {
    for (const double angle : kAngles_deg) {
        // Half of the plate behind the box reaches beyond it by 0.15 pixels, in front of a wall.
        const auto moved = [](glm::dvec3 size, glm::dvec3 by) {
            return transformed(make_box(size), [=](glm::dvec3 p) { return p + by; });
        };
        const Scene scene =
            scene_of({placed(make_box({28, 16, 5}), angle), placed(moved({14, 16, 5}, {0, 0.15, -5}), angle), wall()});
        const Camera camera = pixel_camera(kFineSize, kFineSize);
        EXPECT_LT(largest_error(draw_fine(scene, camera, kFineSize), truth(scene, camera, kFineSize)), 0.15) << angle;
    }
}

TEST(FineLines, AcuteTipsAreNotCutShort) {
    for (const double angle : kAngles_deg) {
        PolygonSoup needle = soup_of({{-10, -2, 0}, {10, 0, 0}, {-10, 2, 0}, {-10, 0, -2}},
                                     {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}});
        const Scene tip = scene_of({placed(needle, angle), wall()});
        const Camera camera = pixel_camera(kFineSize, kFineSize);
        EXPECT_LT(largest_error(draw_fine(tip, camera, kFineSize), truth(tip, camera, kFineSize, 32)), 0.15) << angle;
    }
}

/// Where two edges cross at a small angle the gap between them gets narrower than any sample.
TEST(FineLines, BothLinesOfASlenderCornerAreDrawn) {
    for (const double depth : {-1.5, -6.0}) {
        for (const double angle : {3.0, 21.0, 48.0}) {
            for (const double between : {7.0, 12.0}) {
                const Scene scene = scene_of({placed(make_box({36, 2.7, 1}), angle),
                                              placed(make_box({36, 2.7, 1}), angle + between, depth), wall()});
                const Camera camera = pixel_camera(kFineSize, kFineSize);
                EXPECT_LT(largest_error(draw_fine(scene, camera, kFineSize), truth(scene, camera, kFineSize, 32)), 0.08)
                    << angle << " and " << angle + between << " deg, " << depth << " px";
            }
        }
    }
}

TEST(FineLines, SheetsThatPassThroughEachOtherEndWhereTheyMeet) {
    for (int i = 0; i < 12; ++i) {
        const auto sheet = [&](double turn_deg, double tilt) {
            return placed(
                transformed(make_plane(26, 26, 1, 1), [=](glm::dvec3 p) { return glm::dvec3(p.x, p.z, tilt * p.x); }),
                turn_deg + 29.3 * i);
        };
        const Scene scene = scene_of({sheet(0, 0.7), sheet(74, 0.9)});
        const Camera camera = pixel_camera(kFineSize, kFineSize);
        EXPECT_LT(largest_error(draw_fine(scene, camera, kFineSize), truth(scene, camera, kFineSize, 32)), 0.08) << i;
    }
}

/// A rough ball with several triangles to a pixel, slivers around it, and rods thinner than a sample.
Scene rough_scene(std::uint64_t seed, int segments) {
    Random random(seed);
    PolygonSoup ball = make_torus(0.8, 0.45, segments, segments / 2);
    for (glm::dvec3& p : ball.positions) p += 0.012 * random.direction();
    PolygonSoup slivers;
    for (std::uint32_t i = 0; i < 60; ++i) {
        const glm::dvec3 center = random.in_box(1.2), along = random.direction() * 0.5;
        slivers.positions.push_back(center - along);
        slivers.positions.push_back(center + along);
        slivers.positions.push_back(center + along + 0.03 * random.direction());
        slivers.add_polygon(std::vector<std::uint32_t>{3 * i, 3 * i + 1, 3 * i + 2});
    }
    std::vector<PolygonSoup> objects{ball, slivers};
    for (int i = 0; i < 6; ++i) {
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), random.real(0, 3), random.direction());
        const glm::dvec3 at = random.in_box(0.8);
        objects.push_back(transformed(make_box({1.4, 0.008, 0.008}),
                                      [=](glm::dvec3 p) { return glm::dvec3(turn * glm::dvec4(p, 1.0)) + at; }));
    }
    return scene_of(std::move(objects));
}

const glm::dvec3 kEye(2.3, 1.7, 4.1);

TEST(FineLines, NothingHiddenAppears) {
    constexpr int kPicture = 60;
    for (std::uint64_t seed = 0; seed < 2; ++seed) {
        const Scene scene = rough_scene(seed, 60 + 40 * static_cast<int>(seed));
        const Camera camera = perspective_camera(kEye, {0, 0, 0});
        const Drawing drawn = draw_fine(scene, camera, kPicture), expected = truth(scene, camera, kPicture, 32);
        EXPECT_EQ(count_false(drawn, expected), 0) << "seed " << seed;
        EXPECT_LE(count_false(expected, drawn), 1) << "seed " << seed;
        // The tips of slivers are thinner than the truth's samples, too.
        EXPECT_NEAR(drawn.sum("lines.A") / expected.sum("lines.A"), 1, 0.03) << "seed " << seed;
    }
}

/// A prism within a box ends exactly in the box's face, which is seen there as the first of the two; of one on top
/// of the box, the foot is seen.
TEST(FineLines, OfFlushFacesTheFirstIsSeen) {
    const auto prism = [](double middle) {
        PolygonSoup soup = make_cylinder(0.3, 0.3, 0.6, 6);
        return transformed(std::move(soup), [=](glm::dvec3 p) { return p + glm::dvec3(0.05, middle, 0.02); });
    };
    const auto as_one_mesh = [](PolygonSoup a, const PolygonSoup& b) {
        const auto first_vertex = static_cast<std::uint32_t>(a.positions.size());
        const auto first_corner = static_cast<std::uint32_t>(a.corners.size());
        a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
        for (const std::uint32_t c : b.corners) a.corners.push_back(first_vertex + c);
        for (const std::uint32_t end : b.polygon_ends) a.polygon_ends.push_back(first_corner + end);
        return a;
    };
    const Camera camera = perspective_camera({1.3, 2.6, 2.1}, {0, 0.4, 0});
    for (const double middle : {0.2, 0.8}) {
        const PolygonSoup box = make_box({1, 1, 1});
        for (const Scene& scene : {scene_of({box, prism(middle)}), scene_of({as_one_mesh(box, prism(middle))})}) {
            const Drawing drawn = draw_fine(scene, camera, kFineSize), expected = truth(scene, camera, kFineSize);
            EXPECT_EQ(count_false(drawn, expected), 0) << middle << ' ' << scene.objects.size();
            EXPECT_EQ(count_false(expected, drawn), 0) << middle << ' ' << scene.objects.size();
        }
    }
    // At exactly one depth all over.
    const auto in_the_middle = [](glm::dvec3 size) {
        return transformed(make_box(size), [](glm::dvec3 p) {
            return p + glm::dvec3(kFineSize / 2.0 + 0.13, kFineSize / 2.0 + 0.27, 30);
        });
    };
    const Scene scene = scene_of({in_the_middle({40, 40, 20}), in_the_middle({17, 11, 20})});
    const Drawing drawn = draw_fine(scene, pixel_camera(kFineSize, kFineSize), kFineSize);
    EXPECT_GT(drawn.sum("lines.A"), 100);
    EXPECT_EQ(count_false(drawn, truth(scene, pixel_camera(kFineSize, kFineSize), kFineSize)), 0);
}

// A folded quad, and its two triangles once more as objects of their own, each of which ends along the fold.
// What is in front counts where several meet at an edge, be a corner of the others welded to it or not.
TEST(FineLines, AFinThatTouchesFromBehindIsNotSeen) {
    const Camera camera = perspective_camera({1.5, 0.9, 3}, {0.5, 0, 0});
    const auto sheet_with_fin_at = [](double z) {
        return soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.1}, {1, -1, -0.1}, {0, 0, z}, {0.5, 0.3, -1}},
                       {{0, 1, 3}, {1, 0, 4}, {5, 1, 6}});
    };
    const Drawing welded = draw_fine(scene_of({sheet_with_fin_at(0)}), camera, 160);
    for (const double z : {-1e-6, -1e-5, -1e-4, -1e-3, -3e-3}) {
        EXPECT_LE(largest_error(draw_fine(scene_of({sheet_with_fin_at(z)}), camera, 160), welded), 0.3) << z;
    }
}

TEST(FineLines, WhatLiesInAFoldedPolygonHasNoOutline) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const std::vector<glm::dvec3> corners{
            {0.8, 0.3, 0.02}, {0, 0, 0}, {-0.05, -0.12, 0.001 * random.real(-1, 1)}, {0.75, 0.1, 0}};
        const PolygonSoup quad = soup_of(corners, {{3, 2, 1, 0}});
        std::vector<PolygonSoup> objects{quad};
        const Mesh mesh = build_meshes(quad, {}).front();
        for (const auto& t : mesh.triangles) {
            objects.push_back(soup_of(
                {glm::dvec3(mesh.positions[t[0]]), glm::dvec3(mesh.positions[t[1]]), glm::dvec3(mesh.positions[t[2]])},
                {{0, 1, 2}}));
        }
        const glm::dvec3 middle(0.38, 0.08, 0);
        const Camera camera = perspective_camera(middle + 1.6 * random.direction(), middle);
        const Drawing alone = draw_fine(scene_of({quad}), camera, 200), all = draw_fine(scene_of(objects), camera, 200);
        EXPECT_NEAR(all.sum("lines.A"), alone.sum("lines.A"), 4) << "seed " << seed;
    }
}

TEST(FineLines, ThePreviewLeavesThemOutUnlessAskedFor) {
    Scene scene = scene_of({placed(make_box({30, 0.2, 0.2}), 17), wall()});
    const Camera camera = pixel_camera(kFineSize, kFineSize);
    const auto draw_with = [&](std::optional<int> samples, std::optional<bool> fine_lines) {
        scene.abuffer.samples = samples;
        scene.abuffer.fine_lines = fine_lines;
        return draw_fine(scene, camera, kFineSize);
    };
    EXPECT_EQ(largest_error(draw_with({}, {}), draw_with(2, true)), 0);
    EXPECT_EQ(largest_error(draw_with(2, {}), draw_with(2, false)), 0);
    EXPECT_GT(largest_error(draw_with(2, {}), draw_with(2, true)), 0.3);
    EXPECT_EQ(largest_error(draw_with(4, {}), draw_with(4, true)), 0);
    EXPECT_GT(largest_error(draw_with(4, {}), draw_with(4, false)), 0.1);
}

TEST(FineLines, HundredsOfTrianglesToAPixelAreLookedThrough) {
    constexpr int kFewPixels = 40;
    PolygonSoup bumpy = make_torus(0.8, 0.45, 500, 250);
    for (glm::dvec3& p : bumpy.positions) p += 0.05 * glm::sin(21.0 * glm::dvec3(p.y, p.z, p.x));
    Scene scene = scene_of({bumpy});
    for (const glm::dvec3 eye : {kEye, glm::dvec3(4.3, 0.7, 1.1)}) {
        const Camera camera = perspective_camera(eye, {0, 0, 0});
        const Drawing real = truth(scene, camera, kFewPixels, 32);
        const auto error_with = [&](bool has_fine_lines) {
            scene.abuffer.fine_lines = has_fine_lines;
            const Drawing drawn = draw_fine(scene, camera, kFewPixels);
            double sum = 0;
            for (int y = 0; y < kFewPixels; ++y) {
                for (int x = 0; x < kFewPixels; ++x) sum += std::abs(drawn.line(x, y) - real.line(x, y));
            }
            return sum / real.sum("lines.A");
        };
        EXPECT_LT(error_with(true), 0.045);
        EXPECT_GT(error_with(false), 0.06);
    }
}

// In a heap of very many triangles in a pixel lines are left to the samples, but not those beside it.
TEST(FineLines, AHeapTakesNoLinesFromItsNeighbours) {
    constexpr int kLast = 39;
    PolygonSoup bumpy = make_torus(1.9, 0.9, 700, 280);
    for (glm::dvec3& p : bumpy.positions)
        p = glm::dvec3(20.1, 19.9, 0) + p + 0.04 * glm::sin(70.0 * glm::dvec3(p.y, p.z, p.x));
    const auto rod = [](double x, double y, double w, double h) {
        return transformed(make_box({w, h, 0.1}), [=](glm::dvec3 p) { return p + glm::dvec3(x, y, 0); });
    };
    // Between samples.
    const std::vector<PolygonSoup> rods{rod(8.2, 20.5, 13, 0.2), rod(32.1, 19.5, 13, 0.2), rod(20.5, 7.9, 0.2, 13)};
    std::vector<PolygonSoup> all = rods;
    all.push_back(bumpy);
    const Camera camera = pixel_camera(kLast + 1, kLast + 1);
    const Drawing beside = draw_fine(scene_of(rods), camera, kLast + 1),
                  drawn = draw_fine(scene_of(all), camera, kLast + 1);
    for (int y = 0; y <= kLast; ++y) {
        for (int x = 0; x <= kLast; ++x) {
            const bool is_near_heap = x >= 14 && x < 26 && y >= 14 && y < 26;
            if (!is_near_heap) {
                EXPECT_EQ(drawn.line(x, y), beside.line(x, y)) << x << ' ' << y;
            }
        }
    }
    EXPECT_GT(beside.sum("lines.A"), 20);
    Scene scene = scene_of({bumpy});
    const Drawing heap = draw_fine(scene, camera, kLast + 1);
    scene.abuffer.fine_lines = false;
    EXPECT_EQ(largest_error(heap, draw_fine(scene, camera, kLast + 1)), 0);  // or this is no heap
}

TEST(FineLines, ThreadsTilesAndCropsChangeNothing) {
    constexpr int kPicture = 110;
    const Scene scene = rough_scene(7, 90);
    const Camera camera = perspective_camera(kEye, {0, 0, 0});
    const auto render = [&](PixelRect crop, int threads, int tile_samples, std::uint64_t memory_bytes = 0) {
        const Frame frame = make_frame(scene, camera, kPicture, kPicture, crop);
        Film film({0, 0, kPicture, kPicture}, crop, LayerSet{true, true, true, true, true, true, true, true},
                  frame.criteria.classes);
        RunOptions options;
        options.threads = threads;
        options.tile_samples = tile_samples;
        options.memory_bytes = memory_bytes;
        render_abuffer(frame, options, film);
        return film.image();
    };
    const PixelRect all{0, 0, kPicture, kPicture};
    const Image whole = render(all, 1, 128);
    EXPECT_TRUE(same_bits(whole, render(all, 3, 128)));
    EXPECT_TRUE(same_bits(whole, render(all, 2, 32)));
    EXPECT_TRUE(same_bits(whole, render(all, 2, 32, 24 << 20)));
    for (const PixelRect crop : {PixelRect{37, 21, 84, 80}, PixelRect{51, 50, 52, 51}, PixelRect{0, 63, 110, 71}}) {
        const Image part = render(crop, 2, 64);
        for (const Channel& channel : part.channels()) {
            const Channel& full = *whole.find(channel.name);
            for (int y = 0; y < crop.height(); ++y) {
                for (int x = 0; x < crop.width(); ++x) {
                    ASSERT_EQ(part.value(channel, x, y), whole.value(full, x + crop.x0, y + crop.y0))
                        << channel.name << " " << x << "," << y;
                }
            }
        }
    }
}

}  // namespace
}  // namespace burin::fine_lines_test
