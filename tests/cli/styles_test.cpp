// Style sheets on the command line: where they are found, what changes their values, and what cannot stand beside them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "image/exr_reader.h"
#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::styles_test {
namespace {

using Arguments = std::vector<std::string>;
using Json = nlohmann::json;

constexpr const char* kSheet = R"(style_version = 1
summary = "one width"
[parameters]
width = { value = "1mm", min = 0.5, max = 2 }
color = "#000000"
share = { value = 1, min = 0, max = 1 }
[[set]]
name = "seen"
classes = ["silhouette", "crease"]
layer = true
style = "ink"
[[set]]
name = "behind"
classes = ["silhouette", "crease"]
qi = [1, 255]
style = "ink"
[style.ink]
width = "=width * share + frame"
color = "=color"
)";

/// A value of the environment, as long as this lives.
class Environment {
  public:
    Environment(const char* name, const std::string& value) : name_(name) {
        if (const char* const old = std::getenv(name)) old_ = old;
        setenv(name, value.c_str(), 1);
    }
    ~Environment() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

  private:
    const char* name_;
    std::optional<std::string> old_;
};

class Styles : public testing::Test {
  protected:
    Styles() : home_("HOME", folder_.path()), listed_("BURIN_STYLES", "") {
        folder_.write("cube.obj", kCubeObj);
        folder_.write("mine.toml", kSheet);
        folder_.write("scene.toml", "style = \"mine.toml\"\n[[object]]\nfile = \"cube.obj\"\n");
        folder_.write("plain.toml", "[lines]\nwidth = 3\ncolor = \"#ff0000\"\n[[object]]\nfile = \"cube.obj\"\n");
    }
    void make(const std::string& folder) const { std::filesystem::create_directories(folder_.file(folder)); }
    ProgramResult render(const Arguments& options, const std::string& input = "cube.obj") const {
        Arguments all{"render", input, "-r", "40x30", "-o", "out.exr"};
        all.insert(all.end(), options.begin(), options.end());
        return run_burin(folder_.path(), all);
    }
    /// The bytes of the picture; nothing may be said on the way.
    std::string picture(const Arguments& options, const std::string& input = "cube.obj") const {
        const ProgramResult result = render(options, input);
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(result.err, "");
        return read_file(folder_.file("out.exr"));
    }
    void expect_usage_error(const Arguments& options, const std::string& words,
                            const std::string& input = "cube.obj") const {
        const ProgramResult result = render(options, input);
        EXPECT_EQ(result.status, 2) << words;
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
    }

    TemporaryFolder folder_;
    Environment home_, listed_;
};

/// A text with one place changed.
std::string changed(std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return text;
}

TEST_F(Styles, AreFoundByNameAndByFile) {
    const std::string of_file = picture({"--style", "mine.toml"});
    EXPECT_NE(of_file, picture({}));
    EXPECT_EQ(of_file, picture({"--style", "./mine.toml"}));
    EXPECT_EQ(of_file, picture({"--style", folder_.file("mine.toml")}));
    EXPECT_EQ(of_file, picture({}, "scene.toml"));
    EXPECT_NE(of_file, picture({"--style", "technical"}));
    EXPECT_EQ(picture({"--style", "technical"}), picture({"--style", "technical"}, "scene.toml"));
    EXPECT_EQ(picture({"--style", "technical"}), picture({"--set", "style=technical"}));
    // In the user's folders; built-in names come first, then the home folder, then those that are listed.
    expect_usage_error({"--style", "own"}, "there is no style sheet 'own'");
    make("one"), make("two");
    folder_.write("two/own.toml", kSheet);
    folder_.write("one/technical.toml", "no sheet");
    const Environment listed("BURIN_STYLES", folder_.file("one") + "::" + folder_.file("two"));
    EXPECT_EQ(picture({"--style", "own"}), of_file);
    EXPECT_EQ(render({"--style", "technical"}).status, 0);
    make(".config/burin/styles");
    folder_.write(".config/burin/styles/own.toml", changed(kSheet, "1mm", "2mm"));
    EXPECT_EQ(picture({"--style", "own"}), picture({"--style", "mine.toml", "--set", "style.width=2mm"}));
}

