// Lines that samples miss, where surfaces nearly meet: narrow gaps, cracks, seams, plates in contact.

#include <gtest/gtest.h>

#include "tests/abuffer/fine_drawings.h"

namespace burin::fine_contacts_test {
namespace {

using namespace test;

TEST(FineContacts, BothSidesOfANarrowGapAreDrawn) {
    for (const double angle : kAngles_deg) {
        const auto half = [&](double side) {
            return placed(
                transformed(make_box({28, 12, 5}), [=](glm::dvec3 p) { return p + glm::dvec3(0, side * 6.075, 0); }),
                angle);
        };
        const Scene scene = scene_of({half(1), half(-1), wall()});
        const Camera camera = pixel_camera(kFineSize, kFineSize);
        EXPECT_LT(largest_error(draw_fine(scene, camera, kFineSize), truth(scene, camera, kFineSize)), 0.06) << angle;
    }
}

// The surface beyond the gap is as near as the one that ends at it.
TEST(FineContacts, BothSidesOfNarrowGapsBetweenPlanksAreDrawn) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        const bool is_solid = random.integer(0, 1) == 0;
        const double angle = random.integer(0, 1) == 0 ? 90.0 * random.integer(0, 3) : random.real(0, 180);
        std::vector<PolygonSoup> planks{wall()};
        double y = -15;
        if (seed % 4 == 0) y = -15.25;  // edges along rows of samples
        while (y < 12) {
            const double height = seed % 4 == 0 ? random.integer(1, 4) : random.real(1, 6);
            const auto rise = [=](glm::dvec3 p) { return p + glm::dvec3(0, y + 0.5 * height, 0); };
            const PolygonSoup sheet = soup_of(
                {{-11, -0.5 * height, 0}, {11, -0.5 * height, 0}, {11, 0.5 * height, 0}, {-11, 0.5 * height, 0}},
                {{0, 1, 2, 3}});
            planks.push_back(placed(transformed(is_solid ? make_box({22, height, 4}) : sheet, rise), angle));
            y += height + (seed % 4 == 0 ? 0.125 * random.integer(1, 3) : random.real(0.05, 0.45));
        }
        Scene scene = scene_of(planks);
        scene.lines.style.width_px = random.integer(0, 1) == 0 ? 0.3 : 1;
        const Camera camera = pixel_camera(kFineSize, kFineSize);
        EXPECT_LT(largest_error(draw_fine(scene, camera, kFineSize), truth(scene, camera, kFineSize, 32)), 0.12)
            << "seed " << seed;
    }
}

// In its middle nothing runs along it.
TEST(FineContacts, ABorderThatIsASeamInPartIsNoneThere) {
    for (const double share : {0.3, 0.45, 0.7}) {
        PolygonSoup floor = soup_of({{-5, 0, 0}, {5, 0, 0}, {5, 0, 3}, {-5, 0, 3}}, {{0, 1, 2, 3}});
        constexpr int kPatches = 4;
        for (int i = 0; i < kPatches; ++i) {
            const double from = -5 + 10 * share * i / kPatches, to = -5 + 10 * share * (i + 1) / kPatches;
            const auto first = static_cast<std::uint32_t>(floor.positions.size());
            for (const auto& [x, z] :
                 {std::pair(from, -3 + 0.2 * (i % 2)), {to, -3 + 0.2 * (i % 2)}, {to, 0.0}, {from, 0.0}})
                floor.positions.emplace_back(x, 0, z);
            floor.add_polygon(std::vector<std::uint32_t>{first, first + 1, first + 2, first + 3});
        }
        for (const double height : {4.0, 10.0}) {
            const Camera camera = perspective_camera({4.48288, height, 16.7303}, {0, 0, 0}, 35);
            const auto ink = [&](RenderFunction render) {
                return Drawing(scene_of({floor}), camera, 120, 120, {0, 0, 120, 120}, 2, render).sum("lines.A");
            };
            EXPECT_NEAR(ink(render_abuffer) / ink(render_reference), 1, 0.01) << share << ", " << height;
        }
    }
}

