// A camera that is fitted fills `fit` of the picture, centred.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scene/camera.h"
#include "tests/scene/scene_text.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::expect_near;
using test::Random;

constexpr int kWidth = 1200;

std::array<glm::dvec3, 8> random_box(Random& random) {
    const glm::dvec3 center = random.in_box(random.integer(0, 1) * 100.0);
    glm::dvec3 half(random.real(0.05, 5), random.real(0.05, 5), random.real(0.05, 5));
    if (random.integer(0, 5) == 0) half[random.integer(0, 2)] = 0;  // flat
    std::array<glm::dvec3, 8> corners;
    for (int i = 0; i < 8; ++i) {
        corners[static_cast<std::size_t>(i)] =
            center + half * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    }
    return corners;
}

PointSource source(const std::array<glm::dvec3, 8>& corners) {
    return [&corners](const auto& visit) { visit(std::span<const glm::dvec3>(corners)); };
}

/// What part of the picture the points take: 1 = from edge to edge.
struct Extent {
    glm::dvec2 low{1e300}, high{-1e300};
    double nearest = 1e300;
};

Extent extent_of(const Camera& camera, const std::array<glm::dvec3, 8>& corners, int height) {
    const Projection projection = camera.projection(kWidth, height, 0);
    Extent extent;
    for (const glm::dvec3& p : corners) {
        const glm::dvec3 view(camera.to_view() * glm::dvec4(p, 1));
        const glm::dvec2 at = projection.to_pixel(view) / glm::dvec2(kWidth, height) * 2.0 - 1.0;
        extent.low = glm::min(extent.low, at);
        extent.high = glm::max(extent.high, at);
        extent.nearest = std::min(extent.nearest, -view.z);
    }
    return extent;
}

CameraSettings random_settings(Random& random, bool orthographic) {
    CameraSettings settings;
    settings.orthographic = orthographic;
    settings.fov_deg = random.real(5, 75);
    settings.fit = random.real(0.3, 1);
    if (random.integer(0, 1) == 1) {
        settings.up = random.direction();
        settings.direction = random.direction() * random.real(0.1, 10);
    }
    return settings;
}

TEST(CameraFit, PerspectiveFillsThePictureCentred) {
    int kept_away = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const auto corners = random_box(random);
        const CameraSettings settings = random_settings(random, false);
        const int height = random.integer(300, 3000);
        const Camera camera = resolve_camera(settings, source(corners), static_cast<double>(kWidth) / height);
        const Extent e = extent_of(camera, corners, height);
        ASSERT_GT(e.nearest, 0) << trial;
        // The tighter axis is filled and centred, unless the eye had to keep its distance.
        if (e.nearest < 0.0501 * 0.5 * glm::distance(corners[0], corners[7])) {
            ++kept_away;
        } else {
            ASSERT_NEAR(std::max(e.high.x - e.low.x, e.high.y - e.low.y), 2 * settings.fit, 1e-6) << trial;
            const bool x_is_tighter = e.high.x - e.low.x > e.high.y - e.low.y;
            ASSERT_NEAR(x_is_tighter ? e.high.x + e.low.x : e.high.y + e.low.y, 0, 1e-6) << trial;
        }
        for (int axis = 0; axis < 2; ++axis) {
            ASSERT_GE(e.low[axis], -settings.fit - 1e-6) << trial;
            ASSERT_LE(e.high[axis], settings.fit + 1e-6) << trial;
        }
    }
    EXPECT_LT(kept_away, 20);
}

TEST(CameraFit, OrthographicFillsThePictureCentred) {
    for (int trial = 0; trial < 1000; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const auto corners = random_box(random);
        const CameraSettings settings = random_settings(random, true);
        const int height = random.integer(300, 3000);
        const Camera camera = resolve_camera(settings, source(corners), static_cast<double>(kWidth) / height);
        const Extent e = extent_of(camera, corners, height);
        ASSERT_TRUE(camera.orthographic);
        ASSERT_GT(e.nearest, 0) << trial;
        ASSERT_NEAR(std::max(e.high.x - e.low.x, e.high.y - e.low.y), 2 * settings.fit, 1e-6) << trial;
        ASSERT_NEAR(e.high.x + e.low.x, 0, 1e-6) << trial;
        ASSERT_NEAR(e.high.y + e.low.y, 0, 1e-6) << trial;
    }
}

