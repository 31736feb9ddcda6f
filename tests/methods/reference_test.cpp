// Method reference: strokes have their closed-form areas, end where they must, and lie where the
// oracle and method patel see lines.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/gtc/constants.hpp>

#include "mesh/shapes.h"
#include "methods/reference/reference.h"
#include "scene/scene_description.h"
#include "tests/support/drawing.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

namespace burin::reference_test {
namespace {

using namespace test;

/// What method reference draws.
class Truth {
  public:
    Truth(const Scene& scene, const Camera& camera, int width, int height, int threads = 2)
        : Truth(scene, camera, width, height, {0, 0, width, height}, threads) {}
    Truth(const Scene& scene, const Camera& camera, int width, int height, PixelRect crop, int threads) {
        const Frame frame = make_frame(scene, camera, width, height, crop);
        const LayerSet all{true, true, true, true, true, true, true};
        Film film({0, 0, width, height}, crop, all, frame.criteria.classes);
        RunOptions options;
        options.threads = threads;
        render_reference(frame, options, film);
        image_ = film.image();
    }
    const Image& image() const { return image_; }
    double at(const std::string& channel, int x, int y) const { return image_.value(*image_.find(channel), x, y); }
    double line(int x, int y) const { return at("lines.A", x, y); }
    double sum(const std::string& channel) const {
        double total = 0;
        const PixelRect r = image_.data();
        for (int y = r.y0; y < r.y1; ++y) {
            for (int x = r.x0; x < r.x1; ++x) total += at(channel, x, y);
        }
        return total;
    }
    std::vector<double> coverage() const {
        std::vector<double> values;
        for (int y = 0; y < image_.height(); ++y) {
            for (int x = 0; x < image_.width(); ++x) values.push_back(line(x, y));
        }
        return values;
    }

  private:
    Image image_;
};

/// A flat square of a side length, turned by an angle, in front of pixel_camera().
PolygonSoup square(glm::dvec2 middle, double side, double angle_deg, double z = 0) {
    const double a = glm::radians(angle_deg);
    const glm::dvec2 u = 0.5 * side * glm::dvec2(std::cos(a), std::sin(a)), v(-u.y, u.x);
    std::vector<glm::dvec3> corners;
    for (const glm::dvec2 p : {middle - u - v, middle + u - v, middle + u + v, middle - u + v}) {
        corners.emplace_back(p, z);
    }
    return soup_of(corners, {{0, 1, 2, 3}});
}

PolygonSoup box_at(glm::dvec3 middle, glm::dvec3 size) {
    return transformed(make_box(size), [middle](glm::dvec3 p) { return p + middle; });
}

double stroke_area_of_square(double side, double width) {
    const double r = width / 2;
    return 4 * side * width + glm::pi<double>() * r * r - 4 * r * r;
}

TEST(Reference, StrokesHaveTheirArea) {
    for (const double angle : {0.0, 3.7, 17.0, 45.0, 71.3}) {
        Scene scene = scene_of({square({32.3, 31.8}, 36.7, angle)});
        for (const double width : {0.05, 0.3, 1.0, 3.0, 10.0}) {
            scene.lines.style.width_px = width;
            const Truth truth(scene, pixel_camera(64, 64), 64, 64);
            const double area = stroke_area_of_square(36.7, width);
            EXPECT_NEAR(truth.sum("coverage.border"), area, 0.005 * area) << angle << " degrees, " << width << " px";
            EXPECT_EQ(truth.sum("coverage.silhouette"), 0);
        }
    }
}

TEST(Reference, PixelsHaveTheExactAreaOfTheStroke) {
    const double angle = glm::radians(17.0);
    const glm::dvec2 normal(std::sin(angle), std::cos(angle));  // of the upper edge; y down: see below
    Scene scene = scene_of({square({32.3, 31.8}, 36.7, 17.0)});
    for (const double width : {0.05, 0.7, 3.0}) {
        scene.lines.style.width_px = width;
        const Truth truth(scene, pixel_camera(64, 64), 64, 64);
        // World (x, y) is pixel (x, 64 - y): the edge away from the middle along -normal.
        const glm::dvec2 middle(32.3, 64 - 31.8);
        for (int y = 0; y < 64; ++y) {
            for (int x = 26; x < 38; ++x) {
                if (y > 31) continue;
                constexpr int kFine = 400;  // across the stroke, exactly enough
                double inside = 0;
                for (int i = 0; i < kFine; ++i) {
                    // Columns of the pixel: the covered length of each in closed form.
                    const double px = x + (i + 0.5) / kFine;
                    const double offset = -0.5 * 36.7;
                    // signed distance = dot(p - middle, n), n = (sin, cos) in pixels
                    const auto y_at = [&](double d) { return middle.y + (d - (px - middle.x) * normal.x) / normal.y; };
                    const double low = std::max<double>(y, y_at(offset - width / 2)),
                                 high = std::min<double>(y + 1, y_at(offset + width / 2));
                    inside += std::max(0.0, high - low) / kFine;
                }
                EXPECT_NEAR(truth.line(x, y), inside, 0.002) << x << "," << y << " width " << width;
            }
        }
    }
}

TEST(Reference, JoinsAndEndsAreRound) {
    Scene scene = scene_of({square({32, 32}, 32, 0)});
    scene.lines.style.width_px = 12;
    const Truth truth(scene, pixel_camera(64, 64), 64, 64);
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            const double distance = glm::distance(glm::dvec2(x + 0.5, y + 0.5), glm::dvec2(16, 16));
            if (distance > 6.71) {
                EXPECT_EQ(truth.line(x, y), 0) << x << "," << y;
            } else if (distance < 5.29) {
                EXPECT_EQ(truth.line(x, y), 1) << x << "," << y;
            }
        }
    }
}

