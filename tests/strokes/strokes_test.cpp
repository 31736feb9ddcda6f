// Strokes of method `abuffer`: widths, filters, sides, ends, and what they must not be drawn over.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "methods/reference/reference.h"
#include "strokes/pixel_filter.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::strokes_test {
namespace {

using namespace test;

constexpr PixelFilter kFilters[] = {PixelFilter::box, PixelFilter::gaussian, PixelFilter::mitchell};

Drawing draw(const Scene& scene, const Camera& camera, int size, RenderFunction render = render_abuffer) {
    return Drawing(scene, camera, size, size, {0, 0, size, size}, 2, render);
}

PolygonSoup rectangle(double x0, double y0, double x1, double y1, double z) {
    return soup_of({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, {{0, 1, 2, 3}});
}

/// The filters' formulas, as their authors give them.
double filter_value(PixelFilter filter, double x) {
    x = std::abs(x);
    if (filter == PixelFilter::box) return x < 0.5 ? 1 : 0;
    if (filter == PixelFilter::gaussian) return std::exp(-2 * x * x) * std::sqrt(2 / 3.14159265358979);
    if (x < 1) return (7 * x * x * x - 12 * x * x + 16.0 / 3) / 6;
    return x < 2 ? (-7.0 / 3 * x * x * x + 12 * x * x - 20 * x + 32.0 / 3) / 6 : 0;
}

double integral(PixelFilter filter, double from, double to) {
    constexpr int kSteps = 4000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) sum += filter_value(filter, from + (to - from) * (i + 0.5) / kSteps);
    return sum * (to - from) / kSteps;
}

TEST(Strokes, FiltersMakeTheirProfileOfAStraightLine) {
    constexpr int kSize = 64;
    for (const PixelFilter filter : kFilters) {
        for (const double width : {0.5, 1.0, 3.25}) {
            for (const double edge : {30.0, 30.28, 30.5, 30.84}) {
                Scene scene = scene_of({rectangle(edge, -20, 90, 90, 0)});
                scene.lines.style.width_px = width;
                scene.lines.style.filter = filter;
                const Drawing d = draw(scene, pixel_camera(kSize, kSize), kSize);
                const double at = std::round(edge * 256) / 256;
                for (int x = 24; x < 38; ++x) {
                    const double middle = x + 0.5;
                    const double expected = integral(filter, at - 0.5 * width - middle, at + 0.5 * width - middle);
                    // Samples are 1/32 pixel apart; negative lobes are cut off.
                    ASSERT_NEAR(d.line(x, 32), std::clamp(expected, 0.0, 1.0),
                                filter == PixelFilter::box ? 0.033 : 0.012)
                        << "filter " << static_cast<int>(filter) << " width " << width << " edge " << edge << " x "
                        << x;
                }
            }
        }
    }
}

TEST(Strokes, NoFilterChangesTheSumOfAMask) {
    Random random(1);
    for (const PixelFilter filter : {PixelFilter::gaussian, PixelFilter::mitchell}) {
        const auto table = FilterTable::make(filter);
        for (int trial = 0; trial < 200; ++trial) {
            StrokeMask mask;
            int count = 0;
            for (std::uint32_t& row : mask.rows) {
                row = static_cast<std::uint32_t>(random.integer(0, 0xFFFF)) << random.integer(0, 16);
                count += std::popcount(row);
            }
            double sum = 0;
            for (const auto& row : table->shares_of(mask)) {
                for (const float share : row) sum += static_cast<double>(share);
            }
            EXPECT_NEAR(sum, count / 512.0, 1e-5);
        }
    }
    EXPECT_EQ(FilterTable::make(PixelFilter::box), nullptr);
}

TEST(Strokes, FiltersKeepTheEnergyOfStrokes) {
    constexpr int kSize = 96;
    Scene scene = scene_of({soup_of({{20.2, 20.7, 0}, {75.4, 31.3, 0}, {41.9, 77.2, 0}}, {{0, 1, 2}})});
    for (const double width : {0.05, 0.3, 1.0, 5.0}) {
        scene.lines.style.width_px = width;
        double box = 0;
        for (const PixelFilter filter : kFilters) {
            scene.lines.style.filter = filter;
            const double sum = draw(scene, pixel_camera(kSize, kSize), kSize).sum("lines.A");
            if (filter == PixelFilter::box) box = sum;
            // Without its lobes, Mitchell's filter adds what they would take away.
            EXPECT_NEAR(sum, box, (filter == PixelFilter::mitchell ? 0.05 : 0.005) * box) << width;
        }
    }
}

TEST(Strokes, ThinStrokesHaveTheirEnergyAtEveryAngleAndPlace) {
    constexpr int kSize = 80;
    for (const double width : {0.05, 0.3, 0.6, 1.0}) {
        // At some of them, strokes would be in step with the samples of a plain grid.
        for (const double angle : {0.0, 3.0, 26.5651, 40.0, 45.0, 61.0, 90.0}) {
            for (const double shift : {0.0, 0.17, 0.44}) {
                const glm::dvec2 u(std::cos(glm::radians(angle)), std::sin(glm::radians(angle))), v(-u.y, u.x);
                const glm::dvec2 a = glm::dvec2(40 + shift, 40 + shift) - 25.0 * u;
                const auto at = [&](double along, double across) {
                    const glm::dvec2 p = a + along * u + across * v;
                    return glm::dvec3(p, 0);
                };
                // A crease that two faces on an orthographic view have in common.
                Scene scene = scene_of({soup_of(
                    {at(0, 0), at(50, 0), at(50, 20) + glm::dvec3(0, 0, -40), at(0, 20) + glm::dvec3(0, 0, -40),
                     at(50, -20) + glm::dvec3(0, 0, -40), at(0, -20) + glm::dvec3(0, 0, -40)},
                    {{0, 1, 2, 3}, {1, 0, 5, 4}})});
                scene.lines.classes = LineClass::crease;
                scene.lines.style.width_px = width;
                const double expected = 50 * width + 3.14159265 / 4 * width * width;
                const double sum = draw(scene, pixel_camera(kSize, kSize), kSize).sum("lines.A");
                EXPECT_NEAR(sum, expected, 0.015 * expected) << width << " px at " << angle << " deg, shift " << shift;
            }
        }
    }
}

/// A box with a plate in front of one corner of it. Edges of the box go on behind the plate.
Scene box_behind_plate() {
    const auto turned = [](glm::dvec3 p) {
        const double a = 0.6, b = 0.5;
        p = {p.x * std::cos(a) - p.z * std::sin(a), p.y, p.x * std::sin(a) + p.z * std::cos(a)};
        p = {p.x, p.y * std::cos(b) - p.z * std::sin(b), p.y * std::sin(b) + p.z * std::cos(b)};
        return p + glm::dvec3(48.3, 47.6, -100);
    };
    return scene_of(
        {transformed(make_box({46, 46, 46}), turned),
         soup_of({{34.2, 38.1, 100}, {60.7, 33.6, 100}, {65.4, 58.8, 100}, {38.3, 63.3, 100}}, {{0, 1, 2, 3}})});
}

TEST(Strokes, NothingIsDrawnOverANearerSurfaceThatHasNoLines) {
    constexpr int kSize = 96;
    for (const double width : {1.0, 12.0, 64.0}) {
        for (const StrokeSide side : {StrokeSide::both, StrokeSide::outside}) {
            Scene scene = box_behind_plate();
            scene.lines.classes = LineClassSet(LineClass::crease) | LineClass::silhouette;
            scene.lines.style.width_px = width;
            scene.lines.style.side = side;
            const Drawing d = draw(scene, pixel_camera(kSize, kSize), kSize);
            int inside = 0;
            for (int y = 1; y + 1 < kSize; ++y) {
                for (int x = 1; x + 1 < kSize; ++x) {
                    bool is_plate = true;  // all around
                    for (int dy = -1; dy <= 1; ++dy) {
                        for (int dx = -1; dx <= 1; ++dx) is_plate = is_plate && d.at("id.object", x + dx, y + dy) == 2;
                    }
                    if (!is_plate) continue;
                    ++inside;
                    ASSERT_EQ(d.line(x, y), 0) << "width " << width << ": " << x << "," << y;
                }
            }
            EXPECT_GT(inside, 400);
            EXPECT_GT(d.sum("lines.A"), 50);
        }
    }
}

TEST(Strokes, OutsideStrokesLeaveEverySurfaceFree) {
    constexpr int kSize = 96;
    Scene scene = scene_of({rectangle(20.3, 20.3, 70.6, 60.2, 0), rectangle(40.1, 35.4, 80.2, 76.7, 50)});
    scene.lines.style.width_px = 9;
    for (const StrokeSide side : {StrokeSide::inside, StrokeSide::outside}) {
        scene.lines.style.side = side;
        const Drawing d = draw(scene, pixel_camera(kSize, kSize), kSize);
        EXPECT_NEAR(d.line(45, 96 - 50), 0, 0) << "deep in the near one";
        // Beside the near rectangle's left side, over the far one, and inside of it.
        EXPECT_EQ(d.line(37, 96 - 50), side == StrokeSide::outside ? 1 : 0);
        EXPECT_EQ(d.line(42, 96 - 50), side == StrokeSide::outside ? 0 : 1);
        // Corners: round outside, sharp inside.
        EXPECT_EQ(d.line(78, 96 - 75), side == StrokeSide::outside ? 0 : 1);
        EXPECT_EQ(d.line(84, 96 - 81), 0) << "beyond the round corner";
        EXPECT_EQ(d.line(81, 96 - 77), side == StrokeSide::outside ? 1 : 0);
    }
}

/// Also where corners of lines lie beyond the squares of samples that tell of them.
TEST(Strokes, InsideStrokesStayOnTheSurface) {
    constexpr int kSize = 120;
    std::size_t ink = 0;
    double stray_px = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        Random random(seed);
        Scene scene = scene_of({make_torus(0.75, 0.25, 48, 24)});
        scene.lines.style.width_px = random.real(3, 12);
        scene.lines.style.side = StrokeSide::inside;
        const Drawing d = draw(scene, perspective_camera(3.0 * random.direction(), {0, 0, 0}), kSize);
        const auto is_beside = [&](int x, int y) {
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    const int u = std::clamp(x + dx, 0, kSize - 1), v = std::clamp(y + dy, 0, kSize - 1);
                    if (d.at("id.object", u, v) != 0) return false;
                }
            }
            return true;
        };
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                ink += d.line(x, y) > 0.5 ? 1 : 0;
                if (is_beside(x, y)) stray_px += d.line(x, y);
            }
        }
    }
    EXPECT_LT(stray_px, 1) << "but for a contour that goes on behind its cusp";
    EXPECT_GT(ink, 10000u);
}