TEST_F(Styles, UnknownNamesHaveSuggestions) {
    expect_usage_error({"--style", "comik"},
                       "--style: there is no style sheet 'comik', did you mean 'comic'?; burin styles lists them");
    const ProgramResult missing = render({"--style", "none.toml"});
    EXPECT_EQ(missing.status, 1);
    EXPECT_EQ(missing.err.find("none.toml: "), 0u) << missing.err;
    folder_.write("bad.toml", "style = \"comik\"\n[[object]]\nshape = \"box\"\n");
    const ProgramResult scene = render({}, "bad.toml");
    EXPECT_EQ(scene.status, 1);
    EXPECT_EQ(scene.err.find("bad.toml:1:9: style: there is no style sheet 'comik'"), 0u) << scene.err;
    folder_.write("wrong.toml", changed(kSheet, "width * share", "width * shaer"));
    const ProgramResult wrong = render({"--style", "wrong.toml"});
    EXPECT_EQ(wrong.status, 1);
    EXPECT_EQ(wrong.err, "wrong.toml:18:19: [style.ink] width: unknown variable 'shaer', did you mean 'share'?\n");
    EXPECT_FALSE(std::filesystem::exists(folder_.file("out.exr")));
}

TEST_F(Styles, WidthAndColourAreParameters) {
    // 1 mm is 96 / 25.4 px; or as many as --dpi says.
    folder_.write("three.toml", changed(changed(kSheet, "\"1mm\"", "3"), "max = 2", "max = 9"));
    const std::string three = picture({"--style", "three.toml"});
    EXPECT_EQ(picture({"--style", "mine.toml", "-w", "3"}), three);
    EXPECT_EQ(picture({"--style", "mine.toml", "--dpi", "76.2"}), three);
    EXPECT_EQ(picture({"--style", "mine.toml", "--set", "picture.dpi=76.2"}), three);
    EXPECT_EQ(picture({"--style", "three.toml", "-w", "2", "--frame", "1"}), three);
    EXPECT_EQ(picture({"--style", "three.toml", "--color", "#000000"}), three);
    EXPECT_EQ(picture({"--style", "three.toml", "--color", "#ff8000"}),
              picture({"--style", "three.toml", "--set", "style.color=#ff8000"}));
    EXPECT_NE(picture({"--style", "three.toml", "--color", "#ff8000"}), three);
    // The range is in the parameter's unit.
    expect_usage_error({"--style", "mine.toml", "-w", "8"}, "--line-width: must be at most 2mm, got 2.11666667mm");
    expect_usage_error({"--style", "mine.toml", "-w", "1"}, "--line-width: must be at least 0.5mm, got 0.264583333mm");
    EXPECT_EQ(render({"--style", "mine.toml", "-w", "8", "--dpi", "192"}).status, 0);
    expect_usage_error({"--style", "three.toml", "-w", "10"}, "--line-width: must be at most 9, got 10");
    folder_.write("fixed.toml", changed(changed(kSheet, "width = { value = \"1mm\"", "thick = { value = \"1mm\""),
                                        "\"=width *", "\"=thick *"));
    expect_usage_error({"--style", "fixed.toml", "-w", "3"},
                       "--line-width: the style sheet fixed has no parameter 'width'; it has thick, color, share");
    folder_.write("swapped.toml", changed(kSheet, "color = \"#000000\"", "color = 3"));
    expect_usage_error({"--style", "swapped.toml", "--color", "#ff0000"}, "'color' of the style sheet swapped is no");
}

