// Shadings that vary over surfaces, against what analysis says of balls, planes and boxes.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "methods/abuffer.h"
#include "methods/reference/reference.h"
#include "tests/scene/scene_text.h"
#include "tests/support/drawing.h"

namespace burin::surfaces_test {
namespace {

using namespace test;

constexpr int kSize = 200;
const std::string kNoLines = "[lines]\ndraw = \"none\"\n";

/// A ball of 80 px around the middle of the picture, seen along -z, fine enough that its facets do not matter.
std::string ball(int rings = 256) {
    return "[[object]]\nshape = \"sphere\"\nradius = 80\nsegments = " + std::to_string(2 * rings) +
           "\nrings = " + std::to_string(rings) + "\ntranslate = [100, 100, 0]\n";
}

Drawing drawn(const std::string& text, int threads = 2, PixelRect crop = {0, 0, kSize, kSize},
              RenderFunction render = render_abuffer, const Camera& camera = pixel_camera(kSize, kSize)) {
    return Drawing(loaded(text), camera, kSize, kSize, crop, threads, render);
}

/// The unit normal of the ball at a pixel's centre, and how far that lies from the ball's middle.
glm::dvec3 ball_normal(int x, int y) {
    const double u = (x + 0.5 - 100) / 80, v = (100 - y - 0.5) / 80;
    return {u, v, std::sqrt(std::max(1 - u * u - v * v, 0.0))};
}
double from_middle(int x, int y) { return std::hypot(x + 0.5 - 100, y + 0.5 - 100); }

TEST(SurfaceShading, ExpressionsKnowNormalsAndPositions) {
    const Drawing normals = drawn(kNoLines +
                                  "[surfaces]\ncolor = \"=rgb(0.5 + 0.5*N.x, 0.5 + 0.5*N.y, N.z)\"\n"
                                  "normals = \"smooth\"\n" +
                                  ball());
    const Drawing places = drawn(kNoLines + "[surfaces]\ncolor = \"=rgb(P.x/256, P.y/256, P.z/256)\"\n" + ball());
    const Drawing others = drawn(kNoLines + "[surfaces]\ncolor = \"=rgb(depth/2048, x/256, facing)\"\n" + ball());
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            if (from_middle(x, y) > 74) continue;
            const glm::dvec3 n = ball_normal(x, y);
            ASSERT_NEAR(normals.at("R", x, y), 0.5 + 0.5 * n.x, 2e-3);
            ASSERT_NEAR(normals.at("G", x, y), 0.5 + 0.5 * n.y, 2e-3);
            ASSERT_NEAR(normals.at("B", x, y), n.z, 6e-3);
            ASSERT_NEAR(places.at("R", x, y), (x + 0.5) / 256, 1e-3);
            ASSERT_NEAR(places.at("G", x, y), (kSize - y - 0.5) / 256, 1e-3);
            ASSERT_NEAR(places.at("B", x, y), 80 * n.z / 256, 2e-3);
            ASSERT_NEAR(others.at("R", x, y), (1000 - 80 * n.z) / 2048, 1e-3);
            ASSERT_NEAR(others.at("G", x, y), (x + 0.5) / 256, 1e-3);
            ASSERT_NEAR(others.at("B", x, y), n.z, 2e-2);
        }
    }
}

