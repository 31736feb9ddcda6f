// What the Tab key offers: commands, options and values that the program then takes.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::completion_test {
namespace {

using Words = std::vector<std::string>;

class Completion : public testing::Test {
  protected:
    Words lines_for(Words typed) const {
        typed.insert(typed.begin(), "--complete");
        const ProgramResult result = run_burin(folder_.path(), typed);
        EXPECT_EQ(result.status, 0);
        EXPECT_EQ(result.err, "");
        std::istringstream text(result.out);
        Words lines;
        for (std::string line; std::getline(text, line);) lines.push_back(line);
        return lines;
    }
    /// Without descriptions.
    Words offered(const Words& typed) const {
        Words words;
        for (const std::string& line : lines_for(typed)) words.push_back(line.substr(0, line.find('\t')));
        return words;
    }
    const TemporaryFolder folder_;
};

TEST_F(Completion, Commands) {
    EXPECT_EQ(offered({"re"}), (Words{"render", "restyle"}));
    EXPECT_EQ(lines_for({"expl"}), (Words{"explain\tshow how one pixel was decided"}));
    EXPECT_GE(offered({""}).size(), 9u);
    EXPECT_EQ(offered({"--ver"}), (Words{"--version"}));
    EXPECT_TRUE(offered({}).empty());
    EXPECT_TRUE(offered({"nothing", ""}).empty());
}

TEST_F(Completion, Options) {
    EXPECT_EQ(offered({"render", "--cr"}), (Words{"--crease-angle", "--crop"}));
    EXPECT_EQ(offered({"render", "model.obj", "--hidden", "dashed", "--cre"}), (Words{"--crease-angle"}));
    EXPECT_EQ(offered({"-q", "info", "--js"}), (Words{"--json"}));
    EXPECT_TRUE(offered({"info", "--crease"}).empty());
}

TEST_F(Completion, Values) {
    EXPECT_EQ(offered({"render", "--hidden", ""}), (Words{"none", "solid", "dashed"}));
    EXPECT_EQ(offered({"render", "--hidden=d"}), (Words{"--hidden=dashed"}));
    EXPECT_EQ(offered({"render", "-m", "gb"}), (Words{"gbuffer"}));
    EXPECT_EQ(offered({"render", "--style", "arch"}), (Words{"architect", ":files toml"}));
    EXPECT_EQ(offered({"styles", "arch"}), (Words{"architect"}));
    EXPECT_EQ(offered({"render", "--page", "p"}), (Words{"patent", "plotter"}));
    EXPECT_TRUE(offered({"render", "--fov", ""}).empty());
    // A flag takes no value.
    EXPECT_EQ(offered({"render", "--strict", ""}), offered({"render", ""}));
}

TEST_F(Completion, ListsGoOnBehindACommaWithoutWhatIsThere) {
    EXPECT_EQ(offered({"render", "--lines", "crease,si"}), (Words{"crease,silhouette"}));
    EXPECT_EQ(offered({"render", "--lines", "crease,cr"}), Words{});
    EXPECT_EQ(offered({"compare", "--methods=patel,sv"}), (Words{"--methods=patel,svg"}));
    EXPECT_EQ(offered({"render", "--hidden", "none,d"}), Words{});
    // What contradicts the rest of a list, or says nothing more.
    EXPECT_EQ(offered({"render", "--lines", "a"}), (Words{"all"}));
    EXPECT_EQ(offered({"render", "--lines", "n"}), (Words{"none"}));
    for (const char* typed : {"all,", "none,", "crease,n", "crease,a", "crease,border,n"})
        EXPECT_EQ(offered({"render", "--lines", typed}), Words{}) << typed;
}

TEST_F(Completion, ParametersOfTheStyleSheet) {
    const Words of_pencil = offered({"render", "--style", "pencil", "--set", "style."});
    EXPECT_NE(std::find(of_pencil.begin(), of_pencil.end(), "style.roughness="), of_pencil.end());
    EXPECT_EQ(offered({"render", "--style=pencil", "a.obj", "--set", "style.rou"}), (Words{"style.roughness="}));
    EXPECT_EQ(offered({"restyle", "--style", "pencil", "--set=style.rou"}), (Words{"--set=style.roughness="}));
    EXPECT_EQ(offered({"view", "--style", "pencil", "--set", "style.rou"}), (Words{"style.roughness="}));
    // A value stands there already.
    for (const char* typed : {"style.roughness=", "style.roughness=3"})
        EXPECT_EQ(offered({"render", "--style", "pencil", "--set", typed}), Words{}) << typed;
    folder_.write("mine.toml",
                  "style_version = 1\n[parameters]\nreach = 2\n[[set]]\nname = \"a\"\nclasses = [\"crease\"]\n"
                  "style = \"b\"\n[style.b]\nwidth = \"=reach\"\n");
    EXPECT_EQ(offered({"render", "--style", "mine.toml", "--set", ""}), (Words{"style.reach="}));
    folder_.write("wrong.toml", "style_version = 1\n[[set\n");
    for (const char* sheet : {"wrong.toml", "none.toml", "nobody"})
        EXPECT_EQ(offered({"render", "--style", sheet, "--set", "style."}), Words{}) << sheet;
    EXPECT_EQ(offered({"render", "--set", "style."}), Words{});
}

TEST_F(Completion, Files) {
    EXPECT_EQ(offered({"render", ""}), (Words{":files toml obj ply stl off gltf glb"}));
    EXPECT_EQ(offered({"restyle", ""}), (Words{":files lines"}));
    EXPECT_EQ(offered({"render", "-o", ""}), (Words{":files exr png tif svg pdf dxf"}));
    EXPECT_EQ(offered({"render", "--deep", ""}), (Words{":files exr"}));
    EXPECT_EQ(offered({"compare", "-o", ""}), (Words{":folders"}));
    EXPECT_TRUE(offered({"methods", ""}).empty());
}

// What is offered is no wrong usage: the program goes on to read its input, which is not there.
TEST_F(Completion, OffersWhatTheProgramTakes) {
    const auto expect_taken = [&](Words typed, const std::string& option, const std::string& value) {
        typed.push_back(option + "=" + value);
        const ProgramResult result = run_burin(folder_.path(), typed);
        EXPECT_EQ(result.status, 1) << option << "=" << value << ": " << result.err;
    };
    const std::map<std::string, std::string> needed = {
        {"--projection", "--views=front"}, {"--dashes", "-odrawing.svg"},      {"--group", "-odrawing.svg"},
        {"--ids", "-odrawing.svg"},        {"--layers", "-opicture.exr"},      {"--channel-names", "-opicture.exr"},
        {"--find", "--style=comic"},       {"--compression", "-opicture.exr"}, {"--mask", "--method=patel"}};
    const std::set<std::string> lists = {"--lines", "--views", "--operator", "--layers"};
    int count = 0;
    for (const std::string& option : offered({"render", "--"})) {
        Words typed = {"render", "none.toml"};
        if (const auto other = needed.find(option); other != needed.end()) typed.push_back(other->second);
        for (const std::string& word : offered({"render", option, ""})) {
            if (option == "--help" || word.starts_with(":")) continue;
            expect_taken(typed, option, word);
            ++count;
        }
        if (!lists.contains(option)) continue;
        std::string list;  // as long as it goes on
        for (Words more = offered({"render", option, ""}); !more.empty();
             more = offered({"render", option, list + ","}))
            list = more.front();
        expect_taken(typed, option, list);
    }
    EXPECT_GT(count, 100);
    for (const std::string& word : offered({"compare", "--methods", ""}))
        expect_taken({"compare", "none.toml", "-o", "folder"}, "--methods", word);
    for (const std::string& word : offered({"explain", "--method", ""}))
        expect_taken({"explain", "none.toml", "--pixel", "1,1"}, "--method", word);
}

TEST_F(Completion, UsageBeginsWithTheProgram) {
    EXPECT_NE(run_burin(folder_.path(), {"render", "--help"}).out.find("Usage: burin render [OPTIONS] INPUT\n"),
              std::string::npos);
    const std::string all = run_burin(folder_.path(), {"--help-all"}).out;
    EXPECT_NE(all.find("Usage: burin [OPTIONS] SUBCOMMAND\n"), std::string::npos);
    for (const std::string& command : offered({""}))
        EXPECT_NE(all.find("Usage: burin " + command + " ["), std::string::npos) << command;
}

}  // namespace
}  // namespace burin::test::completion_test