TEST(Reference, NothingIsDrawnOverANearerSurface) {
    // A sheet whose upper border runs behind a box, close to the box's lower edge on the right.
    Scene scene = scene_of({soup_of({{4, 8, 0}, {60, 8, 0}, {60, 30.5, 0}, {4, 30.5, 0}}, {{0, 1, 2, 3}}),
                            box_at({20, 32, 20}, {12, 20, 4}), box_at({48, 38.5, 20}, {14, 10, 4})});
    scene.lines.style.width_px = 12;
    for (const bool all : {false, true}) {
        scene.lines.classes = all ? kDefaultLineClasses : LineClassSet(LineClass::border);
        const Truth truth(scene, pixel_camera(64, 64), 64, 64);
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                const auto within = [&](double x0, double x1, double y0, double y1) {
                    return x >= x0 && x + 1 <= x1 && y >= 64 - y1 && y + 1 <= 64 - y0;
                };
                const bool on_box = within(14, 26, 22, 42) || within(41, 55, 33.5, 43.5);
                if (on_box) {
                    EXPECT_EQ(truth.at("coverage.border", x, y), 0) << x << "," << y;
                }
            }
        }
        // Beside and between the boxes the stroke is whole, also where it overhangs the sheet.
        EXPECT_EQ(truth.line(34, 64 - 35), 1);
        EXPECT_EQ(truth.line(34, 64 - 26), 1);
        EXPECT_EQ(truth.line(48, 64 - 33), 1);
    }
}

TEST(Reference, SilhouetteOfASphere) {
    Scene scene =
        scene_of({transformed(make_sphere(20, 128, 64), [](glm::dvec3 p) { return p + glm::dvec3(32, 32, 0); })});
    for (const double width : {0.3, 1.0, 3.0}) {
        scene.lines.style.width_px = width;
        const Truth truth(scene, pixel_camera(64, 64), 64, 64);
        const double area = glm::two_pi<double>() * 20 * width;
        EXPECT_NEAR(truth.sum("coverage.silhouette"), area, 0.005 * area) << width;
        EXPECT_NEAR(truth.sum("lines.A"), area, 0.005 * area) << width;
    }
}

TEST(Reference, CrossingSheetsMeetInALine) {
    // Two sheets through each other at 45 degrees, along x = 32.4 from y = 12 to 52.
    Scene scene =
        scene_of({soup_of({{12.4, 12, -20}, {52.4, 12, 20}, {52.4, 52, 20}, {12.4, 52, -20}}, {{0, 1, 2, 3}}),
                  soup_of({{52.4, 12, -20}, {12.4, 12, 20}, {12.4, 52, 20}, {52.4, 52, -20}}, {{0, 1, 2, 3}})});
    scene.lines.classes = LineClass::intersection;
    for (const double width : {0.05, 0.3, 1.0, 3.0}) {
        scene.lines.style.width_px = width;
        const Truth truth(scene, pixel_camera(64, 64), 64, 64);
        const double r = width / 2;
        const double area = 40 * width + glm::pi<double>() * r * r;
        EXPECT_NEAR(truth.sum("coverage.intersection"), area, 0.005 * area) << width;
    }
}

