// Lines that lie on each other on the screen are one dashed line.

#include "lines/shared_dashes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lines/dash_pen.h"
#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::shared_dashes_test {
namespace {

using namespace test;

constexpr int kSize = 240;
constexpr PixelRect kPicture{0, 0, kSize, kSize};
constexpr std::array<double, 2> kDash{4, 3};
constexpr double kPeriod = kDash[0] + kDash[1];

/// A chain of one piece whose dashes begin at `at`.
DashPiece piece_of(glm::dvec2 from, glm::dvec2 to, double at = 0) {
    return {from, to, at, at + glm::distance(from, to)};
}

/// Each piece is a chain.
DashPlaces lay_out(SharedDashes& shared, const std::vector<DashPiece>& pieces) {
    std::vector<std::size_t> ends;
    for (std::size_t i = 0; i < pieces.size(); ++i) ends.push_back(i + 1);
    return shared.lay_out(pieces, ends);
}

struct Interval {
    double begin, end;
};

/// What dashes cover along a direction, in order, where those that touch are one.
std::vector<Interval> union_of(const std::vector<DashPiece>& pieces, const DashPlaces& places, glm::dvec2 along) {
    const DashPen pen(kDash, 0);
    std::vector<Interval> all, joined;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        places.for_parts(i, [&](const DashPart& part) {
            const double length = part.at_end - part.at_begin;
            const auto place = [&](double at) {
                return glm::dot(glm::mix(pieces[i].from, pieces[i].to,
                                         std::lerp(part.begin, part.end, (at - part.at_begin) / length)),
                                along);
            };
            pen.for_dashes(part.at_begin, part.at_end, 1, [&](double first, double last) {
                all.push_back({std::min(place(first), place(last)), std::max(place(first), place(last))});
            });
        });
    }
    std::sort(all.begin(), all.end(), [](const Interval& a, const Interval& b) { return a.begin < b.begin; });
    for (const Interval& i : all) {
        if (!joined.empty() && i.begin <= joined.back().end + 0.05)
            joined.back().end = std::max(joined.back().end, i.end);
        else
            joined.push_back(i);
    }
    return joined;
}

// Pieces of any length and either direction that lie on each other in part, an eighth of a pixel beside a line: one
// dashed line.
TEST(SharedDashes, OfPiecesOnOneLineAreThoseOfOneLine) {
    for (std::uint64_t trial = 0; trial < 300; ++trial) {
        Random random(trial);
        const double angle = random.real(0, 2 * std::numbers::pi);
        const glm::dvec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x), middle(120, 120);
        const auto place = [&](double at) { return middle + at * along + random.real(-0.06, 0.06) * across; };
        std::vector<DashPiece> pieces;
        double low = -30, high = -28;
        for (int i = random.integer(2, 12); i > 0; --i) {
            const double begin = pieces.empty() ? low : random.real(low, high - 1.5), end = begin + random.real(2, 40);
            high = std::max(high, end);
            if (random.integer(0, 1) == 1)
                pieces.push_back(piece_of(place(begin), place(end), random.real(0, 20)));
            else
                pieces.push_back(piece_of(place(end), place(begin), random.real(0, 20)));
            low = i > 6 ? low : begin;
        }
        SharedDashes shared(kPicture, 0.25);
        const std::vector<Interval> dashes = union_of(pieces, lay_out(shared, pieces), along);
        ASSERT_FALSE(dashes.empty());
        for (std::size_t i = 1; i + 1 < dashes.size(); ++i) {
            EXPECT_NEAR(dashes[i].end - dashes[i].begin, kDash[0], 0.2) << trial;
            EXPECT_NEAR(dashes[i].begin - dashes[i - 1].begin, i == 1 ? dashes[2].begin - dashes[1].begin : kPeriod,
                        i == 1 ? kPeriod : 0.2)
                << trial;
        }
    }
}

