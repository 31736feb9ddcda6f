// Pictures on paper: sizes, margins, scales, and standard views on one sheet.

#include "scene/paper.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/paper_camera.h"
#include "scene/standard_views.h"
#include "tests/scene/scene_text.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::described;
using test::kBox;
using test::Random;

TEST(Paper, HasNames) {
    EXPECT_EQ(paper_named("A4"), glm::dvec2(210, 297));
    EXPECT_EQ(paper_named("a3-landscape"), glm::dvec2(420, 297));
    EXPECT_EQ(paper_named("A0"), glm::dvec2(841, 1189));
    EXPECT_EQ(paper_named("letter"), glm::dvec2(215.9, 279.4));
    EXPECT_EQ(paper_named("legal-landscape"), glm::dvec2(355.6, 215.9));
    EXPECT_EQ(paper_named("200x100.5mm"), glm::dvec2(200, 100.5));
    for (const char* const word : {"", "A6", "A4-portrait", "200x100", "200x100in", "x100mm", "0x100mm", "-5x100mm",
                                   "5001x1mm", "nanx1mm", "200x100mm-landscape", "1e3x1mm ", "-landscape"}) {
        EXPECT_FALSE(paper_named(word)) << word;
    }
}

TEST(Paper, Scales) {
    EXPECT_EQ(scale_named("1:2"), 0.5);
    EXPECT_EQ(scale_named("5:1"), 5);
    EXPECT_EQ(scale_named("0.1"), 0.1);
    for (const char* const word : {"", "0", "1:0", "-1:2", "1:2:3", "a", "1:", ":2", "inf"})
        EXPECT_FALSE(scale_named(word)) << word;
    EXPECT_EQ(text_of_scale(0.5), "1:2");
    EXPECT_EQ(text_of_scale(2.5), "2.5:1");
    EXPECT_EQ(text_of_scale(round_scale_down(105.97)), "105:1");
    EXPECT_EQ(text_of_scale(round_scale_down(1 / 5914.5)), "1:5920");
    EXPECT_EQ(text_of_scale(round_scale_down(1)), "1:1");
}

TEST(Paper, GivesThePictureItsProportions) {
    const PictureSettings upright = described(std::string(kBox) + "[picture]\npaper='A4'\nsize=[1485,7]\n").picture;
    EXPECT_EQ(upright.width, 1050);
    EXPECT_EQ(upright.height, 1485);
    EXPECT_DOUBLE_EQ(upright.dpi, 127);
    const PictureSettings lying =
        described(std::string(kBox) + "[picture]\npaper='A4-landscape'\nsize=[7,1485]\n").picture;
    EXPECT_EQ(lying.width, 1485);
    EXPECT_EQ(lying.height, 1050);
    EXPECT_EQ(size_in_mm(lying), glm::dvec2(297, 210));
}

TEST(Paper, KeysOfScenes) {
    const PaperSettings paper =
        described(std::string(kBox) + "[picture]\npaper='A4'\nmargin=[25,15,10,20]\nscale='1:2'\nunit='in'\n")
            .picture.paper;
    EXPECT_EQ(paper.margin_mm, (std::array<double, 4>{25, 15, 10, 20}));
    EXPECT_EQ(paper.scale, 0.5);
    EXPECT_EQ(paper.unit_mm, 25.4);
    EXPECT_EQ(described(std::string(kBox) + "[picture]\nmargin=5\n").picture.paper.margin_mm,
              (std::array<double, 4>{5, 5, 5, 5}));
    for (const char* const wrong : {"paper='A9'", "paper=4", "paper='A4'\ndpi=96", "margin=-1", "margin=[1,2]",
                                    "scale='1/2'", "scale=0", "unit='parsec'"}) {
        EXPECT_THROW(described(std::string(kBox) + "[picture]\n" + wrong + "\n"), InputError) << wrong;
    }
}