TEST(Reference, ACubeHasNineVisibleEdges) {
    Scene scene = scene_of({make_box({1, 1, 1})});
    scene.lines.style.width_px = 0.25;
    scene.lines.classes = LineClassSet::all();
    const Camera camera = perspective_camera({2, 1.5, 3}, {0, 0, 0}, 30);
    const Truth truth(scene, camera, 96, 96);
    const Projection projection = camera.projection(96, 96, 0);
    double silhouette = 0, crease = 0;
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 4; ++side) {
            glm::dvec3 p(0.0), q(0.0);
            p[axis] = -0.5;
            q[axis] = 0.5;
            p[(axis + 1) % 3] = q[(axis + 1) % 3] = side & 1 ? 0.5 : -0.5;
            p[(axis + 2) % 3] = q[(axis + 2) % 3] = side & 2 ? 0.5 : -0.5;
            const auto pixel = [&](glm::dvec3 v) {
                return projection.to_pixel(glm::dvec3(camera.to_view() * glm::dvec4(v, 1)));
            };
            const double length = glm::distance(pixel(p), pixel(q));
            // The eye sees the three faces at +0.5: edges of two are creases, of one silhouettes.
            if (side == 3) crease += length;
            if (side == 1 || side == 2) silhouette += length;
        }
    }
    EXPECT_NEAR(truth.sum("coverage.silhouette"), 0.25 * silhouette, 0.005 * 0.25 * silhouette);
    EXPECT_NEAR(truth.sum("coverage.crease"), 0.25 * crease, 0.01 * 0.25 * crease);  // joins belong to silhouettes
    EXPECT_EQ(truth.sum("coverage.polygon") + truth.sum("coverage.border"), 0);
}

/// Mass of lines that lie farther than 1.5 px from any line of the other drawing.
double stray_mass(const std::vector<double>& of, const std::vector<double>& from, int width, int height) {
    double mass = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            bool near = false;
            for (int v = std::max(y - 2, 0); v <= std::min(y + 2, height - 1); ++v) {
                for (int u = std::max(x - 2, 0); u <= std::min(x + 2, width - 1); ++u) {
                    // From the pixel's middle to the other's square.
                    const glm::dvec2 d = glm::max(glm::abs(glm::dvec2(u - x, v - y)) - 0.5, glm::dvec2(0.0));
                    near = near || (glm::length(d) <= 1.5 && from[static_cast<std::size_t>(v * width + u)] > 0);
                }
            }
            if (!near) mass += of[static_cast<std::size_t>(y * width + x)];
        }
    }
    return mass;
}

void expect_agreement(Scene scene, const Camera& camera, int width, int height, const std::string& what) {
    scene.reference.samples = 8;
    const std::vector<double> coverage = Truth(scene, camera, width, height).coverage();
    const Oracle oracle(scene, camera, width, height);
    const auto truth = oracle.line_points(0, 0, width, height, 8, scene.lines.crease_angle_deg);
    const LineAgreement agreement = compare_lines(truth, coverage, 0, 0, width, height);
    EXPECT_GT(agreement.certain, 500) << what << ": the scene must have lines";
    EXPECT_EQ(agreement.missing, 0) << what << ", first at " << agreement.missing_points[0].x << ","
                                    << agreement.missing_points[0].y;
    EXPECT_EQ(agreement.false_mass, 0) << what << ", first at " << agreement.false_pixels[0].x << ","
                                       << agreement.false_pixels[0].y;
    const std::vector<double> patel = Drawing(scene, camera, width, height).coverage();
    EXPECT_EQ(stray_mass(patel, coverage, width, height), 0) << what << ": patel alone";
    // What is thinner than patel's samples, a quarter of a pixel apart, it may miss.
    double mass = 0;
    for (const double c : coverage) mass += c;
    EXPECT_LT(stray_mass(coverage, patel, width, height), 0.001 * mass) << what << ": reference alone";
}

Camera fitted(const Scene& scene, glm::dvec3 direction, double aspect) {
    CameraSettings settings;
    settings.direction = direction;
    return resolve_camera(settings, scene_points(scene), aspect);
}

const glm::dvec3 kDirections[] = {{0.55, 0.4, 0.9}, {-1, 0.1, 0.2}, {0.5, -0.8, -0.4}};

TEST(ReferenceAgrees, Teapot) {
    const Scene scene = scene_of({make_teapot(10)});
    expect_agreement(scene, fitted(scene, kDirections[0], 1.6), 160, 100, "teapot");
}

TEST(ReferenceAgrees, CreasedPart) {
    std::vector<PolygonSoup> parts;
    parts.push_back(make_cylinder(1, 1, 0.3, 48));
    parts.push_back(
        transformed(make_cylinder(0.6, 0.45, 0.8, 48), [](glm::dvec3 p) { return p + glm::dvec3(0, 0.5, 0); }));
    parts.push_back(transformed(make_box({2.4, 0.2, 0.3}), [](glm::dvec3 p) { return p + glm::dvec3(0, 0.45, 0); }));
    parts.push_back(
        transformed(make_torus(0.6, 0.08, 48, 16), [](glm::dvec3 p) { return p + glm::dvec3(0, 0.15, 0); }));
    const Scene scene = scene_of(parts);
    for (int i : {1, 2}) expect_agreement(scene, fitted(scene, kDirections[i], 1.6), 160, 100, "part");
}

