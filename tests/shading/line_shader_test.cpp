// The contour shaders that mental ray ships, as one line of a sheet each and as line shaders: the ink is what their
// formulas say of the surfaces at the line.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>

#include "shading/line_shader.h"
#include "shading/sheet/compiled_sheet.h"
#include "tests/support/shaded_scene.h"

namespace burin {
namespace {

using namespace test;
using V = Variable;

/// Boxes, a cone of eight sides and a pane of glass, of several colours, some behind others.
constexpr const char* kScene = R"(
[camera]
eye = [2, 2.5, 6]
target = [0.2, 0.1, 0]
fov = 40
[[material]]
name = "red"
color = [0.8, 0.1, 0.2]
[[material]]
name = "blue"
color = [0.1, 0.3, 0.6]
[[material]]
name = "glass"
color = [0.2, 0.9, 0.4]
opacity = 0.4
[[object]]
shape = "box"
material = "red"
size = [1, 2, 1.5]
rotate = [10, 30, 20]
[[object]]
shape = "cone"
segments = 8
height = 1.5
material = "blue"
translate = [1.2, 0.2, -1]
[[object]]
shape = "box"
material = "glass"
size = [0.8, 0.6, 0.1]
translate = [0.6, 0.4, 1.5]
)";

/// What is known at a place of a line, without expressions and columns.
struct Place {
    const FoundLines& lines;
    const LinePiece& piece;
    const LineSides& sides;
    double share;

    double depth() const {
        return lines.projection.distance(
            glm::mix(static_cast<double>(piece.nearness_from), static_cast<double>(piece.nearness_to), share));
    }
    double light() const {
        const glm::dvec3 n =
            glm::normalize(glm::mix(glm::dvec3(sides.front_normals[0]), glm::dvec3(sides.front_normals[1]), share));
        glm::dvec3 origin, direction;
        lines.projection.view_ray(glm::mix(piece.from, piece.to, share), origin, direction);
        const glm::dvec3 to_light = lines.light ? glm::normalize(*lines.light) : -glm::normalize(direction);
        return std::clamp(glm::dot(n, to_light), 0.0, 1.0);
    }
    glm::dvec3 color(bool is_front) const {
        const std::uint32_t material = is_front ? sides.front_material : sides.other_material;
        return material == 0 ? glm::dvec3(0) : glm::dvec3(lines.material_colors[material - 1]);
    }
};

/// Width, or the colour.
using Formula = std::function<glm::dvec3(const Place&)>;
using Shade = std::function<void(const StrokeSamples&, StrokeInk&)>;

struct NativeShader final : LineShader {
    std::vector<Variable> reads;
    Shade compute;

    VariableSet needs() const override {
        VariableSet set;
        for (const Variable v : reads) set.add(v);
        return set;
    }
    void shade(const StrokeSamples& in, StrokeInk& out) const override { compute(in, out); }
};

/// A shader of mental ray: what a sheet says, the same as code, and the formula.
struct Shipped {
    std::string name, style, head;
    bool is_color = false;
    std::vector<Variable> reads;
    Shade shade;
    Formula formula;
};

/// A shader that computes the width of each sample from one number.
template <typename Compute>
Shade width_from(Variable v, const Compute& compute) {
    return [v, compute](const StrokeSamples& in, StrokeInk& out) {
        for (std::size_t i = 0; i < in.count(); ++i) out.width_px[i] = compute(in.column(v)[i]);
    };
}
/// One that computes the colour, component by component, from the colours of both sides.
template <typename Compute>
Shade color_from(const Compute& compute) {
    return [compute](const StrokeSamples& in, StrokeInk& out) {
        const std::span<float> parts[] = {out.red, out.green, out.blue};
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t i = 0; i < in.count(); ++i)
                parts[k][i] = compute(in.column(V::C, k)[i], in.column(V::C2, k)[i]);
        }
    };
}

double mix(double a, double b, double share) { return a + (b - a) * share; }
float mixf(float a, float b, float share) { return a + (b - a) * share; }

