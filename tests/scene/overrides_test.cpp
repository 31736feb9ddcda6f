#include <gtest/gtest.h>

#include "tests/scene/scene_text.h"

namespace burin {
namespace {

using test::SceneText;

constexpr const char* kScene = R"([[object]]
shape = 'box'
size = [1, 2, 3]
[[object]]
shape = 'cone'
[[camera]]
name = 'a'
[lines]
width = 4
)";

TEST(Overrides, ReplaceAndAddValues) {
    const SceneText text(kScene);
    EXPECT_EQ(text.read({{"lines.width", "2.5"}}).lines.style.width_px, 2.5);
    EXPECT_EQ(text.read({{"lines.crease_angle", "10"}}).lines.crease_angle_deg, 10);
    EXPECT_EQ(text.read({{"lines.crease_angle", "10"}}).lines.style.width_px, 4);  // the rest stays
    EXPECT_EQ(text.read({{"patel.mask", "16"}}).patel.mask_bits, 16);              // a table that was not there
    EXPECT_EQ(text.read({{"picture.size", "[30, 20]"}}).picture.width, 30);
    EXPECT_EQ(text.read({{"lines.colors.crease", "'#f00'"}}).lines.style.color_of(LineClass::crease),
              glm::vec3(1, 0, 0));
    EXPECT_EQ(text.read({{"lines", "{width = 7}"}}).lines.style.width_px, 7);
}

TEST(Overrides, TheLastOneWins) {
    EXPECT_EQ(SceneText(kScene).read({{"lines.width", "2"}, {"lines.width", "3"}}).lines.style.width_px, 3);
}

TEST(Overrides, NumbersCountIntoLists) {
    const SceneText text(kScene);
    EXPECT_EQ(text.read({{"object.1.name", "hat"}}).objects[1].name, "hat");
    EXPECT_EQ(text.read({{"object.0.subdivide", "2"}}).objects[0].subdivide, 2);
    EXPECT_EQ(text.read({{"object.1.subdivide", "2"}}).objects[0].subdivide, 0);
    test::expect_near(test::bounds_of(text.load({{"object.0.size.1", "8"}})).high, {0.5, 4, 1.5});
    EXPECT_EQ(text.read({{"camera.0.fov", "60"}}).cameras[0].fov_deg, 60);
    EXPECT_EQ(text.read({{"object.0", "{shape='sphere'}"}}).objects[0].name, "sphere");
}

/// Where there is no list, the number is what is wrong; without it the key is right.
TEST(Overrides, ANumberNeedsAList) {
    for (const char* camera : {"", "[camera]\nfov = 20\n"}) {
        const SceneText text("[[object]]\nshape = 'box'\n" + std::string(camera));
        EXPECT_EQ(text.usage_error("camera.0.fov", "60"),
                  "--set camera.0.fov=60: there is no list 'camera' that has an element '0'; without the number, "
                  "camera.fov is a setting of its only element");
        EXPECT_EQ(text.usage_error("camera.0", "{fov=60}"),
                  "--set camera.0={fov=60}: there is no list 'camera' that has an element '0'; without the number, "
                  "camera is a setting of its only element");
        EXPECT_EQ(text.read({{"camera.fov", "60"}}).cameras.at(0).fov_deg, 60);
    }
}

TEST(Overrides, TextsNeedNoQuotes) {
    const SceneText text(kScene);
    const auto name = [&](const std::string& value) { return text.read({{"object.0.name", value}}).objects[0].name; };
    EXPECT_EQ(name("hello"), "hello");
    EXPECT_EQ(name("'hello'"), "hello");
    EXPECT_EQ(name("\"hello\""), "hello");
    EXPECT_EQ(name("two words"), "two words");
    EXPECT_EQ(name("say \"hi\" \\ 'ho'"), "say \"hi\" \\ 'ho'");
    EXPECT_EQ(name("a\nb\tc"), "a\nb\tc");
    EXPECT_EQ(name("Würfel"), "Würfel");
    EXPECT_EQ(name(""), "");
    EXPECT_EQ(name("x\nshape = 'cone'"), "x\nshape = 'cone'");  // no way to smuggle in keys
    EXPECT_EQ(text.read({{"surfaces.shading", "lambert"}}).surfaces.shading, SurfaceShading::lambert);
    EXPECT_EQ(text.read({{"picture.background", "#ff0000"}}).picture.background, glm::vec3(1, 0, 0));
    EXPECT_TRUE(text.read({{"picture.background", "transparent"}}).picture.transparent);
}

TEST(Overrides, NumbersAreWrittenAsInOptions) {
    const SceneText text(kScene);
    EXPECT_EQ(text.read({{"lines.width", ".5"}}).lines.style.width_px, 0.5);
    EXPECT_EQ(text.read({{"lines.width", "5."}}).lines.style.width_px, 5);
    EXPECT_EQ(text.read({{"camera.0.eye", "1,-.5,3e1"}}).cameras[0].eye, glm::dvec3(1, -0.5, 30));
    EXPECT_EQ(text.read({{"lines.dash", "[.3, 1]"}}).lines.style.dash_px, (std::array{0.3, 1.0}));
    const PictureSettings picture = text.read({{"picture.size", "400x300"}}).picture;
    EXPECT_EQ(picture.width, 400);
    EXPECT_EQ(picture.height, 300);
    EXPECT_EQ(text.read({{"lines.draw", "silhouette,crease"}}).lines.classes,
              LineClassSet(LineClass::silhouette) | LineClass::crease);
    EXPECT_EQ(text.read({{"lines.draw", "silhouette, crease"}}).lines.classes,
              LineClassSet(LineClass::silhouette) | LineClass::crease);
    EXPECT_EQ(text.read({{"camera.0.eye", "+.5,1,2"}}).cameras[0].eye, glm::dvec3(0.5, 1, 2));
    EXPECT_EQ(text.read({{"zbuffer.highlight", "01"}}).zbuffer.highlight_objects, std::vector<std::string>{"01"});
    EXPECT_EQ(text.read({{"object.0.name", "2x4"}}).objects[0].name, "2x4");
    EXPECT_EQ(text.read({{"object.0.name", "1,2"}}).objects[0].name, "1,2");
}

TEST(Overrides, MistakesAreWrongUsage) {
    const SceneText text(kScene);
    const struct {
        const char *key, *value, *words;
    } mistakes[] = {
        {"lines.widht", "1", "unknown key 'widht'; did you mean 'width'?"},
        {"line.width", "1", "unknown key 'line'"},
        {"width", "1", "unknown key 'width'"},
        {"lines.width", "thick", "[lines] width: must be a number"},
        {"lines.width", "-1", "greater than 0"},
        {"lines.width", "nan", "finite"},
        {"lines.width", "", "must be a number"},
        {"lines.width", "1\nx=2", "must be a number"},
        {"lines.draw", "1", "must be a list of texts"},
        {"lines.width.x", "1", "'x' stands below a value that is no table"},
        {"patel.mask.x", "1", "must be a whole number"},
        {"object.2.name", "x", "there is no element '2', the list has 2"},
        {"object.-1.name", "x", "there is no element"},
        {"object.1x.name", "x", "there is no element"},
        {"object.99999999999999999999.name", "x", "there is no element"},
        {"object.name", "x", "there is no element 'name'"},
        {"object.0.size.3", "x", "there is no element '3'"},
        {"object.0.size.0.0", "1", "below a value that is no table"},
        {"object.0.material", "wood", "no [[material]] named 'wood'"},
        {"lines..width", "1", "the key must be like"},
        {".width", "1", "the key must be like"},
        {"lines.", "1", "the key must be like"},
        {"a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r", "1", "too many parts"},
        {"lines.color", "\xFF", "not UTF-8"},
        {"picture", "3", "must be a table"},
    };
    for (const auto& m : mistakes) {
        const std::string error = text.usage_error(m.key, m.value);
        EXPECT_EQ(error.find("--set " + std::string(m.key)), 0u) << m.key << '=' << m.value << ": " << error;
        EXPECT_NE(error.find(m.words), std::string::npos) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
}

TEST(Overrides, WhatTheFileSaysStaysAnInputError) {
    const SceneText text("[[object]]\nshape='box'\n[lines]\nwidth=-1\n");
    EXPECT_THROW(text.read({{"lines.crease_angle", "10"}}), InputError);
    EXPECT_EQ(text.read({{"lines.width", "1"}}).lines.style.width_px,
              1);  // the mistake is overridden
}

TEST(Overrides, BareModelsTakeThemToo) {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const SceneDescription scene =
        bare_model_scene(path, {{"object.0.scale", "2"}, {"lines.width", "3"}, {"camera.fov", "50"}});
    EXPECT_EQ(scene.lines.style.width_px, 3);
    EXPECT_EQ(scene.cameras.at(0).fov_deg, 50);
    EXPECT_EQ(test::bounds_of(load_scene(scene)).high.x, 2);
    EXPECT_THROW(bare_model_scene(path, {{"lines.widht", "3"}}), UsageError);
    EXPECT_THROW(bare_model_scene(path, {{"object.1.scale", "3"}}), UsageError);
}

}  // namespace
}  // namespace burin
