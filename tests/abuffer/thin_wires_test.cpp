// Wires: however thin they are, they are lines of full strength, and no place or direction makes
// them blink.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "render/close_cracks.h"
#include "tests/abuffer/fine_drawings.h"

namespace burin::thin_wires_test {
namespace {

using namespace test;

/// A straight wire through the middle of a picture of kFineSize pixels, whose units are pixels.
struct Wire {
    double thickness = 0.01;
    int sides = 4;
    double turn = 0, angle_deg = 0, tilt_deg = 0;  // around its axis, on the screen, and out of it
    glm::dvec3 place{0.0};
    double half_length = 18;
    double taper = 1;  // the thickness at its end, as a share of that at its start

    glm::dvec3 direction() const {
        const double a = glm::radians(angle_deg), b = glm::radians(tilt_deg);
        return {std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)};
    }
    glm::dvec3 middle() const { return glm::dvec3(22, 22, 0) + place; }
    PolygonSoup soup() const {
        const glm::dvec3 along = direction();
        const glm::dvec3 u =
            glm::normalize(glm::cross(along, std::abs(along.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        const glm::dvec3 v = glm::cross(along, u);
        std::vector<glm::dvec3> rings;
        for (const double end : {-1.0, 1.0}) {
            const double radius = 0.5 * thickness * (end > 0 ? taper : 1);
            for (int i = 0; i < sides; ++i) {
                const double a = turn + 2 * M_PI * i / sides;
                rings.push_back(middle() + end * half_length * along + radius * (std::cos(a) * u + std::sin(a) * v));
            }
        }
        return between_rings(std::move(rings));
    }
};

Camera pixels_in_perspective() {
    // At the depth of the middle a unit is a pixel.
    const double distance = 60;
    return perspective_camera({22, 22, distance}, {22, 22, 0}, glm::degrees(2 * std::atan(0.5 * kFineSize / distance)));
}

Wire random_wire(Random& random) {
    Wire wire;
    wire.thickness = std::pow(10, random.real(-4, 0));
    wire.sides = random.integer(3, 16);
    wire.turn = random.integer(0, 2) == 0 ? 0 : random.real(0, 6);
    wire.angle_deg = random.integer(0, 1) == 0 ? 45 * random.integer(0, 3) : random.real(0, 180);
    wire.tilt_deg = random.integer(0, 1) == 0 ? 0 : random.real(-50, 50);
    wire.place = {random.real(-2, 2), random.real(-2, 2), random.real(-5, 5)};
    if (random.integer(0, 3) == 0) wire.place = glm::dvec3(glm::ivec3(wire.place));
    return wire;
}

/// Which share of the way from end to end on the screen has a line, and how much of one there is for each pixel of it.
struct Found {
    double share, strength;
};
Found look(const Drawing& drawn, const Camera& camera, const Wire& wire) {
    const Projection projection = camera.projection(kFineSize, kFineSize, 0);
    const auto pixel = [&](double end) {
        return projection.to_pixel(
            glm::dvec3(camera.to_view() * glm::dvec4(wire.middle() + end * wire.half_length * wire.direction(), 1)));
    };
    const glm::dvec2 a = pixel(-1), b = pixel(1);
    double sum = 0;
    for (int y = 0; y < kFineSize; ++y) {
        for (int x = 0; x < kFineSize; ++x) sum += drawn.line(x, y);
    }
    return {drawn.drawn_share(a, b, 0.5, 0.5), sum / (glm::distance(a, b) + M_PI / 4)};
}

std::string words(const Wire& w) {
    return std::to_string(w.thickness) + " px, " + std::to_string(w.sides) + " sides, " + std::to_string(w.angle_deg) +
           " deg, tilt " + std::to_string(w.tilt_deg);
}

TEST(ThinWires, AreLinesOfFullStrengthAtAnyThickness) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        const Wire wire = random_wire(random);
        const Camera camera = seed % 2 == 0 ? pixel_camera(kFineSize, kFineSize) : pixels_in_perspective();
        std::vector<PolygonSoup> objects{wire.soup()};
        if (seed % 3 == 0) objects.push_back(wall());
        Scene scene = scene_of(objects);
        if (seed % 5 == 0) scene.lines.classes = LineClass::silhouette;
        const Found found = look(draw_fine(scene, camera, kFineSize), camera, wire);
        EXPECT_EQ(found.share, 1) << seed << ": " << words(wire);
        EXPECT_GT(found.strength, 0.96) << seed << ": " << words(wire);
        EXPECT_LT(found.strength, 1.06 + 1.1 * wire.thickness) << seed << ": " << words(wire);
    }
}

// From frame to frame the strength stays the same.
TEST(ThinWires, DoNotBlinkWhileTheyMove) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Random random(1000 + seed);
        Wire wire = random_wire(random);
        wire.thickness = std::pow(10, random.real(-3, -1.2));
        wire.sides = random.integer(8, 16);
        const Camera camera = seed % 2 == 0 ? pixel_camera(kFineSize, kFineSize) : pixels_in_perspective();
        const glm::dvec3 step = random.in_box(0.03);
        double least = 2, most = 0;
        for (int frame = 0; frame < 20; ++frame) {
            wire.place += step;
            wire.angle_deg += 0.037;
            const double strength = look(draw_fine(scene_of({wire.soup()}), camera, kFineSize), camera, wire).strength;
            least = std::min(least, strength);
            most = std::max(most, strength);
        }
        EXPECT_LT(most - least, 0.05) << seed << ": " << words(wire);
    }
}