TEST(Strokes, BothSidesTogetherAreTheWholeStroke) {
    constexpr int kSize = 96;
    Scene scene = scene_of({transformed(make_torus(26, 9, 48, 24), [](glm::dvec3 p) {
        return glm::dvec3(p.x, 0.8 * p.z + 0.6 * p.y, 0.8 * p.y - 0.6 * p.z) + glm::dvec3(48, 48, 0);
    })});
    scene.lines.classes = LineClassSet(LineClass::silhouette) | LineClass::border;
    scene.lines.style.width_px = 3;
    double sums[3];
    for (const StrokeSide side : {StrokeSide::both, StrokeSide::inside, StrokeSide::outside}) {
        scene.lines.style.side = side;
        sums[static_cast<int>(side)] = draw(scene, pixel_camera(kSize, kSize), kSize).sum("lines.A");
    }
    EXPECT_NEAR(sums[1] + sums[2], sums[0], 0.02 * sums[0]);
    EXPECT_GT(sums[1], 0.3 * sums[0]);
    EXPECT_GT(sums[2], 0.3 * sums[0]);
}

double psnr_db(const Drawing& a, const Drawing& b) {
    double sum = 0;
    int count = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const double va = a.line(x, y), vb = b.line(x, y);
            if (va == 0 && vb == 0) continue;
            sum += (va - vb) * (va - vb);
            ++count;
        }
    }
    return -10 * std::log10(sum / count + 1e-12);
}

