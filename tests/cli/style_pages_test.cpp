// The pages on style sheets, and those that one reads first: sheets and scenes stand there in full, commands work as
// they stand, and their pictures have the size of those that the pages show.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::style_pages_test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = BURIN_SOURCE_FOLDER;

std::string page(const char* name) { return read_file(kRoot / "docs" / name); }

/// What stands between ```toml and ```.
std::set<std::string> sheets_in(const std::string& page) {
    const std::string begin = "```toml\n", end = "```\n";
    std::set<std::string> sheets;
    for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
        at += begin.size();
        const std::size_t length = page.find(end, at) - at;
        sheets.insert(page.substr(at, length));
        at += length;
    }
    return sheets;
}

struct Command {
    std::vector<std::string> arguments;
    std::string stdout_file;  ///< behind `>`
};

/// Lines that begin with `    burin `, cut into words as by a shell that knows double quotes alone.
std::vector<Command> commands_in(const std::string& page) {
    std::vector<Command> commands;
    std::istringstream lines(page);
    const std::string begin = "    burin ";
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(begin)) continue;
        Command command;
        std::istringstream words(line.substr(begin.size()));
        for (std::string word; words >> word;) {
            if (word == ">") {
                words >> command.stdout_file;
                continue;
            }
            std::erase(word, '"');
            command.arguments.push_back(word);
        }
        commands.push_back(command);
    }
    return commands;
}

TEST(StylePages, HaveTheSheetsInFull) {
    std::set<std::string> files;
    for (const auto& entry : fs::directory_iterator(kRoot / "docs/shading/examples"))
        files.insert(read_file(entry.path()));
    EXPECT_EQ(files.size(), 9u);
    EXPECT_EQ(sheets_in(page("shading.md")), files);
}

TEST(StylePages, CommandsWorkAsTheyStand) {
    int count = 0;
    for (const char* name :
         {"shading.md", "shading/variables.md", "gallery.md", "start.md", "surfaces.md", "../README.md"}) {
        const TemporaryFolder folder;
        folder.write("mine.toml", read_file(kRoot / "docs/examples/start.toml"));
        for (const char* part : {"docs", "scenes"}) fs::create_directory_symlink(kRoot / part, folder.file(part));
        for (const Command& command : commands_in(page(name))) {
            ProgramOptions options;
            if (!command.stdout_file.empty()) options.stdout_file = folder.write(command.stdout_file, "");
            if (command.arguments.front() == "view") continue;  // goes on until it is stopped
            const ProgramResult result = run_burin(folder.path(), command.arguments, options);
            EXPECT_EQ(result.status, 0) << name << ": " << command.arguments.back() << "\n" << result.err;
            ++count;
        }
    }
    EXPECT_GE(count, 20);
}

/// The pictures of a page by their names: "pictures/start/first.png" is first.png.
std::map<std::string, fs::path> pictures_of(const std::string& page) {
    std::map<std::string, fs::path> pictures;
    const std::string begin = "](pictures/";
    for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1)) {
        const fs::path picture = page.substr(at + 2, page.find(')', at) - at - 2);
        pictures[picture.filename()] = kRoot / "docs" / picture;
    }
    return pictures;
}

/// Of a PNG: its size in pixels, as its header has it.
std::string size_of_png(const fs::path& file) { return read_file(file).substr(16, 8); }

// Lines of a picture of another size look finer or coarser.
TEST(StylePages, CommandsDrawPicturesOfTheSizeThatTheirPageShows) {
    int count = 0;
    for (const char* name : {"start.md", "shading.md", "surfaces.md", "gallery.md", "conventions.md", "how-it-works.md",
                             "scene-format.md"}) {
        const TemporaryFolder folder;
        folder.write("mine.toml", read_file(kRoot / "docs/examples/start.toml"));
        for (const char* part : {"docs", "scenes"}) fs::create_directory_symlink(kRoot / part, folder.file(part));
        const std::map<std::string, fs::path> pictures = pictures_of(page(name));
        for (const Command& command : commands_in(page(name))) {
            const auto shown = pictures.find(command.arguments.back());
            if (command.arguments.front() != "render" || shown == pictures.end()) continue;
            EXPECT_EQ(run_burin(folder.path(), command.arguments).status, 0) << name << ": " << shown->first;
            EXPECT_EQ(size_of_png(folder.file(shown->first)), size_of_png(shown->second)) << shown->second;
            ++count;
        }
    }
    EXPECT_GE(count, 37);
}

