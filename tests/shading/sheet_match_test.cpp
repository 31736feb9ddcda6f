// Matching finds the sets that a reference finds which asks each set, piece by piece, with names.

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "scene/sheet_toml.h"
#include "shading/expression/glob.h"
#include "shading/sheet/compiled_sheet.h"
#include "tests/support/random.h"

namespace burin::test {
namespace {

const std::vector<std::string> kObjects{"wheel_a", "wheel_b", "wheel_spare", "body", "door"};
const std::vector<std::string> kMaterials{"steel", "glass", "steel_dark"};

struct Piece {
    LineClassSet classes;
    int qi = 0;
    std::size_t object = 0, object2 = 0, material = 0, material2 = 0;
    float convex = 0;
};

std::string name_in(const std::vector<std::string>& names, std::size_t number) {
    return number == 0 ? "" : names[number - 1];
}

/// A condition as it is written, and as it is decided by names.
struct Condition {
    const char* text;
    bool (*holds)(const Piece&, LineClass drawn_as);
};

const std::vector<std::string> kWheels{"wheel*", "!*spare"};
bool is_wheel(const Piece& p) { return p.object > 0 && matches_globs(kWheels, kObjects[p.object - 1]); }

const Condition kConditions[] = {
    {"", [](const Piece&, LineClass) { return true; }},
    {"object in wheels", [](const Piece& p, LineClass) { return is_wheel(p); }},
    {"=object in wheels and object2 != object",
     [](const Piece& p, LineClass) { return is_wheel(p) && p.object2 != p.object; }},
    {"object2 == 0", [](const Piece& p, LineClass) { return p.object2 == 0; }},
    {"material == 'steel*'", [](const Piece& p, LineClass) { return p.material == 1 || p.material == 3; }},
    {"not (qi > 1)", [](const Piece& p, LineClass) { return p.qi <= 1; }},
    {"class == 'crease' or is_border",
     [](const Piece& p, LineClass c) { return c == LineClass::crease || p.classes.has(LineClass::border); }},
    {"between_materials('steel', 'glass')",
     [](const Piece& p, LineClass) {
         return (p.material == 1 && p.material2 == 2) || (p.material == 2 && p.material2 == 1);
     }},
    {"convex > 0", [](const Piece& p, LineClass) { return p.convex > 0; }},
    {"object != 'door'", [](const Piece& p, LineClass) { return name_in(kObjects, p.object) != "door"; }},
};

struct Set {
    LineClassSet classes;
    std::array<int, 2> qi{0, 0};
    std::vector<std::string> objects, materials;
    const Condition* condition = nullptr;
    bool also = false, enabled = true;
};

std::string list(const std::vector<std::string>& texts) {
    std::string result;
    for (const std::string& text : texts) result += (result.empty() ? "\"" : ", \"") + text + "\"";
    return "[" + result + "]";
}

/// A quarter of all classes.
LineClassSet random_classes(Random& random) {
    const auto half = [&random] {
        return LineClassSet::from_bits(static_cast<unsigned>(random.integer(0, (1 << kLineClassCount) - 1)));
    };
    return half() & half();
}

Set random_set(Random& random) {
    Set set;
    while (set.classes.empty()) set.classes = random_classes(random);
    constexpr std::array<std::array<int, 2>, 5> kRanges{{{0, 0}, {1, 255}, {0, 255}, {2, 3}, {0, 1}}};
    set.qi = kRanges[static_cast<std::size_t>(random.integer(0, 4))];
    const std::vector<std::vector<std::string>> globs{{}, {}, {"wheel*"}, {"!body"}, {"*", "!wheel_?"}, {"none"}};
    set.objects = globs[static_cast<std::size_t>(random.integer(0, 5))];
    const std::vector<std::vector<std::string>> of_materials{{}, {}, {}, {"steel"}, {"!steel*"}};
    set.materials = of_materials[static_cast<std::size_t>(random.integer(0, 4))];
    set.condition =
        &kConditions[static_cast<std::size_t>(random.integer(0, static_cast<int>(std::size(kConditions)) - 1))];
    set.also = random.integer(0, 1) == 0;
    set.enabled = random.integer(0, 5) != 0;
    return set;
}

std::string text_of(const std::vector<Set>& sets) {
    std::string text = "[groups]\nwheels = { objects = " + list(kWheels) + " }\n[style.ink]\n";
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const Set& set = sets[i];
        std::vector<std::string> classes;
        for (std::size_t c = 0; c < kLineClassCount; ++c) {
            if (set.classes.has(static_cast<LineClass>(c))) classes.emplace_back(kLineClassNames[c]);
        }
        text += "[[set]]\nname = \"s" + std::to_string(i) + "\"\nstyle = \"ink\"\nclasses = " + list(classes) +
                "\nqi = [" + std::to_string(set.qi[0]) + ", " + std::to_string(set.qi[1]) + "]\n";
        if (!set.objects.empty()) text += "objects = " + list(set.objects) + "\n";
        if (!set.materials.empty()) text += "materials = " + list(set.materials) + "\n";
        std::string select = set.condition->text;
        for (char& c : select) c = c == '\'' ? '"' : c;
        if (!select.empty()) text += "select = '" + select + "'\n";
        text += std::string("also = ") + (set.also ? "true" : "false") +
                "\nenabled = " + (set.enabled ? "true\n" : "false\n");
    }
    return text;
}

bool takes(const std::vector<std::string>& globs, const std::vector<std::string>& names, std::size_t a, std::size_t b) {
    if (globs.empty()) return true;
    for (const std::size_t number : {a, b}) {
        if (number > 0 && matches_globs(globs, names[number - 1])) return true;
    }
    return false;
}

std::vector<std::uint16_t> reference(const std::vector<Set>& sets, const Piece& piece) {
    LineClassSet asked;
    for (const Set& set : sets) asked |= set.enabled ? set.classes : LineClassSet();
    std::vector<std::uint16_t> found;
    const auto drawn_as = (piece.classes & asked).first();
    for (std::size_t i = 0; i < sets.size() && drawn_as; ++i) {
        const Set& set = sets[i];
        if (!set.enabled || !set.classes.has(*drawn_as) || piece.qi < set.qi[0] || piece.qi > set.qi[1] ||
            !takes(set.objects, kObjects, piece.object, piece.object2) ||
            !takes(set.materials, kMaterials, piece.material, piece.material2) ||
            !set.condition->holds(piece, *drawn_as))
            continue;
        found.push_back(static_cast<std::uint16_t>(i));
        if (!set.also) break;
    }
    return found;
}

TEST(SheetMatch, FindsWhatAskingEachSetFinds) {
    std::size_t several = 0, none = 0, one = 0;
    for (std::uint64_t trial = 0; trial < 200; ++trial) {
        Random random(trial);
        std::vector<Set> sets;
        for (int i = random.integer(1, 8); i > 0; --i) sets.push_back(random_set(random));
        SheetContext context;
        context.objects = kObjects;
        context.materials = kMaterials;
        const CompiledSheet sheet(read_sheet_text(text_of(sets), "s.toml"), context);

        const std::size_t count = trial % 10 == 0 ? 2500 : 70;
        std::vector<Piece> pieces(count);
        std::vector<LineClassSet> classes;
        std::vector<std::uint8_t> qi;
        std::array<std::vector<float>, 5> columns;
        for (Piece& p : pieces) {
            const auto number = [&](std::size_t most) {
                return static_cast<std::size_t>(random.integer(0, static_cast<int>(most)));
            };
            p = {random_classes(random),
                 random.integer(0, 4),
                 number(5),
                 number(5),
                 number(3),
                 number(3),
                 static_cast<float>(random.integer(-1, 1))};
            classes.push_back(p.classes);
            qi.push_back(static_cast<std::uint8_t>(p.qi));
            columns[0].push_back(static_cast<float>(p.object));
            columns[1].push_back(static_cast<float>(p.object2));
            columns[2].push_back(static_cast<float>(p.material));
            columns[3].push_back(static_cast<float>(p.material2));
            columns[4].push_back(p.convex);
        }
        MatchInput input{count, classes, qi, {}};
        constexpr Variable kVariables[] = {Variable::object, Variable::object2, Variable::material, Variable::material2,
                                           Variable::convex};
        for (std::size_t k = 0; k < 5; ++k) {
            // Only what the sheet says that it reads.
            if (sheet.select_variables().has(kVariables[k])) input.columns.of(kVariables[k]) = columns[k].data();
        }
        const SetMatches matches = sheet.match(input);
        ASSERT_EQ(matches.first.size(), count + 1);
        for (std::size_t i = 0; i < count; ++i) {
            const auto found = matches.of(i);
            const std::vector<std::uint16_t> expected = reference(sets, pieces[i]);
            EXPECT_EQ(std::vector<std::uint16_t>(found.begin(), found.end()), expected) << trial << " " << i << "\n"
                                                                                        << text_of(sets);
            (expected.empty() ? none : expected.size() == 1 ? one : several) += 1;
        }
    }
    EXPECT_GT(none, 1000u);
    EXPECT_GT(one, 1000u);
    EXPECT_GT(several, 100u);
}

CompiledSheet compiled(const std::string& style, const std::string& set = "", const SheetContext& context = {}) {
    return {read_sheet_text("[style.ink]\n" + style + "\n[[set]]\nname='a'\nclasses=['crease']\nstyle='ink'\n" + set,
                            "s.toml"),
            context};
}

float constant(const CompiledSheet& sheet, InkValue value) {
    const ExpressionProgram& ink = sheet.styles()[0].ink;
    std::array<float, kInkColumnCount> values{};
    std::array<float*, kInkColumnCount> to{};
    for (std::size_t k = 0; k < values.size(); ++k) to[k] = &values[k];
    std::array<NotNumbers, kInkValueCount> not_numbers;
    ink.evaluate({}, 1, to, not_numbers);
    EXPECT_TRUE(sheet.styles()[0].is_constant(value));
    return values[static_cast<std::size_t>(value)];
}

TEST(CompiledSheet, UnitsBecomePixels) {
    SheetContext context;
    context.height_px = 500;
    context.px_per_mm = 10;
    const auto width = [&](const char* value) {
        return constant(compiled("width = " + std::string(value), "", context), InkValue::width);
    };
    EXPECT_EQ(width("2"), 2);
    EXPECT_EQ(width("\"2px\""), 2);
    EXPECT_EQ(width("\"0.5mm\""), 5);
    EXPECT_FLOAT_EQ(width("\"72pt\""), 254);
    EXPECT_EQ(width("\"0.2%\""), 1);
    EXPECT_EQ(width("\"=height_px / 100\""), 5);
    EXPECT_EQ(width("\"=1mm + 1\""), 11);
    EXPECT_EQ(width("\"=1 / 0\""), 4096);
    EXPECT_EQ(width("\"1000%\""), 4096);  // a picture of another size may have room for it
    EXPECT_EQ(compiled("smooth = \"1000%\"", "", context).styles()[0].smooth_px, 1024);
    EXPECT_THROW(width("\"500mm\""), InputError);
    const CompiledSheet world = compiled("width = \"0.2world\"");
    EXPECT_FALSE(world.styles()[0].is_constant(InkValue::width));
    EXPECT_TRUE(world.needs().variables.has(Variable::px_size));
    context.frame = 2;
    context.fps = 4;
    EXPECT_EQ(constant(compiled("opacity = \"=frame / 8 + time\"", "", context), InkValue::opacity), 0.75f);
}

TEST(CompiledSheet, SaysWhatItNeeds) {
    const SheetNeeds plain = compiled("width = 2").needs();
    EXPECT_EQ(plain.classes, LineClassSet(LineClass::crease));
    EXPECT_TRUE(plain.variables.empty());
    EXPECT_FALSE(plain.sides || plain.chains || plain.tells_invisibility || plain.one_sided);
    EXPECT_EQ(plain.most_invisibility, 0);
    EXPECT_EQ(plain.most_reach_px, 1);
    const SheetNeeds sides = compiled("color = \"=rgb(C.g, 0, 0)\"").needs();
    EXPECT_TRUE(sides.sides && sides.variables.has(Variable::C, 1) && !sides.variables.has(Variable::C, 0));
    EXPECT_TRUE(compiled("width = \"=t\"").needs().chains);
    for (const char* key : {"dash = [1, 2]", "taper = { start = 3 }", "overshoot = 2", "offset = 1", "copies = 2",
                            "smooth = 3", "min_length = 2", "wobble = {}", "caps = \"butt\""})
        EXPECT_TRUE(compiled(key).needs().chains) << key;
    // What hidden lines need is not asked of visible ones.
    for (const char* const qi : {"", "qi = [0, 1]", "qi = 1", "qi = [2, 255]"}) {
        const SheetNeeds needs = compiled("dash = [1, 2]\nside = \"inside\"", qi).needs();
        const bool takes_visible = std::string_view(qi).empty() || qi[6] == '0';
        EXPECT_EQ(needs.chains, takes_visible) << qi;
        EXPECT_EQ(needs.one_sided, takes_visible) << qi;
        EXPECT_EQ(needs.hidden_chains, needs.most_invisibility > 0) << qi;
    }
    EXPECT_TRUE(compiled("wobble = {}").needs().variables.has(Variable::PO));
    EXPECT_FALSE(compiled("width = 2", "qi = [1, 255]").needs().tells_invisibility);
    EXPECT_EQ(compiled("width = 2", "qi = [1, 255]").needs().most_invisibility, 255);
    EXPECT_TRUE(compiled("width = 2", "qi = [1, 2]").needs().tells_invisibility);
    EXPECT_TRUE(compiled("width = \"=qi\"").needs().tells_invisibility);
    EXPECT_TRUE(compiled("width = \"=t\"", "enabled = false").needs().classes.empty());
    EXPECT_FALSE(compiled("width = \"=t\"", "enabled = false").needs().chains);
}

}  // namespace
}  // namespace burin::test
