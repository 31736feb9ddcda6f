// What is wrong with a scene file is said with line and column, on one line.

#include <gtest/gtest.h>

#include "tests/scene/scene_text.h"

namespace burin {
namespace {

using test::kBox;
using test::SceneText;

struct Mistake {
    const char* text;   // after the two lines of kBox
    const char* place;  // "line:column"
    const char* words;  // that the message has
};

void expect_mistakes(std::initializer_list<Mistake> mistakes) {
    for (const Mistake& m : mistakes) {
        const std::string error = SceneText(std::string(kBox) + m.text).error();
        EXPECT_EQ(error.find("scene.toml:" + std::string(m.place) + ": "), 0u) << m.text << "\n-> " << error;
        EXPECT_NE(error.find(m.words), std::string::npos) << m.text << "\n-> " << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
}

TEST(SceneErrors, UnknownKeys) {
    expect_mistakes({
        {"sise=1", "3:1", "unknown key 'sise'; did you mean 'size'?"},
        {"  x=1", "3:3", "unknown key 'x'"},
        {"banana=1", "3:1", "unknown key 'banana'; docs/scene-format.md"},
        {"radius=1", "3:1", "unknown key 'radius'"},  // of another shape
        {"[[object.instance]]\nname='x'", "4:1", "[[instance]]: unknown key 'name'"},
        {"[line]\nwidth=1", "3:2", "unknown key 'line'; did you mean 'lines'?"},
        {"[lines]\ndraww=[]", "4:1", "[lines]: unknown key 'draww'; did you mean 'draw'?"},
        {"[lines.colors]\ncreese='#fff'", "4:1", "did you mean 'crease'?"},
        {"[picture]\nwidth=1", "4:1", "unknown key 'width'"},
        {"[surfaces]\nshade='paper'", "4:1", "unknown key 'shade'"},
        {"[patel]\nmasks=16", "4:1", "did you mean 'mask'?"},
        {"[[camera]]\nfovy=30", "4:1", "[[camera]]: unknown key 'fovy'; did you mean 'fov'?"},
        {"[[material]]\nname='m'\ncolour='#fff'", "5:1", "did you mean 'color'?"},
        {"\"a\\nb\"=1", "3:1", "unknown key 'a?b'"},  // still one line
    });
}

TEST(SceneErrors, WrongTypes) {
    expect_mistakes({
        {"size=3", "3:6", "[[object]] size: must be a list of 3 numbers"},
        {"size=[1,2]", "3:6", "must be a list of 3 numbers"},
        {"size=[1,2,'3']", "3:6", "must be a number"},
        {"name=3", "3:6", "must be a text in quotes"},
        {"material=[]", "3:10", "must be a text in quotes"},
        {"subdivide=1.0", "3:11", "must be a whole number"},
        {"subdivide='1'", "3:11", "must be a whole number"},
        {"scheme='Loop'", "3:8", "must be one of \"automatic\", \"loop\", \"catmull-clark\""},
        {"scale='big'", "3:7", "must be a list of 3 numbers"},
        {"matrix=[1,2,3]", "3:8", "must be a list of 16 numbers"},
        {"instance=3", "3:10", "must be a list of tables"},
        {"instance=[1]", "3:10", "must be a list of tables"},
        {"[picture]\nsize='1x1'", "4:6", "must be a list of 2 numbers"},
        {"[picture]\nbackground=3", "4:12", "must be a list of 3 numbers"},
        {"[picture]\nbackground='white'", "4:12", "must be a colour"},
        {"[lines]\ndraw=1", "4:6", "must be a list of texts"},
        {"[lines]\ndraw=[1]", "4:6", "must be a list of texts"},
        {"[lines]\nwidth=true", "4:7", "must be a number"},
        {"[lines]\ncolors='#fff'", "4:8", "must be a table"},
        {"[lines]\nside='left'", "4:6", "must be one of"},
        {"[lines]\nfilter='lanczos'", "4:8", "must be one of"},
        {"[lines]\nfilter=2", "4:8", "must be"},
        {"[surfaces]\npaper='#12345'", "4:7", "must be a colour"},
        {"[patel]\nmask='64'", "4:6", "must be a whole number"},
        {"[[camera]]\neye=[1,2,3,4]", "4:5", "must be a list of 3 numbers"},
        {"[[camera]]\nprojection='ortho'", "4:12", "must be one of"},
    });
    EXPECT_NE(SceneText("lines=3\n[[object]]\nshape='box'").error().find("scene.toml:1:7: lines: must be a table"),
              std::string::npos);
    EXPECT_EQ(SceneText("object=3").error().find("scene.toml:1:8: object: must be a list of tables"), 0u);
    EXPECT_EQ(SceneText("[[object]]\nshape='cube'").error().find("scene.toml:2:7: "), 0u);
    EXPECT_EQ(SceneText("[[object]]\nfile=1").error().find("scene.toml:2:6: "), 0u);
}

TEST(SceneErrors, ValuesOutOfRange) {
    expect_mistakes({
        {"size=[1,0,1]", "3:6", "must be positive"},
        {"size=[1,1,-1]", "3:6", "must be positive"},
        {"size=[1,1,-9007199254740993]", "3:6", "must be positive"},
        {"size=[1,nan,1]", "3:6", "finite"},
        {"size=[inf,1,1]", "3:6", "finite"},
        {"subdivide=-1", "3:11", "at least 0 and at most 8, got -1"},
        {"subdivide=9", "3:11", "at least 0 and at most 8, got 9"},
        {"scale=0", "3:7", "must not be zero"},
        {"scale=[1,0,1]", "3:7", "must not be zero"},
        {"scale=nan", "3:7", "finite"},
        {"translate=[0,inf,0]", "3:11", "finite"},
        {"matrix=[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,2]", "3:8", "last row"},
        {"matrix=[1,0,0,0, 0,1,0,0, 0,0,1,0, 1,0,0,1]", "3:8", "last row"},
        {"[picture]\nsize=[0,10]", "4:6", "whole numbers from 1 to 65535"},
        {"[picture]\nsize=[10,65536]", "4:6", "whole numbers from 1 to 65535"},
        {"[picture]\nsize=[10,1.5]", "4:6", "whole numbers"},
        {"[lines]\nwidth=0", "4:7", "greater than 0 and at most 1024, got 0"},
        {"[lines]\nwidth=-1", "4:7", "got -1"},
        {"[lines]\nwidth=1025", "4:7", "got 1025"},
        {"[lines]\ncrease_angle=181", "4:14", "at most 180"},
        {"[lines]\ncrease_angle=-1", "4:14", "at least 0"},
        {"[lines]\ncrease_angle=[45,35]", "4:14", "the smaller one first"},
        {"[lines]\ncrease_angle=[35,181]", "4:14", "from 0 to 180 degrees"},
        {"[lines]\ncrease_angle=[35]", "4:14", "must be a list of 2 numbers"},
        {"[lines]\ncrease_angle='sharp'", "4:14", "must be a list of 2 numbers"},
        {"[lines]\ncontours='round'", "4:10", "must be one of \"mesh\", \"smooth\""},
        {"[lines]\ndash=[4,0]", "4:6", "greater than 0"},
        {"[lines]\ndash=4", "4:6", "must be a list of 2 numbers"},
        {"[lines]\ndash='dotted'", "4:6", "must be a list of 2 numbers"},
        {"[lines]\ndraw=['all','none']", "4:6", "none cannot stand beside other words"},
        {"[lines]\ndraw='none,crease'", "4:6", "none cannot stand beside other words"},
        {"[lines]\ndraw=['crease','edge']", "4:6", "unknown line class 'edge'; known are"},
        {"[lines]\ncolor=[0,-1,0]", "4:7", "must not be negative"},
        {"[reference]\nsamples=3", "4:9", "at least 4"},
        {"[reference]\nsamples=65", "4:9", "at most 64"},
        {"[patel]\nmask=32", "4:6", "must be 16, 64 or 256"},
        {"[patel]\nmask=512", "4:6", "at most 256"},
        {"[zbuffer]\ndepth_bits=20", "4:12", "must be 16, 24, 32 or 64"},
        {"[zbuffer]\ndepth_range=[3,2]", "4:13", "the nearer one first"},
        {"[zbuffer]\neps=-1", "4:5", "at least 0"},
        {"[[camera]]\nfov=0", "4:5", "greater than 0 and less than 180, got 0"},
        {"[[camera]]\nfov=180", "4:5", "less than 180"},
        {"[[camera]]\nfov=nan", "4:5", "finite"},
        {"[[camera]]\nheight=0", "4:8", "greater than 0"},
        {"[[camera]]\nheight=-2", "4:8", "greater than 0"},
        {"[[camera]]\nfit=0", "4:5", "greater than 0 and at most 1"},
        {"[[camera]]\nfit=1.01", "4:5", "at most 1"},
        {"[[material]]\nname='m'\nopacity=1.1", "5:9", "at most 1"},
        {"[lines.hidden]\nstyle='dotted'", "4:7", "dashed"},
        {"[lines.hidden]\ndash=[4,0]", "4:6", "greater than 0"},
    });
    for (const auto& [text, place] : {std::pair{"shape='plane'\nsize=[1,0]", "3:6"},
                                      {"shape='plane'\ncolumns=0", "3:9"},
                                      {"shape='plane'\nrows=4097", "3:6"},
                                      {"shape='sphere'\nradius=0", "3:8"},
                                      {"shape='sphere'\nsegments=2", "3:10"},
                                      {"shape='sphere'\nrings=1", "3:7"},
                                      {"shape='cylinder'\nheight=-1", "3:8"},
                                      {"shape='cylinder'\ntop_radius=0", "3:12"},
                                      {"shape='torus'\ntube_radius=0", "3:13"},
                                      {"shape='torus'\ntube_segments=2", "3:15"},
                                      {"shape='teapot'\ntessellation=257", "3:14"}}) {
        const std::string error = SceneText("[[object]]\n" + std::string(text)).error();
        EXPECT_EQ(error.find("scene.toml:" + std::string(place) + ": [[object]] "), 0u) << error;
    }
}

TEST(SceneErrors, ThingsThatDoNotGoTogether) {
    expect_mistakes({
        {"file='x.obj'", "2:9", "shape: cannot stand beside a file; remove one"},
        {"[[object]]\nname='x'", "3:1", "needs either a file or a shape"},
        {"matrix=[1,0,0,0, 0,0,0,0, 0,0,1,0, 0,0,0,1]", "3:8", "makes everything flat"},
        {"[lines.hidden]\nstyle='dash'", "4:7", "[lines.hidden] style: must be one of"},
        {"[[object]]\nshpe='box'", "4:6", "shpe: unknown key; did you mean 'shape'?"},
        {"matrix=[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\nscale=2", "4:7", "cannot stand beside a matrix"},
        {"material='m'", "3:10", "no [[material]] named 'm'"},
        {"[[material]]\nname='m'\n[[material]]\nname='m'", "6:6", "two materials have this name"},
        {"[[material]]\ncolor='#fff'", "3:1", "needs a name"},
        {"[[material]]\nname=''", "3:1", "needs a name"},
        {"[[camera]]\nname='a'\n[[camera]]\nname='a'", "6:6", "two cameras have this name"},
        {"[[camera]]\n[[camera]]", "4:1", "two cameras have this name"},
        {"[[camera]]\neye=[1,2,3]\ndirection=[1,0,0]", "5:11", "cannot stand beside an eye"},
        {"[[camera]]\nprojection='perspective'\nheight=2", "5:8", "a perspective camera has none"},
    });
    EXPECT_NE(SceneText("[lines]\nwidth=1\n").error().find("the scene has no [[object]]"), std::string::npos);
    EXPECT_NE(SceneText("# nothing\n").error().find("the scene has no [[object]]"), std::string::npos);
}

TEST(SceneErrors, Syntax) {
    expect_mistakes({
        {"size", "3:5", ""},
        {"size=", "3:6", ""},
        {"size=[1,2", "3:10", ""},
        {"name='x", "3:8", ""},
        {"size=[1,1,1]\nsize=[1,1,1]", "4:6", "redefine"},
        {"[lines", "3:7", ""},
        {"[;", "3:2", "saw ';'"},
        {"[[]]", "3:3", "prohibited"},
        {"size=[1, \xC6\xA2]", "3:10", ""},
        {"name=\"\\q\"", "3:8", ""},
        {"name=\"\xFF\"", "3:6", "utf-8"},
    });
    EXPECT_EQ(SceneText(std::string(kBox) + '\0').error().find("scene.toml:3:1: "), 0u);
}

TEST(SceneErrors, DeepNestingDoesNotCrash) {
    std::string dots = "a";
    for (int i = 0; i < 200000; ++i) dots += ".a";
    for (const std::string& text :
         {"a=" + std::string(100000, '['), "a=" + std::string(100000, '[') + std::string(100000, ']'), "[" + dots + "]",
          dots + "=1", std::string("[[object]]\n") + dots + "=1"}) {
        const std::string error = SceneText(text).error();
        EXPECT_EQ(error.find("scene.toml:"), 0u) << error.substr(0, 100);
    }
}

TEST(SceneErrors, FilesThatCannotBeRead) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(read_scene_file(folder.file("missing.toml"), {}), InputError);
    EXPECT_THROW(read_scene_file(folder.write("empty.toml", ""), {}), InputError);
    EXPECT_THROW(read_scene_file(folder.path(), {}), InputError);
}

TEST(SceneErrors, ATransformThatIsTooLargeNamesItsObject) {
    const SceneText text("[[object]]\nshape='box'\nname='big'\nmatrix=[1e200,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n");
    try {
        text.load();
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("scene.toml:1:1: object 'big'"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace burin
