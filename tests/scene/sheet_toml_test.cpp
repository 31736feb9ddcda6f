// What is wrong with a style sheet is said with line and column, on one line: by reading it, or by compiling it.

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <string>

#include "scene/sheet_library.h"
#include "scene/sheet_toml.h"
#include "shading/sheet/compiled_sheet.h"

namespace burin::sheet_toml_test {
namespace {

SheetContext context() {
    SheetContext context;
    context.objects = {"wheel_left", "wheel_spare", "body"};
    context.materials = {"steel"};
    return context;
}

std::string error_of(const std::string& text, const std::vector<Override>& overrides = {}) {
    try {
        const CompiledSheet compiled(read_sheet_text(text, "s.toml", overrides), context());
    } catch (const InputError& error) {
        return error.what();
    } catch (const UsageError& error) {
        return std::string("usage: ") + error.what();
    }
    return {};
}

/// Two lines, then a set of four lines, then the style on line 7: what follows begins on line 8.
const std::string kInk =
    "style_version = 1\nlight = [0, 0, 1]\n[[set]]\nname = \"a\"\nclasses = [\"crease\"]\nstyle = "
    "\"ink\"\n[style.ink]\n";

struct SheetMistake {
    const char* text;
    const char* place;
    const char* words;
};

void expect_mistakes(const std::string& before, std::initializer_list<SheetMistake> mistakes) {
    for (const SheetMistake& m : mistakes) {
        const std::string error = error_of(before + m.text);
        EXPECT_EQ(error.find("s.toml:" + std::string(m.place) + ": "), 0u) << m.text << "\n-> " << error;
        EXPECT_NE(error.find(m.words), std::string::npos) << m.text << "\n-> " << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
}

TEST(SheetErrors, NoneInASheetThatIsRight) { EXPECT_EQ(error_of(kInk), ""); }

TEST(SheetErrors, OfExpressionsNameTheCharacter) {
    // The text behind "= begins in column 11.
    expect_mistakes(
        kInk, {{"width = \"=clamp(3 - , 1, 2)\"", "8:21", "[style.ink] width: a value is missing before ','"},
               {"width = \"=depht + 1\"", "8:11", "unknown variable 'depht', did you mean 'depth'?"},
               {"width = \"=1 + (2\"", "8:17", "')' expected before the end"},
               {"width = \"=C * 2\"", "8:11", "a number is needed here, but the expression is a colour"},
               {"width = \"=1 < t < 2\"", "8:17", "comparisons cannot be chained: use 'and'"},
               {"width = '=depht + 1'", "8:11", "unknown variable 'depht'"},
               {"width =   \"=depht + 1\"", "8:13", "unknown variable 'depht'"},
               {"width = \"=\\u0031 + depht\"", "8:9", "[style.ink] width, character 6: unknown variable 'depht'"},
               {"width = \"\"\"=1 +\n depht\"\"\"", "8:9", "character 7: unknown variable 'depht'"},
               {"width = \"=k1\"", "8:11", "'k1' is not in this version"},
               {"width = \"=ridge(0.3)\"", "8:11", "'ridge' is not in this version"},
               {"width = \"=attr(\\\"\\\")\"", "8:9", "the name of a vertex attribute is missing"},
               {"width = \"=class == 'x'\"", "8:20", ""},
               {"color = { over = \"depht\", stops = [[0, \"#fff\"]] }", "8:19", "unknown variable 'depht'"},
               {"width = { over = \"=2 * depht\", stops = [[0, 1]] }", "8:24", "unknown variable 'depht'"},
               {"dash = [\"=t\", 2]", "8:11", "'t' changes along a line"},
               {"overshoot = \"=qi\"", "8:15", "'qi' changes along a line"},
               {"color = \"=P\"\n[let]\nshade = \"=1 - lihgt\"", "10:15", "unknown variable 'lihgt'"},
               {"width = \"=a\"\n[let]\na = \"=b + 1\"\nb = \"=1 + zz\"", "11:11", "unknown variable 'zz'"},
               {"width = \"=a\"\n[let]\na = \"=a + 1\"", "10:7", "is made of itself"}});
}

TEST(SheetErrors, OfValues) {
    expect_mistakes(kInk, {{"widht = 2", "8:1", "unknown key 'widht'; did you mean 'width'?"},
                           {"banana = 2", "8:1", "unknown key 'banana'; docs/shading/sheets.md lists the known ones"},
                           {"width = -1", "8:9", "must be at least 0 and at most 4096, got -1"},
                           {"width = 4097", "8:9", "must be at least 0 and at most 4096, got 4097"},
                           {"width = \"2000mm\"", "8:9", "is 7559.05512 px; at most 4096 px are possible"},
                           {"width = true", "8:9", "must be a number (pixels), a length"},
                           {"width = \"3cm\"", "8:9", "unknown unit 'cm'"},
                           {"width = nan", "8:9", "must be a finite number"},
                           {"opacity = \"1mm\"", "8:11", "takes no unit"},
                           {"opacity = 1.5", "8:11", "at most 1, got 1.5"},
                           {"color = \"red\"", "8:9", "must be a colour such as"},
                           {"color = \"#12345\"", "8:9", "must be a colour such as"},
                           {"color = [1, 2]", "8:9", "must be a colour such as"},
                           {"color = [1, 2, -1]", "8:9", "must be three linear numbers"},
                           {"color = 3", "8:9", "must be a colour such as"},
                           {"dash = [1]", "8:8", "must be a list of 2, 4, 6 or 8 lengths"},
                           {"dash = [1, 0]", "8:12", "must be greater than 0"},
                           {"taper = { start = \"0.2world\" }", "8:19", "a length in world units changes along a line"},
                           {"taper = { begin = 3 }", "8:11", "unknown key 'begin'"},
                           {"taper = { shape = \"flat\" }", "8:19", "must be one of \"round\", \"linear\", \"sharp\""},
                           {"caps = \"square\"", "8:8", "must be one of \"round\", \"butt\""},
                           {"copies = 9", "8:10", "at most 8, got 9"},
                           {"hold = 0", "8:8", "must be at least 1"},
                           {"min_length = [5, 2]", "8:14", "must have the smaller length first"},
                           {"halo_depth = 3", "8:14", "must be a list of two lengths"},
                           {"smooth = \"=2\"", "8:10", "must be a number (pixels)"},
                           {"wobble = { octaves = 9 }", "8:22", "at most 8"},
                           {"shader = \"mine\"", "8:10", "shader: a line shader is code of a program"},
                           {"shader = \"a b\"", "8:10", "must be a name, which has letters, digits, _ and - only"},
                           {"shader = 3", "8:10", "must be"},
                           {"texture = { file = \"x\" }", "8:11", "texture: is not in this version"},
                           {"width = { over = \"t\" }", "8:9", "needs stops"},
                           {"width = { stops = [[0, 1]] }", "8:9", "needs over"},
                           {"width = { over = \"t\", stops = [[1, 1], [0, 2]] }", "8:31", "stop 2 does not lie behind"},
                           {"width = { over = \"t\", stops = [[0, \"#fff\"]] }", "8:36", "must be a number (pixels)"},
                           {"base = \"brush\"", "8:8", "there is no style 'brush'"},
                           {"base = \"ink\"", "8:8", "inherit from each other in a circle: ink -> ink"},
                           {"base = \"a\"\n[style.a]\nbase = \"ink\"", "10:8", "ink -> a -> ink"}});
}

// The TOML library gives no double for a whole number that a double does not hold.
TEST(SheetErrors, OfWholeNumbersThatAreNoDoubles) {
    const std::string large = "9007199254740993";
    const auto with = [&](const std::string& before, const std::string& behind) { return before + large + behind; };
    const std::string number = with("width = ", ""), negative = with("width = -", ""),
                      value = with("width = { over = \"t\", stops = [[0, ", "]] }"),
                      at = with("width = { over = \"t\", stops = [[0, 1], [", ", 2]] }"),
                      color = with("color = [0, ", ", 0]"), element = with("dash = [1, ", "]");
    expect_mistakes(kInk, {{number.c_str(), "8:9", "at most 4096, got 9.007199255e+15"},
                           {negative.c_str(), "8:9", "at least 0 and at most 4096, got -9.007199255e+15"},
                           {value.c_str(), "8:36", "at most 4096, got 9.007199255e+15"},
                           {at.c_str(), "8:31", "stop 2 has a number beyond 1e15"},
                           {color.c_str(), "8:9", "must be three linear numbers from 0 on"},
                           {element.c_str(), "8:12", "at most 65535, got 9.007199255e+15"}});
    for (const std::string& right : {with("width = \"=a\"\n[let]\na = ", ""),
                                     with("[parameters]\na = { value = ", ", min = 0, max = 9223372036854775807 }")})
        EXPECT_EQ(error_of(kInk + right), "") << right;
}

TEST(SheetErrors, OfSetsAndNames) {
    const std::string style = "[style.ink]\n[[set]]\n";  // what follows begins on line 3
    expect_mistakes(
        style, {{"classes = [\"crease\"]\nstyle = \"ink\"", "2:1", "needs a name"},
                {"name = \"a\"\nstyle = \"ink\"", "2:1", "needs classes"},
                {"name = \"a\"\nclasses = [\"crease\"]", "2:1", "needs a style"},
                {"name = \"a\"\nclasses = [\"creese\"]", "4:11", "unknown line class 'creese', did you mean 'crease'?"},
                {"name = \"a\"\nclasses = [\"suggestive\"]", "4:11", "the class 'suggestive' is not in this version"},
                {"name = \"a\"\nclasses = []", "4:11", "at least one line class"},
                {"name = \"a\"\nclasses = \"crease\"\nstyle = \"inc\"", "5:9", "there is no style 'inc'"},
                {"name = \"a\"\nclasses = \"crease\"\nqi = [2, 1]", "5:6", "must have the smaller number first"},
                {"name = \"a\"\nclasses = \"crease\"\nqi = 256", "5:6", "at most 255"},
                {"name = \"a\"\nclasses = \"crease\"\nstyle = \"ink\"\nselect = \"depth > 3\"", "6:11",
                 "'depth' changes along a line; use it in width or opacity"},
                {"name = \"a\"\nclasses = \"crease\"\nstyle = \"ink\"\nselect = \"object in whels\"", "6:21",
                 "unknown group 'whels'"},
                {"name = \"a\"\nclasses = \"crease\"\nstyle = \"ink\"\nselect = \"class == \\\"light\\\"\"", "6:10",
                 "'light' is not in this version"},
                {"name = \"a\"\nclasses = \"crease\"\nstyle = \"ink\"\nobjects = []", "6:11", "at least one pattern"},
                {"name = \"a\"\nclasses = \"crease\"\nstyle = \"ink\"\nlayer = \"hidden\"", "6:9", "lines_hidden"},
                {"name = \"a\"\nclasses = \"crease\"\nstyle = \"ink\"\nlayer = \"a.b\"", "6:9", "letters, digits"},
                {"name = \"a\"\nclasses = \"crease\"\nstyle = \"ink\"\npriority = 1", "6:12", "is a key of styles"},
                {"name = \"a\"\nclasses = \"crease\"\nstyle = \"ink\"\n[[set]]\nname = \"a\"", "7:8",
                 "two sets have this name"}});
    expect_mistakes(kInk,
                    {{"[let]\ndepth = \"=1\"", "9:9", "'depth' is a variable"},
                     {"[let]\nclamp = \"=1\"", "9:9", "'clamp' is a function"},
                     {"[let]\nink = \"=1\"", "9:7", "a style has this name, too"},
                     {"[let]\nk1 = \"=1\"", "9:6", "is a word that later versions use"},
                     {"[let]\na = \"1\"", "9:5", "which begins with '='"},
                     {"[groups]\na = {}", "9:5", "needs objects"},
                     {"[ramp.fade]\nover = \"t\"\nstops = [[0, 1]]", "9:8", "stands where the ramp is used"},
                     {"[let]\nfade = \"=1\"\n[ramp.fade]\nstops = [[0, 1]]", "10:1", "a let has this name, too"}});
}

TEST(SheetErrors, OfTheWholeSheet) {
    expect_mistakes("", {{"style_version = 2", "1:17", "this version reads 1"},
                         {"style_version = 2\n[passes.first]\na = 1", "1:17", "this version reads 1"},
                         {"crease_angle = [40, 30]", "1:16", "the smaller one first"},
                         {"light = [0, 0, 0]", "1:9", "must be a direction"},
                         {"contours = \"round\"", "1:12", "must be one of"},
                         {"x = = 1", "1:5", ""},
                         {"[parameters]\nw = { value = 3, max = 2 }", "2:15", "must be at most 2, got 3"},
                         {"[parameters]\nw = \"1world\"", "2:5", "takes no world units"},
                         {"[parameters]\nw = { min = 2 }", "2:5", "needs a value"},
                         {"[lines]\nwidth = 3\n[style.ink]\n[[set]]\nname=\"a\"\nclasses=\"crease\"\nstyle=\"ink\"",
                          "1:2", "unknown key 'lines'"}});
    EXPECT_NE(error_of("style_version = 1").find("the sheet has no [[set]]"), std::string::npos);
    EXPECT_NE(error_of(std::string(kMaxSheetBytes + 1, ' ')).find("more than 2 MB"), std::string::npos);
    EXPECT_NE(error_of("a = " + std::string(100, '[')).find("nested more than 64 deep"), std::string::npos);
    std::string many = kInk + "[let]\n";
    for (int i = 0; i < 256; ++i) many += "l" + std::to_string(i) + " = \"=1\"\n";
    EXPECT_EQ(error_of(many), "");
    EXPECT_NE(error_of(many + "m = \"=1\"").find("more than 256"), std::string::npos);
    std::string names;
    for (int i = 0; i < 257; ++i) names += "\"part " + std::to_string(i) + "\", ";
    const auto group = [](const std::string& list) { return kInk + "[groups]\nall = { objects = [" + list + "] }\n"; };
    EXPECT_EQ(error_of(group(names)), "");
    EXPECT_NE(error_of(group(names + "\"part*\"")).find("objects: has more than 256 entries"), std::string::npos);
}

TEST(SheetErrors, SayWhatToDo) {
    expect_mistakes(kInk, {{"width = \"=2", "8:12", "; is the closing quote missing?"},
                           {"color = \"#123456\nwidth = 2", "8:17", "; is the closing quote missing?"},
                           {"color = '#123456", "8:17", "; is the closing quote missing?"},
                           {"color = \xE2\x80\x9C#123456\xE2\x80\x9D", "8:9", "; quotes are written \" here"},
                           {"color = \xE2\x80\x98#123456\xE2\x80\x99", "8:9", "; quotes are written \" here"},
                           {"width = \"1cm\"", "8:9", "unknown unit 'cm': give px, mm, pt, % or world"},
                           {"width = \"2 in\"", "8:9", "unknown unit 'in': give px, mm, pt, % or world"},
                           {"width = \"wide\"", "8:9", "must be a number (pixels)"},
                           {"width = \"=lenght\"", "8:11", "unknown variable 'lenght', did you mean 'length'?"},
                           {"light = [0, 0, 1]", "8:1",
                            "unknown key 'light'; as a key of the whole file it belongs above the first table"},
                           {"[let]\nlight = 1", "9:9",
                            "choose another name; as a key of the whole file it belongs above the first table"},
                           {"[parameters]\nw = { value = \"1mm\", min = \"0.05mm\" }", "9:28",
                            "must be a number: it is in the unit of value, mm"},
                           {"[parameters]\nw = { value = 1, max = \"2mm\" }", "9:24",
                            "must be a number: it is in the unit of value, px"},
                           {"[styles.pen]\nwidth = 3", "8:2", "unknown key 'styles'; did you mean 'style'?"}});
    expect_mistakes("", {{"[set]\nname = \"a\"\n[[set]]\nname = \"b\"", "3:1", "; each of several is written [[set]]"},
                         {"[[set]]\nname = \"a\"\nclasses = \"crease\"\nstyle = \"ink\"\n[styles.ink]\nwidth = 3",
                          "5:2", "unknown key 'styles'; did you mean 'style'?"}});
    // Quotes within strings and comments are right.
    for (const char* text : {"a = \"it\xE2\x80\x99s\"\na = \"it\xE2\x80\x99s\"", "a = 1 x  # it\xE2\x80\x99s"})
        EXPECT_EQ(error_of(text).find("quotes are written"), std::string::npos) << text;
    const std::string select = "[style.ink]\n[[set]]\nname = \"a\"\nclasses = [\"crease\"]\nstyle = \"ink\"\nselect = ";
    expect_mistakes(select, {{"\"object == body\"", "6:21",
                              "unknown variable 'body'; names stand in double quotes: object == \"body\""}});
}

TEST(SheetErrors, OfSheetsWithTooManyValues) {
    const auto keys = [](std::size_t count) {
        std::string text = kInk + "[let]\n";
        for (std::size_t i = 0; i < count; ++i) text += "a" + std::to_string(i) + " = 1\n";
        return error_of(text);
    };
    const std::string words = "a style sheet of more than 30000 keys, tables and lists, or 120000 values";
    EXPECT_NE(keys(29980).find("there are more than 256 of them"), std::string::npos) << keys(29980);
    EXPECT_EQ(keys(30000).find("s.toml:"), 0u);
    EXPECT_NE(keys(30000).find(words), std::string::npos) << keys(30000);
    const auto list = [](std::size_t count, const std::string& value) {
        std::string text = kInk + "[groups]\nall = { objects = [";
        for (std::size_t i = 0; i < count; ++i) text += value + ", ";
        return error_of(text + "] }\n");
    };
    EXPECT_EQ(list(kMostPlainNames, "\"part[1],=\""), "");  // what stands in texts does not count
    EXPECT_NE(list(kMostPlainNames + 1, "\"part\"").find("objects: has more than"), std::string::npos);
    EXPECT_NE(list(120000, "\"part\"").find(words), std::string::npos);
    EXPECT_EQ(error_of(kInk + "# " + std::string(500000, '=')), "");
}

TEST(SheetErrors, OfTheCommandLine) {
    const std::string text = kInk + "width = \"=w\"\n[let]\nx1 = 1\n";
    const std::string sheet = "[parameters]\nw = { value = 2, max = 4 }\n" + text.substr(text.find("[[set]]"));
    EXPECT_EQ(error_of(sheet, {{"style.w", "3"}}), "");
    EXPECT_EQ(error_of(sheet, {{"style.ink.opacity", "=1 - t"}}), "");
    EXPECT_EQ(error_of(sheet, {{"style.set.a.enabled", "false"}}), "");
    EXPECT_EQ(error_of(sheet, {{"style.crease_angle", "30"}}), "");
    EXPECT_EQ(error_of(sheet, {{"style.w", "5"}}).find("usage: --set style.w=5: "), 0u);
    // The range stays in the unit that the sheet has: 1 mm is 96 / 25.4 px there.
    const std::string range = "must be at most 4, got 7.55905512 (2mm)";
    for (const char* key : {"style.w", "style.parameters.w.value"})
        EXPECT_NE(error_of(sheet, {{key, "2mm"}}).find(range), std::string::npos) << error_of(sheet, {{key, "2mm"}});
    EXPECT_EQ(error_of(sheet, {{"style.w", "1mm"}}), "");
    EXPECT_EQ(error_of(sheet, {{"style.w", "3pt"}}), "");  // exactly 4 px
    EXPECT_NE(error_of(sheet, {{"style.w", "3.001pt"}}), "");
    EXPECT_EQ(error_of(sheet, {{"style.parameters.w", "{ value = \"2mm\", max = 4 }"}}), "");
    const std::string in_mm =
        "[parameters]\nw = { value = \"2mm\", min = 1, max = 4 }\n" + text.substr(text.find("[[set]]"));
    EXPECT_EQ(error_of(in_mm, {{"style.w", "15"}}), "");
    EXPECT_NE(error_of(in_mm, {{"style.w", "3"}}).find("must be at least 1mm, got 0.79375mm (3px)"), std::string::npos);
    EXPECT_NE(error_of(in_mm, {{"style.w", "16"}}).find("must be at most 4mm"), std::string::npos);
    const std::string inked = "[parameters]\nred = \"#ff0000\"\nw = 2\n" + text.substr(text.find("[[set]]"));
    EXPECT_NE(error_of(inked, {{"style.red", "5"}}).find("the parameter is a colour, not a number"), std::string::npos);
    EXPECT_NE(error_of(inked, {{"style.w", "#00ff00"}}).find("the parameter is a number, not a colour"),
              std::string::npos);
    EXPECT_EQ(error_of(inked, {{"style.red", "#00ff00"}}), "");
    EXPECT_EQ(error_of(inked, {{"style.red", "[1, 0.5, 0]"}}), "");
    EXPECT_EQ(error_of(inked, {{"style.w", "0.5mm"}}), "");
    EXPECT_NE(error_of(sheet, {{"style.v", "5"}}).find("no parameter 'v'"), std::string::npos);
    EXPECT_NE(error_of(sheet, {{"style.inc.width", "5"}}).find("no style 'inc', did you mean 'ink'?"),
              std::string::npos);
    // What a sheet names is changed, not made.
    const std::string named = sheet + "[groups]\nwheels = { objects = [\"*\"] }\n[ramp.fade]\nstops = [[0, 1]]\n";
    const struct {
        const char *key, *words;
    } unknown[] = {{"style.let.x2", "the sheet has no let 'x2', did you mean 'x1'?; it has x1"},
                   {"style.ramp.fad.between", "the sheet has no ramp 'fad', did you mean 'fade'?; it has fade"},
                   {"style.groups.weels", "the sheet has no group 'weels', did you mean 'wheels'?; it has wheels"},
                   {"style.parameters.v", "the sheet has no parameter 'v', did you mean 'w'?; it has w"},
                   {"style.set.b.enabled", "the sheet has no set 'b', did you mean 'a'?; it has a"}};
    for (const auto& [key, words] : unknown)
        EXPECT_NE(error_of(named, {{key, "1"}}).find(words), std::string::npos) << error_of(named, {{key, "1"}});
    for (const char* key : {"style.let.x1", "style.parameters.w.max"}) EXPECT_EQ(error_of(named, {{key, "3"}}), "");
    EXPECT_EQ(error_of(sheet, {{"style.ink.widht", "5"}}).find("usage: --set style.ink.widht=5: "), 0u);
    const std::string fault = error_of(sheet, {{"style.ink.width", "=depht"}});
    EXPECT_NE(fault.find("usage: --set style.ink.width==depht: "), std::string::npos) << fault;
    EXPECT_NE(fault.find("character 2: unknown variable 'depht'"), std::string::npos) << fault;
}

TEST(Sheets, TakeListsOfNamesFromTheCommandLineAsTheyAreTyped) {
    const auto set_of = [](const std::string& key, const std::string& value) {
        return read_sheet_text(kInk, "s.toml", {{"style.set.a." + key, value}}).sets.front();
    };
    const LineClassSet both = LineClassSet(LineClass::silhouette) | LineClass::border;
    for (const char* value :
         {"silhouette,border", "silhouette, border", "[silhouette,border]", "[\"silhouette\", \"border\"]"})
        EXPECT_EQ(set_of("classes", value).classes, both) << value;
    const std::vector<std::string> names{"wheel*", "!wheel 2"};
    for (const char* value : {"wheel*,!wheel 2", "[wheel*, !wheel 2]", "[\"wheel*\", \"!wheel 2\"]"}) {
        EXPECT_EQ(set_of("objects", value).objects, names) << value;
        EXPECT_EQ(set_of("materials", value).materials, names) << value;
    }
    EXPECT_EQ(set_of("objects", "\"a,b\"").objects, std::vector<std::string>{"a,b"});
    EXPECT_EQ(set_of("objects", "body").objects, std::vector<std::string>{"body"});
}

TEST(Sheets, InheritAndTakeParameters) {
    const StyleSheet sheet = read_sheet_text(
        "[[set]]\nname=\"a\"\nclasses=\"crease\"\nstyle=\"c\"\n[style.c]\nbase=\"b\"\ncopies=2\ndash=\"solid\"\n"
        "[style.a]\nwidth=3\npriority=4\n[style.b]\nbase=\"a\"\nopacity=0.5\ndash=[1,2]\n",
        "s.toml", {{"style.a.width", "5"}});
    ASSERT_EQ(sheet.styles.size(), 3u);
    const SheetStyle& c = sheet.styles[0];
    EXPECT_EQ(c.name, "c");
    EXPECT_EQ(c.width.number, 5);
    EXPECT_EQ(c.opacity.number, 0.5);
    EXPECT_EQ(c.settings.priority, 4);
    EXPECT_EQ(c.settings.copies, 2);
    EXPECT_TRUE(c.dash.empty());
    EXPECT_EQ(sheet.styles[2].dash.size(), 2u);
    EXPECT_EQ(sheet.styles[2].settings.copies, 1);
}

TEST(Sheets, ThatTheProgramBringsAlongCompile) {
    ASSERT_GE(built_in_sheets().size(), 9u);
    for (const BuiltInSheet& built_in : built_in_sheets()) {
        const auto source = find_sheet(std::string(built_in.name), {});
        ASSERT_TRUE(source);
        const StyleSheet sheet = read_sheet(*source);
        EXPECT_FALSE(sheet.summary.empty()) << built_in.name;
        ASSERT_GE(sheet.parameters.size(), 2u);
        EXPECT_EQ(sheet.parameters[0].name, "width");
        EXPECT_EQ(sheet.parameters[1].name, "color");
        EXPECT_LE(std::count(built_in.text.begin(), built_in.text.end(), '\n'), 40) << built_in.name;
        const CompiledSheet compiled(sheet, context());
        EXPECT_FALSE(compiled.needs().classes.empty()) << built_in.name;
    }
}

}  // namespace
}  // namespace burin::sheet_toml_test