// On a face, a little in front of it, and sunk by half: what is in front of the face is seen.
TEST(ThinWires, AreDrawnCloseToASurface) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(2000 + seed);
        Wire wire = random_wire(random);
        wire.tilt_deg = 0;
        wire.thickness = std::pow(10, random.real(-3, -1));
        const double gap = seed % 3 == 0 ? 0.5 * wire.thickness : random.real(0.02, 1);
        const PolygonSoup face = transformed(
            make_box({100, 100, 4}), [&](glm::dvec3 p) { return p + glm::dvec3(22, 22, wire.place.z - gap - 2); });
        const Camera camera = pixel_camera(kFineSize, kFineSize);
        const Found found = look(draw_fine(scene_of({wire.soup(), face}), camera, kFineSize), camera, wire);
        EXPECT_EQ(found.share, 1) << seed << ": " << words(wire) << ", " << gap << " in front";
        EXPECT_GT(found.strength, 0.96) << seed << ": " << words(wire) << ", " << gap << " in front";
    }
}

TEST(ThinWires, BehindASurfaceAreHidden) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(3000 + seed);
        const Wire wire = random_wire(random);
        Scene scene = scene_of({wire.soup(), transformed(make_box({100, 100, 4}),
                                                         [](glm::dvec3 p) { return p + glm::dvec3(22, 22, 40); })});
        const Camera camera = pixel_camera(kFineSize, kFineSize);
        EXPECT_EQ(draw_fine(scene, camera, kFineSize).sum("lines.A"), 0) << seed;
        scene.lines.style.hidden.style = HiddenStyle::solid;
        const Frame frame = make_frame(scene, camera, kFineSize, kFineSize, {0, 0, kFineSize, kFineSize});
        LayerSet layers;
        layers.lines_hidden = true;
        Film film({0, 0, kFineSize, kFineSize}, frame.crop, layers, frame.criteria.classes);
        render_abuffer(frame, {2}, film);
        const Image image = film.image();
        double sum = 0;
        for (int y = 0; y < kFineSize; ++y) {
            for (int x = 0; x < kFineSize; ++x) sum += image.value(*image.find("lines_hidden.A"), x, y);
        }
        const double width = scene.lines.style.hidden_width_px();
        const glm::dvec3 along = wire.direction();
        const double length = 2 * wire.half_length * std::hypot(along.x, along.y);
        EXPECT_GT(sum, 0.95 * width * length) << seed << ": " << words(wire);
        EXPECT_LT(sum, (width + 0.06 + 1.2 * wire.thickness) * (length + 1)) << seed << ": " << words(wire);
    }
}

