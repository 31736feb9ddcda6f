// Cameras that are given explicitly, and those that define no view.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "base/error.h"
#include "scene/camera.h"
#include "tests/scene/scene_text.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::expect_near;
using test::Random;

const PointSource kCube = [](const PointVisitor& visit) {
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 p(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        visit({&p, 1});
    }
};
const PointSource kNothing = [](const PointVisitor&) {};

TEST(Camera, EyeTargetAndUp) {
    for (int trial = 0; trial < 200; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        CameraSettings settings;
        settings.eye = random.in_box(10);
        settings.target = random.in_box(10);
        settings.up = random.direction() * random.real(0.01, 100);
        settings.fov_deg = random.real(1, 170);
        settings.orthographic = trial % 2 == 1;
        settings.height = 3;
        const Camera camera = resolve_camera(settings, kCube, 1.7);
        // glm's lookAt is the same thing by another hand.
        const glm::dmat4 expected = glm::lookAt(*settings.eye, *settings.target, *settings.up);
        const glm::dmat4 view = camera.to_view();
        for (int c = 0; c < 4; ++c) {
            for (int r = 0; r < 4; ++r) ASSERT_NEAR(view[c][r], expected[c][r], 1e-9) << trial;
        }
        expect_near(camera.eye(), *settings.eye, 1e-12);
        ASSERT_EQ(camera.fov_deg, settings.fov_deg);
        ASSERT_EQ(camera.orthographic, settings.orthographic);
    }
}

TEST(Camera, AnEyeAloneLooksAtTheMiddle) {
    CameraSettings settings;
    settings.eye = glm::dvec3(3, 1, 8);
    const Camera camera = resolve_camera(
        settings,
        [](const auto& visit) {
            const glm::dvec3 corners[] = {{0, 0, 0}, {2, 4, 6}};
            visit(std::span(corners));
        },
        1);
    expect_near(glm::normalize(glm::dvec3(camera.to_world[2])), glm::normalize(*settings.eye - glm::dvec3(1, 2, 3)));
}

TEST(Camera, PixelsFollowTheFieldOfView) {
    CameraSettings settings;
    settings.eye = glm::dvec3(0, 0, 5);
    settings.target = glm::dvec3(0);
    settings.fov_deg = 90;
    const Camera camera = resolve_camera(settings, kNothing, 2);
    const Projection p = camera.projection(800, 400, 0);
    const auto pixel = [&](const glm::dvec3& world) {
        return p.to_pixel(glm::dvec3(camera.to_view() * glm::dvec4(world, 1)));
    };
    expect_near({pixel({0, 5, 0}), 0}, {400, 0, 0}, 1e-9);     // the top edge
    expect_near({pixel({0, -5, 0}), 0}, {400, 400, 0}, 1e-9);  // the fov is vertical
    expect_near({pixel({10, 0, 0}), 0}, {800, 200, 0}, 1e-9);

    settings.orthographic = true;
    settings.height = 8;
    const Camera flat = resolve_camera(settings, kNothing, 2);
    const Projection q = flat.projection(800, 400, 0);
    expect_near({q.to_pixel(glm::dvec3(flat.to_view() * glm::dvec4(8, 4, -77, 1))), 0}, {800, 0, 0}, 1e-9);
}

TEST(Camera, AMatrixLosesItsScale) {
    for (int trial = 0; trial < 100; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const glm::dmat4 rigid = glm::inverse(glm::lookAt(random.in_box(10), random.in_box(10), random.direction()));
        CameraSettings settings;
        const glm::dvec3 scale(random.real(0.01, 100), random.real(0.01, 100), random.real(0.01, 100));
        settings.to_world = glm::scale(rigid, scale);
        settings.fov_deg = 60;
        const Camera camera = resolve_camera(settings, kNothing, 1.5);
        for (int c = 0; c < 4; ++c) expect_near(glm::dvec3(camera.to_world[c]), glm::dvec3(rigid[c]), 1e-9);
        ASSERT_EQ(camera.fov_deg, 60);
    }
    // Extreme scales, as a chain of nodes can give them.
    for (const double scale : {1e-150, 1e-30, 1e30, 1e150}) {
        CameraSettings settings;
        settings.to_world = glm::scale(glm::dmat4(1.0), glm::dvec3(scale));
        const Camera camera = resolve_camera(settings, kNothing, 1);
        for (int c = 0; c < 4; ++c) expect_near(glm::dvec3(camera.to_world[c]), glm::dvec3(glm::dmat4(1.0)[c]), 1e-12);
    }
}

TEST(Camera, AMatrixMayBeOrthographic) {
    CameraSettings settings;
    settings.to_world = glm::translate(glm::dmat4(1.0), glm::dvec3(1, 2, 3));
    settings.orthographic = true;
    settings.height = 4;
    const Camera camera = resolve_camera(settings, kNothing, 1);
    EXPECT_TRUE(camera.orthographic);
    EXPECT_EQ(camera.height, 4);
    expect_near(camera.eye(), {1, 2, 3});
}