TEST(SurfaceShading, StepsOfAToonLieWhereTheLightIsSo) {
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(-1, 2, 1.5));
    const Drawing d = drawn(kNoLines +
                            "[[light]]\ndirection = [-1, 2, 1.5]\n[surfaces]\nshading = \"toon\"\n"
                            "normals = \"smooth\"\ntones = { stops = [[-1, 0.1], [0, 0.4], [0.6, 0.9]] }\n"
                            "[[material]]\nname = \"grey\"\ncolor = [0.5, 0.5, 0.5]\n" +
                            ball() + "material = \"grey\"\n");
    int near = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            if (from_middle(x, y) > 76) continue;
            const double light = glm::dot(ball_normal(x, y), to_light);
            const double tone = light < 0 ? 0.1 : light < 0.6 ? 0.4 : 0.9;
            const glm::dvec3 n = ball_normal(x, y);
            const glm::dvec2 change = (glm::dvec2(to_light) - to_light.z / n.z * glm::dvec2(n)) / 80.0;
            if (std::min(std::abs(light), std::abs(light - 0.6)) < 0.8 * glm::length(change) + 0.002) {
                ++near;
                ASSERT_GE(d.at("R", x, y), 0.05 - 1e-3);
                ASSERT_LE(d.at("R", x, y), 0.45 + 1e-3);
            } else {
                ASSERT_NEAR(d.at("R", x, y), 0.5 * tone, 5e-4) << x << ' ' << y << ' ' << light;
            }
        }
    }
    EXPECT_LT(near, 1200);
}

TEST(SurfaceShading, StepsAreAsSoftAtAnyDistance) {
    const std::string text = kNoLines +
                             "[[light]]\ndirection = [1, 0, 0]\n[surfaces]\nshading = \"toon\"\n"
                             "normals = \"smooth\"\nsoftness = 8\n"
                             "tones = { stops = [[-1, 0], [0.5, 1]] }\n"
                             "[[material]]\nname = \"white\"\ncolor = [1, 1, 1]\n"
                             "[[object]]\nshape = \"sphere\"\nradius = 1\nsegments = 256\nrings = 128\n"
                             "material = \"white\"\n";
    for (const double distance : {6.0, 12.0}) {
        const Drawing d =
            drawn(text, 2, {0, 0, kSize, kSize}, render_abuffer, perspective_camera({0, 0, distance}, {0, 0, 0}));
        // The step's share of the row that is above a half is as long as the one below.
        double inner = 0, rise = 0;
        for (int x = 101; x < 199; ++x) {
            const double step = d.at("R", x, 100) - d.at("R", x - 1, 100);
            if (d.at("R", x, 100) > 0.01 && d.at("R", x, 100) < 0.99) ++inner;
            if (d.at("A", x, 100) > 0.99) rise = std::max(rise, step);
        }
        EXPECT_NEAR(inner, 7.5, 1.5) << distance;
        EXPECT_NEAR(rise, 1.5 / 8, 0.02) << distance;  // of a smooth step over 8 px, in its middle
    }
}

TEST(SurfaceShading, DetailMixesInOtherTones) {
    const std::string text = kNoLines +
                             "[[light]]\ndirection = [0, 0, 1]\n[[material]]\nname = \"white\"\n"
                             "color = [1, 1, 1]\n[surfaces]\nshading = \"toon\"\n"
                             "tones = { stops = [[0, 0.25]] }\n"
                             "detail = { over = \"x / 200\", tones = { stops = [[0, \"#ff0000\"]] } }\n"
                             "[[object]]\nshape = \"plane\"\nsize = [150, 150]\n"
                             "rotate = [90, 0, 0]\ntranslate = [100, 100, 0]\nmaterial = \"white\"\n";
    const Drawing d = drawn(text);
    for (int x = 30; x < 170; x += 7) {
        const double share = (x + 0.5) / 200;
        EXPECT_NEAR(d.at("R", x, 100), 0.25 + share * 0.75, 1e-3);
        EXPECT_NEAR(d.at("G", x, 100), 0.25 * (1 - share), 1e-3);
    }
}

