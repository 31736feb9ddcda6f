// Keys of styles, each with the effect that its table in docs/shading/sheets.md says, on strokes or on the picture.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/methods/level_crease.h"

namespace burin::styled_keys_test {
namespace {

using namespace test;

/// How far a level line at row 50.5 has moved down, at each place of it.
class Moves {
  public:
    explicit Moves(const InkedLines& lines) {
        EXPECT_EQ(lines.strokes.size(), 1u);
        for (const InkPoint& p : lines.points) moves_[p.place.x] = p.place.y - 50.5;
    }
    double at(double x) const {
        const auto after = moves_.lower_bound(x);
        if (after == moves_.end()) return moves_.rbegin()->second;
        if (after == moves_.begin()) return after->second;
        const auto before = std::prev(after);
        return glm::mix(before->second, after->second, (x - before->first) / (after->first - before->first));
    }
    double most() const {
        double most = 0;
        for (const auto& [x, move] : moves_) most = std::max(most, std::abs(move));
        return most;
    }
    bool operator==(const Moves& other) const = default;

  private:
    std::map<double, double> moves_;  ///< by x
};

Moves moves_of(const std::string& wobble, const std::string& more = "", double frame = 0) {
    ShadedScene scene = level(20, 220, 50.5, "width = 1\n" + more + "wobble = { " + wobble + " }");
    scene.scene().frame.number = frame;
    return Moves(scene.inked());
}

TEST(StyledKeys, BoilMakesNewRandomNumbersEveryHoldFrames) {
    const std::string wobble = "amplitude = 3, wavelength = 30";
    for (double frame = 1; frame < 6; ++frame) EXPECT_EQ(moves_of(wobble, "hold = 2\n", frame), moves_of(wobble));
    for (const int hold : {1, 2, 3}) {
        const std::string more = "boil = true\nhold = " + std::to_string(hold) + "\n";
        Moves before = moves_of(wobble, more, 0);
        EXPECT_EQ(before, moves_of(wobble));
        for (int frame = 1; frame < 9; ++frame) {
            const Moves now = moves_of(wobble, more, frame);
            EXPECT_EQ(now == before, frame % hold != 0) << "frame " << frame << " of drawings held for " << hold;
            before = now;
        }
    }
    EXPECT_NE(moves_of(wobble, "seed = 1\n"), moves_of(wobble));
}

/// Boiling reaches what expressions read, too: nothing else of them changes.
TEST(StyledKeys, BoilChangesRandomNumbersOfExpressions) {
    const auto width = [](const std::string& style, double frame) {
        ShadedScene scene = level(20, 220, 50.5, style);
        scene.scene().frame.number = frame;
        return scene.inked().points[0].width_px;
    };
    for (const std::string name : {"rand_object", "rand_chain", "rand_set"}) {
        const std::string style = "width = \"=1 + " + name + "\"\n";
        EXPECT_EQ(width(style, 0), width(style, 7)) << name;
        EXPECT_NE(width(style + "boil = true\n", 0), width(style + "boil = true\n", 7)) << name;
    }
    EXPECT_EQ(width("width = \"=1 + x / 1000\"\nboil = true\n", 0),
              width("width = \"=1 + x / 1000\"\nboil = true\n", 7));
}

/// With pinned ends, wobble grows from nothing over half a wavelength; else ends move as any other place does.
TEST(StyledKeys, EndsThatAreNotPinnedMove) {
    for (const std::string anchor : {"object", "chain"}) {
        const std::string wobble = "amplitude = 6, wavelength = 60, anchor = \"" + anchor + "\"";
        const Moves pinned = moves_of(wobble), loose = moves_of(wobble + ", pin = false");
        EXPECT_EQ(pinned, moves_of(wobble + ", pin = true"));
        EXPECT_NEAR(pinned.at(20), 0, 1e-9);
        EXPECT_NEAR(pinned.at(220), 0, 1e-9);
        EXPECT_GT(std::max(std::abs(loose.at(20)), std::abs(loose.at(220))), 0.5) << anchor;
        for (double x = 20; x <= 220; x += 1.3) {
            const double share = std::min({(x - 20) / 30, (220 - x) / 30, 1.0});
            EXPECT_NEAR(pinned.at(x), share * loose.at(x), 0.2) << anchor << ", x " << x;
        }
    }
}

/// An octave has half of the amplitude and of the wavelength of the one before.
TEST(StyledKeys, OctavesAreSumsOfShorterWaves) {
    for (const std::string anchor : {"object", "chain"}) {
        const auto wobble = [&](double wavelength, int octaves) {
            return moves_of("amplitude = 8, wavelength = " + std::to_string(wavelength) +
                            ", octaves = " + std::to_string(octaves) + ", pin = false, anchor = \"" + anchor + "\"");
        };
        const Moves whole = wobble(96, 1), half = wobble(48, 1), quarter = wobble(24, 1), two = wobble(96, 2),
                    three = wobble(96, 3);
        for (double x = 20; x <= 220; x += 1.3) {
            EXPECT_NEAR(two.at(x), whole.at(x) + half.at(x) / 2, 0.25) << anchor << ", x " << x;
            EXPECT_NEAR(three.at(x), whole.at(x) + half.at(x) / 2 + quarter.at(x) / 4, 0.25) << anchor << ", x " << x;
        }
        EXPECT_GT(half.most(), 1.5) << anchor;  // so that one octave more or less is seen
        EXPECT_GT(quarter.most(), 1.5) << anchor;
    }
}

/// A crease at depth 1000 crosses one `behind` px farther away, which is of full height but for its gap.
double halo_gap_px(double behind, const std::string& style) {
    const ShadedScene scene({folded({20, 49.5, 0}, {220, 49.5, 0}), folded({120.5, 10, -behind}, {120.5, 90, -behind})},
                            pixel_camera(240, 100), sheet_of(R"("crease")", "width = 2\n" + style), 240, 100);
    const Image image = scene.draw();
    double sum = 0;
    for (int y = 20; y < 80; ++y) {
        for (int x = 110; x < 131; ++x) sum += value_at(image, "lines.A", x, y);
    }
    return 60 - (sum - 21 * 2) / 2;
}

/// The front strip is 8 px wide and hides what is behind it; halos are wider.
TEST(StyledKeys, HalosAreAsWideAsTheirDepthSays) {
    struct Case {
        const char* style;
        double least, most;
    };
    const Case cases[] = {{"halo = 10", 2, 50},
                          {"halo = \"=5 + 5\"\nhalo_depth = [2, 50]", 2, 50},
                          {"halo = 10\nhalo_depth = [20, 40]", 20, 40},
                          {"halo = 10\nhalo_depth = [5, \"=10 + 10\"]", 5, 20}};
    for (const Case& c : cases) {
        for (const double behind : {12.0, 16.0, 26.0, 30.0, 38.0, 60.0}) {
            const double share = std::clamp((behind - c.least) / (c.most - c.least), 0.0, 1.0);
            EXPECT_NEAR(halo_gap_px(behind, c.style), std::max(2 + 2 * 10 * share, 8.0), 1.0 / 16)
                << c.style << ", " << behind << " px behind";
        }
    }
    EXPECT_NEAR(halo_gap_px(60, ""), 8, 1.0 / 16);
}

TEST(StyledKeys, BlendMultipliesWhatIsBelow) {
    const auto drawn = [](const std::string& blend) {
        const std::string sheet =
            "style_version = 1\n"
            "[[set]]\nname = \"wide\"\nclasses = [\"crease\"]\nstyle = \"wide\"\nalso = true\n"
            "[[set]]\nname = \"thin\"\nclasses = [\"crease\"]\nstyle = \"thin\"\n"
            "[style.wide]\nwidth = 9\ncolor = [0.8, 0.4, 0.2]\n"
            "[style.thin]\nwidth = 3\ncolor = [0.5, 0.25, 1]\nopacity = 0.5\npriority = 1\n" +
            blend;
        const ShadedScene scene({folded({20, 49.5, 0}, {220, 49.5, 0})}, pixel_camera(240, 100), sheet, 240, 100);
        const Image image = scene.draw();
        const auto color = [&](int y) {
            return glm::dvec3(value_at(image, "R", 120, y), value_at(image, "G", 120, y), value_at(image, "B", 120, y));
        };
        EXPECT_LT(glm::distance(color(53), glm::dvec3(0.8, 0.4, 0.2)), 2e-3) << blend;
        EXPECT_NEAR(value_at(image, "lines.A", 120, 50), 1, 2e-3) << blend;
        return color(50);
    };
    const glm::dvec3 below(0.8, 0.4, 0.2), ink(0.5, 0.25, 1);
    EXPECT_LT(glm::distance(drawn(""), 0.5 * below + 0.5 * ink), 2e-3);
    EXPECT_LT(glm::distance(drawn("blend = \"over\"\n"), 0.5 * below + 0.5 * ink), 2e-3);
    EXPECT_LT(glm::distance(drawn("blend = \"multiply\"\n"), below * (1.0 - 0.5 * (1.0 - ink))), 2e-3);
}

}  // namespace
}  // namespace burin::styled_keys_test
