// Which frames there are, what their files are called, and where things stand in them.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "scene/animation/fitted_camera.h"
#include "scene/animation/frame_list.h"
#include "scene/animation/frame_pattern.h"
#include "scene/animation/scene_animation.h"
#include "tests/scene/scene_text.h"

namespace burin::animation_test {
namespace {

using test::expect_near;
using test::SceneText;
using Frames = std::vector<double>;

TEST(FrameList, ReadsWhatOptionsMaySay) {
    const std::vector<std::pair<std::string, Frames>> lists = {
        {"7", {7}},
        {"1-4", {1, 2, 3, 4}},
        {"1:4", {1, 2, 3, 4}},
        {"1..4", {1, 2, 3, 4}},
        {"1-10x4", {1, 5, 9}},
        {"1,5,9-12", {1, 5, 9, 10, 11, 12}},
        {" 1 , 2 ", {1, 2}},
        {"4-1", {4, 3, 2, 1}},
        {"10-1x3", {10, 7, 4, 1}},
        {"-2-1", {-2, -1, 0, 1}},
        {"-3--1", {-3, -2, -1}},
        {"-3:-1", {-3, -2, -1}},
        {"-1..-3", {-1, -2, -3}},
        {"+3", {3}},
        {"0.5", {0.5}},
        {"1-2x0.25", {1, 1.25, 1.5, 1.75, 2}},
        {"1..2x0.5", {1, 1.5, 2}},
        {"3,1-4,2", {3, 1, 2, 4}},
        {"0,-0", {0}},
        {"5-5", {5}},
    };
    for (const auto& [text, frames] : lists) EXPECT_EQ(parse_frame_list(text), frames) << text;
    // Steps do not add up what they are rounded by.
    const Frames tenths = parse_frame_list("0-1000x0.1");
    ASSERT_EQ(tenths.size(), 10001u);
    for (std::size_t i = 0; i < tenths.size(); ++i) EXPECT_EQ(tenths[i], static_cast<double>(i) / 10);
}

std::string error_of(const std::string& list) {
    try {
        parse_frame_list(list);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(FrameList, RefusesTheRest) {
    EXPECT_EQ(error_of("5-1x0"), "5-1x0: a step must not be 0");
    EXPECT_EQ(error_of("1,5-1x0,9"), "5-1x0: a step must not be 0");
    EXPECT_NE(error_of("10-1x-2").find("positive"), std::string::npos);
    for (const char* text : {"",   ",",   "1,",  "a",   "1-",   "-",   "--1",   "1-2-3", "1x2", "1-2x", ".",
                             "1.", "nan", "inf", "1e3", "0x10", "1 2", "1-2y3", "1;2",   "#",   "1,,2", "\xff"})
        EXPECT_NE(error_of(text), "") << text;
    // Nothing is made of what is too much.
    for (const char* text : {"1-1000000000", "1-2000000", "0-1x0.000001", "99999999999999999999999",
                             "1-1000000,2000000-2000001", "1.0000001", "1-1e99"})
        EXPECT_NE(error_of(text), "") << text;
    EXPECT_EQ(parse_frame_list("1-1000000").size(), kMostFrames);
}

TEST(FrameList, IsWrittenAsItIsRead) {
    EXPECT_EQ(text_of_frames({1, 2, 3, 4, 7}), "1-4,7");
    EXPECT_EQ(text_of_frames({1, 2, 9}), "1,2,9");
    EXPECT_EQ(text_of_frames({}), "");
    for (const char* text : {"1-4,7", "-3--1", "0.5,1.5,2.5", "12"})
        EXPECT_EQ(parse_frame_list(text_of_frames(parse_frame_list(text))), parse_frame_list(text)) << text;
    EXPECT_EQ(text_of_frame(12), "12");
    EXPECT_EQ(text_of_frame(-0.0), "0");
    EXPECT_EQ(text_of_frame(1.3), "1.3");
    EXPECT_EQ(text_of_frame(1e9), "1000000000");
}

TEST(FrameRate, MayBeAFraction) {
    EXPECT_EQ(parse_frame_rate("24"), 24);
    EXPECT_EQ(parse_frame_rate("29.97"), 29.97);
    EXPECT_EQ(parse_frame_rate("24000/1001"), 24000.0 / 1001);
    for (const char* text : {"0", "-24", "24/0", "24/", "/1", "x", "", "nan", "inf", "1e99", "24 fps"})
        EXPECT_THROW(parse_frame_rate(text), InputError) << text;
}

TEST(FramePattern, NamesFrames) {
    const auto name = [](const std::string& pattern, double frame) {
        return FramePattern::find(pattern, FramePattern::SingleHash::digits)->path_of(frame);
    };
    EXPECT_EQ(name("out.####.exr", 12), "out.0012.exr");
    EXPECT_EQ(name("out.#.exr", 12), "out.0012.exr");
    EXPECT_EQ(name("out.##.exr", 12345), "out.12345.exr");
    EXPECT_EQ(name("out_%04d.png", 7), "out_0007.png");
    EXPECT_EQ(name("out.$F3.png", 7), "out.007.png");
    EXPECT_EQ(name("out.####.exr", -12), "out.-0012.exr");
    EXPECT_EQ(name("out.###.##.exr", 1.5), "out.001.50.exr");
    EXPECT_EQ(name("out.###.##.exr", 2), "out.002.00.exr");
    EXPECT_EQ(name("out.###.##.exr", 1.125), "out.001.125.exr");
    EXPECT_EQ(name("out.####.exr", 1.5), "out.0001.5.exr");
    EXPECT_EQ(name("a.##/b.##.exr", 3), "a.##/b.03.exr");
    EXPECT_EQ(name("%3d", 3), "003");
}

TEST(FramePattern, IsOneInTheLastComponent) {
    using SingleHash = FramePattern::SingleHash;
    for (const char* path : {"", "out.exr", "a.####/out.exr", "out%d.exr", "out$F.exr", "100%.exr", "out%4x.exr"})
        EXPECT_FALSE(FramePattern::find(path, SingleHash::digits)) << path;
    EXPECT_FALSE(FramePattern::find("part#1.exr", SingleHash::letter));
    EXPECT_TRUE(FramePattern::find("part#1.exr", SingleHash::digits));
    EXPECT_TRUE(FramePattern::find("part##.exr", SingleHash::letter));
    for (const std::string path :
         {"##.%04d.exr", "a##b##.exr", "%99999999999999999999d", "########################################"})
        EXPECT_THROW(FramePattern::find(path, SingleHash::letter), InputError) << path;
}

TEST(KeyCurve, IsExactAtKeysAndHeldOutside) {
    KeyCurve<double> curve;
    for (const auto& [frame, value] : {std::pair(1.0, 0.1), std::pair(5.0, 0.7), std::pair(6.0, -3.3)})
        curve.add(frame, value);
    for (const Interpolation way : {Interpolation::smooth, Interpolation::linear, Interpolation::step}) {
        EXPECT_EQ(curve.at(1, way), 0.1);
        EXPECT_EQ(curve.at(5, way), 0.7);
        EXPECT_EQ(curve.at(6, way), -3.3);
        EXPECT_EQ(curve.at(-100, way), 0.1);
        EXPECT_EQ(curve.at(100, way), -3.3);
    }
    EXPECT_EQ(curve.at(4.999, Interpolation::step), 0.1);
    EXPECT_DOUBLE_EQ(curve.at(3, Interpolation::linear), 0.4);
}

TEST(KeyCurve, IsHermitesCubic) {
    // Keys on a parabola: the inner tangents are its own where keys are equally far apart, the outer ones are chords.
    KeyCurve<double> curve;
    for (int k = 0; k <= 4; ++k) curve.add(2 * k, static_cast<double>(4 * k * k));  // f^2
    for (double f = 2; f <= 6; f += 0.125) EXPECT_NEAR(curve.at(f, Interpolation::smooth), f * f, 1e-12) << f;
    // Uneven keys, by the formula: p0 = 0, p1 = 1 at 3, p2 = 0 at 4.
    KeyCurve<double> uneven;
    uneven.add(0, 0);
    uneven.add(3, 1);
    uneven.add(4, 0);
    const double m0 = 1.0 / 3, m1 = 0.0 / 4, u = 0.5;
    const double expected = (2 * u * u * u - 3 * u * u + 1) * 0 + (u * u * u - 2 * u * u + u) * 3 * m0 +
                            (-2 * u * u * u + 3 * u * u) * 1 + (u * u * u - u * u) * 3 * m1;
    EXPECT_NEAR(uneven.at(1.5, Interpolation::smooth), expected, 1e-15);
    // Two keys are a straight line.
    KeyCurve<double> two;
    two.add(0, 1);
    two.add(8, 3);
    for (double f = 0; f <= 8; f += 0.5) EXPECT_NEAR(two.at(f, Interpolation::smooth), 1 + f / 4, 1e-15);
}

AnimatedScene animated(std::string_view text) { return load_animated_scene(SceneText(text).read()); }

TEST(SceneAnimation, KeysMoveObjectsAndTheRestStands) {
    const AnimatedScene scene = animated(
        "[[object]]\nshape='box'\nname='a'\ntranslate=[9,9,9]\nrotate=[0,90,0]\ninterpolation='linear'\n"
        "[[object.instance]]\n[[object.instance]]\ntranslate=[0,0,2]\n"
        "[[object.key]]\nframe=1\ntranslate=[0,0,0]\n[[object.key]]\nframe=11\ntranslate=[10,0,0]\n"
        "[[object]]\nshape='box'\nname='b'\ntranslate=[1,2,3]\n");
    ASSERT_TRUE(scene.animation.moves_objects());
    const SceneChange change = scene.animation.at(6);
    ASSERT_EQ(change.to_world.size(), 3u);
    expect_near(glm::dvec3(change.to_world[0][3]), {5, 0, 0});
    expect_near(glm::dvec3(change.to_world[1][3]), {7, 0, 0});  // turned by the object's own rotation
    EXPECT_EQ(change.to_world[2], scene.scene.objects[2].to_world);
    EXPECT_TRUE(change.cameras.empty());
    EXPECT_EQ(scene.scene.objects[0].to_world[3], glm::dvec4(9, 9, 9, 1));  // at rest
}

TEST(SceneAnimation, RotationsAreAngles) {
    const AnimatedScene scene = animated(
        "[[object]]\nshape='box'\ninterpolation='linear'\n[[object.key]]\nframe=0\nrotate=[0,0,0]\n"
        "[[object.key]]\nframe=8\nrotate=[0,720,0]\n");
    for (const auto& [frame, x, z] : {std::tuple(0.0, 1.0, 0.0), std::tuple(1.0, 0.0, -1.0), std::tuple(2.0, -1.0, 0.0),
                                      std::tuple(5.0, 0.0, -1.0)}) {
        expect_near(glm::dvec3(scene.animation.at(frame).to_world[0] * glm::dvec4(1, 0, 0, 0)), {x, 0, z});
    }
}

TEST(SceneAnimation, CameraKeysCountForWhatTheyName) {
    const AnimatedScene scene = animated(
        "[[camera]]\neye=[0,0,5]\ntarget=[0,0,0]\nfov=40\ninterpolation='linear'\n[[camera.key]]\nframe=0\neye=[0,0,4]"
        "\n"
        "[[camera.key]]\nframe=2\nfov=20\n[[camera.key]]\nframe=4\neye=[4,0,4]\nfov=60\n[[object]]\nshape='box'\n");
    EXPECT_FALSE(scene.animation.moves_objects());
    const SceneChange change = scene.animation.at(3);
    ASSERT_EQ(change.cameras.size(), 1u);
    expect_near(*change.cameras[0].eye, {3, 0, 4});
    EXPECT_DOUBLE_EQ(change.cameras[0].fov_deg, 40);
    EXPECT_EQ(*change.cameras[0].target, glm::dvec3(0));
}

TEST(SceneAnimation, SaysWhatIsWrongWithKeys) {
    const auto error = [](const std::string& text) { return SceneText(text).error(); };
    const std::string camera = "[[camera]]\nname='main'\n[[camera.key]]\nframe=10\neye=[0,0,1]\n";
    EXPECT_EQ(error(camera + "[[camera.key]]\nframe=10\neye=[0,0,2]\n"),
              "scene.toml:7:7: camera \"main\": two keys at frame 10");
    EXPECT_NE(error(camera + "[[camera.key]]\nframe=9\neye=[0,0,2]\n").find("ascending"), std::string::npos);
    EXPECT_NE(error(camera + "[[camera.key]]\nframe=nan\neye=[0,0,2]\n").find("finite"), std::string::npos);
    EXPECT_NE(error(camera + "[[camera.key]]\neye=[0,0,2]\n").find("camera \"main\": a key needs a frame"),
              std::string::npos);
    EXPECT_NE(error(camera + "[[camera.key]]\nframe=11\n").find("says nothing"), std::string::npos);
    EXPECT_NE(error(camera + "[[camera.key]]\nframe=11\nzoom=2\neye=[0,0,2]\n").find("zoom"), std::string::npos);
    EXPECT_NE(error(camera + "[[camera.key]]\nframe=11\neye=[0,nan,2]\n").find("finite"), std::string::npos);
    EXPECT_NE(error(camera + "[[camera.key]]\nframe=11\nheight=2\n").find("no height"), std::string::npos);
    EXPECT_NE(error(camera + "interpolation='cubic'\n[[object]]\nshape='box'\n").find("interpolation"),
              std::string::npos);
    EXPECT_NE(
        error("[[object]]\nshape='box'\nmatrix=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]\n[[object.key]]\nframe=1\nscale=2\n")
            .find("matrix"),
        std::string::npos);
    EXPECT_NE(error("[[object]]\nshape='box'\n[[object.key]]\nframe=1\nscale=0\n").find("zero"), std::string::npos);
    EXPECT_EQ(error("[[object]]\nshape='box'\n[frames]\nrange='5-1x0'\n"),
              "scene.toml:4:7: [frames] range: 5-1x0: a step must not be 0");
    EXPECT_NE(error("[[object]]\nshape='box'\n[turntable]\naxis=[0,1,0]\n").find("frames"), std::string::npos);
    EXPECT_NE(error("[[object]]\nshape='box'\n[turntable]\nframes=4\naxis=[0,0,0]\n").find("axis"), std::string::npos);
    EXPECT_EQ(error("[[object]]\nshape='box'\n[frames]\nrange='1-4'\nfps='24000/1001'\n[turntable]\nframes=4\n"), "");
}

TEST(Turntable, FramesATurnApartAreEqual) {
    Camera camera;
    camera.to_world[3] = {1, 2, 7, 1};
    for (const double degrees : {360.0, -360.0, 720.0}) {
        for (const int frames : {1, 3, 7, 24, 100}) {
            const Turntable turntable{frames, {0.3, 1, 0.2}, degrees, 1};
            EXPECT_EQ(turned(camera, turntable, {1, 0, 0}, 1).to_world, camera.to_world);
            EXPECT_EQ(turned(camera, turntable, {1, 0, 0}, frames + 1).to_world, camera.to_world);
        }
    }
}

TEST(Turntable, TurnsCounterClockwiseAboutTheTarget) {
    Camera camera;
    camera.to_world[3] = {1, 0, 5, 1};  // looks down -z, at (1, 0, 0)
    const Camera quarter = turned(camera, {4, {0, 1, 0}, 360, 1}, {1, 0, 0}, 2);
    expect_near(quarter.eye(), {6, 0, 0});  // seen from +y, from the front to the right
    expect_near(glm::dvec3(quarter.to_world[2]), {1, 0, 0});
}

TEST(Turntable, FitsASphereAroundTheScene) {
    // A flat plate, seen from a corner of its box: what is seen from one side only would be cut off from others.
    const std::vector<glm::dvec3> corners = {{-4, 0, -1}, {4, 0, -1}, {4, 0, 1}, {-4, 0, 1}};
    const PointSource points = [&](const PointVisitor& visit) { visit(corners); };
    for (const bool is_orthographic : {false, true}) {
        CameraSettings settings;
        settings.orthographic = is_orthographic;
        const FittedCamera fitted(settings, points, 1.5, Turntable{8, {0, 1, 0}, 360, 1});
        for (int frame = 1; frame <= 8; ++frame) {
            const Camera camera = fitted.at(settings, frame);
            const Projection projection = camera.projection(300, 200, 0);
            for (const glm::dvec3& p : corners) {
                const glm::dvec2 at = projection.to_pixel(glm::dvec3(camera.to_view() * glm::dvec4(p, 1)));
                EXPECT_TRUE(at.x > 0 && at.x < 300 && at.y > 0 && at.y < 200) << frame << ": " << at.x << " " << at.y;
            }
        }
    }
}

TEST(FittedCamera, IsFittedToAllFramesOnce) {
    const AnimatedScene scene = animated(
        "[[object]]\nshape='box'\n[[object.key]]\nframe=1\ntranslate=[-5,0,0]\n[[object.key]]\nframe=9\ntranslate=[5,0,"
        "0]\n");
    const PointSource points = points_of_frames(scene.scene, scene.animation, parse_frame_list("1-9"));
    const Box box = box_of(points);
    expect_near(box.low, {-5.5, -0.5, -0.5});
    expect_near(box.high, {5.5, 0.5, 0.5});
    const CameraSettings settings;
    const FittedCamera camera(settings, points, 2, std::nullopt);
    EXPECT_EQ(camera.at(settings, 1).to_world, camera.at(settings, 9).to_world);
    // What keys say moves; what is fitted stays.
    CameraSettings moved = settings;
    moved.target = glm::dvec3(1, 0, 0);
    EXPECT_EQ(camera.at(moved, 2).eye(), camera.at(settings, 2).eye());
}

}  // namespace
}  // namespace burin::animation_test