TEST_F(Styles, SetChangesEveryValue) {
    const std::string plain = picture({"--style", "mine.toml"});
    EXPECT_EQ(picture({"--style", "mine.toml", "--set", "style.width=1mm"}), plain);
    EXPECT_NE(picture({"--style", "mine.toml", "--set", "style.share=0.5"}), plain);
    EXPECT_EQ(picture({"--style", "mine.toml", "--set", "style.share=0.5"}),
              picture({"--set", "style.ink.width=0.5mm"}, "scene.toml"));
    EXPECT_EQ(picture({"--style", "mine.toml", "--set", "style.ink.width==width"}), plain);
    EXPECT_EQ(picture({"--style", "mine.toml", "--hidden", "none"}),
              picture({"--style", "mine.toml", "--set", "style.set.behind.enabled=false"}));
    expect_usage_error({"--style", "mine.toml", "--set", "style.widht=3"},
                       "the sheet has no parameter 'widht', did you mean 'width'?; it has color, share, width");
    expect_usage_error({"--style", "mine.toml", "--set", "style.inks.width=3"},
                       "the sheet has no style 'inks', did you mean 'ink'?; it has ink");
    expect_usage_error({"--style", "mine.toml", "--set", "style.ink.widht=3"}, "did you mean 'width'?");
    expect_usage_error({"--style", "mine.toml", "--set", "style.set.none.qi=3"},
                       "the sheet has no set 'none'; it has ");
    expect_usage_error({"--style", "mine.toml", "--set", "style.width=3mm"}, "must be at most 2mm, got 3mm");
    expect_usage_error({"--style", "mine.toml", "--set", "style.width=8"},
                       "must be at most 2mm, got 2.11666667mm (8px)");
    expect_usage_error({"--style", "mine.toml", "--set", "style.ink.width==depht"}, "unknown variable 'depht'");
    expect_usage_error({"--set", "style.width=3"}, "there is no style sheet; give one with --style");
}

TEST_F(Styles, SayThatSurfacesOfTheSceneStay) {
    folder_.write("flat.toml", kSheet + std::string("[surfaces]\nshading = \"flat\"\n"));
    folder_.write("lambert.toml", "[surfaces]\nshading = \"lambert\"\n[[object]]\nfile = \"cube.obj\"\n");
    folder_.write("both.toml", "style = \"flat.toml\"\n" + read_file(folder_.file("lambert.toml")));
    EXPECT_EQ(render({"--style", "flat.toml"}, "lambert.toml").err,
              "burin: note: the scene's own [surfaces] stay; those of the style sheet change nothing; take them "
              "out of the scene to have the sheet's\n");
    EXPECT_EQ(read_file(folder_.file("out.exr")), picture({"--style", "mine.toml"}, "lambert.toml"));
    EXPECT_EQ(render({"--style", "flat.toml", "-q"}, "lambert.toml").err, "");
    EXPECT_NE(picture({"--style", "flat.toml"}), picture({"--style", "mine.toml"}));
    EXPECT_EQ(picture({"--style", "flat.toml", "--set", "style.surfaces.shading=lambert"}),
              picture({"--style", "mine.toml"}, "lambert.toml"));
    picture({}, "both.toml");  // whoever wrote the scene knows
}

TEST_F(Styles, TakeThePlaceOfLooksOrRefuseThem) {
    const ProgramResult noted = render({"--style", "mine.toml", "--set", "lines.draw=crease"}, "plain.toml");
    EXPECT_EQ(noted.status, 0);
    EXPECT_EQ(noted.err,
              "burin: note: the style sheet says which lines are drawn and how; lines.draw, lines.width, lines.color "
              "change nothing\n");
    EXPECT_EQ(read_file(folder_.file("out.exr")), picture({"--style", "mine.toml"}));
    const ProgramResult one = render({"--style", "mine.toml", "--set", "lines.width=2"});
    EXPECT_EQ(one.err,
              "burin: note: the style sheet says which lines are drawn and how; lines.width changes nothing\n");
    EXPECT_EQ(render({"--style", "mine.toml", "-q"}, "plain.toml").err, "");
    const std::pair<std::string, std::string> looks[] = {
        {"width = 3", "[style.ink] width says it"},
        {"color = \"#ff0000\"", "[style.ink] color says it"},
        {"dash = [3, 3]", "[style.ink] dash says it"},
        {"side = \"inside\"", "[style.ink] side says it"},
        {"colors = { crease = \"#ff0000\" }", "[style.ink] color says it"},
        {"hidden = { style = \"solid\" }", "the set 'behind' draws hidden lines in [style.ink]"}};
    const auto refusal_of = [&](const std::string& key, const std::string& sheet) {
        folder_.write("both.toml",
                      "style = \"" + sheet + "\"\n[lines]\n" + key + "\n[[object]]\nfile = \"cube.obj\"\n");
        const ProgramResult both = render({}, "both.toml");
        EXPECT_EQ(both.status, 1) << key;
        EXPECT_EQ(both.err.find("both.toml:3:"), 0u) << both.err;
        EXPECT_TRUE(is_one_line(both.err)) << both.err;
        return both.err;
    };
    for (const auto& [key, words] : looks) {
        const std::string error = refusal_of(key, "mine.toml");
        const std::string name = key.substr(0, key.find(' '));
        EXPECT_NE(
            error.find("[lines] " + name + ": cannot stand beside a style sheet, where " + words + "; remove one"),
            std::string::npos)
            << error;
        EXPECT_EQ(render({"--style", "mine.toml", "-q"}, "both.toml").status, 0) << key;
    }
    // The styles of visible lines are named, three at most.
    std::string many = "style_version = 1\n";
    for (const std::string style : {"a", "b", "c", "d"}) {
        many += "[[set]]\nname = \"" + style + "\"\nclasses = [\"crease\"]\nstyle = \"" + style + "\"\n";
        folder_.write(style + ".toml", many + "[style.a]\n[style.b]\n[style.c]\n[style.d]\n");
    }
    EXPECT_NE(refusal_of("width = 3", "b.toml").find("where [style.a] width, [style.b] width say it;"),
              std::string::npos);
    EXPECT_NE(refusal_of("side = \"inside\"", "d.toml").find("[style.c] side, ... say it;"), std::string::npos);
    EXPECT_NE(
        refusal_of("hidden = { style = \"solid\" }", "d.toml").find("a set with qi = [1, 255] would draw hidden lines"),
        std::string::npos);
    // What says what is found may stand in [lines].
    folder_.write("both.toml", "style = \"mine.toml\"\n[lines]\ncrease_angle = 91\n[[object]]\nfile = \"cube.obj\"\n");
    EXPECT_EQ(picture({}, "both.toml"), picture({"--style", "mine.toml", "--crease-angle", "91"}));
    EXPECT_NE(picture({}, "both.toml"), picture({}, "scene.toml"));
}