TEST(SurfaceShading, GoochHasItsTwoTones) {
    const std::string material = "[[material]]\nname = \"m\"\ncolor = [0.8, 0.4, 0.2]\n";
    for (const double angle : {0.0, 30.0, 75.0, 120.0, 180.0}) {
        const double c = std::cos(glm::radians(angle)), s = std::sin(glm::radians(angle));
        const Drawing d = drawn(kNoLines + "[[light]]\ndirection = [" + std::to_string(s) + ", 0, " +
                                std::to_string(c) + "]\n[surfaces]\nshading = \"gooch\"\n" + material +
                                "[[object]]\nshape = \"plane\"\nsize = [150, 150]\nrotate = [90, 0, 0]\n"
                                "translate = [100, 100, 0]\nmaterial = \"m\"\n");
        const glm::dvec3 color(0.8, 0.4, 0.2);
        const glm::dvec3 right =
            glm::mix(glm::dvec3(0, 0, 0.55) + 0.25 * color, glm::dvec3(0.3, 0.3, 0) + 0.5 * color, (1 + c) / 2);
        EXPECT_NEAR(d.at("R", 90, 90), right.r, 1e-3) << angle;
        EXPECT_NEAR(d.at("G", 90, 90), right.g, 1e-3) << angle;
        EXPECT_NEAR(d.at("B", 90, 90), right.b, 1e-3) << angle;
    }
}

TEST(SurfaceShading, FlatIsTheMaterial) {
    const Drawing d = drawn(kNoLines +
                            "[surfaces]\nshading = \"flat\"\n[[material]]\nname = \"m\"\n"
                            "color = [0.8, 0.4, 0.2]\n" +
                            ball(32) + "material = \"m\"\n");
    EXPECT_NEAR(d.at("R", 60, 70), 0.8, 1e-3);
    EXPECT_NEAR(d.at("G", 60, 70), 0.4, 1e-3);
    EXPECT_EQ(d.at("A", 60, 70), 1);
    EXPECT_EQ(d.at("A", 5, 5), 0);
}

TEST(SurfaceShading, AHatchingHasItsTone) {
    for (const char* const space : {"screen", "object"}) {
        for (const double tone : {0.05, 0.3, 0.5, 0.62, 0.9, 1.0}) {
            for (const double spacing : {2.5, 4.0, 7.3}) {
                const std::string where = std::string(space) == "screen"
                                              ? "angle = " + std::to_string(10 * spacing) + "\n"
                                              : "axis = [1, 0.3, 0.6]\n";
                const Drawing d =
                    drawn(kNoLines + "[surfaces]\nshading = \"hatch\"\nspace = \"" + space + "\"\nlevels = 3\n" +
                          where + "tone = " + std::to_string(tone) + "\nspacing = " + std::to_string(spacing) +
                          "\n[[object]]\nshape = \"plane\"\nsize = [170, 170]\n"
                          "rotate = [90, 0, 0]\ntranslate = [100, 100, 0]\n");
                double sum = 0, least = 1, most = 0;
                for (int y = 20; y < 180; ++y) {
                    for (int x = 20; x < 180; ++x) {
                        sum += d.at("R", x, y);
                        least = std::min(least, d.at("R", x, y));
                        most = std::max(most, d.at("R", x, y));
                    }
                }
                EXPECT_NEAR(sum / (160 * 160), tone, 1.0 / 64) << space << ' ' << tone << ' ' << spacing;
                if (spacing > 5 && tone > 0.2 && tone < 0.8) {
                    EXPECT_LT(least, 0.05) << space;
                    EXPECT_GT(most, 0.95) << space;
                }
            }
        }
    }
}

TEST(SurfaceShading, NothingButThePlaceCounts) {
    const std::string rest =
        "[[light]]\nposition = [300, 300, 300]\n[[light]]\ndirection = [-1, 0, 0]\n"
        "space = \"camera\"\n[[object]]\nshape = \"torus\"\nradius = 60\ntube_radius = 25\n"
        "rotate = [50, 20, 0]\ntranslate = [100, 100, 0]\n";
    for (const std::string shading :
         {"shading = \"toon\"\nnormals = \"smooth\"\n", "shading = \"hatch\"\nspace = \"object\"\n",
          "color = \"=rgb(light, facing, noise3(P/20))\"\nnormals = \"smooth\"\n"}) {
        const std::string text = rest + "[surfaces]\n" + shading;
        const Drawing all = drawn(text, 1);
        EXPECT_TRUE(same_bits(all.image(), drawn(text, 2).image())) << shading;
        const PixelRect crop{37, 51, 133, 120};
        const Drawing part = drawn(text, 2, crop);
        for (int y = crop.y0; y < crop.y1; ++y) {
            for (int x = crop.x0; x < crop.x1; ++x) {
                const int u = x - crop.x0, v = y - crop.y0;
                ASSERT_EQ(part.at("R", u, v), all.at("R", x, y)) << shading << x << ' ' << y;
                ASSERT_EQ(part.at("B", u, v), all.at("B", x, y)) << shading << x << ' ' << y;
            }
        }
    }
}

