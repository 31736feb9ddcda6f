// How much of a line the z-buffer methods lose, and how much hidden line they show: the laws that
// follow from a fill's z being that of the pixel's centre and a vector's z that of the vector. With
// f the pixel's centre minus the line, -1/2 to 1/2, and b = dz/dy, a fill lies b f behind the line.

#include "tests/methods/zbuffer_support.h"

namespace burin::zbuffer_laws_test {
namespace {

using namespace test;

constexpr double kSlopes[] = {1e-4, -1e-3, 1e-2};
/// Lines have 72 to 192 pixels whose f is spread evenly: a share is exact to about 1/60.
constexpr double kShareError = 0.02;

MinimalScene exact(MinimalScene s) {
    s.scene.zbuffer.depth_bits = 64;
    return s;
}

TEST(Stippling, OfOffsetsFollowsTheSlope) {
    for (const double b : kSlopes) {
        for (const double pixels : {0.0, 0.25, 0.4, 0.6}) {
            SCOPED_TRACE(testing::Message() << "b " << b << " eps/b " << pixels);
            MinimalScene s = exact(scene_slope(b));
            s.scene.zbuffer.eps = pixels * std::abs(b);
            const double expected = 0.5 - std::min(0.5, pixels);
            EXPECT_NEAR(measured_missing("offset", s), expected, kShareError);
            // It makes no difference which of the two is moved.
            s.scene.zbuffer.adjust = DepthAdjust::fills;
            EXPECT_NEAR(measured_missing("offset", s), expected, kShareError);
        }
    }
}

TEST(Stippling, OfSimpleEdgingIsHalfAtAnySlope) {
    for (const double b : kSlopes) {
        EXPECT_NEAR(measured_missing("simple", exact(scene_slope(b))), 0.5, kShareError) << b;
    }
    EXPECT_EQ(measured_missing("simple", exact(scene_slope(0))), 0);
}

TEST(Stippling, WithFillOnOneSideDependsOnItsDirection) {
    for (const bool below : {true, false}) {
        for (const double b : {1e-3, -1e-3}) {
            SCOPED_TRACE(testing::Message() << "b " << b << " below " << below);
            const bool nearer_inwards = below == (b < 0);
            EXPECT_NEAR(measured_missing("simple", exact(scene_half_slope(b, below))), nearer_inwards ? 0.5 : 0,
                        kShareError);
        }
    }
}

TEST(Stippling, IsGoneWithAnOffsetOfHalfTheSlope) {
    for (const double b : kSlopes) {
        for (const double factor : {0.5, 1.0}) {
            for (const DepthAdjust adjust : {DepthAdjust::fills, DepthAdjust::edges}) {
                MinimalScene s = exact(scene_slope(b));
                s.scene.zbuffer.factor = factor;
                s.scene.zbuffer.adjust = adjust;
                EXPECT_EQ(measured_missing("slope-offset", s), 0) << b << " " << factor;
            }
        }
        MinimalScene s = exact(scene_slope(b));
        s.scene.zbuffer.factor = 0.3;
        s.scene.zbuffer.units = 0;
        EXPECT_NEAR(measured_missing("slope-offset", s), 0.2, kShareError) << b;
        s.scene.zbuffer.clamp = 0.1 * std::abs(b);
        EXPECT_NEAR(measured_missing("slope-offset", s), 0.4, kShareError) << b;
    }
}

TEST(Stippling, NeverInEdgesThatDoNotMeetTheirFill) {
    for (const std::string_view method : {"decal", "edging-plane", "virgin-plane", "stencil"}) {
        for (const int bits : {16, 32}) {
            for (const double b : kSlopes) {
                MinimalScene s = scene_half_slope(b, true);
                s.scene.zbuffer.depth_bits = bits;
                EXPECT_EQ(measured_missing(method, s), 0) << method << " " << b << " " << bits;
            }
        }
    }
}

TEST(Stippling, NotAtEdgesThatTwoPolygonsShare) {
    for (const std::string_view method : {"decal", "edging-plane", "virgin-plane", "stencil"}) {
        for (const double b : kSlopes) {
            EXPECT_EQ(measured_missing(method, exact(scene_slope(b))), 0) << method << " " << b;
        }
    }
}

TEST(Leak, OfAConstantOffsetBeginsAtTheGap) {
    for (const double gap : {1e-5, 1e-4, 1e-3, 1e-2, 1e-1}) {
        for (const double eps : {0.5 * gap, 0.99 * gap, 1.01 * gap, 2 * gap}) {
            MinimalScene s = exact(scene_gap(gap));
            s.scene.zbuffer.eps = eps;
            const MethodDrawing d("offset", s);
            for (const ScreenSegment& line : s.lines) {
                ASSERT_EQ(drawn_share(d, line), eps > gap ? 1 : 0) << gap << " " << eps;
            }
        }
    }
}

TEST(Leak, NeverBehindALevelCoverWithoutAnOffset) {
    for (const std::string_view method : kZBufferMethods) {
        if (method == "offset") continue;
        for (const double gap : {1e-6, 1e-4, 1e-2}) {
            EXPECT_EQ(MethodDrawing(method, scene_gap(gap)).sum("lines.A"), 0) << method << " " << gap;
        }
    }
}

TEST(Leak, OfASlantedCoverNeedsNoOffset) {
    // A line behind a parallel cover with dz/dy = b shows where the cover's fill, at the pixel's
    // centre, is farther than the line: where D + b f < eps.
    MinimalScene s = exact(scene_dilemma());
    constexpr double b = 0.02, gap = 0.005;
    constexpr double kShareErrorOf31Pixels = 0.05;
    for (const double eps : {0.0, 1e-4, 1e-3, 3e-3, 6e-3, 9e-3, 1.2e-2, 3e-2}) {
        s.scene.zbuffer.eps = eps;
        const MethodDrawing d("offset", s);
        const double missing = missing_share(d, s.lines[0]), leak = drawn_share(d, s.lines[1]);
        EXPECT_NEAR(missing, 0.5 - std::min(0.5, eps / b), kShareErrorOf31Pixels) << eps;
        EXPECT_NEAR(leak, std::clamp(0.5 + (eps - gap) / b, 0.0, 1.0), kShareErrorOf31Pixels) << eps;
        EXPECT_GT(missing + leak, 0.2) << "no offset does it: " << eps;
    }
    // Without any offset the line shows as well: fills and vectors disagree about z by up to |b|/2.
    for (const std::string_view method : {"simple", "decal", "edging-plane", "virgin-plane", "stencil"}) {
        EXPECT_NEAR(drawn_share(MethodDrawing(method, s), s.lines[1]), 0.25, kShareErrorOf31Pixels) << method;
    }
    // The slope's worth of an offset lets it through everywhere.
    EXPECT_EQ(drawn_share(MethodDrawing("slope-offset", s), s.lines[1]), 1);
}

TEST(Leak, OfSlopeOffsetsIsWorstAtTheLimb) {
    MinimalScene s = scene_sphere();
    double inner = 0, outer = 0;
    const MethodDrawing d("slope-offset", s);
    for (int y = 0; y < s.size_px; ++y) {
        for (int x = 0; x < s.size_px; ++x) {
            const double radius = glm::distance(glm::dvec2(x + 0.5, y + 0.5), glm::dvec2(128.2, 127.9));
            (radius < 60 ? inner : outer) += d.at("lines.A", x, y);
        }
    }
    EXPECT_EQ(inner, 0);
    EXPECT_GT(outer, 100);
    for (const std::string_view method : {"simple", "offset", "decal", "edging-plane", "virgin-plane", "stencil"}) {
        EXPECT_LE(MethodDrawing(method, s).sum("lines.A"), 0.02 * outer) << method;
    }
    // A clamp confines it, and brings stippling back where faces are steep.
    s.scene.zbuffer.clamp = 1e-3;
    EXPECT_LT(MethodDrawing("slope-offset", s).sum("lines.A"), 0.1 * outer);
    MinimalScene steep = exact(scene_slope(1e-2));
    steep.scene.zbuffer.clamp = 1e-3;
    EXPECT_NEAR(measured_missing("slope-offset", steep), 0.4, kShareError);
}

}  // namespace
}  // namespace burin::zbuffer_laws_test