/// A bead around a cylinder turns away half a sample behind the line in which it goes into the cylinder.
TEST(Strokes, SurfacesThatPassThroughEachOtherNearAFoldMeetThere) {
    constexpr int kSize = 128;
    const auto tilted = [](PolygonSoup soup) {
        return transformed(std::move(soup), [](glm::dvec3 p) {
            return glm::dvec3(64 + p.x, 64 + 0.8 * p.y - 0.6 * p.z, 0.6 * p.y + 0.8 * p.z);
        });
    };
    for (const double bead : {4.0, 5.5, 7.0}) {
        Scene scene = scene_of({tilted(make_cylinder(44, 38, 60, 96)), tilted(make_torus(43, bead, 96, 24))});
        const Camera camera = pixel_camera(kSize, kSize);
        const Drawing drawn = draw(scene, camera, kSize);
        scene.reference.samples = 32;
        EXPECT_GT(psnr_db(drawn, draw(scene, camera, kSize, render_reference)), 40) << "bead " << bead;
    }
}

TEST(Strokes, OneSideIsWhatRaysSay) {
    constexpr int kSize = 96;
    const Scene scenes[] = {
        box_behind_plate(),
        scene_of({transformed(make_sphere(30, 48, 24), [](glm::dvec3 p) { return p + glm::dvec3(44, 44, 0); }),
                  rectangle(50.4, 20.3, 88.1, 52.7, 120)})};
    for (const Scene& plain : scenes) {
        for (const StrokeSide side : {StrokeSide::both, StrokeSide::inside, StrokeSide::outside}) {
            for (const double width : {1.0, 3.0, 10.0}) {
                Scene scene = plain;
                scene.lines.style.side = side;
                scene.lines.style.width_px = width;
                const Camera camera = pixel_camera(kSize, kSize);
                const double psnr = psnr_db(draw(scene, camera, kSize), draw(scene, camera, kSize, render_reference));
                EXPECT_GT(psnr, 38) << "width " << width << " side " << static_cast<int>(side) << " objects "
                                    << scene.objects.size() << (&plain == scenes ? " box" : " sphere");
            }
        }
    }
}