TEST(CameraFit, ATargetStaysInTheMiddle) {
    int kept_away = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const auto corners = random_box(random);
        CameraSettings settings = random_settings(random, trial % 2 == 1);
        settings.target = corners[0] + random.in_box(3);
        const int height = random.integer(300, 3000);
        const Camera camera = resolve_camera(settings, source(corners), static_cast<double>(kWidth) / height);
        const Extent e = extent_of(camera, corners, height);
        ASSERT_GT(e.nearest, 0) << trial;
        const double farthest = std::max({e.high.x, -e.low.x, e.high.y, -e.low.y});
        if (e.nearest > 0.0501 * 0.5 * glm::distance(corners[0], corners[7])) {
            ASSERT_NEAR(farthest, settings.fit, 1e-6) << trial;
        } else {
            ASSERT_LT(farthest, settings.fit + 1e-6) << trial;
            ++kept_away;
        }
        const glm::dvec3 at(camera.to_view() * glm::dvec4(*settings.target, 1));
        ASSERT_NEAR(at.x, 0, 1e-6) << trial;
        ASSERT_NEAR(at.y, 0, 1e-6) << trial;
    }
    EXPECT_LT(kept_away, 40);
}

TEST(CameraFit, AnOrthographicHeightIsKept) {
    Random random(7);
    const auto corners = random_box(random);
    CameraSettings settings;
    settings.orthographic = true;
    settings.height = 12.5;
    EXPECT_EQ(resolve_camera(settings, source(corners), 1.5).height, 12.5);
    // An eye without a height: fitted around the view axis.
    settings.height.reset();
    settings.eye = corners[0] + glm::dvec3(1, 2, 30);
    const Camera camera = resolve_camera(settings, source(corners), 1.5);
    const Extent e = extent_of(camera, corners, kWidth * 2 / 3);
    EXPECT_NEAR(std::max({e.high.x, -e.low.x, e.high.y, -e.low.y}), 0.95, 1e-6);
    expect_near(camera.eye(), *settings.eye);
}

TEST(CameraFit, AWideAngleKeepsItsDistance) {
    // The tightest eye of a wide angle would sit on the foremost corner.
    for (const double fov : {100.0, 130.0, 160.0, 179.0}) {
        for (const bool has_target : {false, true}) {
            Random random(3);
            const auto corners = random_box(random);
            CameraSettings settings;
            settings.fov_deg = fov;
            if (has_target) settings.target = 0.5 * (corners[0] + corners[7]);
            const Camera camera = resolve_camera(settings, source(corners), 1);
            const Extent e = extent_of(camera, corners, kWidth);
            EXPECT_GT(e.nearest, 0.04 * 0.5 * glm::distance(corners[0], corners[7])) << fov;
            EXPECT_LE(std::max({e.high.x, -e.low.x, e.high.y, -e.low.y}), 0.9501) << fov;
        }
    }
}

TEST(CameraFit, SizeOfTheSceneDoesNotMatter) {
    Random random(5);
    const auto corners = random_box(random);
    for (const double scale : {1e-12, 1e-6, 1.0, 1e6, 1e12}) {
        auto scaled = corners;
        for (glm::dvec3& p : scaled) p *= scale;
        const Camera camera = resolve_camera({}, source(scaled), 1);
        const Camera unit = resolve_camera({}, source(corners), 1);
        expect_near(camera.eye() / scale, unit.eye(), 1e-9);
    }
}

TEST(CameraFit, TheDefaultViewIsFromTheFrontRightAndAbove) {
    const std::array<glm::dvec3, 8> cube = [] {
        std::array<glm::dvec3, 8> corners;
        for (int i = 0; i < 8; ++i) {
            corners[static_cast<std::size_t>(i)] = {i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1};
        }
        return corners;
    }();
    const auto back = [&](std::optional<glm::dvec3> up) {
        CameraSettings settings;
        settings.up = up;
        return glm::dvec3(resolve_camera(settings, source(cube), 1).to_world[2]);
    };
    const glm::dvec3 expected = glm::normalize(glm::dvec3(0.55, 0.4, 0.9));  // right, up, front
    expect_near(back(std::nullopt), expected);
    expect_near(back(glm::dvec3(0, 7, 0)), expected);
    // Standing along Z, the front is -Y: right is +X, as in Blender's front view.
    expect_near(back(glm::dvec3(0, 0, 1)), {expected.x, -expected.z, expected.y});
    // Standing along X, the front stays +Z; right is then -Y.
    expect_near(back(glm::dvec3(1, 0, 0)), {expected.y, -expected.x, expected.z});
    expect_near(back(glm::dvec3(0, -1, 0)), {-expected.x, -expected.y, expected.z});
}