TEST(SurfaceShading, RaysSeeTheSame) {
    const std::string text =
        "[reference]\nsamples = 8\n" + kNoLines +
        "[[light]]\ndirection = [1, 2, 3]\n[surfaces]\nshading = \"toon\"\nnormals = \"smooth\"\n" + ball(48) +
        "[[object]]\nshape = \"box\"\nsize = [60, 60, 60]\nrotate = [30, 40, 0]\n"
        "translate = [40, 60, 60]\n";
    const Drawing fast = drawn(text), rays = drawn(text, 2, {0, 0, kSize, kSize}, render_reference);
    double sum = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) sum += std::abs(fast.at("surface.R", x, y) - rays.at("surface.R", x, y));
    }
    EXPECT_LT(sum / (kSize * kSize), 2e-3);
}

TEST(SurfaceShading, TransparentSurfacesAreShaded) {
    const Drawing d =
        drawn(kNoLines +
              "[surfaces]\ncolor = \"=C * (x / 200)\"\n[[material]]\nname = \"glass\"\ncolor = [1, 0, 0]\n"
              "opacity = 0.25\n[[material]]\nname = \"wall\"\ncolor = [0, 1, 0]\n"
              "[[object]]\nshape = \"plane\"\nsize = [150, 150]\nrotate = [90, 0, 0]\ntranslate = [100, 100, 0]\n"
              "material = \"wall\"\n[[object]]\nshape = \"plane\"\nsize = [150, 80]\nrotate = [90, 0, 0]\n"
              "translate = [100, 100, 50]\nmaterial = \"glass\"\n");
    EXPECT_NEAR(d.at("R", 120, 100), 0.25 * 120.5 / 200, 1e-3);
    EXPECT_NEAR(d.at("G", 120, 100), 0.75 * 120.5 / 200, 1e-3);
    EXPECT_NEAR(d.at("G", 120, 35), 120.5 / 200, 1e-3);
}

TEST(SurfaceShading, AFoldHasTwoNormals) {
    // A box keeps its flat faces whatever normals are asked for: its edges are creases.
    const Drawing d = drawn(kNoLines +
                            "[surfaces]\nnormals = \"smooth\"\ncolor = \"=rgb(abs(N.x), abs(N.y), abs(N.z))\"\n"
                            "[[object]]\nshape = \"box\"\nsize = [80, 80, 80]\n"
                            "rotate = [0, 30, 0]\ntranslate = [100, 100, 0]\n");
    EXPECT_NEAR(d.at("R", 70, 100), 0.5, 0.4);
    EXPECT_NEAR(std::pow(d.at("R", 70, 100), 2) + std::pow(d.at("B", 70, 100), 2), 1, 2e-3);
    EXPECT_NEAR(d.at("R", 70, 100), d.at("R", 80, 120), 1e-6);
}