TEST(FineContacts, ACrackBesideAPartOfABorderIsNoLine) {
    for (const double crack : {0.004, 0.02, 0.1, 0.2, 0.4}) {
        for (const double share : {0.3, 0.45, 0.7}) {
            for (const double y : {0.0, 0.13, 0.25}) {
                const double end = -12 + 24 * share;
                const PolygonSoup patches = soup_of({{-12, y, 0},
                                                     {12, y, 0},
                                                     {12, 9, 0},
                                                     {-12, 9, 0},
                                                     {-12, -9, 0},
                                                     {end, -9, 0},
                                                     {end, y - crack, 0},
                                                     {-12, y - crack, 0}},
                                                    {{0, 1, 2, 3}, {4, 5, 6, 7}});
                const Scene scene = scene_of({placed(patches, 0), wall()});
                const Camera camera = pixel_camera(kFineSize, kFineSize);
                EXPECT_LT(largest_error(draw_fine(scene, camera, kFineSize), truth(scene, camera, kFineSize)), 0.4)
                    << "crack " << crack << ", share " << share << ", y " << y;
            }
        }
    }
}

/// Closer than 1/64 pixel with no sample between them: wherever blocks of pixels, their cells and tiles end.
TEST(FineContacts, PlatesInContactHaveNoBorders) {
    constexpr int kWide = 96;
    for (const double end : {16.25, 20.25, 33.1, 48.25, 56.25, 64.25}) {
        for (const double gap : {1 / 256.0, 2 / 256.0, 3 / 256.0}) {
            for (const bool is_level : {false, true}) {
                const auto plate = [&](double from, double to) {
                    PolygonSoup soup = soup_of({{from, 5, 0}, {to, 5, 0}, {to, 91, 0}, {from, 91, 0}}, {{0, 1, 2, 3}});
                    return is_level ? transformed(soup, [](glm::dvec3 p) { return glm::dvec3(p.y, kWide - p.x, p.z); })
                                    : soup;
                };
                Scene scene = scene_of({plate(5.3, end - gap), plate(end, 90.3)});
                scene.lines.classes = LineClass::border;
                const Drawing drawn = draw_fine(scene, pixel_camera(kWide, kWide), kWide);
                double ink = 0;
                for (int along = 8; along < 88; ++along) {
                    for (int across = 8; across < 88; ++across)
                        ink += is_level ? drawn.line(along, across) : drawn.line(across, along);
                }
                EXPECT_EQ(ink, 0) << end << ", gap " << gap << (is_level ? ", level" : "");
            }
        }
    }
}

/// Bars between two rows of samples, one after the other, whose ends are in contact: wherever tiles end, as they do
/// elsewhere in a crop.
TEST(FineContacts, ContactsDoNotHangOnTiles) {
    constexpr int kWide = 96;
    const PixelRect crop{40, 0, 80, kWide};
    for (const int gap : {1, 2, 3}) {
        PolygonSoup bars[2];
        for (const double end : {48.25, 56.25, 64.25, 72.25}) {
            for (int before = 1; before < 3; ++before) {
                for (PolygonSoup& soup : bars) {
                    const bool is_left = &soup == bars;
                    const double edge = end + (is_left ? -before : gap - before) / 256.0,
                                 other = edge + (is_left ? -3 : 3);
                    const double y = 3 * before + std::floor(end / 2) + 0.3;
                    const auto first = static_cast<std::uint32_t>(soup.positions.size());
                    for (const auto& [px, py] : {std::pair(edge, y), {other, y}, {other, y + 0.4}, {edge, y + 0.4}})
                        soup.positions.emplace_back(px, py, 0);
                    soup.add_polygon(std::vector<std::uint32_t>{first, first + 1, first + 2, first + 3});
                }
            }
        }
        for (PolygonSoup& soup : bars) soup.object_names = {"bars"};
        Scene scene = scene_of({bars[0], bars[1]});
        scene.lines.classes = LineClass::border;
        scene.lines.style.width_px = 0.25;
        const Camera camera = pixel_camera(kWide, kWide);
        const Drawing whole = draw_fine(scene, camera, kWide),
                      part(scene, camera, kWide, kWide, crop, 2, render_abuffer);
        for (int y = crop.y0; y < crop.y1; ++y) {
            for (int x = crop.x0; x < crop.x1; ++x)
                ASSERT_EQ(part.line(x - crop.x0, y - crop.y0), whole.line(x, y)) << x << ", " << y << ", gap " << gap;
        }
    }
}

}  // namespace
}  // namespace burin::fine_contacts_test
