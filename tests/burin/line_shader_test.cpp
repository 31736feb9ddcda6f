// Line shaders and line tests: functions of a program take part in style sheets, and what they return is checked.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <thread>
#include <utility>

#include "tests/burin/shapes.h"
#include "tests/cli/program.h"

namespace burin::test::line_shader_test {
namespace {

const View kView{.width = 160, .height = 120};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

/// One set of all lines; `more` are keys of its style, `of_set` of the set.
std::string sheet(const std::string& more, const std::string& of_set = {}) {
    return "style_version = 1\n[[set]]\nname = \"all\"\nclasses = [\"silhouette\", \"border\", \"crease\"]\n"
           "qi = [0, 255]\nstyle = \"ink\"\n" +
           of_set + "[style.ink]\n" + more + "\n";
}

/// A glass cube before waves, so that much is hidden.
Scene scene() {
    Scene scene;
    const int glass = scene.add(Material{.name = "glass", .color = {0, 0.5f, 0}, .opacity = 0.25f});
    const int mesh = scene.add_mesh(cube().mesh());
    scene.add(waves(12).mesh("waves"));
    scene.add_object(mesh, "solid", {0.3, 0, 0, 0.3, 0, 0.3, 0, -0.1, 0, 0, 0.3, 0.3, 0, 0, 0, 1});
    scene.add_object(mesh, "glass", {0.4, 0, 0, 0.2, 0, 0.4, 0, 0, 0, 0, 0.4, 1.2, 0, 0, 0, 1}, glass);
    return scene;
}

class Shader final : public LineShader {
  public:
    Shader(std::string needs, std::function<void(const LineSamples&, LineInk&)> shade)
        : needs_(std::move(needs)), shade_(std::move(shade)) {}
    std::string needs() const override { return needs_; }
    void shade(const LineSamples& in, LineInk& out) const override { shade_(in, out); }

  private:
    std::string needs_;
    std::function<void(const LineSamples&, LineInk&)> shade_;
};

class Test final : public LineTest {
  public:
    Test(std::string needs, std::function<void(const LineSamples&, std::span<float>)> test)
        : needs_(std::move(needs)), test_(std::move(test)) {}
    std::string needs() const override { return needs_; }
    void test(const LineSamples& in, std::span<float> strength) const override { test_(in, strength); }