TEST(SurfaceShading, FaultsOfExpressionsHaveTheirPlace) {
    struct Case {
        const char *text, *message;
    };
    const Case cases[] = {
        {"color = \"=C * depht\"", ":4:15: [surfaces] color: unknown variable 'depht', did you mean 'depth'?"},
        {"color = \"=N.x*s\"", ":4:15: [surfaces] color: unknown variable 's'"},
        {"color = \"=qi\"", ":4:11: [surfaces] color: unknown variable 'qi'"},
        {"color = \"=attr(x) * C\"", ":4:16: [surfaces] color: attr(\"name\") needs a text"},
        {"shading = \"hatch\"\ntone = \"=C\"", ":5:10: [surfaces] tone: a number is needed here"},
        {"shading = \"hatch\"\nspacing = \"9000pt\"", ":5:11: [surfaces] spacing: is 12000 px"},
        {"shading = \"hatch\"\nspacing = 0.5", ":5:11: [surfaces] spacing: is 0.5 px; it must be from 1"},
        {"shading = \"toon\"\ndetail = { over = \"N\", tones = { stops = [[0, 1]] } }",
         ":5:20: [surfaces.detail] over: a number is needed here, but the expression is a vector"},
    };
    for (const Case& c : cases) {
        try {
            drawn(kNoLines + "[surfaces]\n" + c.text + "\n" + ball(8));
            ADD_FAILURE() << c.text;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(c.message), std::string::npos) << error.what();
        }
    }
}

TEST(SurfaceShading, LengthsOfThePicturesSizeAreDrawnInEverySize) {
    const auto with = [](const std::string& surfaces) {
        return drawn(kNoLines + "[surfaces]\n" + surfaces + ball(32));
    };
    const std::string hatch = "shading = \"hatch\"\nspacing = ", toon = "shading = \"toon\"\nsoftness = ";
    const Drawing least = with(hatch + "1\n"), most = with(hatch + "4096\n"), softest = with(toon + "4096\n");
    for (const char* const small : {"\"0.3%\"", "\"0.05mm\"", "\"0.1pt\"", "\"0%\""})
        EXPECT_TRUE(same_bits(with(hatch + small + "\n").image(), least.image())) << small;
    EXPECT_TRUE(same_bits(with(hatch + "\"3000%\"\n").image(), most.image()));
    EXPECT_TRUE(same_bits(with(toon + "\"3000%\"\n").image(), softest.image()));
    EXPECT_FALSE(same_bits(with(hatch + "\"2%\"\n").image(), least.image()));
}

TEST(SurfaceShading, WhatIsNoNumberIsBlackAndNoted) {
    const Drawing d = drawn(kNoLines + "[surfaces]\ncolor = \"=rgb(1, 1, sqrt(0)/0 * 0)\"\n" + ball(32));
    EXPECT_EQ(d.at("R", 100, 100), 0);
    EXPECT_EQ(d.at("A", 100, 100), 1);
    // A plate of which the columns to the left of 100 have no colour, seen in 20 x 20 pixels.
    const auto notes_of = [&](const std::string& color, RenderFunction render) {
        const Scene scene = loaded(kNoLines + "[surfaces]\ncolor = \"" + color + "\"\n[[object]]\nshape = \"plane\"\n" +
                                   "size = [119, 119]\nrotate = [90, 0, 0]\ntranslate = [100, 100, 0]\n");
        const Frame frame = make_frame(scene, pixel_camera(kSize, kSize), kSize, kSize, {95, 90, 115, 110});
        Film film({0, 0, kSize, kSize}, frame.crop, {}, frame.criteria.classes);
        return render(frame, {}, film).notes;
    };
    const std::string half = "=rgb(1, 1, x < 100 ? 0 / 0 : 1)", note = "[surfaces]: a value is not a number at ";
    for (const RenderFunction render : {render_abuffer, render_reference}) {
        const std::vector<std::string> notes = notes_of(half, render);
        ASSERT_EQ(notes.size(), 1u);
        EXPECT_TRUE(notes[0].starts_with(note) && notes[0].ends_with(" places on surfaces; there it is 0")) << notes[0];
        EXPECT_GE(std::stoi(notes[0].substr(note.size())), 5 * 20);
        EXPECT_TRUE(notes_of("=rgb(1, 1, x < 100 ? 0 : 1)", render).empty());
    }
}