// Widths up to 1.5 px: beyond, samples may leave more than 1/64 px between them.
std::vector<Shipped> shipped() {
    return {
        {"depth fade",
         "width = { over = \"depth\", stops = [[4, 1.5], [9, 0.3]] }",
         "",
         false,
         {V::depth},
         width_from(V::depth, [](float d) { return mixf(1.5f, 0.3f, std::clamp((d - 4) / 5, 0.0f, 1.0f)); }),
         [](const Place& p) { return glm::dvec3(mix(1.5, 0.3, std::clamp((p.depth() - 4) / 5, 0.0, 1.0))); }},
        {"layer thinner",
         "width = \"=1.5 * 0.5^qi\"",
         "",
         false,
         {V::qi},
         width_from(V::qi, [](float qi) { return 1.5f * std::exp2(-qi); }),
         [](const Place& p) { return glm::dvec3(1.5 * std::pow(0.5, p.piece.invisibility)); }},
        {"layer thinner behind glass",
         "width = \"=1.5 * transmission\"",
         "",
         false,
         {V::transmission},
         width_from(V::transmission, [](float t) { return 1.5f * t; }),
         [](const Place& p) { return glm::dvec3(1.5 * static_cast<double>(p.piece.transmission) / 255); }},
        {"curvature",
         "width = \"=mix(0.3, 1.5, 0.5 - 0.5 * cosd(dihedral))\"",
         "",
         false,
         {V::dihedral},
         width_from(
             V::dihedral,
             [](float deg) { return mixf(0.3f, 1.5f, 0.5f - 0.5f * std::cos(deg * std::numbers::pi_v<float> / 180)); }),
         [](const Place& p) {
             const double radians = static_cast<double>(p.sides.dihedral_deg) * std::numbers::pi / 180;
             return glm::dvec3(mix(0.3, 1.5, 0.5 - 0.5 * std::cos(radians)));
         }},
        {"width from light",
         "width = \"=mix(1.5, 0.3, light)\"",
         "",
         false,
         {V::light},
         width_from(V::light, [](float light) { return mixf(1.5f, 0.3f, light); }),
         [](const Place& p) { return glm::dvec3(mix(1.5, 0.3, p.light())); }},
        {"width from light direction",
         "width = \"=mix(1.5, 0.3, light)\"",
         "light = [-1, 2, 1]\n",
         false,
         {V::light},
         width_from(V::light, [](float light) { return mixf(1.5f, 0.3f, light); }),
         [](const Place& p) { return glm::dvec3(mix(1.5, 0.3, p.light())); }},
        {"width from colour",
         "width = \"=mix(1.5, 0.3, max(C.r, C.g, C.b))\"",
         "",
         false,
         {V::C},
         [](const StrokeSamples& in, StrokeInk& out) {
             for (std::size_t i = 0; i < in.count(); ++i) {
                 const float most = std::max({in.column(V::C, 0)[i], in.column(V::C, 1)[i], in.column(V::C, 2)[i]});
                 out.width_px[i] = mixf(1.5f, 0.3f, most);
             }
         },
         [](const Place& p) {
             const glm::dvec3 c = p.color(true);
             return glm::dvec3(mix(1.5, 0.3, std::max({c.r, c.g, c.b})));
         }},
        {"factor colour",
         "color = \"=0.5 * C\"",
         "",
         true,
         {V::C, V::C2},
         color_from([](float c, float) { return 0.5f * c; }),
         [](const Place& p) { return 0.5 * p.color(true); }},
        {"maximum colour",
         "color = \"=max(C, C2)\"",
         "",
         true,
         {V::C, V::C2},
         color_from([](float c, float c2) { return std::max(c, c2); }),
         [](const Place& p) { return glm::max(p.color(true), p.color(false)); }},
    };
}

/// How far an ink is from the formula at the nearest place of its line. Where pieces meet, either may count.
double distance_from(const Formula& formula, const FoundLines& lines, const InkStroke& stroke, glm::dvec2 place,
                     const glm::dvec3& ink) {
    const LineRun& run = lines.runs.runs[stroke.chain >> 3];
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = run.first; i < run.first + run.count; ++i) {
        const LinePiece& piece = lines.runs.pieces[i].piece;
        const glm::dvec2 way = piece.to - piece.from;
        const double share = std::clamp(glm::dot(place - piece.from, way) / glm::dot(way, way), 0.0, 1.0);
        if (glm::distance(piece.from + way * share, place) > 1e-6) continue;
        const glm::dvec3 difference = glm::abs(formula({lines, piece, lines.sides[i], share}) - ink);
        least = std::min(least, std::max({difference.x, difference.y, difference.z}));
    }
    return least;
}

