// Drawings as PDF and DXF files, read back by programs and code that know nothing of the writers.

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "output/dxf.h"
#include "output/pdf.h"
#include "output/svg.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::TemporaryFolder;

constexpr double kDpi = 127;  // 5 pixels per mm

VectorStyle stroke(float width_px, glm::vec3 color = glm::vec3(0.0f)) {
    VectorStyle style;
    style.width_px = width_px;
    style.color = color;
    return style;
}

/// A drawing of 100 x 60 mm, to which paths are added.
struct Drawing {
    VectorDrawing drawing;

    Drawing() {
        drawing.width_px = 500;
        drawing.height_px = 300;
        drawing.crop = {0, 0, 500, 300};
        drawing.dpi = kDpi;
        drawing.paper = glm::vec3(1.0f);
        drawing.sets = {"lines"};
        drawing.objects = {"a <b> (c) \\ \"d\" \xF0\x9F\xA6\x8A\n"};
    }
    void begin_group(bool is_hidden, LineClass line_class) {
        VectorGroup group;
        group.is_hidden = is_hidden;
        group.line_class = line_class;
        group.object = 1;
        group.first_path = drawing.paths.size();
        drawing.groups.push_back(group);
    }
    void add(glm::dvec2 start, const std::vector<PathStep>& steps, const VectorStyle& style, bool is_closed = false) {
        VectorPath path;
        path.start = start;
        path.first_step = drawing.steps.size();
        path.step_count = steps.size();
        path.is_closed = is_closed;
        path.object = 1;
        path.style = static_cast<std::uint32_t>(drawing.styles.size());
        drawing.styles.push_back(style);
        drawing.steps.insert(drawing.steps.end(), steps.begin(), steps.end());
        drawing.paths.push_back(path);
        ++drawing.groups.back().path_count;
    }
};

PathStep line(double x, double y) {
    PathStep step;
    step.to = {x, y};
    return step;
}
PathStep cubic(glm::dvec2 a, glm::dvec2 b, glm::dvec2 to) {
    PathStep step;
    step.kind = PathStep::Kind::cubic;
    step.a = a;
    step.b = b;
    step.to = to;
    return step;
}
/// Half of a circle, clockwise as seen.
PathStep half_circle(double radius, glm::dvec2 to) {
    PathStep step;
    step.kind = PathStep::Kind::arc;
    step.is_clockwise = true;
    step.a = glm::dvec2(radius);
    step.to = to;
    return step;
}

Drawing several_paths() {
    Drawing d;
    d.begin_group(true, LineClass::crease);
    VectorStyle dashed = stroke(2, {1, 0, 0});
    dashed.dash_px = {20, 10};
    d.add({50, 250}, {line(450, 250)}, dashed);
    d.begin_group(false, LineClass::silhouette);
    d.add({50, 50}, {line(150, 50), line(150, 100), line(50, 50)}, stroke(4), true);
    VectorStyle pale = stroke(4);
    pale.opacity = 0.5f;
    pale.blend = InkBlend::multiply;
    d.add({200, 50}, {cubic({230, 0}, {270, 100}, {300, 50})}, pale);
    d.add({350, 100}, {half_circle(50, {450, 100})}, stroke(4));
    VectorStyle outline = stroke(0, {0, 0, 1});
    d.add({50, 150}, {line(100, 150), line(100, 200), line(50, 200), line(50, 150)}, outline, true);
    d.add({200, 200}, {line(200, 200)}, stroke(10));  // a dot
    return d;
}

// ---- PDF ----

std::string inflated(const std::string& file, std::size_t stream) {
    const std::size_t begin = file.find("stream\n", stream) + 7, end = file.find("\nendstream", begin);
    std::string out(1 << 20, '\0');
    uLongf size = out.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                         reinterpret_cast<const Bytef*>(file.data() + begin), end - begin),
              Z_OK);
    out.resize(size);
    return out;
}
std::string content_of(const std::string& pdf) { return inflated(pdf, pdf.find("<< /Filter /FlateDecode")); }