TEST(Lights, OfASceneAreThoseOfItsLines) {
    // Opacity is the light of a square's border, which a light in front of its middle reaches less and less.
    const auto lines = [](const std::string& light, const std::string& of_sheet) {
        const SceneText scene("style = \"s.toml\"\n[[light]]\n" + light +
                              "\n[[object]]\nshape = \"plane\"\nsize = [160, 160]\nrotate = [90, 0, 0]\n"
                              "translate = [100, 100, 0]\n");
        scene.folder().write("s.toml", of_sheet +
                                           "[[set]]\nname = \"a\"\nclasses = [\"border\"]\n"
                                           "style = \"s\"\n[style.s]\nwidth = 6\nopacity = \"=light\"\n");
        return Drawing(scene.load(), pixel_camera(kSize, kSize), kSize, kSize, {0, 0, kSize, kSize}, 2, render_abuffer);
    };
    const Drawing at_point = lines("position = [100, 100, 50]", "");
    const Drawing far = lines("direction = [3, 0, 4]", ""),
                  in_camera = lines("direction = [3, 0, 4]\nspace = \"camera\"", "");
    const Drawing of_sheet = lines("position = [100, 100, 50]", "light = [0, 0, 1]\n");
    for (int y = 40; y < 160; y += 9) {
        EXPECT_NEAR(at_point.at("lines.A", 20, y), 50 / std::hypot(50, 80, y + 0.5 - 100), 0.01) << y;
        EXPECT_NEAR(far.at("lines.A", 20, y), 0.8, 2e-3) << y;
        EXPECT_NEAR(in_camera.at("lines.A", 20, y), 0.8, 2e-3) << y;
        EXPECT_NEAR(of_sheet.at("lines.A", 20, y), 1, 2e-3) << y;
    }
}

Drawing with_lines(const std::string& objects, const std::string& opacity) {
    const SceneText scene("style = \"s.toml\"\n[[light]]\ndirection = [1, 0, 1]\n" + objects);
    scene.folder().write("s.toml",
                         "[[set]]\nname = \"a\"\nclasses = [\"border\", \"silhouette\", \"crease\"]\n"
                         "style = \"s\"\n[style.s]\nwidth = 4\nopacity = \"" +
                             opacity + "\"\n");
    return Drawing(scene.load(), pixel_camera(kSize, kSize), kSize, kSize, {0, 0, kSize, kSize}, 2, render_abuffer);
}

TEST(Lights, LinesKnowShadows) {
    // The shadow of a ball falls on the border of a square.
    const Drawing d = with_lines(
        "[[object]]\nshape = \"plane\"\nsize = [160, 160]\nrotate = [90, 0, 0]\n"
        "translate = [100, 100, 0]\n[[object]]\nshape = \"sphere\"\nradius = 20\n"
        "segments = 128\nrings = 64\ntranslate = [60, 100, 40]\n",
        "=lit");
    for (int y = 40; y < 160; ++y) {
        const double across = std::abs(y + 0.5 - 100);
        if (std::abs(across - 20) < 3) continue;  // round ends of strokes
        ASSERT_NEAR(d.at("lines.A", 20, y), across < 20 ? 0 : 1, 2e-3) << y;
    }
}

TEST(Lights, ConvexBodiesCastNoShadowOnTheirOwnLines) {
    for (const char* const body : {"shape = \"box\"\nsize = [70, 60, 80]\nrotate = [20, 30, 40]\n",
                                   "shape = \"sphere\"\nradius = 70\nsegments = 24\nrings = 12\n",
                                   "shape = \"cylinder\"\nradius = 40\nheight = 90\nrotate = [50, 0, 20]\n"}) {
        const std::string object = std::string("[[object]]\n") + body + "translate = [100, 100, 0]\n";
        const Drawing lit = with_lines(object, "=lit"), facing = with_lines(object, "=light > 0 ? 1 : 0");
        EXPECT_GT(lit.sum("lines.A"), 100) << body;
        EXPECT_TRUE(same_bits(lit.image(), facing.image())) << body;
    }
}