// A page overwrites no scene of a page that leads to it.
TEST(StylePages, PagesWriteNoSceneOfOthers) {
    for (const char* name : {"start.md", "shading.md", "gallery.md", "surfaces.md", "vector.md"}) {
        for (const Command& command : commands_in(page(name))) EXPECT_NE(command.stdout_file, "mine.toml") << name;
    }
}

/// Pages whose first scene is one to save, and to draw by the commands that name it.
TEST(StylePages, ScenesOfSequencesAreDrawn) {
    const struct {
        const char *page, *scene;
        int commands;
    } scenes[] = {{"pipeline.md", "shot.toml", 4}, {"pipeline/blur.md", "scene.toml", 2}};
    for (const auto& [name, scene, commands] : scenes) {
        const TemporaryFolder folder;
        const std::string text = page(name), begin = "```toml\n";
        const std::size_t at = text.find(begin) + begin.size();
        EXPECT_NE(text.substr(0, at).find(scene), std::string::npos) << name;
        folder.write(scene, text.substr(at, text.find("```\n", at) - at));
        fs::create_directory(folder.file("out"));
        for (const char* part : {"docs", "scenes"}) fs::create_directory_symlink(kRoot / part, folder.file(part));
        int count = 0;
        for (Command& command : commands_in(text)) {
            if (std::find(command.arguments.begin(), command.arguments.end(), "--size") == command.arguments.end())
                command.arguments.insert(command.arguments.end(), {"--size", "48x27"});
            const ProgramResult result = run_burin(folder.path(), command.arguments);
            EXPECT_EQ(result.status, 0) << name << ": " << command.arguments[1] << "\n" << result.err;
            ++count;
        }
        EXPECT_EQ(count, commands) << name;
    }
}

TEST(StylePages, ReferenceHasItsSheetInFull) {
    EXPECT_EQ(sheets_in(page("shading/sheets.md")).count(read_file(kRoot / "docs/examples/marker.toml")), 1u);
}

TEST(StylePages, StartHasItsSceneInFull) {
    EXPECT_EQ(sheets_in(page("start.md")), std::set<std::string>{read_file(kRoot / "docs/examples/start.toml")});
}

TEST(StylePages, EverySheetIsInTheGallery) {
    const std::string gallery = page("gallery.md");
    int count = 0;
    for (const auto& entry : fs::directory_iterator(kRoot / "styles")) {
        if (entry.path().extension() != ".toml") continue;
        const std::string name = entry.path().stem();
        EXPECT_NE(gallery.find("--style " + name + " "), std::string::npos) << name;
        for (const char* scene : {"engine", "teapot", "still_life", "flange"}) {
            const std::string picture = std::string("pictures/gallery/") + scene + "_" + name + ".png";
            EXPECT_NE(gallery.find(picture), std::string::npos) << picture;
            EXPECT_TRUE(fs::exists(kRoot / "docs" / picture)) << picture;
        }
        ++count;
    }
    EXPECT_GE(count, 9);
}

/// A sheet that one can read at a glance, with the parameters that `-w` and `--color` set.
TEST(StylePages, BuiltInSheetsAreShort) {
    for (const auto& entry : fs::directory_iterator(kRoot / "styles")) {
        if (entry.path().extension() != ".toml") continue;
        const std::string sheet = read_file(entry.path());
        EXPECT_LE(std::count(sheet.begin(), sheet.end(), '\n'), 40) << entry.path();
        EXPECT_NE(sheet.find("\nwidth = { value = "), std::string::npos) << entry.path();
        EXPECT_NE(sheet.find("\ncolor = \"#"), std::string::npos) << entry.path();
    }
}

}  // namespace
}  // namespace burin::test::style_pages_test