TEST(ReferenceAgrees, CrossingSheets) {
    for (std::uint64_t seed = 0; seed < 2; ++seed) {
        Random random(seed);
        std::vector<PolygonSoup> sheets;
        for (int i = 0; i < 6; ++i) {
            const glm::dvec3 u = random.direction(), v = glm::normalize(glm::cross(u, random.direction()));
            const glm::dvec3 c = random.in_box(0.2);
            sheets.push_back(soup_of({c - u - v, c + u - v, c + u + v, c - u + v}, {{0, 1, 2, 3}}));
        }
        const Scene scene = scene_of(sheets);
        expect_agreement(scene, fitted(scene, {0.3, 0.5, 1}, 1.6), 160, 100, "sheets " + std::to_string(seed));
    }
}

TEST(ReferenceAgrees, Engine) {
    ASSERT_TRUE(std::filesystem::exists(BURIN_ENGINE))
        << "install assimp-testmodels (scripts/install-dependencies does)";
    const Scene scene = load_scene(bare_model_scene(BURIN_ENGINE, {}));
    expect_agreement(scene, fitted(scene, kDirections[0], 1.6), 200, 125, "engine");
}

TEST(Reference, ThreadsAndCropsChangeNothing) {
    const Scene scene = scene_of({make_teapot(6), box_at({0.4, 0.3, 0.2}, {0.8, 0.6, 0.5})});
    Scene coarse = scene;
    coarse.reference.samples = 5;
    coarse.lines.style.width_px = 5;
    const Camera camera = fitted(scene, kDirections[0], 1);
    const Truth whole(coarse, camera, 100, 100, 1);
    EXPECT_TRUE(same_bits(whole.image(), Truth(coarse, camera, 100, 100, 3).image()));
    const PixelRect crop{37, 51, 90, 77};
    const Truth part(coarse, camera, 100, 100, crop, 2);
    for (const Channel& channel : part.image().channels()) {
        const Channel& other = *whole.image().find(channel.name);
        for (int y = 0; y < crop.height(); ++y) {
            for (int x = 0; x < crop.width(); ++x) {
                ASSERT_EQ(part.image().value(channel, x, y), whole.image().value(other, x + crop.x0, y + crop.y0))
                    << channel.name << " " << x << "," << y;
            }
        }
    }
}

TEST(Reference, SixteenSamplesAreAsGoodAsSixtyFour) {
    for (const char* const name : {"star", "crossing", "still_life"}) {
        const std::string path = std::string(BURIN_SOURCE_FOLDER) + "/scenes/" + name + ".toml";
        Scene scene = load_scene(read_scene_file(path, {}));
        const Camera camera = resolve_camera(scene.cameras.front(), scene_points(scene), 1);
        const PixelRect part{32, 64, 64, 96};
        const std::vector<double> coarse = Truth(scene, camera, 128, 128, part, 2).coverage();
        scene.reference.samples = 64;
        const std::vector<double> fine = Truth(scene, camera, 128, 128, part, 2).coverage();
        double squares = 0;
        int count = 0;
        for (std::size_t i = 0; i < fine.size(); ++i) {
            if (fine[i] == 0 && coarse[i] == 0) continue;
            ++count;
            squares += (fine[i] - coarse[i]) * (fine[i] - coarse[i]);
        }
        EXPECT_GT(count, 40) << name;
        EXPECT_LT(std::sqrt(squares / count), 0.003) << name;
    }
}

TEST(Reference, ACrackSeenAtASmallAngleIsNoLine) {
    const auto ink = [](double crack) {
        const PolygonSoup sheet = soup_of({{0, -2.5, 0.5},
                                           {1, -2.5, 0.5},
                                           {1, -0.5, 0.5},
                                           {0, -0.5, 0.5},
                                           {1 + crack, -2.5, 0.5},
                                           {2, -2.5, 0.5},
                                           {2, -0.5, 0.5},
                                           {1 + crack, -0.5, 0.5}},
                                          {{0, 1, 2, 3}, {4, 5, 6, 7}});
        return Truth(scene_of({sheet}), perspective_camera({3.56, -5.65, 0.22}, {0.17, 0.16, -0.12}), 160, 160)
            .sum("lines.A");
    };
    EXPECT_NEAR(ink(0.0034), ink(0), 2);
}

TEST(Reference, CoincidentSheetsAreOne) {
    // The first object wins, everywhere.
    Scene scene = scene_of({square({32, 32}, 40, 10), square({32, 32}, 20, 33)});
    const Truth truth(scene, pixel_camera(64, 64), 64, 64);
    EXPECT_NEAR(truth.sum("lines.A"), stroke_area_of_square(40, 1), 1);
    EXPECT_EQ(truth.at("id.object", 32, 32), 1);
    EXPECT_EQ(truth.sum("coverage.object") + truth.sum("coverage.intersection"), 0);
}

}  // namespace
}  // namespace burin::reference_test