TEST(Paper, AViewFillsWhatIsWithinTheMargins) {
    for (std::uint64_t trial = 0; trial < 50; ++trial) {
        Random random(trial);
        PictureSettings picture;
        picture.paper.size_mm = {random.real(100, 400), random.real(100, 400)};
        for (double& side : picture.paper.margin_mm) side = random.real(0, 40);
        fit_to_paper(picture);
        std::vector<glm::dvec3> points;
        for (int i = 0; i < 9; ++i) points.push_back(random.in_box(random.real(0.1, 5)));
        const PointSource source = [&](const auto& visit) { visit(std::span<const glm::dvec3>(points)); };
        CameraSettings settings;
        settings.orthographic = trial % 2 == 0;
        settings.fit = 1;
        settings.area = area_within_margins(picture);
        const Camera camera = resolve_camera(settings, source, static_cast<double>(picture.width) / picture.height);
        const Projection projection = camera.projection(picture.width, picture.height, 0);
        glm::dvec2 low(1e9), high(-1e9);
        for (const glm::dvec3& p : points) {
            const glm::dvec2 mm =
                projection.to_pixel(glm::dvec3(camera.to_view() * glm::dvec4(p, 1))) * (25.4 / picture.dpi);
            low = glm::min(low, mm);
            high = glm::max(high, mm);
        }
        const auto& [top, right, bottom, left] = picture.paper.margin_mm;
        const glm::dvec2 free_low = low - glm::dvec2(left, top);
        const glm::dvec2 free_high = *picture.paper.size_mm - glm::dvec2(right, bottom) - high;
        EXPECT_NEAR(std::min({free_low.x, free_low.y, free_high.x, free_high.y}), 0, 1e-6) << trial;
        if (!settings.orthographic) continue;
        EXPECT_NEAR(free_low.x, free_high.x, 1e-6) << trial;
        EXPECT_NEAR(free_low.y, free_high.y, 1e-6) << trial;
    }
}

TEST(Paper, TooSmallForItsMargins) {
    PictureSettings picture;
    picture.paper.size_mm = {100, 50};
    picture.paper.margin_mm = {25, 0, 25, 0};
    fit_to_paper(picture);
    EXPECT_THROW(area_within_margins(picture), InputError);
    picture.paper.margin_mm = {25, 0, 24, 0};
    EXPECT_NEAR(area_within_margins(picture).low.y, 0.5, 1e-3);
}

TEST(Paper, OnlyOrthographicViewsHaveAScale) {
    PictureSettings picture;
    picture.paper.size_mm = {100, 50};
    picture.paper.margin_mm = {5, 0, 5, 0};
    picture.paper.scale = 0.5;
    picture.paper.unit_mm = 10;
    fit_to_paper(picture);
    CameraSettings camera;
    EXPECT_THROW(see_on_paper(picture, camera), InputError);
    camera.orthographic = true;
    see_on_paper(picture, camera);
    EXPECT_DOUBLE_EQ(*camera.height, 8);
}

/// Places of a box's corners on the sheet, in mm with y upwards, as the middle and the size.
struct SeenBox {
    glm::dvec2 middle, size;
};
SeenBox seen(const ViewOnSheet& view, const PictureSettings& picture, const glm::dvec3& size) {
    const Projection projection = view.camera.projection(picture.width, picture.height, 0);
    glm::dvec2 low(1e9), high(-1e9);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 p = size * glm::dvec3(i & 1, i >> 1 & 1, i >> 2 & 1);
        glm::dvec2 mm =
            projection.to_pixel(glm::dvec3(view.camera.to_view() * glm::dvec4(p, 1))) * (25.4 / picture.dpi);
        mm.y = picture.paper.size_mm->y - mm.y;
        low = glm::min(low, mm);
        high = glm::max(high, mm);
    }
    return {0.5 * (low + high), high - low};
}