TEST_F(Styles, OnlyTheABufferDrawsThem) {
    for (const Arguments& more : {Arguments{"-m", "patel"}, {"-m", "gbuffer"}, {"-m", "reference"}})
        expect_usage_error({"--style", "mine.toml", more[0], more[1]},
                           "draws no style sheets; draw with method abuffer");
    expect_usage_error({"-m", "patel"}, "--style: method patel draws no style sheets", "scene.toml");
    expect_usage_error({"--style", "mine.toml", "--hidden", "dashed"}, "--hidden: the style sheet says how");
    expect_usage_error({"--style", "mine.toml", "--hidden", "solid"}, "only none can stand beside it");
    // It says how to have them, too.
    expect_usage_error({"--style", "pencil", "--hidden", "solid"}, "a set with qi = [1, 255] would draw them, and");
    expect_usage_error({"--style", "technical", "--hidden", "solid"},
                       "in technical the set 'hidden' draws them in the style 'dashed': --set 'style.set.hidden.qi=[1, "
                       "255]' draws those behind any number of surfaces, --set style.dashed.KEY=VALUE changes how");
    expect_usage_error({"--style", "mine.toml", "--lines", "crease"}, "--lines: the style sheet says which");
    const ProgramResult compare =
        run_burin(folder_.path(), {"compare", "cube.obj", "-o", "compared", "-r", "20x15", "--style", "mine.toml"});
    EXPECT_EQ(compare.status, 2);
    EXPECT_NE(compare.err.find("--style: burin compare draws no style sheets"), std::string::npos) << compare.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.file("compared")));
}

TEST_F(Styles, NoSheetIsWrittenOver) {
    folder_.write("mine.png", kSheet);
    const ProgramResult result =
        run_burin(folder_.path(), {"render", "cube.obj", "-r", "20x15", "--style", "./mine.png", "-o", "mine.png"});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(read_file(folder_.file("mine.png")), kSheet);
}

TEST_F(Styles, SetsHaveLayersOfTheirOwn) {
    const auto channels = [&](const Arguments& options) {
        std::string names;
        EXPECT_EQ(render(options).status, 0);
        const Image image = read_exr(folder_.file("out.exr"));
        for (const Channel& c : image.channels()) names += c.name + " ";
        return names;
    };
    const std::string usual = channels({"--style", "mine.toml"});
    for (const char* const layer : {"lines.A ", "lines_hidden.A ", "lines_seen.A "})
        EXPECT_NE(usual.find(layer), std::string::npos) << usual;
    EXPECT_EQ(usual.find("lines_behind"), std::string::npos);
    EXPECT_EQ(channels({"--style", "mine.toml", "--layers", "Z,lines_seen"}),
              "Z lines_seen.A lines_seen.B lines_seen.G lines_seen.R ");
    expect_usage_error({"--style", "mine.toml", "--layers", "lines_behind"},
                       "--layers: unknown layer 'lines_behind'; sets of the style sheet have lines_seen");
    expect_usage_error({"--layers", "lines_seen"}, "only sets of a style sheet have such layers");
}