// Dashes of lines that only touch go on as well, where lines lie on each other somewhere along them.
TEST(SharedDashes, RunOnStraight) {
    const std::vector<DashPiece> pieces{piece_of({20, 50}, {50, 50}), piece_of({50, 50}, {61, 50}, 0.7),
                                        piece_of({79, 50}, {61, 50}, 1.9), piece_of({79, 50}, {100, 50}, 2.3),
                                        piece_of({45, 50}, {20, 50}, 5.5)};
    SharedDashes shared(kPicture, 0.25);
    const std::vector<Interval> dashes = union_of(pieces, lay_out(shared, pieces), {1, 0});
    ASSERT_EQ(dashes.size(), 12u);  // of 80 pixels
    for (std::size_t i = 0; i < 11; ++i) {
        EXPECT_NEAR(dashes[i].begin, 20 + kPeriod * static_cast<double>(i), 1e-9);
        EXPECT_NEAR(dashes[i].end - dashes[i].begin, kDash[0], 1e-9);
    }
}

// Lines that cross, run beside each other at a distance, or touch in a straight line only: to the bit.
TEST(SharedDashes, OfOtherLinesAreTheirOwn) {
    std::vector<DashPiece> pieces{piece_of({20, 50}, {120, 50}, 0.3), piece_of({20, 40}, {120, 61}, 0.4),
                                  piece_of({20, 50.75}, {120, 50.75}, 0.5), piece_of({120, 50}, {180, 50}, 0.6),
                                  piece_of({70, 10}, {70, 200}, 0.7)};
    SharedDashes shared(kPicture, 0.25);
    const DashPlaces places = lay_out(shared, pieces);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        int parts = 0;
        places.for_parts(i, [&](const DashPart& part) {
            ++parts;
            EXPECT_EQ(part.begin, 0);
            EXPECT_EQ(part.end, 1);
            EXPECT_EQ(part.at_begin, pieces[i].at_from);
            EXPECT_EQ(part.at_end, pieces[i].at_to);
        });
        EXPECT_EQ(parts, 1);
    }
}

// Two circles of different facets: the second one's dashes are those of the first.
TEST(SharedDashes, OfCurvesAreThoseOfTheFirst) {
    std::vector<DashPiece> pieces;
    std::vector<std::size_t> ends;
    for (const int count : {64, 96}) {
        double at = count == 64 ? 0 : 3.1;
        for (int i = 0; i < count; ++i) {
            const auto corner = [&](int k) {
                const double a = 2 * std::numbers::pi * k / count;
                return glm::dvec2(120, 120) + 60.0 * glm::dvec2(std::cos(a), std::sin(a));
            };
            pieces.push_back(piece_of(corner(i), corner((i + 1) % count), at));
            at = pieces.back().at_to;
        }
        ends.push_back(pieces.size());
    }
    SharedDashes shared(kPicture, 0.25);
    const DashPlaces places = shared.lay_out(pieces, ends);
    const auto is_on = [](double at) { return at - kPeriod * std::floor(at / kPeriod) < kDash[0]; };
    int alike = 0, all = 0;
    for (std::size_t i = 64; i < pieces.size(); ++i) {
        places.for_parts(i, [&](const DashPart& part) {
            for (double s = 0.05; s < 1; s += 0.1) {
                const glm::dvec2 p =
                    glm::mix(pieces[i].from, pieces[i].to, std::lerp(part.begin, part.end, s)) - glm::dvec2(120, 120);
                const double a = std::atan2(p.y, p.x), on_first = (a < 0 ? a + 2 * std::numbers::pi : a) * 60;
                alike += is_on(std::lerp(part.at_begin, part.at_end, s)) == is_on(on_first) ? 1 : 0;
                ++all;
            }
        });
    }
    EXPECT_GT(alike, 0.93 * all);
}