// A spoke that ends in a tip, or gets too thin for a contour on its way.
TEST(ThinWires, MayGetThinTowardsOneEnd) {
    for (std::uint64_t seed = 0; seed < 120; ++seed) {
        Random random(4000 + seed);
        Wire wire = random_wire(random);
        wire.thickness = std::pow(10, random.real(-2.5, 0));
        wire.taper = seed % 2 == 0 ? 0.01 : 0.1;
        const Camera camera = seed % 4 < 2 ? pixel_camera(kFineSize, kFineSize) : pixels_in_perspective();
        const Found found = look(draw_fine(scene_of({wire.soup()}), camera, kFineSize), camera, wire);
        EXPECT_EQ(found.share, 1) << seed << ": " << words(wire);
        EXPECT_GT(found.strength, 0.96) << seed << ": " << words(wire);
    }
    for (std::uint64_t seed = 0; seed < 60; ++seed) {  // with an apex
        Random random(5000 + seed);
        Wire wire = random_wire(random);
        const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), glm::radians(wire.angle_deg - 90), glm::dvec3(0, 0, 1)));
        wire.tilt_deg = 0;
        const PolygonSoup cone = transformed(make_cylinder(0.5 * wire.thickness, 0, 2 * wire.half_length, wire.sides),
                                             [&](glm::dvec3 p) { return turn * p + wire.middle(); });
        const Camera camera = pixel_camera(kFineSize, kFineSize);
        const Found found = look(draw_fine(scene_of({cone}), camera, kFineSize), camera, wire);
        EXPECT_EQ(found.share, 1) << seed << ": " << words(wire);
        EXPECT_GT(found.strength, 0.96) << seed << ": " << words(wire);
    }
}

TEST(ThinWires, RingsOfThemAreClosed) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(6000 + seed);
        const double thickness = std::pow(10, random.real(-4, -0.5)), radius = random.real(5, 17);
        const int segments = random.integer(8, 200);
        const glm::dvec3 offset = glm::dvec3(22, 22, 0) + random.in_box(2);
        const PolygonSoup ring = transformed(make_torus(radius, 0.5 * thickness, segments, random.integer(3, 12)),
                                             [&](glm::dvec3 p) { return glm::dvec3(p.x, p.z, p.y) + offset; });
        const Drawing drawn = draw_fine(scene_of({ring}), pixel_camera(kFineSize, kFineSize), kFineSize);
        const double length = 2 * segments * radius * std::sin(M_PI / segments);
        EXPECT_GT(drawn.sum("lines.A"), 0.96 * length) << seed << ": " << thickness << ' ' << segments;
        EXPECT_LT(drawn.sum("lines.A"), (1.06 + 1.1 * thickness) * length)
            << seed << ": " << thickness << ' ' << segments;
    }
}

// A plate that is seen edge-on, as thin as a wire.
TEST(ThinWires, PlatesSeenEdgeOn) {
    for (std::uint64_t seed = 0; seed < 80; ++seed) {
        Random random(7000 + seed);
        Wire wire = random_wire(random);
        wire.tilt_deg = 0;
        const double depth = random.real(0.5, 20), lean = seed % 2 == 0 ? 0 : random.real(-0.001, 0.001);
        const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), glm::radians(wire.angle_deg), glm::dvec3(0, 0, 1)));
        const PolygonSoup plate =
            transformed(make_box({2 * wire.half_length, wire.thickness, depth}),
                        [&](glm::dvec3 p) { return turn * (p + glm::dvec3(0, lean * p.z, 0)) + wire.middle(); });
        const Camera camera = pixel_camera(kFineSize, kFineSize);
        const Found found = look(draw_fine(scene_of({plate}), camera, kFineSize), camera, wire);
        EXPECT_EQ(found.share, 1) << seed << ": " << words(wire);
        EXPECT_GT(found.strength, 0.96) << seed << ": " << words(wire);
    }
}

// A strip of one or more polygons across, flat or bent, open at both sides.
TEST(ThinWires, OpenBandsAndTubes) {
    for (std::uint64_t seed = 0; seed < 120; ++seed) {
        Random random(8000 + seed);
        const Wire wire = random_wire(random);
        const PolygonSoup closed = wire.soup();
        PolygonSoup open;
        open.positions = closed.positions;
        const bool is_tube = seed % 2 == 0;
        const auto sides = static_cast<std::size_t>(is_tube ? wire.sides : random.integer(1, wire.sides - 1));
        for (std::size_t i = 0; i < sides; ++i) open.add_polygon(closed.polygon(i));
        const Camera camera = seed % 4 < 2 ? pixel_camera(kFineSize, kFineSize) : pixels_in_perspective();
        Scene scene = scene_of({open});
        close_cracks(scene, camera, kFineSize, kFineSize, 2);
        const Found found = look(draw_fine(scene, camera, kFineSize), camera, wire);
        EXPECT_EQ(found.share, 1) << seed << ": " << words(wire) << ", " << sides;
        EXPECT_GT(found.strength, 0.96) << seed << ": " << words(wire) << ", " << sides;
    }
}

}  // namespace
}  // namespace burin::thin_wires_test