TEST_F(Styles, AreListedAndPrinted) {
    make("more");
    folder_.write("more/mine.toml", kSheet);
    folder_.write("more/broken.toml", "[[set]]\n");
    const Environment listed("BURIN_STYLES", folder_.file("more"));
    const ProgramResult list = run_burin(folder_.path(), {"styles"});
    EXPECT_EQ(list.status, 0);
    EXPECT_TRUE(is_one_line(list.err)) << list.err;
    EXPECT_NE(list.err.find("note: left out, because " + folder_.file("more/broken.toml") + ":1:"), std::string::npos)
        << list.err;
    EXPECT_NE(list.out.find("\nmine             one width\n                 width = 1mm, color = #000000, share = 1\n"),
              std::string::npos)
        << list.out;
    EXPECT_EQ(run_burin(folder_.path(), {"styles", "-q"}).err, "");
    EXPECT_EQ(run_burin(folder_.path(), {"styles", "mine"}).out, kSheet);
    EXPECT_EQ(run_burin(folder_.path(), {"styles", "mine.toml"}).out, kSheet);
    const Json json = Json::parse(run_burin(folder_.path(), {"styles", "--json", "-q"}).out);
    for (const char* const name :
         {"technical", "blueprint", "comic", "patent", "wireframe", "instructions", "pencil", "architect", "mine"}) {
        const auto is_it = [&](const Json& style) { return style["name"] == name; };
        const auto found = std::find_if(json["styles"].begin(), json["styles"].end(), is_it);
        ASSERT_NE(found, json["styles"].end()) << name;
        std::vector<std::string> parameters;
        for (const Json& p : (*found)["parameters"]) parameters.push_back(p["name"]);
        EXPECT_NE(std::find(parameters.begin(), parameters.end(), "width"), parameters.end()) << name;
        EXPECT_NE(std::find(parameters.begin(), parameters.end(), "color"), parameters.end()) << name;
    }
    const Json mine = Json::parse(run_burin(folder_.path(), {"styles", "mine", "--json"}).out);
    EXPECT_EQ(mine, Json::parse(R"({"styles": [{"name": "mine", "summary": "one width", "parameters": [
        {"name": "width", "value": "1mm", "min": 0.5, "max": 2}, {"name": "color", "value": "#000000"},
        {"name": "share", "value": 1, "min": 0, "max": 1}]}]})"));
    const ProgramResult unknown = run_burin(folder_.path(), {"styles", "minne"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_NE(unknown.err.find("did you mean 'mine'?"), std::string::npos) << unknown.err;
    const ProgramResult broken = run_burin(folder_.path(), {"styles", "broken", "--json"});
    EXPECT_EQ(broken.status, 1);
}

TEST_F(Styles, BlueprintWantsAGroundOnly) {
    folder_.write("c.toml", "[[object]]\nshape = \"box\"\n");
    const auto drawn = [&](Arguments more) {
        more.insert(more.begin(), {"render", "c.toml", "--style", "blueprint", "-r", "64x48", "-o", "b.png"});
        return run_burin(folder_.path(), more).err;
    };
    EXPECT_NE(drawn({}).find("the color of the style sheet is about as pale as the paper"), std::string::npos);
    EXPECT_EQ(drawn({"-q"}), "");
    EXPECT_EQ(drawn({"--color", "#203060"}), "");
    EXPECT_EQ(drawn({"--background", "transparent"}), "");
    EXPECT_EQ(drawn({"--background", "#1f3a6e"}), "");
    const std::string alone = read_file(folder_.file("b.png"));
    drawn({"--background", "#1f3a6e", "--set", "surfaces.shading=none"});
    EXPECT_EQ(read_file(folder_.file("b.png")), alone);
    EXPECT_FALSE(alone.empty());
}

}  // namespace
}  // namespace burin::test::styles_test
