// Trees that would take more stack than there is are refused by their depth, however it comes
// about.

#include "scene/toml_depth.h"

#include <gtest/gtest.h>

#include "scene/toml_reader.h"
#include "tests/scene/scene_text.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;
using test::SceneText;

std::string repeated(const std::string& text, int count) {
    std::string result;
    for (int i = 0; i < count; ++i) result += text;
    return result;
}

TEST(TomlDepth, CountsWhateverMakesATreeDeep) {
    const std::string dots = "a" + repeated(".a", 100);
    for (const std::string& deep :
         {dots + " = 1", "[" + dots + "]", "[[" + dots + "]]", "\"=\"" + repeated(".\"=\"", 100) + " = 1",
          "'['" + repeated(" . '#'", 100) + " = 1", "\"\\\"\"" + repeated(".\"\\\\\"", 100) + " = 1",
          "x = " + repeated("[", 100) + repeated("]", 100), "x = " + repeated("{ a = ", 100) + "1" + repeated("}", 100),
          "x = [\n" + repeated("[ # [\n", 100),
          "[a.b.c.d.e.f.g.h]\n" + std::string("a") + repeated(".b", 30) + " = {" + repeated("c.", 20) + "d = [[[1]]]}",
          "[[" + std::string("a") + repeated(".b", 20) + "]]\nx" + repeated(".y", 30) + " = 1",
          "x = \"\"\"\" a \"\"\"\"\ny" + repeated(".y", 100) + " = 1",
          "x = '''' a ''''' \ny" + repeated(".y", 100) + " = 1", "x = {" + dots + " = 1}",
          "x = [1, {a = 1, " + dots + " = 1}]"}) {
        EXPECT_TRUE(line_nested_too_deep("a = 1\n" + deep + "\n").has_value()) << deep.substr(0, 60);
        const std::string error = SceneText(std::string(test::kBox) + deep + "\n").error();
        EXPECT_TRUE(error.starts_with("scene.toml:") && error.find("nested more than 64 deep") != std::string::npos)
            << error;
    }
    EXPECT_EQ(line_nested_too_deep("a = 1\n\n" + dots + " = 1\n"), 3u);
    EXPECT_EQ(line_nested_too_deep("a = \"\"\"\n\\\n\n\"\"\"\n" + dots + " = 1\n"), 5u);
}

TEST(TomlDepth, LeavesFlatTextsAlone) {
    for (const std::string& flat :
         {"a = \"" + repeated(".", 1000) + "\"", "# " + repeated("[.", 1000), "a = '" + repeated("[", 1000) + "'",
          "a = \"\"\"\n" + repeated("[{.\n", 1000) + "\"\"\"", "a = '''\n" + repeated("[{.\\\n", 1000) + "'''",
          "a = [" + repeated("1.5, ", 1000) + "]", "a = [" + repeated("[1.5, 2.5], ", 1000) + "]",
          repeated("[[a.b]]\nc.d = 1.5\n", 1000), "\"" + repeated(".", 1000) + "\" = 1",
          repeated("a = \"\\\\\" # \"\n", 100), "x = {" + repeated("a.b = 1, ", 1000) + "}"}) {
        EXPECT_FALSE(line_nested_too_deep(flat).has_value()) << flat.substr(0, 60);
    }
}

std::size_t depth_of(const toml::node& node) {
    std::size_t deepest = 0;
    if (const toml::table* table = node.as_table()) {
        for (const auto& [key, value] : *table) deepest = std::max(deepest, depth_of(value));
    } else if (const toml::array* array = node.as_array()) {
        for (const toml::node& value : *array) deepest = std::max(deepest, depth_of(value));
    }
    return deepest + 1;
}

/// No text that toml++ reads gives a tree deeper than the limit, but for its root, unless it is
/// refused before.
TEST(TomlDepth, NoTreeIsDeeperThanItsTextSays) {
    int read = 0, refused = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        Random random(seed);
        const auto word = [&] {
            static const char* const kWords[] = {"a",   "b", "\"=\"", "'['",  "\"\\\"\"", "\"\"",
                                                 "'#'", "1", "\"'\"", "'\"'", "-"};
            return std::string(kWords[random.integer(0, 10)]);
        };
        const auto key = [&] {
            std::string text = word();
            for (int i = random.integer(0, random.integer(0, 4) == 0 ? 60 : 6); i > 0; --i)
                text += (random.integer(0, 3) == 0 ? " . " : ".") + word();
            return text;
        };
        const std::function<std::string(int)> value = [&](int depth) -> std::string {
            static const char* const kValues[] = {
                "1.5",      "\"]\"", "'}'", "\"\"\"\n\"\\\"\"\"\"", "''''[''''", "1979-05-27T00:32:00.999",
                "\"\\\\\"", "true"};
            if (depth <= 0) return kValues[random.integer(0, 7)];
            if (random.integer(0, 1) == 0)
                return "[" + value(depth - 1) + (random.integer(0, 1) == 0 ? ",# ]\n" : "\n,") + value(0) + "]";
            return "{" + key() + " = " + value(depth - 1) + ", z" + std::to_string(depth) + " = " + value(0) + "}";
        };
        std::string text;
        for (int i = random.integer(1, 3); i > 0; --i) {
            if (random.integer(0, 1) == 0)
                text += random.integer(0, 1) == 0 ? "[" + key() + "] # [\n" : "[[" + key() + "]]\r\n";
            text += key() + " = " + value(random.integer(0, random.integer(0, 3) == 0 ? 60 : 5)) + "\n";
        }
        const bool is_refused = line_nested_too_deep(text).has_value();
        try {
            const toml::table tree = toml::parse(text);
            ++(is_refused ? refused : read);
            if (is_refused) continue;
            EXPECT_LE(depth_of(tree), kMaxTomlDepth + 1) << text;
        } catch (const toml::parse_error&) {
        }
    }
    EXPECT_GT(read, 500);
    EXPECT_GT(refused, 50);
}

TEST(TomlDepth, OverridesToo) {
    const SceneText text(test::kBox);
    for (const std::string& value : {repeated("[", 1000) + repeated("]", 1000), "{a" + repeated(".a", 60000) + " = 1}",
                                     "{" + std::string("\"=\"") + repeated(".\"=\"", 40000) + " = 1}"}) {
        EXPECT_NE(text.usage_error("object.0.size", value).find("nested more than 64 deep"), std::string::npos);
    }
}

}  // namespace
}  // namespace burin