std::string pdf(const VectorDrawing& drawing, bool is_plain = false, std::vector<std::string>* notes = nullptr) {
    std::vector<std::string> own;
    return pdf_of(drawing, {is_plain}, notes == nullptr ? own : *notes);
}

TEST(Pdf, TableOfObjectsTellsWhereTheyAre) {
    const std::string file = pdf(several_paths().drawing);
    EXPECT_TRUE(file.starts_with("%PDF-1.6\n%"));
    EXPECT_TRUE(file.ends_with("%%EOF\n"));
    const std::size_t table = std::stoul(file.substr(file.find("startxref\n") + 10));
    ASSERT_EQ(file.substr(table, 7), "xref\n0 ");
    const std::size_t count = std::stoul(file.substr(table + 7));
    std::size_t at = file.find('\n', table + 5) + 1;
    for (std::size_t i = 0; i < count; ++i, at += 20) {
        ASSERT_EQ(file.substr(at + 18, 2), " \n");
        if (i == 0) continue;
        const std::string object = std::to_string(i) + " 0 obj\n";
        EXPECT_EQ(file.substr(std::stoul(file.substr(at, 10)), object.size()), object);
    }
    EXPECT_EQ(file.substr(at, 7), "trailer");
    EXPECT_EQ(file.find("Date"), std::string::npos);
}

TEST(Pdf, SaysWhatIsDrawn) {
    const std::string file = pdf(several_paths().drawing);
    EXPECT_NE(file.find("/MediaBox [0 0 283.464566929 170.078740157]"), std::string::npos);  // 100 x 60 mm
    const std::string text = content_of(file);
    EXPECT_TRUE(text.starts_with("0.566929134 0 0 -0.566929134 0 170.078740157 cm\n1 j\n")) << text;
    EXPECT_NE(text.find("1 0 0 RG\n2 w\n1 J\n[18 12] 29 d\n50 250 m\n450 250 l\nS\n"), std::string::npos) << text;
    EXPECT_NE(text.find("0 G\n4 w\n[] 0 d\n50 50 m\n150 50 l\n150 100 l\nh S\n"), std::string::npos) << text;
    EXPECT_NE(text.find("200 50 m\n230 0 270 100 300 50 c\nS\n"), std::string::npos) << text;
    EXPECT_NE(text.find("0 0 1 rg\n50 150 m\n"), std::string::npos) << text;
    EXPECT_NE(text.find("h f\n"), std::string::npos);
    EXPECT_NE(text.find("200 200 m\n200 200 l\nS\n"), std::string::npos) << text;
    EXPECT_NE(file.find("/CA 0.5 /ca 0.5 /BM /Multiply"), std::string::npos) << file;
    EXPECT_NE(file.find("(1 visible)"), std::string::npos);
    EXPECT_NE(file.find("(2 hidden)"), std::string::npos);
}

/// An arc as cubics is as near to it as paths are to lines.
TEST(Pdf, ArcsAreExact) {
    Drawing d;
    d.begin_group(false, LineClass::silhouette);
    d.add({0, 1000}, {half_circle(1000, {2000, 1000})}, stroke(1));
    std::istringstream text(content_of(pdf(d.drawing)));
    std::string row;
    while (std::getline(text, row) && row != "0 1000 m") {
    }
    glm::dvec2 from(0, 1000);
    int count = 0;
    while (std::getline(text, row) && row.ends_with(" c")) {
        std::istringstream numbers(row);
        glm::dvec2 a, b, to;
        numbers >> a.x >> a.y >> b.x >> b.y >> to.x >> to.y;
        for (double t = 0; t <= 1; t += 0.05) {
            const double s = 1 - t;
            const glm::dvec2 p = s * s * s * from + 3 * s * s * t * a + 3 * s * t * t * b + t * t * t * to;
            EXPECT_NEAR(glm::length(p - glm::dvec2(1000)), 1000, 0.02);
        }
        from = to;
        ++count;
    }
    EXPECT_EQ(count, 4);
}

