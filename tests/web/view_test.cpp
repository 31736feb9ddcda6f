// `burin view` as its pages see it, and as a shell does.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/web/view_client.h"

namespace burin::test::view_test {
namespace {

using Json = nlohmann::json;

constexpr const char* kScene = R"toml(
[[object]]
shape = "torus"
rotate = [60, 20, 0]
[[object]]
shape = "box"
translate = [0.4, 0.1, 0]
[lines]
width = 1.5
)toml";

struct Viewed {
    TemporaryFolder folder;
    std::unique_ptr<RunningView> view;

    explicit Viewed(const std::string& scene = kScene, std::vector<std::string> more = {}) {
        folder.write("scene.toml", scene);
        more.insert(more.begin(), {"scene.toml", "-q"});
        view = std::make_unique<RunningView>(folder.path(), more);
    }
};

std::string look(int number, const std::string& more) {
    return "kind = \"look\"\nnumber = " + std::to_string(number) + "\nlines = [\"silhouette\", \"crease\"]\n" + more;
}

std::string saved(PageSocket& page, int number, const std::string& format) {
    page.send_text(view_message("save", number, 320, 240, "format = \"" + format + "\""));
    const auto file = page.receive("file", number);
    return file ? file->bytes : "";
}

TEST(View, TheAddressStandsAloneOnStandardOutput) {
    Viewed viewed;
    EXPECT_EQ(viewed.view->out(), "http://" + viewed.view->host() + viewed.view->path() + "\n");
    const ProgramResult ended = viewed.view->end(SIGTERM);
    EXPECT_EQ(ended.status, 0);
    EXPECT_EQ(ended.err, "");
}

TEST(View, SignalsEndItWithAPageOpen) {
    for (const int number : {SIGTERM, SIGINT, SIGHUP}) {
        Viewed viewed;
        PageSocket page(*viewed.view);
        page.send_text(view_message("draw", 1, 4096, 4096, "full = true"));
        ASSERT_TRUE(page.receive("hello"));
        const ProgramResult ended = viewed.view->end(number);
        EXPECT_EQ(ended.status, 0) << number << ended.err;
        EXPECT_FALSE(ended.timed_out);
    }
}

TEST(View, WritesNoFile) {
    Viewed viewed;
    const std::vector<std::string> before = viewed.folder.names();
    PageSocket page(*viewed.view);
    EXPECT_NE(saved(page, 1, "png"), "");
    EXPECT_NE(saved(page, 2, "svg"), "");
    EXPECT_NE(saved(page, 3, "toml"), "");
    EXPECT_EQ(viewed.folder.names(), before);
}

TEST(View, FilesAreThoseOfRender) {
    const std::string looks[] = {
        "",
        look(1, "width = 3.25\nhidden = \"dashed\"\ncrease_angle = 20\nshading = \"lambert\""),
        look(1, "shading = \"hatch\""),
        look(1, "shading = \"none\""),
        look(1, "style = \"comic\"\nwidth = 2\n[parameters]\nwidth = \"5\"\ncolor = \"#c02040\""),
        look(1,
             "style = \"technical\"\nsheet = \"style_version = 1\\n[parameters]\\nink = '#203060'\\n"
             "[[set]]\\nname = 'a'\\nclasses = ['silhouette', 'crease']\\nstyle = 's'\\n[style.s]\\nwidth = 3\\ncolor "
             "= '=ink'\\n\""),
    };
    for (const std::string& change : looks) {
        Viewed viewed;
        PageSocket page(*viewed.view);
        if (!change.empty()) {
            page.send_text(change);
            ASSERT_TRUE(page.receive("look", 1)) << change;
        }
        const std::string png = saved(page, 2, "png"), svg = saved(page, 3, "svg"), toml = saved(page, 4, "toml");
        // A scene that is kept elsewhere draws the same.
        const TemporaryFolder other;
        other.write("view.toml", toml);
        for (const std::string name : {"view.png", "view.svg"}) {
            const ProgramResult made = run_burin(other.path(), {"render", "view.toml", "-o", name, "-q"});
            ASSERT_EQ(made.status, 0) << made.err << toml;
        }
        EXPECT_TRUE(png == read_file(other.file("view.png"))) << toml;
        EXPECT_TRUE(svg == read_file(other.file("view.svg"))) << toml;
        // So does the command line, where there is one.
        page.send_text(view_message("command", 5, 320, 240));
        const Json command = Json::parse(page.receive("command", 5)->text);
        EXPECT_EQ(command["needs_scene"].get<bool>(), change.find("sheet") != std::string::npos);
        if (command["needs_scene"]) continue;
        const std::string line = "cd '" + viewed.folder.path() + "' && '" + std::string(BURIN_PROGRAM) + "'" +
                                 command["command"].get<std::string>().substr(5) + " -q";
        ASSERT_EQ(std::system(line.c_str()), 0) << line;
        EXPECT_TRUE(png == read_file(viewed.folder.file("scene.png"))) << line;
    }
}

TEST(View, TheNewestViewWins) {
    Viewed viewed;
    PageSocket page(*viewed.view);
    ASSERT_TRUE(page.receive("hello"));
    page.send_text(view_message("draw", 1, 4000, 3000, "full = true"));
    constexpr int kLast = 400;
    for (int i = 2; i <= kLast; ++i) page.send_text(view_message("draw", i, 100 + i, 100));
    int frames = 0, last = 0;
    while (last != kLast) {
        const auto answer = page.receive("frame");
        ASSERT_TRUE(answer);
        const Json json = Json::parse(answer->text);
        EXPECT_GT(json["number"].get<int>(), last);
        last = json["number"];
        EXPECT_EQ(json["width"].get<int>(), last > 1 ? 100 + last : 4000);
        ++frames;
    }
    EXPECT_LT(frames, kLast / 2);
}

TEST(View, AFullPictureWaitsForRequests) {
    Viewed viewed;
    PageSocket page(*viewed.view);
    page.send_text(view_message("draw", 1, 2000, 1500, "full = true"));
    page.send_text(view_message("fit", 2, 320, 240));
    // Whatever came first, both are answered.
    bool has_frame = false, has_view = false;
    while (!has_frame || !has_view) {
        const auto answer = page.receive();
        ASSERT_TRUE(answer);
        const Json json = Json::parse(answer->text);
        has_frame = has_frame || (json["kind"] == "frame" && json["full"]);
        has_view = has_view || json["kind"] == "view";
    }
}

TEST(View, PagesHaveLooksOfTheirOwn) {
    Viewed viewed;
    PageSocket first(*viewed.view), second(*viewed.view);
    const std::string before = saved(first, 1, "png");
    second.send_text(look(2, "width = 9"));
    ASSERT_TRUE(second.receive("look", 2));
    EXPECT_NE(saved(second, 3, "png"), before);
    EXPECT_TRUE(saved(first, 4, "png") == before);
}

TEST(View, WrongMessagesAreAnsweredAndChangeNothing) {
    Viewed viewed;
    PageSocket page(*viewed.view);
    ASSERT_TRUE(page.receive("hello"));
    const std::string before = saved(page, 1, "png");
    const std::string view_along_up =
        "kind = \"draw\"\nnumber = 2\nsize = [64, 48]\n[camera]\neye = [0, 5, 0]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\n";
    const std::string no_view =
        "kind = \"draw\"\nnumber = 2\nsize = [64, 48]\n[camera]\neye = [0, 0, 0]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\n";
    const std::string nan_view =
        "kind = \"draw\"\nnumber = 2\nsize = [64, 48]\n[camera]\neye = [nan, 0, 0]\ntarget = [0, 0, 0]\nup = [0, 1, "
        "0]\n";
    const std::string wrong[] = {"",
                                 "kind = \"dance\"",
                                 view_along_up,
                                 no_view,
                                 nan_view,
                                 look(2, "style = \"nobody\""),
                                 look(2, "style = \"/etc/passwd\""),
                                 look(2, "style = \"../x.toml\""),
                                 look(2, "style = \"comic\"\n[parameters]\nno = \"5\""),
                                 look(2, "style = \"comic\"\n[parameters]\nwidth = \"many\"")};
    for (const std::string& message : wrong) {
        page.send_text(message);
        EXPECT_TRUE(page.receive("error")) << message;
    }
    EXPECT_TRUE(saved(page, 3, "png") == before);
}

TEST(View, FaultsOfASheetHaveTheirPlace) {
    Viewed viewed;
    PageSocket page(*viewed.view);
    const std::string begin =
        "style_version = 1\\n[[set]]\\nname = 'a'\\nclasses = ['silhouette']\\nstyle = 's'\\n[style.s]\\n";
    // What is no sheet is told at once; what is wrong in an expression, when it is drawn.
    page.send_text(look(1, "sheet = \"" + begin + "widht = 3\\n\""));
    Json fault = Json::parse(page.receive("error", 1)->text);
    EXPECT_EQ(fault["line"], 7);
    EXPECT_NE(fault["message"].get<std::string>().find("widht"), std::string::npos);
    page.send_text(look(2, "sheet = \"" + begin + "color = '#123456'\\nwidth = '=1 + nothing'\\n\""));
    page.send_text(view_message("draw", 3, 64, 48));
    fault = Json::parse(page.receive("error")->text);
    EXPECT_EQ(fault["line"], 8);
    EXPECT_NE(fault["message"].get<std::string>().find("nothing"), std::string::npos);
    page.send_text(look(4, "sheet = \"" + begin + "width = 3\\n\""));
    page.send_text(view_message("draw", 5, 64, 48));
    EXPECT_TRUE(page.receive("frame", 5));
}

TEST(View, TheNearestLineIsExplained) {
    Viewed viewed;
    PageSocket page(*viewed.view);
    const auto explained = [&](int number, int x, const std::string& more) {
        page.send_text(view_message("explain", number, 320, 240, "x = " + std::to_string(x) + "\ny = 120\n" + more));
        return Json::parse(page.receive("explain", number)->text);
    };
    int line_x = -1;
    for (int x = 0; x < 320 && line_x < 0; x += 40) {
        const Json answer = explained(1 + x, x, "reach = 64");
        if (!answer["reasons"].empty()) line_x = answer["x"];
    }
    ASSERT_GE(line_x, 0);
    const Json line = explained(1000, line_x, "");
    const std::string reason = line["reasons"][0];
    EXPECT_EQ(reason.find("silhouette of torus"), 0u) << reason;
    EXPECT_EQ(line["lines"], "");  // of a sheet
    EXPECT_NE(line["fragments"].get<std::string>().find("pixel " + std::to_string(line_x)), std::string::npos);
    // Beside it the same is said, if it is near enough.
    EXPECT_EQ(explained(1001, line_x - 5, "reach = 5"), [&] {
        Json same = line;
        same["number"] = 1001;
        return same;
    }());
    EXPECT_TRUE(explained(1002, line_x - 5, "reach = 2")["reasons"].empty());
    page.send_text(look(2, "style = \"comic\""));
    const Json styled = explained(1003, line_x, "reach = 5");
    EXPECT_NE(styled["lines"], "");
    EXPECT_EQ(styled["reasons"][0], reason);
}

TEST(View, AClosedPageLeavesNothingRunning) {
    Viewed viewed;
    {
        PageSocket page(*viewed.view);
        ASSERT_TRUE(page.receive("hello"));
    }
    // As many pages as are let in at once, again and again: those that are gone have made room.
    for (int round = 0; round < 3; ++round) {
        std::vector<std::unique_ptr<PageSocket>> pages;
        for (int i = 0; i < 12; ++i) {
            pages.push_back(std::make_unique<PageSocket>(*viewed.view));
            pages.back()->send_text(view_message("draw", 1, 3000, 2000, "full = true"));
        }
        pages.clear();
        for (int i = 0; i < 200; ++i) {
            if (ask(*viewed.view, get_request(*viewed.view, viewed.view->path())).status == 200) break;
        }
    }
    PageSocket page(*viewed.view);
    page.send_text(view_message("draw", 1, 64, 48));
    EXPECT_TRUE(page.receive("frame", 1));
}

TEST(View, ATakenPortIsNamed) {
    Viewed viewed;
    const std::string port = std::to_string(viewed.view->port());
    const ProgramResult second =
        run_burin(viewed.folder.path(), {"view", "scene.toml", "--no-browser", "--port", port});
    EXPECT_EQ(second.status, 1);
    EXPECT_EQ(second.out, "");
    EXPECT_EQ(second.err, "127.0.0.1:" + port + ": the port is in use; give another --port, or none for a free one\n");
}

TEST(View, WhatCannotBeSeenIsSaidAtOnce) {
    const TemporaryFolder folder;
    folder.write("empty.toml", "");
    folder.write("broken.toml", "[[object]]\nshape = \"box\"\n[lines]\nwidth = 0\n");
    folder.write("blind.toml", "[[object]]\nshape = \"box\"\n[[camera]]\neye = [1, 1, 1]\ntarget = [1, 1, 1]\n");
    folder.write("styled.toml", "style = \"nobody\"\n[[object]]\nshape = \"box\"\n");
    folder.write("good.toml", "[[object]]\nshape = \"box\"\n");
    struct Wrong {
        std::vector<std::string> arguments;
        int status;
        std::string begin;
    };
    const Wrong wrong[] = {
        {{"missing.obj"}, 1, "missing.obj: "},
        {{"picture.png"}, 1, "picture.png: unknown kind of input"},
        {{"empty.toml"}, 1, "empty.toml"},
        {{"broken.toml"}, 1, "broken.toml:4:9: [lines] width"},
        {{"blind.toml"}, 1, "blind.toml:3:1: the camera's eye and target"},
        {{"styled.toml"}, 1, "styled.toml:1:9: style: there is no style sheet 'nobody'"},
        {{"good.toml", "--port", "0"}, 2, "burin: --port"},
        {{"good.toml", "--port", "65536"}, 2, "burin: --port"},
        {{"good.toml", "--style", "nobody"}, 2, "burin: --style: there is no style sheet 'nobody'"},
        {{"good.toml", "--set", "lines.width=0"}, 2, "burin: --set lines.width=0: "},
        {{"good.toml", "--set", "lines.widht=1"}, 2, "burin: --set lines.widht=1: "},
        {{"good.toml", "--style", "comic", "--set", "style.no=1"}, 2, "burin: --set style.no=1: "},
        {{"good.toml", "--size", "3x3"}, 2, "burin: unknown option '--size'"},
        {{}, 2, "burin: INPUT is required"},
    };
    for (const Wrong& w : wrong) {
        std::vector<std::string> arguments = {"view", "--no-browser"};
        arguments.insert(arguments.end(), w.arguments.begin(), w.arguments.end());
        const ProgramResult result = run_burin(folder.path(), arguments);
        EXPECT_EQ(result.status, w.status) << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_TRUE(is_one_line(result.err) && result.err.starts_with(w.begin)) << result.err << w.begin;
    }
}

TEST(View, ASceneWithoutACameraIsFitted) {
    Viewed viewed;
    PageSocket page(*viewed.view);
    page.send_text("kind = \"home\"\nnumber = 1\nsize = [300, 600]\n");
    const Json home = Json::parse(page.receive("view", 1)->text);
    page.send_text("kind = \"home\"\nnumber = 2\nsize = [600, 300]\n");
    const Json wide = Json::parse(page.receive("view", 2)->text);
    EXPECT_NE(home["eye"], wide["eye"]);  // it is farther away where the picture is narrow
    EXPECT_TRUE(home["height"].is_null());
}

TEST(View, TheBrowserIsOpenedWhereThereIsADesktop) {
    TemporaryFolder folder;
    folder.write("scene.toml", kScene);
    folder.write("xdg-open",
                 "#!/bin/sh\necho \"$1\" > opened.part; mv opened.part opened; echo noise; echo noise >&2\n");
    ::chmod(folder.file("xdg-open").c_str(), 0755);
    const char* const old_path = std::getenv("PATH");
    const std::string path = folder.path() + ":" + (old_path != nullptr ? old_path : "");
    ::setenv("PATH", path.c_str(), 1);
    ::setenv("DISPLAY", ":99", 1);
    ProgramOptions options;
    options.stdout_file = folder.write("out", "");
    Program program(folder.path(), {"view", "scene.toml", "-q"}, options);
    for (int i = 0; i < 1000 && ::access(folder.file("opened").c_str(), R_OK) != 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ::unsetenv("DISPLAY");
    if (old_path != nullptr) ::setenv("PATH", path.substr(folder.path().size() + 1).c_str(), 1);
    program.send(SIGINT);
    const ProgramResult ended = program.wait();
    EXPECT_EQ(ended.status, 0);
    EXPECT_EQ(ended.err, "");
    EXPECT_EQ(read_file(folder.file("opened")), read_file(folder.file("out")));
}

TEST(View, ABrowserThatCannotBeOpenedIsSaid) {
    const TemporaryFolder folder;
    folder.write("scene.toml", kScene);
    const char* const old_path = std::getenv("PATH");
    const std::string path = old_path != nullptr ? old_path : "";
    ::setenv("PATH", folder.path().c_str(), 1);  // without xdg-open
    ::setenv("DISPLAY", ":99", 1);
    for (const bool quiet : {false, true}) {
        std::vector<std::string> arguments = {"view", "scene.toml"};
        if (quiet) arguments.emplace_back("-q");
        ProgramOptions options;
        options.stdout_file = folder.write("out", "");
        Program program(folder.path(), arguments, options);
        std::string address;
        for (int i = 0; i < 1000 && !address.ends_with('\n'); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            address = read_file(folder.file("out"));
        }
        const std::string begin = "http://127.0.0.1:";
        ASSERT_TRUE(address.starts_with(begin)) << address;
        Connection connection(static_cast<std::uint16_t>(std::stoi(address.substr(begin.size()))));
        connection.send("GET / HTTP/1.1\r\nConnection: close\r\n\r\n");
        EXPECT_NE(connection.read_all(), "");  // it answers, so it has tried to open a browser
        program.send(SIGINT);
        const ProgramResult ended = program.wait();
        EXPECT_EQ(ended.status, 0);
        EXPECT_EQ(ended.err.find("burin: note: xdg-open (package xdg-utils) is not there") != std::string::npos, !quiet)
            << ended.err;
    }
    ::unsetenv("DISPLAY");
    ::setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace burin::test::view_test