/// A block of the picture's size, in which bodies are hidden.
PolygonSoup block() {
    return transformed(make_box({200, 200, 200}), [](glm::dvec3 p) { return p + glm::dvec3(120, 120, 0); });
}
PolygonSoup box_between(glm::dvec3 low, glm::dvec3 high) {
    return transformed(make_box(high - low), [&](glm::dvec3 p) { return p + 0.5 * (low + high); });
}
/// An upright pin around x = 120.
PolygonSoup pin(double radius, double low, double high, int segments, double z, double turn = 0) {
    return transformed(make_cylinder(radius, radius, high - low, segments), [&](glm::dvec3 p) {
        const double c = std::cos(turn), s = std::sin(turn);
        return glm::dvec3(c * p.x - s * p.z + 120, p.y + 0.5 * (low + high), s * p.x + c * p.z + z);
    });
}

Image drawn(const Scene& scene, const Camera& camera = pixel_camera(kSize, kSize), int threads = 1,
            PixelRect crop = kPicture) {
    return Drawing(scene, camera, kSize, kSize, crop, threads, render_abuffer).image();
}

double ink(const Image& image, const std::string& channel, PixelRect rect) {
    double sum = 0;
    const Channel& c = *image.find(channel);
    for (int y = rect.y0; y < rect.y1; ++y) {
        for (int x = rect.x0; x < rect.x1; ++x) sum += image.value(c, x, y);
    }
    return sum;
}

/// Hidden ink of dashes as a share of that of solid lines.
double dashed_share(Scene scene, PixelRect rect) {
    scene.lines.style.hidden.style = HiddenStyle::dashed;
    const double dashes = ink(drawn(scene), "lines_hidden.A", rect);
    scene.lines.style.hidden.style = HiddenStyle::solid;
    return dashes / ink(drawn(scene), "lines_hidden.A", rect);
}

// The rims of pins seen from the side are many edges on one line.
TEST(SharedDashes, OfHiddenRimsSeenFromTheSide) {
    for (const int segments : {5, 6, 24, 200}) {
        std::vector<PolygonSoup> objects{block()};
        for (int i = 0; i < (segments > 24 ? 1 : 6); ++i)
            objects.push_back(pin(20 + 4 * i, 70, 170.2, segments, -60 + 30 * i, 0.3 * i));
        const double share = dashed_share(scene_of(objects), {60, 66, 180, 74});
        EXPECT_GT(share, 0.45) << segments;
        EXPECT_LT(share, 0.7) << segments;
    }
}

// Sides of bodies one behind the other and in contact.
TEST(SharedDashes, OfHiddenBodiesWithCommonSides) {
    for (std::uint64_t trial = 0; trial < 20; ++trial) {
        Random random(trial);
        std::vector<PolygonSoup> objects{block()};
        for (int i = 0; i < 8; ++i) {
            const double low = random.real(50, 110);
            objects.push_back(box_between({60.5, low, -80 + 18 * i},
                                          {random.real(90, 180), low + random.real(15, 60), -62 + 18 * i}));
        }
        const double share = dashed_share(scene_of(objects), {60, 30, 61, 210});
        EXPECT_GT(share, 0.45) << trial;
        EXPECT_LT(share, 0.72) << trial;
    }
}

// A row of bodies in contact side by side: their common edges are visible, those of one or of the other.
TEST(SharedDashes, OfVisibleBodiesInContact) {
    std::vector<PolygonSoup> objects;
    for (int i = 0; i < 4; ++i)
        objects.push_back(box_between({30 + 40.0 * i, 40, 0}, {70 + 40.0 * i, 200, 50 + 3.0 * (i % 2)}));
    Scene scene = scene_of(objects);
    const double solid = ink(drawn(scene), "lines.A", kPicture);
    scene.lines.style.dash_px = {8, 6};
    EXPECT_NEAR(ink(drawn(scene), "lines.A", kPicture) / solid, 8.0 / 14, 0.05);
}