TEST(Pdf, PlainFilesHaveNeitherLayersNorTransparency) {
    std::vector<std::string> notes;
    const std::string file = pdf(several_paths().drawing, true, &notes);
    EXPECT_TRUE(file.starts_with("%PDF-1.4\n"));
    for (const char* word : {"/OCG", "/OCProperties", "/ExtGState", "/Group", "/CA "})
        EXPECT_EQ(file.find(word), std::string::npos) << word;
    EXPECT_EQ(content_of(file).find("BDC"), std::string::npos);
    EXPECT_NE(file.find("<pdfaid:part>1</pdfaid:part>"), std::string::npos);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(notes[0], "PDF/A-1b has no transparency: the colours of 1 path are mixed with the paper's");
}

TEST(Pdf, NamesAreEscaped) {
    Drawing d = several_paths();
    d.drawing.grouping = VectorGrouping::object;
    const std::string file = pdf(d.drawing);
    // UTF-16: a < b > ... fox, line feed.
    EXPECT_NE(file.find("/Name <FEFF0061"), std::string::npos);
    EXPECT_NE(file.find("D83EDD8A000A>"), std::string::npos);
    d.drawing.objects = {"(a) \\ b"};
    EXPECT_NE(pdf(d.drawing).find("/Name (\\(a\\) \\\\ b)"), std::string::npos);
    d.drawing.objects = {"\xFF\xC3"};
    EXPECT_NE(pdf(d.drawing).find("/Name <FEFFFFFDFFFD>"), std::string::npos);
}

bool has_program(const char* name) {
    return std::system((std::string("command -v ") + name + " >/dev/null 2>&1").c_str()) == 0;
}

TEST(Pdf, QpdfFindsNoFault) {
    ASSERT_TRUE(has_program("qpdf")) << "scripts/install-dependencies installs it";
    const TemporaryFolder folder;
    Drawing named = several_paths(), large = several_paths();
    named.drawing.grouping = VectorGrouping::object;
    large.drawing.dpi = 1;
    int number = 0;
    for (const VectorDrawing& drawing : {several_paths().drawing, Drawing().drawing, named.drawing, large.drawing}) {
        for (const bool is_plain : {false, true}) {
            const std::string path = folder.file(std::to_string(number++) + ".pdf");
            std::ofstream(path, std::ios::binary) << pdf(drawing, is_plain);
            EXPECT_EQ(std::system(("qpdf --check '" + path + "' >'" + path + ".log' 2>&1").c_str()), 0) << number;
        }
    }
}

/// How dark a picture of a PDF file is, by pixel.
class Printed {
  public:
    Printed(const TemporaryFolder& folder, const std::string& file, int dpi) {
        const std::string path = folder.file("printed.pdf");
        std::ofstream(path, std::ios::binary) << file;
        const std::string command = "pdftoppm -r " + std::to_string(dpi) + " -gray '" + path + "' >'" + path + ".pgm'";
        EXPECT_EQ(std::system(command.c_str()), 0);
        std::ifstream in(path + ".pgm", std::ios::binary);
        std::string magic;
        int most = 0;
        in >> magic >> width >> height >> most;
        in.get();
        pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        in.read(reinterpret_cast<char*>(pixels_.data()), static_cast<std::streamsize>(pixels_.size()));
    }
    int at(int x, int y) const {
        return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
    int width = 0, height = 0;

  private:
    std::vector<unsigned char> pixels_;
};

TEST(Pdf, PopplerDrawsItWhereItIs) {
    ASSERT_TRUE(has_program("pdftoppm")) << "scripts/install-dependencies installs it";
    const TemporaryFolder folder;
    const Printed printed(folder, pdf(several_paths().drawing), static_cast<int>(kDpi));
    EXPECT_NEAR(printed.width, 500, 1);
    EXPECT_NEAR(printed.height, 300, 1);
    EXPECT_LT(printed.at(100, 50), 30);  // the triangle's upper side, and its inside
    EXPECT_GT(printed.at(120, 62), 240);
    EXPECT_LT(printed.at(150, 75), 30);
    EXPECT_LT(printed.at(400, 50), 30);    // on top of the half circle
    EXPECT_GT(printed.at(400, 150), 240);  // not below
    EXPECT_LT(printed.at(75, 175), 60);    // filled, blue
    EXPECT_LT(printed.at(202, 203), 30);   // the dot
    EXPECT_GT(printed.at(208, 208), 240);
    EXPECT_NEAR(printed.at(200, 50), 128, 40);  // half covered by opacity
    EXPECT_LT(printed.at(60, 250), 120);        // a dash, and a gap
    EXPECT_GT(printed.at(75, 250), 240);
}

// ---- DXF ----

/// A file as pairs of a code and a value.
struct DxfFile {
    std::vector<std::pair<int, std::string>> pairs;