TEST(StandardViews, StandWhereTheProjectionSaysAlignedAndAtOneScale) {
    const glm::dvec3 size(60, 40, 20);
    const PointSource source = [&](const auto& visit) {
        std::vector<glm::dvec3> points;
        for (int i = 0; i < 8; ++i) points.push_back(size * glm::dvec3(i & 1, i >> 1 & 1, i >> 2 & 1));
        visit(std::span<const glm::dvec3>(points));
    };
    using enum StandardView;
    PictureSettings picture;
    picture.paper.size_mm = {297, 210};
    picture.paper.margin_mm.fill(10);
    picture.paper.scale = 1;
    picture.width = 2970;
    fit_to_paper(picture);
    for (const ViewProjection projection : {ViewProjection::first, ViewProjection::third}) {
        const auto views =
            views_on_sheet({front, top, right, left, bottom, back, iso}, projection, picture, {0, 1, 0}, source);
        ASSERT_EQ(views.size(), 7u);
        std::vector<SeenBox> boxes;
        for (const ViewOnSheet& view : views) boxes.push_back(seen(view, picture, size));
        const glm::dvec2 expected[] = {{60, 40}, {60, 20}, {20, 40}, {20, 40}, {60, 20}, {60, 40}};
        for (std::size_t i = 0; i < 6; ++i) {
            EXPECT_NEAR(boxes[i].size.x, expected[i].x, 1e-6);
            EXPECT_NEAR(boxes[i].size.y, expected[i].y, 1e-6);
        }
        for (const std::size_t i : {1u, 4u}) EXPECT_NEAR(boxes[i].middle.x, boxes[0].middle.x, 1e-6);
        for (const std::size_t i : {2u, 3u, 5u}) EXPECT_NEAR(boxes[i].middle.y, boxes[0].middle.y, 1e-6);
        const double side = projection == ViewProjection::third ? 1 : -1;
        EXPECT_GT(side * (boxes[1].middle.y - boxes[0].middle.y), 30 + 5);  // the top above in third angle
        EXPECT_LT(side * (boxes[4].middle.y - boxes[0].middle.y), -30 - 5);
        EXPECT_GT(side * (boxes[2].middle.x - boxes[0].middle.x), 40 + 5);  // from the right on the right
        EXPECT_LT(side * (boxes[3].middle.x - boxes[0].middle.x), -40 - 5);
        // None covers another, and none is in the margins.
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const glm::dvec2 low = boxes[i].middle - 0.5 * boxes[i].size, high = boxes[i].middle + 0.5 * boxes[i].size;
            EXPECT_GT(std::min(low.x, low.y), 10 - 0.1);
            EXPECT_LT(high.x, 287 + 0.1);
            EXPECT_LT(high.y, 200 + 0.1);
            for (std::size_t k = 0; k < i; ++k) {
                const glm::dvec2 apart =
                    glm::abs(boxes[i].middle - boxes[k].middle) - 0.5 * (boxes[i].size + boxes[k].size);
                EXPECT_GT(std::max(apart.x, apart.y), 9) << i << " " << k;
            }
        }
    }
}

TEST(StandardViews, AreFittedOrRefused) {
    const PointSource source = [&](const auto& visit) {
        const std::vector<glm::dvec3> points = {glm::dvec3(0), glm::dvec3(600, 400, 200)};
        visit(std::span<const glm::dvec3>(points));
    };
    using enum StandardView;
    PictureSettings picture;
    picture.paper.size_mm = {297, 210};
    fit_to_paper(picture);
    const auto views = views_on_sheet({front, right}, ViewProjection::first, picture, {0, 1, 0}, source);
    const SeenBox first = seen(views[0], picture, {600, 400, 200});
    EXPECT_NEAR(first.size.x, 0.95 * (297 - 10) * 600 / 800, 0.5);
    picture.paper.scale = 1;
    EXPECT_THROW(views_on_sheet({front, right}, ViewProjection::first, picture, {0, 1, 0}, source), UsageError);
    picture.paper.scale = 0.2;
    EXPECT_NO_THROW(views_on_sheet({front, right}, ViewProjection::first, picture, {0, 1, 0}, source));
    // Where Z is up, the front is what looks along +Y.
    const auto upright = views_on_sheet({front}, ViewProjection::first, picture, {0, 0, 1}, source);
    EXPECT_EQ(glm::dvec3(upright[0].camera.to_world[2]), glm::dvec3(0, -1, 0));
}

}  // namespace
}  // namespace burin