// A hidden line exactly behind a visible dashed one is left out.
TEST(SharedDashes, OfHiddenLinesLeaveVisibleOnesAlone) {
    Scene scene = scene_of({block(), box_between({60, 60, -50}, {180, 150, 50})});
    scene.lines.style.dash_px = {8, 6};
    scene.lines.style.hidden.style = HiddenStyle::dashed;
    const Image image = drawn(scene);
    EXPECT_GT(ink(image, "lines.A", kPicture), 100);
    EXPECT_GT(ink(image, "lines_hidden.A", {50, 50, 190, 190}), 100);  // of the box inside
    EXPECT_NEAR(ink(image, "lines_hidden.A", kPicture), ink(image, "lines_hidden.A", {50, 50, 190, 190}),
                0.01);  // of the block
}

/// Pins and boxes whose lines lie on each other.
std::vector<PolygonSoup> assembly() {
    return {block(), pin(30, 60, 150, 24, 0), pin(22, 60, 150, 10, 10, 0.2),
            box_between({80, 60, -70}, {150, 120, -50}), box_between({80, 90, -50}, {140, 160, -31})};
}

TEST(SharedDashes, DependOnThePictureOnly) {
    Scene scene = scene_of(assembly()), turned = scene_of([] {
                                            std::vector<PolygonSoup> objects = assembly();
                                            for (PolygonSoup& o : objects) {
                                                PolygonSoup other;
                                                other.positions = o.positions;
                                                for (std::size_t p = o.polygon_count(); p-- > 0;)
                                                    other.add_polygon(o.polygon(p));
                                                other.object_names = o.object_names;
                                                o = other;
                                            }
                                            return objects;
                                        }());
    for (Scene* s : {&scene, &turned}) {
        s->lines.style.hidden.style = HiddenStyle::dashed;
        s->lines.style.dash_px = {7, 4};
    }
    for (const Camera& camera : {pixel_camera(kSize, kSize), perspective_camera({150, 160, 600}, {120, 120, 0})}) {
        const Image whole = drawn(scene, camera);
        EXPECT_TRUE(same_bits(whole, drawn(scene, camera, 3)));
        const PixelRect crop{61, 70, 133, 171};
        const Image part = drawn(scene, camera, 1, crop), other = drawn(turned, camera);
        for (const std::string channel : {"lines.A", "lines_hidden.A"}) {
            const Channel &a = *whole.find(channel), &b = *part.find(channel), &c = *other.find(channel);
            for (int y = 0; y < kSize; ++y) {
                for (int x = 0; x < kSize; ++x) {
                    ASSERT_EQ(whole.value(a, x, y), other.value(c, x, y)) << channel << ' ' << x << ' ' << y;
                    if (x < crop.x0 || y < crop.y0 || x >= crop.x1 || y >= crop.y1) continue;
                    ASSERT_EQ(whole.value(a, x, y), part.value(b, x - crop.x0, y - crop.y0))
                        << channel << ' ' << x << ' ' << y;
                }
            }
        }
    }
}

// A camera that moves by 1/32 pixel a frame moves shared dashes by as much.
TEST(SharedDashes, StandStillInAnAnimation) {
    Scene scene = scene_of(assembly()), plain = scene;
    scene.lines.style.hidden.style = HiddenStyle::dashed;
    plain.lines.style.hidden.style = HiddenStyle::solid;
    const auto frame = [](const Scene& s, int number) {
        return drawn(s, [&] {
            Camera camera = pixel_camera(kSize, kSize);
            camera.to_world[3] += glm::dvec4(0.8, 0.6, 0, 0) * (number / 32.0);
            return camera;
        }());
    };
    const auto change = [](const Image& a, const Image& b) {
        double sum = 0;
        const Channel &p = *a.find("lines_hidden.A"), &q = *b.find("lines_hidden.A");
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) sum += std::abs(a.value(p, x, y) - b.value(q, x, y));
        }
        return sum;
    };
    for (int number = 0; number < 12; ++number) {
        const double of_dashes = change(frame(scene, number), frame(scene, number + 1));
        EXPECT_GT(of_dashes, 1) << number;
        EXPECT_LE(of_dashes, change(frame(plain, number), frame(plain, number + 1))) << number;
    }
}

}  // namespace
}  // namespace burin::shared_dashes_test