    explicit DxfFile(const std::string& text) {
        std::istringstream in(text);
        std::string code, value;
        while (std::getline(in, code) && std::getline(in, value)) pairs.emplace_back(std::stoi(code), value);
        EXPECT_EQ(pairs.empty() ? "" : pairs.back().second, "EOF");
    }

    struct Polyline {
        std::map<int, std::string> entries;
        std::vector<glm::dvec2> points;
        bool is_closed() const { return std::stoi(entries.at(70)) % 2 == 1; }
    };
    std::vector<Polyline> polylines() const {
        std::vector<Polyline> found;
        std::string entity;
        for (const auto& [code, value] : pairs) {
            if (code == 0) {
                entity = value;
                if (entity == "POLYLINE") found.emplace_back();
                if (entity == "VERTEX") found.back().points.emplace_back(0.0);
            } else if (entity == "POLYLINE") {
                found.back().entries[code] = value;
            } else if (entity == "VERTEX" && (code == 10 || code == 20)) {
                found.back().points.back()[code == 10 ? 0 : 1] = std::stod(value);
            }
        }
        return found;
    }
    /// Entries of a table, by name.
    std::map<std::string, std::multimap<int, std::string>> table(const std::string& kind) const {
        std::map<std::string, std::multimap<int, std::string>> found;
        std::string entry, name;
        for (const auto& [code, value] : pairs) {
            if (code == 0) entry = value;
            if (entry != kind) continue;
            if (code == 2) name = value;
            if (code != 0) found[name].emplace(code, value);
        }
        return found;
    }
};

std::string dxf(const VectorDrawing& drawing, std::vector<std::string>* notes = nullptr) {
    std::vector<std::string> own;
    return dxf_of(drawing, {}, notes == nullptr ? own : *notes);
}

TEST(Dxf, PolylinesAreInMillimetresWithYUpwards) {
    std::vector<std::string> notes;
    const DxfFile file(dxf(several_paths().drawing, &notes));
    const auto lines = file.polylines();
    ASSERT_EQ(lines.size(), 6u);
    EXPECT_EQ(lines[0].entries.at(8), "HIDDEN_CREASE");
    EXPECT_EQ(lines[1].entries.at(8), "VISIBLE_SILHOUETTE");
    ASSERT_EQ(lines[1].points.size(), 3u);
    EXPECT_TRUE(lines[1].is_closed());
    EXPECT_EQ(lines[1].points[1], glm::dvec2(30, 50));
    EXPECT_EQ(lines[1].points[2], glm::dvec2(30, 40));
    EXPECT_EQ(lines[1].entries.at(40), "0.8");
    EXPECT_FALSE(lines[3].is_closed());
    for (const glm::dvec2 p : lines[3].points) EXPECT_NEAR(glm::distance(p, glm::dvec2(80, 40)), 10, 1e-3);
    for (std::size_t i = 0; i + 1 < lines[3].points.size(); ++i) {
        const glm::dvec2 middle = 0.5 * (lines[3].points[i] + lines[3].points[i + 1]);
        EXPECT_GT(glm::distance(middle, glm::dvec2(80, 40)), 10 - 0.02 / 5 - 1e-3);
        EXPECT_GT(middle.y, 40);
    }
    EXPECT_EQ(file.pairs[4], std::pair(9, std::string("$INSUNITS")));
    EXPECT_EQ(file.pairs[5], std::pair(70, std::string("4")));
    const std::vector<std::string> expected = {
        "DXF R12: 1 path is drawn opaque", "DXF R12: 1 path is the outline of a stroke whose width varies, not filled"};
    EXPECT_EQ(notes, expected);
}

TEST(Dxf, LayersHaveColoursAndLineTypes) {
    const DxfFile file(dxf(several_paths().drawing));
    const auto layers = file.table("LAYER"), types = file.table("LTYPE");
    EXPECT_EQ(layers.at("HIDDEN_CREASE").find(62)->second, "1");  // red
    EXPECT_EQ(layers.at("HIDDEN_CREASE").find(6)->second, "DASHES_1");
    EXPECT_EQ(layers.at("VISIBLE_SILHOUETTE").find(62)->second, "7");
    std::vector<std::string> parts;
    for (auto [at, end] = types.at("DASHES_1").equal_range(49); at != end; ++at) parts.push_back(at->second);
    EXPECT_EQ(parts, (std::vector<std::string>{"4", "-2"}));
    EXPECT_EQ(file.polylines()[4].entries.at(62), "5");  // blue, unlike its layer
}

/// Line types have no phase: patterns that differ by what fits them to loops are one.
TEST(Dxf, StretchedDashesAreOneLineType) {
    VectorDrawing drawing = several_paths().drawing;
    std::vector<VectorStyle> styles;
    for (const float stretch : {0.9f, 1.0f, 1.0f, 1.1f, 1.2f, 3.0f}) {
        styles.push_back(drawing.styles[0]);
        styles.back().dash_px = {4 * stretch, 2 * stretch};
    }
    drawing.styles = styles;
    for (std::size_t i = 0; i < drawing.paths.size(); ++i) drawing.paths[i].style = static_cast<std::uint32_t>(i % 6);
    const DxfFile file(dxf(drawing));
    const auto types = file.table("LTYPE");
    EXPECT_EQ(types.size(), 3u);  // with CONTINUOUS
    std::vector<std::string> parts;
    for (auto [at, end] = types.at("DASHES_1").equal_range(49); at != end; ++at) parts.push_back(at->second);
    EXPECT_EQ(parts, (std::vector<std::string>{"0.8", "-0.4"}));  // that of two paths; a pixel is 0.2 mm
}

TEST(Dxf, NearestColours) {
    EXPECT_EQ(nearest_color_index({0, 0, 0}), 7);
    EXPECT_EQ(nearest_color_index({254, 1, 2}), 1);
    EXPECT_EQ(nearest_color_index({255, 255, 255}), 255);
    EXPECT_EQ(nearest_color_index({129, 127, 128}), 8);
    EXPECT_EQ(nearest_color_index({255, 127, 0}), 30);
    EXPECT_EQ(nearest_color_index({0, 82, 165}), 152);
}

TEST(Dxf, NamesOfLayersArePlainAndDiffer) {
    Drawing d;
    d.drawing.grouping = VectorGrouping::object;
    d.drawing.objects = {"Rad \xC3\xBC\n<1>", "Rad \xC3\xB6\n<1>", std::string(80, 'x')};
    for (std::uint32_t object = 1; object <= 3; ++object) {
        d.begin_group(false, LineClass::crease);
        d.drawing.groups.back().object = object;
        d.add({0, 0}, {line(10, 10)}, stroke(1));
    }
    std::vector<std::string> notes;
    const auto layers = DxfFile(dxf(d.drawing, &notes)).table("LAYER");
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_TRUE(notes[0].starts_with("DXF R12: the names of 3 layers")) << notes[0];
    EXPECT_EQ(layers.size(), 4u);
    EXPECT_TRUE(layers.contains("VISIBLE_RAD____1_"));
    EXPECT_TRUE(layers.contains("VISIBLE_RAD____1_-2"));
    for (const auto& [name, entries] : layers) EXPECT_LE(name.size(), 31u);
}

TEST(Dxf, LayersOfObjectsWithoutNames) {
    Drawing d;
    d.drawing.grouping = VectorGrouping::object;
    d.drawing.objects = {""};
    for (std::uint32_t object = 0; object <= 1; ++object) {
        d.begin_group(object == 0, LineClass::crease);
        d.drawing.groups.back().object = object;
        d.add({0, 0}, {line(10, 10)}, stroke(1));
    }
    const auto layers = DxfFile(dxf(d.drawing, nullptr)).table("LAYER");
    EXPECT_TRUE(layers.contains("HIDDEN_NO_OBJECT"));
    EXPECT_TRUE(layers.contains("VISIBLE_OBJECT"));
}

TEST(Dxf, AnEmptyDrawingIsAFile) {
    const DxfFile file(dxf(Drawing().drawing));
    EXPECT_TRUE(file.polylines().empty());
    EXPECT_EQ(file.table("LAYER").size(), 1u);
}

TEST(Dxf, EzdxfReadsIt) {
    ASSERT_EQ(std::system("/usr/bin/python3 -c 'import ezdxf' >/dev/null 2>&1"), 0)
        << "scripts/install-dependencies installs python3-ezdxf";
    const TemporaryFolder folder;
    std::ofstream(folder.file("a.dxf"), std::ios::binary) << dxf(several_paths().drawing);
    const std::string script =
        "import ezdxf; d = ezdxf.readfile('" + folder.file("a.dxf") +
        "'); a = d.audit(); assert not a.errors, a.errors; assert len(d.modelspace().query('POLYLINE')) == 6";
    EXPECT_EQ(std::system(("/usr/bin/python3 -c \"" + script + "\"").c_str()), 0);
}

// ---- all ----

TEST(VectorFiles, PaperIsNotRoundedToPixels) {
    Drawing d = several_paths();
    d.drawing.width_px = 358;
    d.drawing.height_px = 506;
    d.drawing.crop = {0, 0, 358, 506};
    d.drawing.paper_mm = {210, 297};
    d.drawing.dpi = 506 * 25.4 / 297;
    const std::string svg = svg_of(d.drawing);
    EXPECT_NE(svg.find("width=\"210mm\" height=\"297mm\" viewBox=\"0 0 357.7778 506\""), std::string::npos) << svg;
    EXPECT_NE(pdf(d.drawing).find("/MediaBox [0 0 595.275590551 841.88976378]"), std::string::npos);
    // A part of it has whole pixels.
    d.drawing.crop = {10, 20, 110, 70};
    EXPECT_NE(svg_of(d.drawing).find("viewBox=\"10 20 100 50\""), std::string::npos);
    EXPECT_NE(pdf(d.drawing).find("/MediaBox [0 0 166.381"), std::string::npos) << pdf(d.drawing);
}

TEST(VectorFiles, WidthsOfAllSizes) {
    Drawing d;
    d.begin_group(false, LineClass::silhouette);
    d.add({0, 0}, {line(10, 0)}, stroke(4096));
    d.add({0, 0}, {line(10, 0)}, stroke(0.0001f));
    EXPECT_NE(content_of(pdf(d.drawing)).find("4096 w\n"), std::string::npos);
    EXPECT_EQ(DxfFile(dxf(d.drawing)).polylines()[0].entries.at(40), "819.2");
}

}  // namespace
}  // namespace burin