void expect_formula(const Shipped& of, const FoundLines& lines, const InkedLines& inked) {
    const auto ink = [&](const InkPoint& p) {
        return of.is_color ? glm::dvec3(p.color) : glm::dvec3(static_cast<double>(p.width_px));
    };
    std::set<double> values;
    std::size_t count = 0;
    for (const InkStroke& stroke : inked.strokes) {
        const auto points = inked.points_of(stroke);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            // At a sample, and between two.
            const glm::dvec2 middle = 0.5 * (points[i].place + points[i + 1].place);
            const glm::dvec3 mean = 0.5 * (ink(points[i]) + ink(points[i + 1]));
            ASSERT_LT(distance_from(of.formula, lines, stroke, points[i].place, ink(points[i])), 1e-4) << of.name;
            ASSERT_LE(distance_from(of.formula, lines, stroke, middle, mean), 1.0 / 64) << of.name;
            values.insert(std::round(1000 * ink(points[i]).x));
            ++count;
        }
    }
    EXPECT_GT(count, 40u) << of.name;
    EXPECT_GT(values.size(), 1u) << of.name << ": all lines are alike";
}

TEST(LineShader, NineShadersOfMentalRayAreOneLineEach) {
    for (const Shipped& of : shipped()) {
        const std::string set = "qi = [0, 255]", classes = R"("silhouette", "crease", "border")";
        const ShadedScene scene(kScene, of.head + sheet_of(classes, of.style, set));
        const FoundLines lines = scene.found();
        std::vector<std::string> notes;
        expect_formula(of, lines, scene.inked());

        const auto native = std::make_shared<NativeShader>();
        native->reads = of.reads;
        native->compute = of.shade;
        const auto shaders = std::make_shared<LineShaders>();
        shaders->shaders["native"] = native;
        ShadedScene by_code(kScene, of.head + sheet_of(classes, "shader = \"native\"", set));
        by_code.scene().line_shaders = shaders;
        expect_formula(of, by_code.found(), by_code.inked());
    }
}

/// A jump of a shader's value lies where it is, and its samples have what they asked for.
TEST(LineShader, JumpsAreFoundToAQuarterOfAPixel) {
    const auto native = std::make_shared<NativeShader>();
    native->reads = {V::x};
    native->compute = width_from(V::x, [](float x) { return x < 91.3f ? 1.0f : 7.0f; });
    const auto shaders = std::make_shared<LineShaders>();
    shaders->shaders["native"] = native;
    ShadedScene scene(kScene, sheet_of(R"("silhouette", "crease")", "shader = \"native\""));
    scene.scene().line_shaders = shaders;
    const InkedLines inked = scene.inked();
    int jumps = 0;
    for (const InkStroke& stroke : inked.strokes) {
        const auto points = inked.points_of(stroke);
        for (std::size_t i = 0; i < points.size(); ++i) {
            ASSERT_EQ(points[i].width_px, points[i].place.x < 91.3 ? 1.0f : 7.0f) << points[i].place.x;
            if (i == 0 || points[i].width_px == points[i - 1].width_px) continue;
            ++jumps;
            EXPECT_LE(glm::distance(points[i].place, points[i - 1].place), 0.25 + 1e-9);
        }
    }
    EXPECT_GT(jumps, 2);
}

/// What is computed of `in.column()` is there for exactly what was asked for, and not more is computed.
TEST(LineShader, NeedsOfTheSheetAreThoseOfItsCode) {
    const auto needs_of = [](std::vector<Variable> reads) {
        const auto native = std::make_shared<NativeShader>();
        native->reads = std::move(reads);
        LineShaders shaders;
        shaders.shaders["native"] = native;
        SheetContext context;
        context.shaders = &shaders;
        return CompiledSheet(read_sheet_text(sheet_of(R"("crease")", "shader = \"native\""), "s.toml"), context)
            .needs();
    };
    EXPECT_TRUE(needs_of({}).chains);  // it may move lines
    EXPECT_FALSE(needs_of({V::depth}).sides);
    EXPECT_TRUE(needs_of({V::gap}).sides);
    EXPECT_TRUE(needs_of({V::qi}).tells_invisibility);
    EXPECT_FALSE(needs_of({V::depth}).tells_invisibility);
    EXPECT_TRUE(needs_of({V::transmission}).tells_transmission);
    EXPECT_GE(needs_of({}).most_reach_px, 4096.0f);
}

}  // namespace
}  // namespace burin