std::string error_of(const CameraSettings& settings, const PointSource& points = kCube) {
    try {
        resolve_camera(settings, points, 1.5);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

template <typename Change>
CameraSettings changed(const Change& change) {
    CameraSettings settings;
    change(settings);
    return settings;
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(BadCamera, EyeAndTargetAreTheSame) {
    EXPECT_NE(error_of(changed([](auto& s) { s.eye = s.target = glm::dvec3(1, 2, 3); })).find("same place"),
              std::string::npos);
    EXPECT_NE(error_of(changed([](auto& s) { s.eye = glm::dvec3(0); })).find("same place"), std::string::npos);
    EXPECT_NE(error_of(changed([](auto& s) {
                  s.eye = glm::dvec3(1e-200, 0, 0);
                  s.target = glm::dvec3(0);
              })).find("same place"),
              std::string::npos);
}

TEST(BadCamera, UpPointsAlongTheView) {
    const auto look_down = [](auto& s) { s.eye = glm::dvec3(0, 5, 0); };
    EXPECT_NE(error_of(changed(look_down)).find("up vector"), std::string::npos);
    EXPECT_NE(error_of(changed([](auto& s) { s.direction = glm::dvec3(0, -2, 0); })).find("up vector"),
              std::string::npos);
    EXPECT_NE(error_of(changed([](auto& s) {
                  s.eye = glm::dvec3(1, 1, 1);
                  s.up = glm::dvec3(-3, -3, -3);
              })).find("up vector"),
              std::string::npos);
    EXPECT_EQ(error_of(changed([](auto& s) {
                  s.eye = glm::dvec3(0, 5, 0);
                  s.up = glm::dvec3(0, 0, -1);
              })),
              "");
}

TEST(BadCamera, FieldsOfView) {
    for (const double fov : {0.0, -10.0, 180.0, 200.0, kNan, kInfinity}) {
        EXPECT_NE(error_of(changed([&](auto& s) { s.fov_deg = fov; })).find("field of view"), std::string::npos) << fov;
    }
    // Not looked at in an orthographic view.
    EXPECT_EQ(error_of(changed([](auto& s) {
                  s.fov_deg = 0;
                  s.orthographic = true;
              })),
              "");
    EXPECT_NE(error_of(changed([](auto& s) { s.fov_deg = 1e-300; })),
              "");  // would need an eye at infinity
}

TEST(BadCamera, HeightsAndFits) {
    for (const double value : {0.0, -1.0, kNan, kInfinity}) {
        EXPECT_NE(error_of(changed([&](auto& s) {
                      s.orthographic = true;
                      s.height = value;
                  })).find("height"),
                  std::string::npos)
            << value;
    }
    for (const double value : {0.0, -1.0, 1.1, kNan}) {
        EXPECT_NE(error_of(changed([&](auto& s) { s.fit = value; })).find("fit"), std::string::npos) << value;
    }
}

TEST(BadCamera, CoordinatesThatAreNotFiniteOrTooLarge) {
    for (const double value : {kNan, kInfinity, -kInfinity, 1e31, 1e300}) {
        const glm::dvec3 bad(1, value, 2);
        EXPECT_NE(error_of(changed([&](auto& s) { s.eye = bad; })).find("1e30"), std::string::npos) << value;
        EXPECT_NE(error_of(changed([&](auto& s) { s.target = bad; })).find("1e30"), std::string::npos) << value;
        EXPECT_NE(error_of(changed([&](auto& s) { s.up = bad; })).find("1e30"), std::string::npos) << value;
        EXPECT_NE(error_of(changed([&](auto& s) { s.direction = bad; })).find("1e30"), std::string::npos) << value;
    }
    EXPECT_NE(error_of(changed([](auto& s) { s.up = glm::dvec3(0); })).find("zero"), std::string::npos);
    EXPECT_NE(error_of(changed([](auto& s) { s.direction = glm::dvec3(0); })).find("zero"), std::string::npos);
}

TEST(BadCamera, Matrices) {
    for (const double value : {0.0, kNan, kInfinity, 1e200}) {
        EXPECT_NE(error_of(changed([&](auto& s) {
                      s.to_world = glm::scale(glm::dmat4(1.0), glm::dvec3(1, 1, value == 1e200 ? 0 : value));
                  })).find("matrix"),
                  std::string::npos)
            << value;
        EXPECT_NE(error_of(changed([&](auto& s) {
                      s.to_world = glm::dmat4(1.0);
                      (*s.to_world)[3][0] = value == 0 ? kNan : value;
                  })).find("matrix"),
                  std::string::npos)
            << value;
    }
    EXPECT_NE(error_of(changed([](auto& s) {  // up and back are parallel
                  s.to_world = glm::dmat4(1.0);
                  (*s.to_world)[1] = (*s.to_world)[2];
              }))
                  .find("matrix"),
              std::string::npos);
}

TEST(BadCamera, NothingToFitTo) {
    const PointSource point = [](const auto& visit) {
        const glm::dvec3 p(1, 2, 3);
        visit({&p, 1});
    };
    for (const PointSource& source : {point, kNothing}) {
        for (const bool orthographic : {false, true}) {
            const CameraSettings settings = changed([&](auto& s) { s.orthographic = orthographic; });
            EXPECT_NE(error_of(settings, source).find("no extent"), std::string::npos);
        }
    }
    // A camera that needs no fitting does not care.
    EXPECT_EQ(error_of(changed([](auto& s) {
                           s.eye = glm::dvec3(0, 0, 5);
                           s.target = glm::dvec3(0);
                       }),
                       kNothing),
              "");
}

}  // namespace
}  // namespace burin