/// Seen along their axis, bodies have two edges in each place, which must not cut each other off.
TEST(Strokes, EdgesInOnePlaceAreOneStroke) {
    constexpr int kSize = 48;
    const Camera camera = pixel_camera(kSize, kSize);
    for (const double angle_deg : {0.0, 20.0, 71.0}) {
        const double c = std::cos(glm::radians(angle_deg)), s = std::sin(glm::radians(angle_deg));
        const auto upright = [=](glm::dvec3 p) {
            return glm::dvec3(24.1 + c * p.x + s * p.z, 23.8 + s * p.x - c * p.z, p.y);
        };
        for (const PolygonSoup& body : {make_box({24, 4, 16}), make_cylinder(9, 9, 12, 48)}) {
            for (const StrokeSide side : {StrokeSide::both, StrokeSide::inside, StrokeSide::outside}) {
                Scene scene = scene_of({transformed(body, upright)});
                scene.lines.style.side = side;
                const Drawing drawn = draw(scene, camera, kSize), real = draw(scene, camera, kSize, render_reference);
                EXPECT_GT(psnr_db(drawn, real), 35) << angle_deg << " deg, side " << static_cast<int>(side);
            }
        }
    }
}

TEST(Strokes, CropsAndThreadsChangeNothingOfFiltersAndSides) {
    constexpr int kSize = 96;
    const Camera camera = pixel_camera(kSize, kSize);
    for (const PixelFilter filter : kFilters) {
        for (const StrokeSide side : {StrokeSide::both, StrokeSide::inside, StrokeSide::outside}) {
            Scene scene = box_behind_plate();
            scene.lines.style.filter = filter;
            scene.lines.style.side = side;
            scene.lines.style.width_px = 5;
            scene.lines.style.hidden.style = HiddenStyle::dashed;
            scene.lines.classes = LineClassSet(LineClass::crease) | LineClass::silhouette;
            const PixelRect all{0, 0, kSize, kSize}, crop{31, 18, 70, 63};
            const Drawing whole(scene, camera, kSize, kSize, all, 1, render_abuffer);
            EXPECT_TRUE(same_bits(whole.image(), Drawing(scene, camera, kSize, kSize, all, 3, render_abuffer).image()));
            const Drawing part(scene, camera, kSize, kSize, crop, 2, render_abuffer);
            for (const Channel& channel : part.image().channels()) {
                const Channel& full = *whole.image().find(channel.name);
                for (int y = 0; y < part.height(); ++y) {
                    for (int x = 0; x < part.width(); ++x) {
                        ASSERT_EQ(part.image().value(channel, x, y),
                                  whole.image().value(full, x + crop.x0, y + crop.y0))
                            << channel.name << " " << x << "," << y << " filter " << static_cast<int>(filter)
                            << " side " << static_cast<int>(side);
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace burin::strokes_test
