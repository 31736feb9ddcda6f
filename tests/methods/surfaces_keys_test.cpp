// The tables [surfaces] and [[light]] of scene files: what they say, and what is wrong with them.

#include <gtest/gtest.h>

#include "methods/abuffer.h"
#include "methods/reference/reference.h"
#include "shading/surface/surface_recipe.h"
#include "tests/scene/scene_text.h"
#include "tests/support/drawing.h"

namespace burin::surfaces_keys_test {
namespace {

using namespace test;

SurfaceStyle surfaces(const std::string& text) { return described(kBox + ("[surfaces]\n" + text)).surfaces; }
std::string fault(const std::string& text) { return SceneText(kBox + text).error(); }

TEST(SurfaceKeys, EachShadingHasItsRecipe) {
    EXPECT_EQ(surfaces("shading = 'flat'").shading, SurfaceShading::flat);
    EXPECT_FALSE(surfaces("shading = 'lambert'").recipe);
    const SurfaceStyle toon = surfaces(
        "shading = 'toon'\nnormals = 'smooth'\nshadows = true\nsoftness = '2mm'\n"
        "tones = { stops = [[0, '#ff0000'], [0.5, '#00ff00']], between = 'smooth' }\n"
        "detail = { over = '=facing^2', tones = { stops = [[0, 1]] } }");
    EXPECT_EQ(toon.shading, SurfaceShading::toon);
    ASSERT_TRUE(toon.recipe);
    EXPECT_TRUE(toon.recipe->has_smooth_normals);
    EXPECT_TRUE(toon.recipe->has_shadows);
    EXPECT_EQ(toon.recipe->softness.unit, SheetUnit::mm);
    EXPECT_TRUE(toon.recipe->tones.is_color);
    EXPECT_EQ(toon.recipe->tones.between, RampBetween::smooth);
    ASSERT_TRUE(toon.recipe->detail);
    EXPECT_EQ(toon.recipe->detail->over.source.text, "facing^2");
    EXPECT_EQ(toon.recipe->detail->tones.between, RampBetween::step);
    EXPECT_EQ(surfaces("shading = 'gooch'\nwarm = [1, 0.5, 0]").recipe->warm, glm::vec3(1, 0.5f, 0));
    const SurfaceStyle hatch =
        surfaces("shading = 'hatch'\nspace = 'object'\naxis = [1, 2, 3]\nlevels = 2\ntone = 0.5");
    EXPECT_EQ(hatch.recipe->space, HatchSpace::object);
    EXPECT_EQ(hatch.recipe->axis, glm::dvec3(1, 2, 3));
    EXPECT_EQ(hatch.recipe->levels, 2);
    EXPECT_EQ(surfaces("color = '=C'").shading, SurfaceShading::expression);
}

TEST(SurfaceKeys, LightsStandInOrder) {
    const SceneDescription scene = described(kBox + std::string("[[light]]\ndirection = [0, 3, 4]\n[[light]]\n"
                                                                "position = [1, 2, 3]\nspace = 'camera'\n"));
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_FALSE(scene.lights[0].is_at_point);
    expect_near(scene.lights[0].place, {0, 0.6, 0.8});
    EXPECT_FALSE(scene.lights[0].is_in_camera);
    EXPECT_TRUE(scene.lights[1].is_at_point);
    EXPECT_EQ(scene.lights[1].place, glm::dvec3(1, 2, 3));
    EXPECT_TRUE(scene.lights[1].is_in_camera);
}

TEST(SurfaceKeys, ASheetFillsSurfacesWhereTheSceneDoesNotSay) {
    TemporaryFolder folder;
    folder.write("grey.toml",
                 "style_version = 1\n[surfaces]\nshading = 'flat'\n[[set]]\nname = 'a'\n"
                 "classes = ['crease']\nstyle = 's'\n[style.s]\n");
    const std::string style = "style = 'grey.toml'\n";
    const std::string without = folder.write("without.toml", style + kBox);
    const std::string with = folder.write("with.toml", style + kBox + "[surfaces]\npaper = '#ff0000'\n");
    EXPECT_EQ(read_scene_file(without, {}).surfaces.shading, SurfaceShading::flat);
    EXPECT_EQ(read_scene_file(with, {}).surfaces.shading, SurfaceShading::paper);
}

TEST(SurfaceKeys, FaultsAreNamedWithTheirPlace) {
    struct Case {
        const char *text, *message;
    };
    const Case cases[] = {
        {"[surfaces]\nshading = 'cartoon'\n", "4:11: [surfaces] shading: "},
        {"[surfaces]\nshading = 'toon'\ncolor = '=C'\n", "5:9: [surfaces] color: takes the place of shading"},
        {"[surfaces]\nshading = 'flat'\ntones = { stops = [[0, 1]] }\n",
         "5:9: [surfaces] tones: is read with shading = \"toon\" only"},
        {"[surfaces]\nshading = 'flat'\npaper = '#fff'\n", "5:9: [surfaces] paper: is not read with this shading"},
        {"[surfaces]\nshading = 'toon'\ntones = [[0, 1]]\n", "5:9: [surfaces] tones: must be a table"},
        {"[surfaces]\nshading = 'toon'\ntones = { stops = [] }\n", "5:19: [surfaces.tones] stops: a ramp needs a stop"},
        {"[surfaces]\nshading = 'toon'\ntones = { stops = [[1, 1], [0, 1]] }\n", "5:19: "},
        {"[surfaces]\nshading = 'toon'\ntones = { over = 'depth', stops = [[0, 1]] }\n",
         "5:18: [surfaces.tones] over: tones always go over the light"},
        {"[surfaces]\nshading = 'toon'\nsoftness = -1\n", "5:12: [surfaces] softness: must be at least 0"},
        {"[surfaces]\nshading = 'toon'\nsoftness = '1world'\n", "5:12: [surfaces] softness: takes no world units"},
        {"[surfaces]\nshading = 'toon'\nsoftness = '=depth'\n", "5:12: [surfaces] softness: must be "},
        {"[surfaces]\nshading = 'toon'\ndetail = { tones = { stops = [[0, 1]] } }\n",
         "5:10: [surfaces.detail] needs over"},
        {"[surfaces]\nshading = 'hatch'\nspace = 'uv'\naxis = [1, 0, 0]\n",
         "6:8: [surfaces] axis: is of lines on objects"},
        {"[surfaces]\nshading = 'hatch'\nspace = 'object'\nangle = 3\n",
         "6:9: [surfaces] angle: is of lines on the screen"},
        {"[surfaces]\nshading = 'hatch'\naxis = [1, 0, 0]\n", "5:8: [surfaces] axis: is of lines on objects"},
        {"[surfaces]\nshading = 'hatch'\nlevels = 5\n", "5:10: [surfaces] levels: "},
        {"[surfaces]\nshading = 'hatch'\nshadows = true\ntone = 0.5\n",
         "5:11: [surfaces] shadows: cannot stand beside a tone"},
        {"[surfaces]\nnormal = 'smooth'\n", "4:1: [surfaces]: unknown key 'normal'"},
        {"[[light]]\n", "3:1: [[light]] needs a direction"},
        {"[[light]]\ndirection = [0, 0, 0]\n", "4:13: [[light]] direction: must not be 0"},
        {"[[light]]\ndirection = [0, 0, 1]\nposition = [0, 0, 1]\n", "5:12: [[light]] position: cannot stand beside"},
        {"[[light]]\nposition = [0, 0, 1e300]\n", "4:12: [[light]] position: "},
        {"[[light]]\nposition = [0, 1]\n", "4:12: [[light]] position: "},
        {"[[light]]\ndirection = [0, 0, 1]\ncolor = '#fff'\n", "5:1: [[light]]: unknown key 'color'"},
    };
    for (const Case& c : cases) {
        const std::string message = fault(c.text);
        EXPECT_TRUE(message.starts_with(std::string("scene.toml:") + c.message)) << c.text << message;
    }
}

TEST(SurfaceKeys, NamesOfSheetsAreNotKnownAndProbableMistakesAreNoted) {
    const auto notes_of = [](const std::string& color, RenderFunction render) {
        const Scene scene = loaded("[lines]\ndraw = 'none'\n[surfaces]\ncolor = '" + color + "'\n" + kBox);
        const Frame frame = make_frame(scene, pixel_camera(8, 8), 8, 8, {0, 0, 8, 8});
        Film film({0, 0, 8, 8}, frame.crop, {}, frame.criteria.classes);
        return render(frame, {}, film).notes;
    };
    const std::vector<std::string> wrong{
        "[surfaces]: no object fits 'x' (burin info lists them)",
        "[surfaces]: a colour has 200, 0, 0, beyond 1: components are from 0 to 1; for 0 to 255 write #c80000"};
    for (const RenderFunction render : {render_abuffer, render_reference}) {
        EXPECT_EQ(notes_of("=object == \"x\" ? rgb(200, 0, 0) : C", render), wrong);
        EXPECT_EQ(notes_of("=object == \"*\" ? rgb(1, 0, 0) : C", render), std::vector<std::string>{});
    }
    try {
        notes_of("=width", render_abuffer);
        FAIL();
    } catch (const InputError& error) {
        const std::string words =
            "unknown variable 'width'; surfaces have variables of their own, and know no parameters and lets of a "
            "sheet";
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace burin::surfaces_keys_test
