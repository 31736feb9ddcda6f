// Views that show nothing, and models of extreme sizes, still give correct pictures.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/glm.hpp>

#include "image/exr_io.h"
#include "image/exr_reader.h"
#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::views_test {
namespace {

using Arguments = std::vector<std::string>;

Image rendered(const TemporaryFolder& folder, const std::string& input, const Arguments& options = {}) {
    Arguments arguments = {"render", input, "-r", "80x60", "-o", "out.exr"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = run_burin(folder.path(), arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    if (!result.err.empty()) {
        EXPECT_EQ(result.err,
                  "burin: note: no sample of the picture sees a surface; does the camera look at the scene?\n");
    }
    return read_exr(folder.file("out.exr"));
}

bool is_empty(const Image& image) {
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            for (const char* name : {"R", "A", "lines.A", "id.object"}) {
                if (image.value(*image.find(name), x, y) != 0) return false;
            }
            if (image.value(*image.find("Z"), x, y) != static_cast<double>(INFINITY)) return false;
        }
    }
    return true;
}

TEST(Views, NothingInSight) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    EXPECT_FALSE(is_empty(rendered(folder, "cube.obj")));
    // Behind the camera, beside the picture, and too small to hit a sample.
    EXPECT_TRUE(is_empty(rendered(folder, "cube.obj", {"--eye", "0,0,5", "--target", "0,0,10"})));
    EXPECT_TRUE(is_empty(rendered(folder, "cube.obj", {"--eye", "0,0,5", "--target", "0,0,10", "--ortho", "4"})));
    EXPECT_TRUE(is_empty(rendered(folder, "cube.obj", {"--eye", "0,0,5", "--target", "9,0,5.1"})));
    EXPECT_TRUE(is_empty(rendered(folder, "cube.obj", {"--crop", "0,0,4,4"})));
    EXPECT_TRUE(is_empty(rendered(folder, "cube.obj", {"--eye", "0.1,0,1e9", "--target", "0.1,0,0"})));
}

TEST(Views, FromWithinTheModel) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    const Image image = rendered(folder, "cube.obj", {"--eye", "0.1,0.2,0.3", "--target", "0,0,-1", "--fov", "120"});
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) ASSERT_EQ(image.value(*image.find("A"), x, y), 1) << x << ',' << y;
    }
}

TEST(Views, ExtremeCameras) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    for (const Arguments& options : std::vector<Arguments>{{"--fov", "1e-6"},
                                                           {"--fov", "179.999999"},
                                                           {"--ortho", "1e-300"},
                                                           {"--ortho", "1e300"},
                                                           {"--ortho", "1e-9", "--eye", "1,1,1"},
                                                           {"--fov", "1e-300", "--eye", "0,0,5"},
                                                           {"--eye", "1e29,0,0"},
                                                           {"--eye", "1,1,1"},
                                                           {"--eye", "1.0000001,1,1"},
                                                           {"--eye", "0,0,1"},
                                                           {"--target", "1e20,0,0", "--eye", "0,0,3"}}) {
        rendered(folder, "cube.obj", options);
    }
}

/// The cube, scaled, with an extra triangle through it.
std::string scaled_model(double scale) {
    std::string obj;
    for (int i = 0; i < 8; ++i) {
        char line[128];
        std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", scale * (i & 1 ? 1.25 : -1),
                      scale * (i & 2 ? 0.75 : -1), scale * (i & 4 ? 1.5 : -1));
        obj += line;
    }
    obj += "f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\no cut\n";
    for (const glm::dvec3& p : {glm::dvec3(-2, 0.5, 0), {2, 0.5, 1}, {0, -2, 1.75}}) {
        char line[128];
        std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", scale * p.x, scale * p.y, scale * p.z);
        obj += line;
    }
    return obj + "f 9 10 11\n";
}

TEST(Views, SizeOfTheModelDoesNotMatter) {
    // Powers of two near 1e-12 and 1e12: every number of the computation scales exactly.
    for (const Arguments& options :
         std::vector<Arguments>{{"--lines", "all"}, {"--up", "0,0,1", "--fov", "60", "-m", "patel"}}) {
        const TemporaryFolder folder;
        folder.write("unit.obj", scaled_model(1));
        const Image unit = rendered(folder, "unit.obj", options);
        EXPECT_FALSE(is_empty(unit));
        for (const int exponent : {-40, -13, 7, 40}) {
            folder.write("scaled.obj", scaled_model(std::ldexp(1.0, exponent)));
            const Image image = rendered(folder, "scaled.obj", options);
            for (const Channel& channel : unit.channels()) {
                const double factor = channel.name == "Z" ? std::ldexp(1.0, exponent) : 1;
                for (int y = 0; y < unit.height(); ++y) {
                    for (int x = 0; x < unit.width(); ++x) {
                        ASSERT_EQ(image.value(*image.find(channel.name), x, y), factor * unit.value(channel, x, y))
                            << channel.name << " at " << x << ',' << y << ", 2^" << exponent;
                    }
                }
            }
        }
    }
}

TEST(Views, DecimalSizesToo) {
    const TemporaryFolder folder;
    for (const double scale : {1e-12, 1e-6, 1e6, 1e12}) {
        folder.write("scaled.obj", scaled_model(scale));
        const Image image = rendered(folder, "scaled.obj");
        double lines = 0, alpha = 0;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                lines += image.value(*image.find("lines.A"), x, y);
                alpha += image.value(*image.find("A"), x, y);
            }
        }
        folder.write("unit.obj", scaled_model(1));
        const Image unit = rendered(folder, "unit.obj");
        for (int y = 0; y < unit.height(); ++y) {
            for (int x = 0; x < unit.width(); ++x) {
                lines -= unit.value(*unit.find("lines.A"), x, y);
                alpha -= unit.value(*unit.find("A"), x, y);
            }
        }
        EXPECT_NEAR(lines, 0, 2) << scale;  // coordinates round differently: single samples may change
        EXPECT_NEAR(alpha, 0, 2) << scale;
    }
}

TEST(Views, AModelFarFromTheOrigin) {
    const TemporaryFolder folder;
    folder.write("far.toml", "[[object]]\nshape='box'\ntranslate=[1e9,0,0]\n");
    folder.write("near.toml", "[[object]]\nshape='box'\n");
    const Image far = rendered(folder, "far.toml"), near = rendered(folder, "near.toml");
    double difference = 0;
    for (int y = 0; y < near.height(); ++y) {
        for (int x = 0; x < near.width(); ++x) {
            difference += std::abs(far.value(*far.find("lines.A"), x, y) - near.value(*near.find("lines.A"), x, y));
        }
    }
    EXPECT_LT(difference, 20);
}

}  // namespace
}  // namespace burin::test::views_test
