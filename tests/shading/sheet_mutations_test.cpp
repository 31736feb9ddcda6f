// Whatever a style sheet has in it, it is read and compiled, or it is an error with a place; and neither takes long.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scene/sheet_library.h"
#include "scene/sheet_toml.h"
#include "shading/line_shader.h"
#include "shading/sheet/compiled_sheet.h"
#include "tests/support/random.h"

namespace burin::test {
namespace {

struct NoShader final : LineShader {
    VariableSet needs() const override { return {}; }
    void shade(const StrokeSamples&, StrokeInk&) const override {}
};
struct NoTest final : LineTest {
    VariableSet needs() const override { return {}; }
    void test(const StrokeSamples&, std::span<float>) const override {}
};

SheetContext context() {
    static const LineShaders shaders{{{"mine", std::make_shared<NoShader>()}}, {{"mine", std::make_shared<NoTest>()}}};
    SheetContext context;
    context.shaders = &shaders;
    context.objects = {"wheel_left", "wheel_spare", "body"};
    context.materials = {"steel", "glass"};
    return context;
}

/// Every key that a sheet may have, and the sheets that the program brings along.
std::vector<std::string> sheets() {
    std::vector<std::string> texts{R"toml(style_version = 1
summary = "all of it"
crease_angle = [30, 40]
contours = "smooth"
filter = "mitchell"
light = [-1, 1, 1]
[parameters]
width = { value = "0.35mm", min = 0, max = 200 }
ink = "#102030"
n = 3
[groups]
wheels = { objects = ["wheel*", "!*spare"], materials = ["steel"] }
[let]
shade = "=1 - light"
edge = "=smoothstep(0, 1, shade) * n"
[ramp.fade]
stops = [[0, 1], [10, 0.5], [40, 0]]
between = "curve"
outside = "mirror"
[[set]]
name = "outline"
classes = ["silhouette", "border"]
select = "object in wheels and object2 != object or between_materials(\"steel\", \"glass\")"
objects = ["!body"]
materials = ["*"]
also = true
layer = true
style = "brush"
test = "mine"
[[set]]
name = "hidden"
classes = ["crease", "mark"]
qi = [1, 255]
enabled = false
layer = "behind"
style = "dots"
[style.brush]
width = "=width * mix(0.5, 1.8, edge)"
color = "=mix(ink, C, ramp(\"fade\", depth))"
opacity = { over = "t", stops = [[0, 0], [1, 1]], between = "smooth", outside = "repeat" }
offset = "0.02world"
side = "outside"
taper = { start = 24, end = "=2 * n", shape = "sharp", at = "all" }
caps = "butt"
overshoot = "=rand_chain * 4 - 2"
wobble = { amplitude = 1, wavelength = "1mm", octaves = 2, anchor = "chain", pin = false }
copies = 3
halo = 3
halo_depth = [2, 50]
min_length = [3, 9]
smooth = 4
priority = 2
blend = "multiply"
seed = 7
hold = 2
boil = true
shader = "mine"
[style.dots]
base = "brush"
width = { over = "depth", stops = [[4, "1.2mm"], [40, "0.3mm"]] }
taper = "none"
wobble = "none"
dash = [0.5, 3, "=n", 2]
dash_phase = 1.5
)toml"};
    for (const BuiltInSheet& sheet : built_in_sheets()) texts.emplace_back(sheet.text);
    return texts;
}

std::string mutated(std::string text, Random& random, const std::vector<std::string>& all) {
    static const std::vector<std::string> parts{"=",
                                                "\"",
                                                "[",
                                                "]",
                                                "{",
                                                "}",
                                                "\n",
                                                "#",
                                                "1e999",
                                                "nan",
                                                "-",
                                                "mm",
                                                "world",
                                                "true",
                                                "[[set]]\n",
                                                "[style.x]\n",
                                                "base = \"dots\"\n",
                                                "=depht",
                                                "\\u0031",
                                                "\"\"\"",
                                                ",",
                                                "[let]\na = \"=a\"\n",
                                                "qi = 3\n",
                                                "\xC3\xA9",
                                                "= \"=P\"",
                                                "[ramp.r]\nstops = [[0, 1]]\n",
                                                "over = \"t\""};
    const auto place = [&] { return static_cast<std::size_t>(random.integer(0, static_cast<int>(text.size()))); };
    const auto line_at = [&](std::size_t at) {
        const std::size_t begin = text.rfind('\n', at == 0 ? 0 : at - 1), end = text.find('\n', at);
        const std::size_t first = begin == std::string::npos ? 0 : begin + 1;
        return std::pair(first, end == std::string::npos ? text.size() : end + 1);
    };
    for (int k = random.integer(1, 3); k > 0 && !text.empty(); --k) {
        const std::size_t at = place();
        switch (random.integer(0, 8)) {
            case 0:
                text.erase(at, static_cast<std::size_t>(random.integer(1, 6)));
                break;
            case 1:
                text.insert(at, 1, static_cast<char>(random.integer(0, 255)));
                break;
            case 2:
                if (at < text.size()) text[at] = text[place() % text.size()];
                break;
            case 3:
                text.insert(at, parts[static_cast<std::size_t>(random.integer(0, static_cast<int>(parts.size()) - 1))]);
                break;
            case 4:    // a line goes
            case 5: {  // or comes again, elsewhere
                const auto [first, end] = line_at(at);
                const std::string line = text.substr(first, end - first);
                if (random.integer(0, 1) == 0) text.erase(first, end - first);
                text.insert(line_at(place()).first, line);
                break;
            }
            case 6: {  // a line of another sheet
                const std::string& other =
                    all[static_cast<std::size_t>(random.integer(0, static_cast<int>(all.size()) - 1))];
                const std::size_t from =
                    other.find('\n', static_cast<std::size_t>(random.integer(0, static_cast<int>(other.size()) - 2)));
                if (from + 1 < other.size())
                    text.insert(line_at(at).first, other.substr(from + 1, other.find('\n', from + 1) - from));
                break;
            }
            case 7: {  // a number becomes another one
                const std::size_t digit = text.find_first_of("0123456789", at);
                if (digit != std::string::npos) text[digit] = static_cast<char>('0' + random.integer(0, 9));
                break;
            }
            default: {
                const std::string part = text.substr(at, static_cast<std::size_t>(random.integer(0, 60)));
                text.insert(place(), part);
            }
        }
    }
    return text;
}

/// What is wrong with a sheet; empty: nothing.
std::string error_of(const std::string& text) {
    try {
        const CompiledSheet compiled(read_sheet_text(text, "s.toml"), context());
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(SheetMutations, TheSheetsThemselvesAreRight) {
    for (const std::string& text : sheets()) EXPECT_EQ(error_of(text), "") << text;
}

TEST(SheetMutations, EndInASheetOrAnErrorWithAPlace) {
    constexpr std::uint64_t kTrials = 100000;
    const std::vector<std::string> texts = sheets();
    std::uint64_t right = 0;
    for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
        Random random(trial);
        const std::size_t which = trial % texts.size();
        const std::string text = mutated(texts[which], random, texts);
        const std::string error = error_of(text);
        if (error.empty()) {
            ++right;
            continue;
        }
        ASSERT_EQ(error.find("s.toml:"), 0u) << trial << ": " << error;
        ASSERT_EQ(error.find('\n'), std::string::npos) << trial << ": " << error;
        std::size_t end = 0;
        const std::string behind = error.substr(std::string("s.toml:").size());
        const auto line = std::stoul(behind, &end);
        ASSERT_GE(line, 1u) << trial;
        ASSERT_LE(line, 2 + static_cast<unsigned long>(std::count(text.begin(), text.end(), '\n'))) << trial << error;
        ASSERT_EQ(behind[end], ':') << trial << ": " << error;
    }
    EXPECT_GT(right, kTrials / 20);
    EXPECT_LT(right, kTrials / 2);
}

std::string repeated(const std::string& part, std::size_t size) {
    std::string text;
    while (text.size() + part.size() <= size) text += part;
    return text;
}

const std::string kSet = "[[set]]\nname = \"a\"\nclasses = [\"crease\"]\nstyle = \"s\"\n";

/// Compiling all of these takes from a tenth of a second to many: what is too much work is refused before it is done.
TEST(SheetMutations, TooMuchWorkIsRefused) {
    const std::string sum = "=" + repeated("noise(s)+", 4000) + "1";
    std::string inherited = kSet + "[style.s]\nwidth = \"" + sum + "\"\nopacity = \"" + sum + "\"\n";
    for (int i = 0; i < 63; ++i) inherited += "[style.s" + std::to_string(i) + "]\nbase = \"s\"\n";
    std::string styles = kSet + "[style.s]\n", lets = styles + "[let]\n", faulty = lets, selects = "[style.s]\n";
    for (int i = 0; i < 60; ++i) {
        const std::string number = std::to_string(i);
        styles += "[style.s" + number + "]\nwidth = \"" + sum + "\"\n";
        lets += "a" + number + " = \"" + sum + "\"\n";
        faulty += "a" + number + " = \"=" + repeated("t+", 2000) + "a" + std::to_string(i + 1) + "\"\n";
        selects += "[[set]]\nname = \"" + number + "\"\nclasses = [\"crease\"]\nstyle = \"s\"\nselect = '" +
                   repeated("class == \"c*\" or ", 4000) + "1'\n";
    }
    for (const std::string& text : {inherited, styles, lets, faulty, selects}) {
        const std::string error = error_of(text);
        EXPECT_NE(error.find("the expressions of this sheet are too many or too long"), std::string::npos)
            << text.substr(0, 200) << "\n"
            << error;
    }
}

/// Patterns are matched with the names of a scene, which may have many.
TEST(SheetMutations, PatternsForManyObjectsAreWork) {
    SheetContext many;
    for (int i = 0; i < 3000; ++i) many.objects.push_back("object" + std::to_string(i));
    std::string patterns;
    for (int i = 0; i < 256; ++i) patterns += "\"*" + std::to_string(i) + "*x*\", ";
    const auto compile = [&](const std::string& select) {
        const std::string text =
            "[groups]\nall = { objects = [" + patterns + "] }\n[style.s]\n" + kSet + "select = '" + select + "'\n";
        try {
            const CompiledSheet compiled(read_sheet_text(text, "s.toml"), many);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(compile("object in all or object2 in all or object == \"object1?\""), "");
    const std::string error = compile(repeated("object in all or ", 4000) + "1");
    EXPECT_NE(error.find("the expressions of this sheet are too many or too long"), std::string::npos) << error;
}

/// Programs write down all names of a collection.
TEST(SheetMutations, NamesOfManyObjectsAreNot) {
    SheetContext many;
    std::string names;
    for (int i = 0; i < 20000; ++i) {
        many.objects.push_back("object" + std::to_string(i));
        if (i % 2 == 0) names += "\"object" + std::to_string(i) + "\", ";
    }
    const std::string text = "[groups]\nall = { objects = [" + names + "] }\n[style.s]\n" + kSet + "objects = [" +
                             names + "]\nselect = 'not (object in all) or object2 in all'\n";
    EXPECT_NO_THROW(const CompiledSheet compiled(read_sheet_text(text, "s.toml"), many));
}

/// What people write is far from that.
TEST(SheetMutations, ALargeSheetIsNotTooMuch) {
    std::string text = kSet + "[let]\n";
    for (int i = 0; i < 20; ++i)
        text += "part" + std::to_string(i) + " = \"=smoothstep(0.1, 0.9, 1 - facing) * (1 + 0.5 * light)\"\n";
    text +=
        "[style.s]\nwidth = \"=1.2 * (part0 + part1 + part2 + part3) * (1 + 0.3 * noise(s / 12, rand_chain))\"\n"
        "opacity = \"=exp(-depth / 50) * part4\"\ncolor = \"=mix(C, C2, fbm(P, 4))\"\n"
        "dash = [\"=length / 20\", 3]\ntaper = { start = \"=length / 9\" }\n";
    for (int i = 0; i < 40; ++i) text += "[style.s" + std::to_string(i) + "]\nbase = \"s\"\nwidth = \"=part5 * 2\"\n";
    EXPECT_EQ(error_of(text), "");
}

}  // namespace
}  // namespace burin::test
