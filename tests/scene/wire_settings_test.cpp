// The table [wire].

#include <gtest/gtest.h>

#include "tests/scene/scene_text.h"

namespace burin {
namespace {

using namespace test;

WireSettings wire(const std::string& text) { return described(std::string(kBox) + "[wire]\n" + text).wire; }
std::string error(const std::string& text) { return SceneText(std::string(kBox) + "[wire]\n" + text).error(); }

TEST(WireSettings, EmptyIsTheDefault) {
    const WireSettings s = wire("");
    EXPECT_EQ(s.width, WireWidth::matched);
    EXPECT_FALSE(s.profile || s.thickness_px || s.path || s.exclude);
    EXPECT_EQ(s.q_px, 100);
    EXPECT_EQ(s.transition_px, 1.8);
    EXPECT_EQ(s.pattern, WirePattern::solid);
    EXPECT_EQ(s.alpha_test, 0);
}

TEST(WireSettings, WordsAndNumbers) {
    const std::pair<const char*, WireProfileKind> profiles[] = {
        {"gauss", WireProfileKind::gauss},   {"nv", WireProfileKind::nv},         {"step", WireProfileKind::step},
        {"linear", WireProfileKind::linear}, {"smooth", WireProfileKind::smooth}, {"box", WireProfileKind::box}};
    for (const auto& [word, kind] : profiles) EXPECT_EQ(wire("profile='" + std::string(word) + "'").profile, kind);
    const std::pair<const char*, WirePath> paths[] = {{"linear", WirePath::linear},
                                                      {"premultiplied", WirePath::premultiplied},
                                                      {"homogeneous", WirePath::homogeneous},
                                                      {"cases", WirePath::cases}};
    for (const auto& [word, path] : paths) EXPECT_EQ(wire("path='" + std::string(word) + "'").path, path);
    EXPECT_EQ(wire("exclude='flags'").exclude, WireExclude::flags);
    EXPECT_EQ(wire("exclude='q'\nq=3").exclude, WireExclude::q);
    EXPECT_EQ(wire("exclude='q'\nq=3").q_px, 3);
    EXPECT_EQ(wire("exclude='polygon'").exclude, WireExclude::polygon);
    EXPECT_EQ(wire("thinning='linear'").thinning, WireThinning::linear);
    EXPECT_EQ(wire("thinning='hermite'").thinning, WireThinning::hermite);
    EXPECT_EQ(wire("width='published'\nthickness=2").thickness_px, 2);
    EXPECT_TRUE(wire("diagonals='dotted'").dotted_diagonals);
    EXPECT_TRUE(wire("slope=true").slope);
    EXPECT_EQ(wire("pattern='dash'\nperiod=5").period_px, 5);
    EXPECT_EQ(wire("pattern='dots'\ndot_period=2").dot_period, 2);
    EXPECT_EQ(wire("squeeze=[0.25,1]").squeeze_min, 0.25);
    EXPECT_EQ(wire("dual=0.5").dual, 0.5);
    EXPECT_EQ(SceneText(kBox).load({{"wire.fade_distance", "7"}}).wire.fade_distance, 7);
}

TEST(WireSettings, WrongOnesAreErrors) {
    EXPECT_NE(error("profile='gaus'").find("scene.toml:4:9"), std::string::npos) << error("profile='gaus'");
    EXPECT_NE(error("widht='matched'").find("did you mean 'width'?"), std::string::npos);
    EXPECT_NE(error("duty=1.5").find("at most 1"), std::string::npos);
    EXPECT_NE(error("period=0").find("greater than 0"), std::string::npos);
    EXPECT_NE(error("squeeze=[0,2]").find("from 0 to 1"), std::string::npos);
    EXPECT_NE(error("dual=1").find("less than 1"), std::string::npos);
    EXPECT_NE(error("slope='yes'"), "");
}

}  // namespace
}  // namespace burin