/// Points that may be left out, for others tell as much, change nothing.
TEST(CameraFit, TheBoxesOfAMeshTellWhatItsPointsDo) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Scene scene;
        Mesh mesh;
        if (seed % 3 == 0) mesh.origin = random.in_box(1000);
        glm::dvec3 at(0.0);
        for (int i = random.integer(3, 6000); i > 0; --i) {
            at = seed % 2 == 0 ? random.in_box(2) : at + random.in_box(0.1);  // anywhere, or near the one before
            mesh.positions.emplace_back(at);
        }
        scene.meshes.push_back(mesh);
        scene.objects.emplace_back();
        const PointSource all = [&](const PointVisitor& visit) {
            for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
                const glm::dvec3 p = mesh.position(v);
                visit({&p, 1});
            }
        };
        CameraSettings settings = random_settings(random, seed % 5 == 0);
        const double aspect = random.real(0.3, 3);
        const Camera camera = resolve_camera(settings, scene_points(scene), aspect),
                     same = resolve_camera(settings, all, aspect);
        EXPECT_EQ(camera.to_world, same.to_world);
        EXPECT_EQ(camera.height, same.height);
    }
}

/// Neither do those of instances, whatever their matrices; and boxes are asked for before points.
TEST(CameraFit, TheBoxesOfInstancesTellWhatTheirPointsDo) {
    std::size_t looked_at = 0, in_all = 0;
    for (std::uint64_t seed = 0; seed < 120; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Scene scene;
        for (int m = 0; m < 2; ++m) {
            Mesh mesh;
            if (seed % 3 == 0) mesh.origin = random.in_box(1000);
            glm::dvec3 at(0.0);
            for (int i = random.integer(3, 40000); i > 0; --i) {
                at = seed % 2 == 0 ? random.in_box(2) : at + random.in_box(0.1);
                mesh.positions.emplace_back(at);
            }
            scene.meshes.push_back(mesh);
        }
        for (int i = random.integer(1, 12); i > 0; --i) {
            SceneObject object;
            object.mesh = static_cast<std::uint32_t>(random.integer(0, 1));
            for (int c = 0; c < 4 && i % 4 != 0; ++c) {
                object.to_world[c] = glm::dvec4(random.in_box(c < 3 ? 2 : 50), c == 3 ? 1 : 0);
            }
            scene.objects.push_back(object);
        }
        const PointSource some = scene_points(scene);
        const PointSource all = [&](const PointVisitor& visit) {
            for_each_point(some, [&](const glm::dvec3& p) { visit({&p, 1}); });
        };
        CameraSettings settings = random_settings(random, seed % 5 == 0);
        if (seed % 7 == 0) settings.target = random.in_box(10);
        const double aspect = random.real(0.3, 3);
        const Camera camera = resolve_camera(settings, some, aspect), same = resolve_camera(settings, all, aspect);
        EXPECT_EQ(camera.to_world, same.to_world);
        EXPECT_EQ(camera.height, same.height);
        const Box box = box_of(some), same_box = box_of(all);
        EXPECT_EQ(box.low, same_box.low);
        EXPECT_EQ(box.high, same_box.high);
        if (seed % 2 != 0) continue;  // a path reaches anywhere
        for (const SceneObject& object : scene.objects) in_all += scene.meshes[object.mesh].positions.size();
        Box seen;
        const auto is_outside = [&](const Box& b, bool) {
            return b.low.x < seen.low.x || b.low.y < seen.low.y || b.low.z < seen.low.z || b.high.x > seen.high.x ||
                   b.high.y > seen.high.y || b.high.z > seen.high.z;
        };
        some({is_outside, [&](std::span<const glm::dvec3> points) {
                  looked_at += points.size();
                  for (const glm::dvec3& p : points) seen.add(p);
              }});
        EXPECT_EQ(seen.low, same_box.low);
        EXPECT_EQ(seen.high, same_box.high);
    }
    EXPECT_LT(looked_at, in_all);
}

}  // namespace
}  // namespace burin