  private:
    std::string needs_;
    std::function<void(const LineSamples&, std::span<float>)> test_;
};

std::shared_ptr<Shader> shader(std::string needs, std::function<void(const LineSamples&, LineInk&)> shade) {
    return std::make_shared<Shader>(std::move(needs), std::move(shade));
}
/// Changes each place by itself.
template <typename Change>
std::shared_ptr<Shader> each(const Change& change) {
    return shader("", [change](const LineSamples& in, LineInk& out) {
        for (std::size_t i = 0; i < in.count(); ++i) change(out, i);
    });
}
std::shared_ptr<Test> test_of(std::string needs, std::function<void(const LineSamples&, std::span<float>)> test) {
    return std::make_shared<Test>(std::move(needs), std::move(test));
}

std::vector<std::byte> exr(Scene& scene, const Options& options = {}) {
    return scene.render(kView, options).encode("exr");
}

/// The picture of a shader, and that of a sheet without one, of the same lines.
void expect_alike(Scene& from, const std::string& with_shader, const std::string& without, bool are_alike = true) {
    from.set_style(with_shader);
    const Drawing drawing = from.find_lines(kView);
    EXPECT_TRUE(drawing.draw().encode("exr") == exr(from)) << with_shader;
    EXPECT_EQ(drawing.draw().encode("exr") == drawing.draw(without).encode("exr"), are_alike) << without;
}

TEST(LibraryLineShader, DrawsWhatTheSameExpressionDraws) {
    Scene from = scene();
    from.add_line_shader("wide", shader("depth, light", [](const LineSamples& in, LineInk& out) {
                             for (std::size_t i = 0; i < in.count(); ++i)
                                 out.width_px[i] = 2 * in.column("depth")[i] * (1 - in.column("light")[i]);
                         }));
    expect_alike(from, sheet("shader = \"wide\"\ndash = [9, 4]"),
                 sheet("width = \"=2 * depth * (1 - light)\"\ndash = [9, 4]"));
    // Triples are three columns; what the style says is what the shader begins with.
    from.add_line_shader("ink", shader("N, C.g", [](const LineSamples& in, LineInk& out) {
                             for (std::size_t i = 0; i < in.count(); ++i) {
                                 EXPECT_EQ(in.style(), "ink");
                                 out.width_px[i] *= 2;
                                 out.opacity[i] *= 0.5f;
                                 out.offset_px[i] += 1;
                                 out.red[i] = std::abs(in.column("N.x")[i]);
                                 out.green[i] = std::abs(in.column("N.y")[i]) * in.column("C.g")[i];
                                 out.blue[i] = std::abs(in.column("N.z")[i]);
                             }
                         }));
    const std::string after = "\ntaper = { start = 9 }\nwobble = { amplitude = 1 }\nmin_length = [3, 20]";
    expect_alike(from, sheet("width = \"=1 + t\"\nopacity = 0.5\noffset = 1\nshader = \"ink\"" + after),
                 sheet("width = \"=2 * (1 + t)\"\nopacity = 0.25\noffset = 2\n"
                       "color = \"=rgb(abs(N.x), abs(N.y) * C.g, abs(N.z))\"" +
                       after));
    expect_alike(from, sheet("shader = \"ink\""), sheet("width = 2"), false);
}

/// A style that inherits a shader, and one that takes it away again.
TEST(LibraryLineShader, IsInheritedAndTakenAway) {
    Scene from = scene();
    from.add_line_shader("three", each([](LineInk& out, std::size_t i) { out.width_px[i] = 3; }));
    const std::string base = "[style.base]\nwidth = 1\nshader = \"three\"\ncaps = \"butt\"\n";
    expect_alike(
        from, base + "[[set]]\nname = \"a\"\nclasses = [\"crease\"]\nstyle = \"own\"\n[style.own]\nbase = \"base\"\n",
        "[[set]]\nname = \"a\"\nclasses = [\"crease\"]\nstyle = \"own\"\n[style.own]\nwidth = 3\ncaps = \"butt\"\n");
    expect_alike(
        from,
        base +
            "[[set]]\nname = \"a\"\nclasses = [\"crease\"]\nstyle = \"own\"\n"
            "[style.own]\nbase = \"base\"\nshader = \"none\"\n",
        "[[set]]\nname = \"a\"\nclasses = [\"crease\"]\nstyle = \"own\"\n[style.own]\nwidth = 1\ncaps = \"butt\"\n");
    from.set_style(sheet("width = 1\ncaps = \"butt\""));
    from.set("style.ink.shader=three");
    EXPECT_TRUE(from.find_lines(kView).draw(sheet("width = 3\ncaps = \"butt\"")).encode("exr") == exr(from));
}

TEST(LibraryLineTest, MultipliesOpacityByStrength) {
    Scene from = scene();
    from.add_line_test("front", test_of("facing, facing2", [](const LineSamples& in, std::span<float> strength) {
                           for (std::size_t i = 0; i < in.count(); ++i) {
                               EXPECT_EQ(strength[i], 1);
                               strength[i] = in.column("facing")[i] * in.column("facing2")[i];
                           }
                       }));
    const std::string style = "width = 3\ncaps = \"butt\"\nopacity = ";
    expect_alike(from, sheet(style + "0.5", "test = \"front\"\n"), sheet(style + "\"=0.5 * (facing * facing2)\""));
    // Nothing is left of lines without strength.
    from.add_line_test("front", test_of("", [](const LineSamples&, std::span<float> strength) {
                           std::fill(strength.begin(), strength.end(), 0.0f);
                       }));
    from.set_style(sheet(style + "1", "test = \"front\"\n"));
    const Picture picture = from.render(kView);
    for (const char* const layer : {"lines.A", "lines_hidden.A"}) {
        for (const std::uint16_t bits : picture.channel<std::uint16_t>(layer)) ASSERT_EQ(bits, 0) << layer;
    }
}

TEST(LibraryLineShader, NumbersAreBroughtToTheirRangesAndNotesSayWhereTheyWereNone) {
    Scene from = scene();
    from.add_line_shader("wild", each([](LineInk& out, std::size_t i) {
                             out.width_px[i] = 3;
                             out.opacity[i] = kInfinity;
                             out.offset_px[i] = kNan;
                             out.red[i] = -kInfinity;
                             out.green[i] = 0.5f;
                             out.blue[i] = -1;
                         }));
    expect_alike(from, sheet("shader = \"wild\"\ncaps = \"butt\""),
                 sheet("width = 3\ncaps = \"butt\"\ncolor = [0, 0.5, 0]"));
    const std::vector<std::string> notes = from.find_lines(kView).draw().notes();
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(notes[0].find("style ink: offset is not a number at "), 0u) << notes[0];
    EXPECT_NE(notes[0].find(" samples, first at pixel "), std::string::npos) << notes[0];
    EXPECT_EQ(from.render(kView).notes(), notes);

    from.add_line_shader("wild", each([](LineInk& out, std::size_t i) {
                             out.width_px[i] = kNan;
                             out.opacity[i] = kNan;
                             out.red[i] = kNan;
                         }));
    from.add_line_test("wild", test_of("", [](const LineSamples&, std::span<float> strength) { strength[0] = kNan; }));
    from.set_style(sheet("shader = \"wild\"", "test = \"wild\"\n"));
    std::vector<std::string> begins;
    for (const std::string& note : from.render(kView).notes()) begins.push_back(note.substr(0, note.find(" is not")));
    EXPECT_EQ(begins, (std::vector<std::string>{"style ink: width", "style ink: opacity", "style ink: color",
                                                "style ink: strength"}));
    from.set_style(sheet("width = \"=0 / 0\""));
    EXPECT_EQ(from.render(kView).notes().size(), 1u);
    from.set_style(sheet("width = 1"));
    EXPECT_EQ(from.render(kView).notes().size(), 0u);
}

/// What the program prints as notes on a picture is there, and nothing else.
TEST(LibraryNotes, ArePicturesOwn) {
    Scene from;
    Arrays marked = cube();
    marked.marks = {0, 6, 1, 7};  // no edges of polygons
    from.add(marked.mesh("marked"));
    const std::string missing = "the class mark is not drawn, and so 2 lines of the input are missing; lines.draw=";
    from.set("lines.draw=crease,mark");
    EXPECT_TRUE(from.render(kView).notes().empty());
    from.set("lines.draw=crease");
    ASSERT_EQ(from.render(kView).notes().size(), 1u);
    EXPECT_EQ(from.render(kView).notes()[0], missing + "mark,crease has it, too");
    const Drawing drawing = from.find_lines(kView);
    EXPECT_EQ(drawing.draw().notes(), from.render(kView).notes());

    from.set("lines.width=2");
    from.set_style(sheet("width = 1"));
    const std::vector<std::string> notes = from.render(kView).notes();
    ASSERT_EQ(notes.size(), 2u);
    EXPECT_EQ(notes[0].find("the style sheet says which lines are drawn and how; lines."), 0u) << notes[0];
    EXPECT_EQ(notes[1], "no set of the style sheet draws the class mark, and so 2 lines of the input are missing");
    EXPECT_EQ(from.find_lines(kView).draw().notes(), notes);
    EXPECT_TRUE(from.find_lines(kView).draw(sheet("width = 2")).notes().empty());

    Scene nothing = scene();
    View away = kView;
    away.camera_to_world = looking({0, 0, 9}, {0, 0, 10});
    EXPECT_EQ(nothing.render(away).notes(),
              std::vector<std::string>{"no sample of the picture sees a surface; does the camera look at the scene?"});
    EXPECT_EQ(burin_picture_note(nullptr, 0), nullptr);
    const Picture picture = nothing.render(away);
    EXPECT_EQ(burin_picture_note(picture.get(), -1), nullptr);
    EXPECT_EQ(burin_picture_note(picture.get(), 1), nullptr);
}

/// Samples come in batches that nobody chooses; threads and crops change nothing.
TEST(LibraryLineShader, PicturesDependOnNoThreadsAndCrops) {
    Scene from = scene();
    std::atomic<bool> is_too_many = false;
    from.add_line_shader("waves", shader("s, x", [&](const LineSamples& in, LineInk& out) {
                             if (in.count() < 1 || in.count() > 1024) is_too_many = true;
                             for (std::size_t i = 0; i < in.count(); ++i) {
                                 out.width_px[i] = 3 + 2 * std::sin(in.column("s")[i] / 5);
                                 if (in.column("x")[i] > 90) out.offset_px[i] = 4;
                             }
                         }));
    from.set_style(sheet("shader = \"waves\""));
    const std::vector<std::byte> one = exr(from, {.threads = 1});
    EXPECT_TRUE(exr(from, {.threads = 4}) == one);
    EXPECT_FALSE(is_too_many);
    View crop = kView;
    crop.crop = {50, 30, 130, 100};
    const Picture whole = from.render(kView), part = from.render(crop);
    const auto all = whole.channel<std::uint16_t>("A"), some = part.channel<std::uint16_t>("A");
    for (std::size_t y = 0; y < 70; ++y) {
        for (std::size_t x = 0; x < 80; ++x) ASSERT_EQ(some[80 * y + x], all[160 * (y + 30) + x + 50]) << x << "," << y;
    }
}

TEST(LibraryLineShader, DrawingsKeepTheShadersTheyWereFoundWith) {
    Scene from = scene();
    const auto constant = [](float width) {
        return each([width](LineInk& out, std::size_t i) { out.width_px[i] = width; });
    };
    from.add_line_shader("own", constant(2));
    from.set_style(sheet("shader = \"own\""));
    const std::vector<std::byte> two = exr(from);
    const Drawing drawing = from.find_lines(kView);
    from.add_line_shader("own", constant(4));
    EXPECT_FALSE(exr(from) == two);
    EXPECT_TRUE(drawing.draw().encode("exr") == two);
    from.add_line_shader("own", nullptr);
    std::string error;
    EXPECT_EQ(failure_of([&] { exr(from); }, &error), BURIN_BAD_INPUT);
    EXPECT_NE(error.find("there is no line shader 'own'"), std::string::npos) << error;
    from = Scene();
    EXPECT_TRUE(drawing.draw().encode("exr") == two);
    EXPECT_TRUE(drawing.draw(sheet("shader = \"own\"")).encode("exr") == two);
    // Two drawings on two threads at once.
    std::vector<std::byte> others[2];
    std::thread other([&] { others[0] = drawing.draw().encode("exr"); });
    others[1] = drawing.draw().encode("exr");
    other.join();
    EXPECT_TRUE(others[0] == two && others[1] == two);
}

TEST(LibraryLineShader, WhatItReadsIsANeedOfTheSheet) {
    Scene from = scene();
    from.set_style(sheet("width = 1\ndash = [9, 9]"));
    const Drawing drawing = from.find_lines(kView);
    from.add_line_shader("reads", shader("N", [](const LineSamples&, LineInk&) {}));
    std::string error;
    from.set_style(sheet("dash = [9, 9]"));
    const Drawing plain = from.find_lines(kView);
    EXPECT_EQ(failure_of([&] { plain.draw(sheet("shader = \"reads\"")); }, &error), BURIN_BAD_ARGUMENT);
    EXPECT_NE(error.find("the drawing lacks what the style sheet needs: the surfaces behind lines, normals"),
              std::string::npos)
        << error;
}

TEST(LibraryLineShader, WhatFailsEndsTheDrawWithItsMessage) {
    Scene from = scene();
    from.set_style(sheet("shader = \"bad\"", "test = \"bad\"\n"));
    from.add_line_test("bad", test_of("", [](const LineSamples&, std::span<float>) {}));
    std::string error;
    const auto expect_failure = [&](const std::string& text) {
        EXPECT_EQ(failure_of([&] { from.render(kView); }, &error), BURIN_BAD_ARGUMENT);
        EXPECT_EQ(error, text);
        const Drawing drawing = from.find_lines(kView);
        EXPECT_EQ(failure_of([&] { drawing.draw(); }, &error), BURIN_BAD_ARGUMENT);
        EXPECT_EQ(error, text);
    };
    from.add_line_shader("bad", each([](LineInk&, std::size_t) { throw std::runtime_error("no\nink"); }));
    expect_failure("style ink: the line shader 'bad' failed: no?ink");
    from.add_line_shader("bad", each([](LineInk&, std::size_t) { throw 7; }));
    expect_failure("style ink: the line shader 'bad' failed: it threw what is no std::exception");
    from.add_line_shader("bad", shader("depth", [](const LineSamples& in, LineInk&) { in.column("dept"); }));
    expect_failure("style ink: the line shader 'bad' failed: needs() has no column 'dept'");
    checked(burin_add_line_shader(
        from.get(), "bad", nullptr, [](const burin_line_samples*, burin_line_ink*, void*) { return 3; }, nullptr));
    expect_failure("style ink: the line shader 'bad' returned 3");
    checked(burin_add_line_shader(
        from.get(), "bad", nullptr, [](const burin_line_samples*, burin_line_ink*, void*) { return 0; }, nullptr));
    from.add_line_test("bad", test_of("", [](const LineSamples&, std::span<float>) { throw std::runtime_error(""); }));
    expect_failure("style ink: the line test 'bad' returned 1");
    from.add_line_test("bad", test_of("", [](const LineSamples&, std::span<float>) {}));
    EXPECT_EQ(failure_of([&] { from.render(kView); }), BURIN_DONE);  // nothing is left of the failures
}

TEST(LibraryLineShader, ArgumentsAreChecked) {
    Scene from = scene();
    const burin_line_shader nothing = [](const burin_line_samples*, burin_line_ink*, void*) { return 0; };
    const auto error_of = [&](const char* name, const char* variables) {
        const int result = burin_add_line_shader(from.get(), name, variables, nothing, nullptr);
        EXPECT_TRUE(result == BURIN_DONE || result == BURIN_BAD_ARGUMENT) << result;
        return result == BURIN_DONE ? std::string() : std::string(burin_error());
    };
    for (const char* const good : {"depth", " depth ,N.x, C", "", "C.b", "N,N,N.z", "frame,time,width_px,height_px"})
        EXPECT_EQ(error_of("a-Z_9", good), "") << good;
    EXPECT_EQ(error_of("a", nullptr), "");
    for (const auto& [variables, message] : std::vector<std::pair<const char*, const char*>>{
             {"depht", "variables: unknown variable 'depht', did you mean 'depth'?"},
             {"depth,", "variables: a name is missing beside a comma"},
             {",depth", "variables: a name is missing beside a comma"},
             {"depth.x", "variables: there is no 'depth.x'; depth is a number"},
             {"N.r", "variables: there is no 'N.r'; N has the parts xyz"},
             {"C.", "variables: there is no 'C.'; C has the parts rgb"},
             {"suggestive", "variables: 'suggestive' is not in this version"}}) {
        EXPECT_EQ(error_of("a", variables), message) << variables;
    }
    std::string many = "N";
    for (int i = 0; i < 99; ++i) many += ",N";
    EXPECT_EQ(error_of("a", many.c_str()), "variables: are more than 256 columns");
    for (const char* const bad : {"", "a b", "none", "ü", "a\"", "x\n"}) EXPECT_NE(error_of(bad, "depth"), "") << bad;
    EXPECT_EQ(error_of(nullptr, "depth"), "name is NULL");
    EXPECT_EQ(burin_add_line_shader(nullptr, "a", "depth", nothing, nullptr), BURIN_BAD_ARGUMENT);
    EXPECT_EQ(burin_add_line_test(from.get(), "a", "depht", nullptr, nullptr), BURIN_DONE);  // nothing to take away
}

TEST(LibraryLineShader, UnknownNamesAreErrorsWithAPlace) {
    Scene from = scene();
    from.add_line_shader("mine", each([](LineInk&, std::size_t) {}));
    std::string error;
    const auto expect_error = [&](const std::string& style, const std::string& text) {
        from.set_style(style);
        EXPECT_EQ(failure_of([&] { from.render(kView); }, &error), BURIN_BAD_INPUT);
        EXPECT_EQ(error, text);
    };
    expect_error(sheet("shader = \"mien\""),
                 "style:8:10: [style.ink] shader: there is no line shader 'mien', did you mean 'mine'?");
    expect_error(sheet("", "test = \"mine\"\n"),
                 "style:7:8: [[set]] test: there is no line test 'mine'; the program that draws adds it by "
                 "burin_add_line_test()");
    // The program has none.
    const TemporaryFolder folder;
    folder.write("mine.toml", sheet("shader = \"mine\""));
    const ProgramResult result =
        run_burin(folder.path(), {"render", std::string(BURIN_SOURCE_FOLDER) + "/scenes/cube.toml", "--style",
                                  "./mine.toml", "-o", "program.exr"});
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("mine.toml:8:10: [style.ink] shader: a line shader is code of a program that draws with "
                              "the library (burin_add_line_shader()); this program has none"),
              std::string::npos)
        << result.err;
    EXPECT_EQ(failure_of([&] { from.set_style(sheet("shader = 3")); }, &error), BURIN_BAD_INPUT);
    EXPECT_EQ(failure_of([&] { from.set_style(sheet("shader = \"a b\"")); }, &error), BURIN_BAD_INPUT);
    EXPECT_NE(error.find("must be a name, which has letters, digits, _ and - only"), std::string::npos) << error;
}

}  // namespace
}  // namespace burin::test::line_shader_test