TEST(Lights, TheBrightestCounts) {
    const Drawing d = drawn(kNoLines +
                            "[[light]]\ndirection = [1, 0, 1]\n[[light]]\nposition = [100, 100, 60]\n"
                            "[[material]]\nname = \"white\"\ncolor = [1, 1, 1]\n[surfaces]\nshading = \"toon\"\n"
                            "tones = { stops = [[0, 0], [1, 1]], between = \"linear\" }\n"
                            "[[object]]\nshape = \"plane\"\nsize = [160, 160]\nrotate = [90, 0, 0]\n"
                            "translate = [100, 100, 0]\nmaterial = \"white\"\n");
    for (int x = 30; x < 170; x += 11) {
        const double near = 60 / std::hypot(60, x + 0.5 - 100, 0.5);
        EXPECT_NEAR(d.at("R", x, 100), std::max(near, std::sqrt(0.5)), 1e-3) << x;
    }
}

/// A plane at z = 0 that fills the picture, and a small ball in front of its middle.
std::string ball_on_plane(double radius, double height, int rings = 80) {
    return "[surfaces]\ncolor = \"=rgb(lit, lit, lit)\"\n[[object]]\nshape = \"plane\"\nsize = [400, 400]\n"
           "rotate = [90, 0, 0]\ntranslate = [100, 100, 0]\n[[object]]\nshape = \"sphere\"\nradius = " +
           std::to_string(radius) + "\nsegments = " + std::to_string(2 * rings) + "\nrings = " + std::to_string(rings) +
           "\ntranslate = [100, 100, " + std::to_string(height) + "]\n";
}

TEST(Shadows, OfABallOnAPlaneAreEllipses) {
    constexpr double kRadius = 20;
    for (const double angle : {15.0, 40.0, 60.0}) {
        const double s = std::sin(glm::radians(angle)), c = std::cos(glm::radians(angle));
        const double height = 25, turn = glm::radians(25.0);
        const glm::dvec2 along(std::cos(turn), std::sin(turn));
        const Drawing d =
            drawn(kNoLines + "[[light]]\ndirection = [" + std::to_string(s * along.x) + ", " +
                  std::to_string(s * along.y) + ", " + std::to_string(c) + "]\n" + ball_on_plane(kRadius, height));
        double area = 0, hidden = 0;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                if (d.at("id.object", x, y) != 1 || from_middle(x, y) < kRadius + 1) continue;
                const glm::dvec2 p = glm::dvec2(x + 0.5 - 100, 100 - y - 0.5) + height * s / c * along;
                const glm::dvec2 q(glm::dot(p, along) * c, glm::dot(p, glm::dvec2(-along.y, along.x)));
                // The distance from an ellipse, to first order.
                const double f = glm::length(q) - kRadius;
                const glm::dvec2 slope = glm::dvec2(q.x * c, q.y) / glm::length(q);
                const double distance = f / glm::length(slope);
                const double lit = d.at("R", x, y);
                if (std::abs(distance) > 0.5 + 0.71) {
                    ASSERT_EQ(lit, distance > 0 ? 1 : 0) << angle << ' ' << x << ' ' << y << ' ' << distance;
                }
                if (std::abs(distance) < 3) {
                    area += lit;
                    hidden += std::clamp(distance + 0.5, 0.0, 1.0);
                }
            }
        }
        EXPECT_NEAR(area, hidden, 0.01 * hidden) << angle;
    }
}

TEST(Shadows, OfALightAtAPointAreCones) {
    const double far = 100, height = 40, radius = 15;
    const Drawing d = drawn(kNoLines + "[[light]]\nposition = [100, 100, 100]\n" + ball_on_plane(radius, height));
    const double right = far * radius / std::sqrt((far - height) * (far - height) - radius * radius);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            if (d.at("id.object", x, y) != 1 || from_middle(x, y) < radius + 1) continue;
            if (std::abs(from_middle(x, y) - right) < 1.2) continue;
            ASSERT_EQ(d.at("R", x, y), from_middle(x, y) > right ? 1 : 0) << x << ' ' << y;
        }
    }
}

