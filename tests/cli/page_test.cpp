// Paper, pages and sheets of views, through the program.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "image/exr_io.h"
#include "image/exr_reader.h"
#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::page_test {
namespace {

using Arguments = std::vector<std::string>;

/// Runs `render` with a cube and options, and returns its result.
ProgramResult render(const TemporaryFolder& folder, const Arguments& options, const std::string& output = "out.svg") {
    folder.write("cube.obj", kCubeObj);
    Arguments all = {"render", "cube.obj", "-o", output};
    all.insert(all.end(), options.begin(), options.end());
    return run_burin(folder.path(), all);
}

std::string drawn(const TemporaryFolder& folder, const Arguments& options, const std::string& output = "out.svg") {
    const ProgramResult result = render(folder, options, output);
    EXPECT_EQ(result.status, 0) << result.err;
    return read_file(folder.file(output));
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

int polylines(const std::string& dxf) {
    int count = 0;
    for (std::size_t at = 0; (at = dxf.find("0\nPOLYLINE\n", at)) != std::string::npos; ++at) ++count;
    return count;
}

/// The least and the greatest coordinates of a DXF file's vertices.
struct Bounds {
    double x0 = 1e9, y0 = 1e9, x1 = -1e9, y1 = -1e9;
    explicit Bounds(const std::string& dxf) {
        std::istringstream in(dxf);
        std::string code, value, entity;
        while (std::getline(in, code) && std::getline(in, value)) {
            if (code == "0") entity = value;
            if (entity != "VERTEX" || (code != "10" && code != "20")) continue;
            double& low = code == "10" ? x0 : y0;
            double& high = code == "10" ? x1 : y1;
            low = std::min(low, std::stod(value));
            high = std::max(high, std::stod(value));
        }
    }
};

const Arguments kFrontView = {"--set", "camera.projection=orthographic", "--set", "camera.direction=[0,0,1]"};
Arguments front_view(Arguments more) {
    more.insert(more.end(), kFrontView.begin(), kFrontView.end());
    return more;
}

TEST(Paper, SaysSizeInPixelsAndMillimetres) {
    const TemporaryFolder folder;
    EXPECT_TRUE(has(drawn(folder, {"--paper", "A4", "-r", "500"}),
                    "width=\"210mm\" height=\"297mm\" viewBox=\"0 0 353.5354 500\""));
    EXPECT_TRUE(has(drawn(folder, {"--paper", "A5-landscape", "-r", "100x420"}),
                    "width=\"210mm\" height=\"148mm\" viewBox=\"0 0 420 296\""));
    EXPECT_TRUE(has(drawn(folder, {"--set", "picture.paper=letter"}), "width=\"215.9mm\" height=\"279.4mm\""));
    EXPECT_TRUE(
        has(drawn(folder, {"--paper", "A4", "-r", "500"}, "out.pdf"), "/MediaBox [0 0 595.275590551 841.88976378]"));
    // Lengths in mm follow: 0.5 mm are 1 pixel.
    EXPECT_TRUE(
        has(drawn(folder, {"--paper", "200x100mm", "-r", "400", "--style", "technical"}), "stroke-width=\"1\""));
}

TEST(Paper, ScaleIsExact) {
    const TemporaryFolder folder;
    // 2 units at 10:1 are 20 mm, in the middle of what the margins leave.
    const Bounds b(
        drawn(folder, front_view({"--paper", "A4", "--scale", "10:1", "--margin", "20,10,40,30"}), "out.dxf"));
    EXPECT_NEAR(b.x1 - b.x0, 20, 0.01);
    EXPECT_NEAR(b.y1 - b.y0, 20, 0.01);
    EXPECT_NEAR(0.5 * (b.x0 + b.x1), 0.5 * (30 + 200), 0.005);
    EXPECT_NEAR(0.5 * (b.y0 + b.y1), 0.5 * (40 + 277), 0.005);
    const Bounds inch(drawn(folder, front_view({"--paper", "A4", "--scale", "1:2", "--unit", "in"}), "out.dxf"));
    EXPECT_NEAR(inch.x1 - inch.x0, 25.4, 0.01);
    const Bounds fitted(
        drawn(folder, front_view({"--paper", "A4", "--margin", "10", "--set", "camera.fit=1"}), "out.dxf"));
    EXPECT_NEAR(fitted.x0, 10, 0.05);
    EXPECT_NEAR(fitted.x1, 200, 0.05);
    const ProgramResult cut = render(folder, front_view({"--paper", "A4", "--scale", "200:1"}));
    EXPECT_EQ(cut.status, 0);
    EXPECT_EQ(cut.err, "burin: note: at 200:1 the view reaches beyond the paper; 105:1 would fit\n");
    // A part in metres, as if it were in millimetres.
    const std::string tiny =
        " the drawing fills less than a twentieth of the paper's width and height; 105:1 would fit (--unit says the "
        "unit of the scene)\n";
    EXPECT_EQ(render(folder, front_view({"--paper", "A4", "--scale", "5.2:1"})).err, "burin: note: at 5.2:1" + tiny);
    EXPECT_EQ(render(folder, front_view({"--paper", "A4", "--scale", "5.3:1"})).err, "");
    const Arguments from_a_place = {"--set", "camera.projection=orthographic", "--set", "camera.eye=[0,0,9]"};
    Arguments placed = {"--paper", "A4", "--scale", "1:1"};
    placed.insert(placed.end(), from_a_place.begin(), from_a_place.end());
    EXPECT_TRUE(has(render(folder, placed).err, "less than a twentieth"));
    EXPECT_EQ(render(folder, {"--paper", "A4", "--scale", "5.2:1", "--views", "front"}).err,
              "burin: note: at 5.2:1" + tiny);
    EXPECT_EQ(render(folder, {"--paper", "A4", "--scale", "5.3:1", "--views", "front"}).err, "");
}

/// Models are in mm, glTF files in metres, and --unit knows better.
TEST(Paper, UnitsOfModels) {
    const TemporaryFolder folder;
    folder.write("a.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [{"bufferView": 0, "componentType": 5126,
        "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}]})");
    folder.write("a.toml", "[[object]]\nfile='a.gltf'\n");
    folder.write("b.toml", "[[object]]\nfile='a.gltf'\n[[object]]\nshape='box'\nsize=[0.1,0.1,0.1]\n");
    const auto width = [&](const std::string& input, const Arguments& options) {
        Arguments all = front_view({"--paper", "A4", "-o", "a.dxf"});
        all.insert(all.begin(), {"render", input});
        all.insert(all.end(), options.begin(), options.end());
        const ProgramResult result = run_burin(folder.path(), all);
        EXPECT_EQ(result.status, 0) << result.err;
        const Bounds b(read_file(folder.file("a.dxf")));
        return b.x1 - b.x0;
    };
    EXPECT_NEAR(width("a.gltf", {"--scale", "1:10"}), 100, 0.1);
    EXPECT_NEAR(width("a.toml", {"--scale", "1:10"}), 100, 0.1);
    EXPECT_NEAR(width("a.gltf", {"--scale", "1:10", "--unit", "cm"}), 1, 0.1);
    EXPECT_NEAR(width("b.toml", {"--scale", "100:1"}), 105, 0.1);
}

/// A perspective view, too, fills what is within the margins.
TEST(Paper, MarginsOfAPerspectiveView) {
    const TemporaryFolder folder;
    const Bounds b(drawn(folder, {"--paper", "A4", "--margin", "150,20,10,80", "--set", "camera.fit=1"}, "out.dxf"));
    EXPECT_GT(b.x0, 80 - 0.1);
    EXPECT_LT(b.x1, 190 + 0.1);
    EXPECT_GT(b.y0, 10 - 0.1);
    EXPECT_LT(b.y1, 147 + 0.1);
    EXPECT_GT(std::max((b.x1 - b.x0) / 110, (b.y1 - b.y0) / 137), 0.99);
}

TEST(Paper, WrongUse) {
    const TemporaryFolder folder;
    const std::pair<Arguments, const char*> wrong[] = {
        {{"--paper", "A4", "--dpi", "96"}, "--dpi: cannot stand beside --paper"},
        {{"--page", "patent", "--dpi", "96"}, "--dpi: cannot stand beside --page"},
        {{"--set", "picture.paper=A4", "--dpi", "96"}, "--dpi: cannot stand beside paper"},
        {{"--paper", "A9"}, "--paper: 'A9' is none of A5, A4"},
        {{"--paper", "A4", "--scale", "1:2"}, "--scale: only an orthographic view has a scale"},
        {{"--scale", "1:0"}, "--scale: must be a scale like"},
        {{"--scale", "1:2", "--ortho", "3"}, "--scale: cannot stand beside --ortho"},
        {{"--scale", "1:2", "--fov", "30"}, "--scale: a perspective view"},
        {{"--unit", "yd"}, "--unit: must be mm, cm"},
        {{"--margin", "1,2"}, "--margin: must be one number or"},
        {{"--margin", "-1"}, "--margin: must be from 0"},
        {{"--paper", "40x40mm", "--margin", "20"},
         "--margin: paper of 40 x 40 mm is too small for margins of 20, 20, 20, 20"},
        {{"--page", "iso"}, "--page: must be iso128"},
        {{"-r", "500"}, "--size: must be WIDTHxHEIGHT in pixels, got '500'"},
        {{"--projection", "first"}, "--projection: needs --views"},
        {{"--views", "front,side"}, "--views: unknown view 'side'; known are front, back"},
        {{"--views", "front+x"}, "--views: unknown view 'front+x'"},
        {{"--views", "front,front-hidden"}, "--views: front is given more than once"},
        {{"--views", "iso+hidden", "--hidden", "none"}, "--views: iso+hidden cannot stand beside --hidden none"},
        {{"--views", "front,front"}, "--views: front is given more than once"},
        {{"--views", "front", "--eye", "1,2,3"}, "--views: cannot stand beside --eye"},
        {{"--views", "front,top", "--paper", "A5", "--scale", "100:1"},
         "--scale: at 100:1 the views need 200 x 407.4 mm"},
        {{"--views", "front,top", "--paper", "A5", "--scale", "10000:1"}, "--scale: at 10000:1 the views need 20000 x"},
    };
    for (const auto& [options, message] : wrong) {
        const ProgramResult result = render(folder, options);
        EXPECT_EQ(result.status, 2) << message;
        EXPECT_TRUE(has(result.err, message)) << result.err;
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
    }
}

/// What is wrong in a scene is told with its name.
TEST(Paper, WrongScenes) {
    const TemporaryFolder folder;
    const std::string box = "[[object]]\nshape='box'\n[picture]\n";
    const std::pair<const char*, const char*> wrong[] = {
        {"paper='40x40mm'\nmargin=20\n", "a.toml: [picture] margin: paper of 40 x 40 mm is too small"},
        {"scale='1:2'\n", "a.toml: [picture] scale: only an orthographic view has a scale"},
        {"paper='A4'\ndpi=96\n", "a.toml:5:5: [picture] dpi: cannot stand beside paper"},
    };
    for (const auto& [keys, message] : wrong) {
        folder.write("a.toml", box + keys);
        const ProgramResult result = run_burin(folder.path(), {"render", "a.toml", "-o", "a.svg"});
        EXPECT_EQ(result.status, 1);
        EXPECT_TRUE(result.err.starts_with(message)) << result.err;
    }
}

TEST(Pages, Patent) {
    const TemporaryFolder folder;
    const std::string pdf = drawn(folder, {"--page", "patent"}, "out.pdf");
    EXPECT_TRUE(pdf.starts_with("%PDF-1.4"));
    EXPECT_TRUE(has(pdf, "/MediaBox [0 0 595.275590551 841.88976378]"));
    EXPECT_FALSE(has(pdf, "/OCG"));
    const Bounds b(drawn(folder, {"--page", "patent"}, "out.dxf"));
    EXPECT_GT(b.x0, 25);
    EXPECT_LT(b.x1, 195);
    EXPECT_GT(b.y0, 10);
    EXPECT_LT(b.y1, 272);
    EXPECT_TRUE(has(drawn(folder, {"--page", "patent", "--paper", "letter"}), "width=\"215.9mm\""));
}

TEST(Pages, Iso128) {
    const TemporaryFolder folder;
    const auto width_of = [&](const Arguments& options) {
        const std::string svg = drawn(folder, options);
        std::set<double> widths;
        for (std::size_t at = 0; (at = svg.find(" stroke-width=\"", at)) != std::string::npos; ++at)
            widths.insert(std::stod(svg.substr(at + 15)));
        return *widths.rbegin();
    };
    // A pixel is 0.1 mm.
    EXPECT_NEAR(width_of({"--page", "iso128", "-r", "2970"}), 5, 1e-3);
    EXPECT_NEAR(width_of({"--page", "iso128", "--paper", "A1", "-r", "8410"}), 7, 1e-3);
    EXPECT_NEAR(width_of({"--page", "iso128", "--paper", "A1", "-r", "8410", "-w", "9"}), 9, 1e-3);
}

/// ISO 128-2: visible edges and outlines are wide, hidden ones half of it, with dashes of 12 widths and gaps of 3.
TEST(Pages, Iso128HasTwoWidths) {
    const TemporaryFolder folder;
    folder.write("a.toml", "[[object]]\nshape = 'box'\n[[object]]\nshape = 'box'\nsize = [0.5, 0.5, 0.5]\n");
    const Arguments look = {"--page", "iso128", "-r", "2970", "--views", "front,top,iso+hidden", "-q"};
    Arguments all = {"render", "a.toml", "-o", "a.svg"};
    all.insert(all.end(), look.begin(), look.end());
    ASSERT_EQ(run_burin(folder.path(), all).err, "");
    const std::string svg = read_file(folder.file("a.svg"));
    EXPECT_FALSE(has(svg, "opacity"));
    const std::string hidden =
        svg.substr(svg.find("layer-hidden"), svg.find("layer-visible") - svg.find("layer-hidden"));
    EXPECT_TRUE(has(hidden, "stroke-width=\"2.5\""));
    EXPECT_TRUE(has(hidden, "stroke-dasharray=\"27.5 10\""));  // round ends are parts of dashes
    EXPECT_FALSE(has(svg.substr(svg.find("layer-visible")), "stroke-width=\"2.5\""));
    EXPECT_TRUE(has(svg.substr(svg.find("layer-visible")), "stroke-width=\"5\""));
}

/// A pen and a laser have no grey.
TEST(Pages, MachinesHaveNoGrey) {
    const TemporaryFolder folder;
    for (const char* const page : {"plotter", "laser", "patent"}) {
        const std::string svg = drawn(folder, {"--page", page, "--style", "technical"});
        EXPECT_TRUE(has(svg, "layer-hidden")) << page;
        EXPECT_FALSE(has(svg, "opacity")) << page;
    }
}

/// Workshop drawings have hidden lines at any depth; the sheet alone has those right behind a face.
TEST(Pages, Iso128HasAllHiddenLines) {
    const TemporaryFolder folder;
    std::string scene = "[camera]\neye = [3, 2, 20]\ntarget = [0, 0, 0]\n";
    for (const char* const at : {"[0, 0, -2]", "[0, 0, 2]", "[0, 0, 4]"})
        scene += "[[object]]\nshape = 'box'\nsize = [4, 4, 1]\ntranslate = " + std::string(at) + "\n";
    scene += "[[object]]\nshape = 'box'\nsize = [1, 1, 1]\ntranslate = [0, 0, -6]\n";
    folder.write("a.toml", scene);
    for (const bool is_page : {true, false}) {
        const Arguments look = is_page ? Arguments{"--page", "iso128"} : Arguments{"--style", "technical"};
        Arguments all = {"render", "a.toml", "-o", "a.svg", "-q"};
        all.insert(all.end(), look.begin(), look.end());
        ASSERT_EQ(run_burin(folder.path(), all).err, "");
        const std::string svg = read_file(folder.file("a.svg"));
        EXPECT_EQ(has(svg, "data-qi=\"3\"") || has(svg, "data-qi=\"4\"") || has(svg, "data-qi=\"5\""), is_page);
    }
}

/// What a page makes of a look is said.
TEST(Pages, NotesOnLooks) {
    const TemporaryFolder folder;
    const std::pair<Arguments, const char*> cases[] = {
        {{"--page", "patent", "--style", "blueprint"}, "about as pale as the paper"},
        {{"--background", "#000000"}, "about as pale as the paper, or as dark"},
        {{"--page", "patent", "--color", "#ff0000"}, "patent offices want black"},
        {{"--page", "laser", "-w", "5"}, "--line-width changes nothing here"},
        {{"--bits", "16"}, "--bits is for PNG and TIFF"},
    };
    for (const auto& [options, note] : cases) EXPECT_TRUE(has(render(folder, options).err, note)) << note;
    EXPECT_EQ(render(folder, {"--page", "patent"}).err, "");
    EXPECT_EQ(render(folder, {"--background", "#000000", "--color", "#ffffff"}).err, "");
}

TEST(Pages, Machines) {
    const TemporaryFolder folder;
    const std::string plot = drawn(folder, {"--page", "plotter", "--stats", "stats.json", "-r", "1000"});
    EXPECT_FALSE(has(plot, "dasharray"));
    EXPECT_FALSE(has(plot, "<rect"));
    const nlohmann::json stats = nlohmann::json::parse(read_file(folder.file("stats.json")));
    EXPECT_LT(stats["pen_travel_mm"].get<double>(), stats["pen_travel_unsorted_mm"].get<double>());
    EXPECT_TRUE(stats["stages"].contains("merge") && stats["stages"].contains("sort"));
    EXPECT_TRUE(has(drawn(folder, {"--page", "plotter", "--background", "#ff0000"}), "<rect"));
    const int separate = polylines(drawn(folder, {"--page", "plotter"}, "out.dxf"));
    const int merged = polylines(drawn(folder, {"--page", "plotter", "--merge"}, "out.dxf"));
    EXPECT_LE(merged, separate);
    const std::string cut = drawn(folder, {"--page", "laser", "-r", "297"});
    EXPECT_TRUE(has(cut, "stroke-width=\"0.01\"")) << cut;
}

/// The paper of kept lines is that of their picture: options that would change it say what to do instead.
TEST(Pages, RestyleHasThePaperOfItsLines) {
    const TemporaryFolder folder;
    for (const char* const option : {"--paper", "--scale", "--margin", "-r"}) {
        const ProgramResult result =
            run_burin(folder.path(), {"restyle", "a.lines", "--style", "technical", "-o", "a.svg", option, "A4"});
        EXPECT_EQ(result.status, 2);
        EXPECT_TRUE(has(result.err, "render it again with " + std::string(option) + " and --save-lines")) << result.err;
    }
}

/// Lines that were kept are written for machines, too.
TEST(Pages, RestyleWritesForMachines) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    for (const char* const page : {"plotter", "laser", "patent"}) {
        ASSERT_EQ(run_burin(folder.path(), {"render", "cube.obj", "-o", "a.svg", "--page", page, "--style", "technical",
                                            "--find", "all", "--save-lines", "a.lines", "-q"})
                      .err,
                  "");
        ASSERT_EQ(run_burin(folder.path(),
                            {"restyle", "a.lines", "-o", "b.svg", "--page", page, "--style", "technical", "-q"})
                      .err,
                  "");
        EXPECT_TRUE(read_file(folder.file("a.svg")) == read_file(folder.file("b.svg"))) << page;
    }
}

TEST(Views, OnOneSheet) {
    const TemporaryFolder folder;
    const Arguments views = {"--views", "front,top,right,iso", "--paper", "A4", "-r", "600"};
    const std::string svg = drawn(folder, views);
    for (const char* const view : {"front", "top", "right", "iso"}) {
        EXPECT_TRUE(has(svg, "id=\"visible-" + std::string(view) + "-s0-silhouette\"")) << view;
    }
    EXPECT_FALSE(has(svg, "layer-visible-2"));
    Arguments third = views;
    third.insert(third.end(), {"--projection", "third"});
    EXPECT_NE(svg, drawn(folder, third));
    // The same bytes for any threads, in all formats.
    for (const char* const name : {"out.svg", "out.pdf", "out.dxf", "out.png"}) {
        Arguments one = views, three = views;
        one.insert(one.end(), {"-j", "1"});
        three.insert(three.end(), {"-j", "3"});
        EXPECT_EQ(drawn(folder, one, name), drawn(folder, three, name)) << name;
    }
}

/// Views that show three sides at once leave hidden lines out, unless they are asked for.
TEST(Views, PictorialOnesHaveNoHiddenLines) {
    const TemporaryFolder folder;
    const auto hidden = [&](const std::string& views, const Arguments& look) {
        Arguments all = {"--views", views, "--paper", "A4", "-r", "600"};
        all.insert(all.end(), look.begin(), look.end());
        const std::string svg = drawn(folder, all);
        std::string found;
        for (const std::string view : {"front", "top", "iso"}) {
            EXPECT_EQ(has(svg, "id=\"visible-" + view + "-s"), has(views, view)) << view;
            if (has(svg, "id=\"hidden-" + view + "-s")) found += view + " ";
        }
        return found;
    };
    // From the front and from above, what is hidden of a cube lies behind what is seen: so it is asked for a slant.
    for (const Arguments& look : {Arguments{"--hidden", "dashed"}, {"--page", "patent"}, {"--page", "iso128"}}) {
        Arguments slanted = look;
        slanted.insert(slanted.end(), {"--up", "0.1,1,0.2"});
        EXPECT_EQ(hidden("front,top,iso", slanted), "front top ") << look[1];
        EXPECT_EQ(hidden("front,top,iso+hidden", slanted), "front top iso ") << look[1];
        EXPECT_EQ(hidden("front-hidden,top,iso-hidden", slanted), "top ") << look[1];
        EXPECT_EQ(hidden("iso", look), "");
    }
    // As pixels, too.
    const Arguments paper = {"--paper", "A4", "-r", "600"};
    const auto picture = [&](Arguments options) {
        options.insert(options.end(), paper.begin(), paper.end());
        return drawn(folder, options, "out.png");
    };
    const std::string without = picture({"--views", "iso", "--hidden", "none"});
    EXPECT_EQ(picture({"--views", "iso", "--hidden", "solid"}), without);
    EXPECT_NE(picture({"--views", "iso+hidden", "--hidden", "solid"}), without);
    // A view without them leaves the next one alone.
    EXPECT_EQ(picture({"--views", "iso,front+hidden", "--hidden", "solid"}),
              picture({"--views", "iso,front", "--hidden", "solid"}));
    EXPECT_EQ(render(folder, {"--views", "iso", "--hidden", "solid"}).err,
              "burin: note: --hidden draws nothing: iso leaves hidden lines out; iso+hidden has them\n");
}

/// Pixels and paths are at the same places on paper.
TEST(Paper, PixelsAreWherePathsAre) {
    const TemporaryFolder folder;
    // In millimetres: half a line wider than paths.
    for (const Arguments& options :
         {Arguments{"--paper", "A5", "-r", "210", "--margin", "60,10,5,70"},
          Arguments{"--paper", "A5-landscape", "-r", "210", "--views", "front,top,iso", "--margin", "5,80,30,7"}}) {
        const Bounds paths(drawn(folder, options, "out.dxf"));
        Arguments with_lines = options;
        with_lines.insert(with_lines.end(), {"--layers", "lines"});
        drawn(folder, with_lines, "out.exr");
        const Image image = read_exr(folder.file("out.exr"));
        Bounds pixels("");
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                if (image.value(*image.find("lines.A"), x, y) < 0.3) continue;
                pixels.x0 = std::min(pixels.x0, x + 0.5);
                pixels.x1 = std::max(pixels.x1, x + 0.5);
                pixels.y0 = std::min(pixels.y0, image.height() - y - 0.5);
                pixels.y1 = std::max(pixels.y1, image.height() - y - 0.5);
            }
        }
        EXPECT_NEAR(pixels.x0, paths.x0, 1);
        EXPECT_NEAR(pixels.x1, paths.x1, 1);
        EXPECT_NEAR(pixels.y0, paths.y0, 1);
        EXPECT_NEAR(pixels.y1, paths.y1, 1);
    }
}

/// Files of lines know their paper.
TEST(Paper, IsKeptWithLines) {
    const TemporaryFolder folder;
    const std::string svg = drawn(folder, {"--paper", "A4", "-r", "500", "--style", "technical"});
    folder.write("cube.obj", kCubeObj);
    ASSERT_EQ(run_burin(folder.path(), {"render", "cube.obj", "-o", "a.png", "--paper", "A4", "-r", "500", "--style",
                                        "technical", "--save-lines", "a.lines"})
                  .status,
              0);
    ASSERT_EQ(run_burin(folder.path(), {"restyle", "a.lines", "--style", "technical", "-o", "b.svg"}).status, 0);
    const std::string again = read_file(folder.file("b.svg"));
    EXPECT_EQ(svg.substr(0, svg.find("stroke-width")), again.substr(0, again.find("stroke-width")));
}

}  // namespace
}  // namespace burin::test::page_test