/// The least and the largest value of a channel in a pixel and those that touch it.
std::array<double, 2> range_around(const Drawing& d, const char* channel, int x, int y) {
    std::array<double, 2> range = {d.at(channel, x, y), d.at(channel, x, y)};
    for (int v = y - 1; v <= y + 1; ++v) {
        for (int u = x - 1; u <= x + 1; ++u)
            range = {std::min(range[0], d.at(channel, u, v)), std::max(range[1], d.at(channel, u, v))};
    }
    return range;
}

TEST(Shadows, DoNotSpeckleWhatIsLit) {
    // Whether a ball is round or has some facets, it is lit as far as its normals face the light.
    for (const int rings : {6, 12, 100}) {
        for (const char* const normals : {"flat", "smooth"}) {
            const Drawing d = drawn(kNoLines +
                                    "[[light]]\ndirection = [3, 1, 1]\n[surfaces]\ncolor = \"=rgb(lit, light, 0)"
                                    "\"\nnormals = \"" +
                                    normals + "\"\n" + ball(rings));
            for (int y = 0; y < kSize; ++y) {
                for (int x = 0; x < kSize; ++x) {
                    if (d.at("A", x, y) < 1) continue;
                    const double polygon = d.at("id.polygon", x, y);
                    const bool is_edge =
                        d.at("id.polygon", x - 1, y) != polygon || d.at("id.polygon", x, y - 1) != polygon ||
                        d.at("id.polygon", x + 1, y) != polygon || d.at("id.polygon", x, y + 1) != polygon;
                    if (rings < 100 && is_edge) continue;
                    // At the rim normals turn within a pixel.
                    if (d.at("G", x, y) > 0.06 && range_around(d, "A", x, y)[0] == 1) {
                        ASSERT_EQ(d.at("R", x, y), 1) << rings << normals << ' ' << x << ' ' << y;
                    }
                    // A part of the pixel may be turned to the light, where one beside it is.
                    if (range_around(d, "G", x, y)[1] == 0) {
                        ASSERT_EQ(d.at("R", x, y), 0) << rings << normals << ' ' << x << ' ' << y;
                    }
                }
            }
        }
    }
}

TEST(Shadows, FlushSurfacesCastNone) {
    const std::string plane = "[[object]]\nshape = \"plane\"\nrotate = [90, 0, 0]\n";
    const Drawing d = drawn(kNoLines + "[[light]]\ndirection = [3, 1, 1]\n[surfaces]\ncolor = \"=rgb(lit, 0, 0)\"\n" +
                            plane + "size = [150, 150]\ntranslate = [100, 100, 7.3]\n" + plane +
                            "size = [90, 50]\ntranslate = [110, 100, 7.3]\n");
    for (int y = 30; y < 170; ++y) {
        for (int x = 30; x < 170; ++x) ASSERT_EQ(d.at("R", x, y), 1) << x << ' ' << y;
    }
}

TEST(Shadows, AreDarkerInEveryShading) {
    const std::string rest =
        ball_on_plane(20, 40).substr(std::string("[surfaces]\ncolor = \"=rgb(lit, lit, lit)\"\n").size());
    for (const char* const shading : {"toon", "gooch", "hatch"}) {
        const std::string text =
            kNoLines + "[[light]]\ndirection = [1, 0, 1]\n[surfaces]\nshading = \"" + shading + "\"\n";
        const Drawing without = drawn(text + rest), with = drawn(text + "shadows = true\n" + rest);
        double lit[2] = {0, 0}, hidden[2] = {0, 0};  // without and with shadows
        for (int y = 95; y < 105; ++y) {
            for (int x = 50; x < 65; ++x) hidden[0] += without.at("R", x, y), hidden[1] += with.at("R", x, y);
            for (int x = 150; x < 165; ++x) lit[0] += without.at("R", x, y), lit[1] += with.at("R", x, y);
        }
        EXPECT_EQ(lit[0], lit[1]) << shading;
        EXPECT_LT(hidden[1], 0.9 * hidden[0]) << shading;
    }
}

}  // namespace
}  // namespace burin::surfaces_test
