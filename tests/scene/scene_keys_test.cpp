// Every key of a scene file has the effect that docs/scene-format.md promises.

#include <gtest/gtest.h>

#include "image/image_io.h"
#include "tests/scene/scene_text.h"

namespace burin {
namespace {

using test::bounds_of;
using test::described;
using test::expect_near;
using test::kBox;
using test::loaded;

glm::dvec3 linear(int r, int g, int b) {
    const auto channel = [](int code) {
        return static_cast<double>(linear_from_srgb(static_cast<float>(code) / 255.0f));
    };
    return {channel(r), channel(g), channel(b)};
}

TEST(SceneKeys, TheSmallestSceneHasTheDocumentedDefaults) {
    const SceneDescription scene = described(kBox);
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.objects[0].name, "box");
    EXPECT_EQ(scene.objects[0].subdivide, 0);
    EXPECT_EQ(scene.objects[0].scheme, SubdivisionScheme::automatic);
    EXPECT_EQ(scene.objects[0].to_world, glm::dmat4(1.0));
    EXPECT_EQ(scene.objects[0].instances, std::vector<glm::dmat4>{glm::dmat4(1.0)});
    EXPECT_TRUE(scene.cameras.empty());
    EXPECT_TRUE(scene.materials.empty());
    EXPECT_EQ(scene.picture.width, 1920);
    EXPECT_EQ(scene.picture.height, 1080);
    EXPECT_FALSE(scene.picture.background);
    EXPECT_FALSE(scene.picture.transparent);
    EXPECT_EQ(scene.lines.classes, kDefaultLineClasses);
    EXPECT_EQ(scene.lines.crease_angle_deg, 40);
    EXPECT_EQ(scene.lines.style.width_px, 1);
    EXPECT_EQ(scene.lines.style.side, StrokeSide::both);
    for (const glm::vec3& color : scene.lines.style.colors) EXPECT_EQ(color, glm::vec3(0.0f));
    EXPECT_EQ(scene.surfaces.shading, SurfaceShading::paper);
    EXPECT_EQ(scene.surfaces.paper_color, glm::vec3(1.0f));
    EXPECT_EQ(scene.patel.mask_bits, 64);
    EXPECT_EQ(scene.patel.halo, HaloShape::four);
    EXPECT_EQ(scene.reference.samples, 16);
}

TEST(SceneKeys, EmptyTablesChangeNothing) {
    const SceneDescription scene =
        described(std::string(kBox) + "[lines]\n[picture]\n[surfaces]\n[patel]\n[[camera]]\n");
    EXPECT_EQ(scene.picture.width, 1920);
    EXPECT_EQ(scene.lines.classes, kDefaultLineClasses);
    EXPECT_EQ(scene.lines.style.width_px, 1);
    EXPECT_EQ(scene.patel.mask_bits, 64);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].fov_deg, 35);
    EXPECT_EQ(scene.cameras[0].fit, 0.95);
    EXPECT_FALSE(scene.cameras[0].orthographic);
    EXPECT_FALSE(scene.cameras[0].eye || scene.cameras[0].target || scene.cameras[0].up || scene.cameras[0].direction ||
                 scene.cameras[0].height || scene.cameras[0].to_world);
}

struct Shape {
    const char* keys;
    std::uint32_t polygons;
    glm::dvec3 low, high;
};

TEST(SceneKeys, Shapes) {
    const Shape shapes[] = {
        {"shape='box'", 6, {-.5, -.5, -.5}, {.5, .5, .5}},
        {"shape='box'\nsize=[1,2,3.5]", 6, {-.5, -1, -1.75}, {.5, 1, 1.75}},
        {"shape='plane'", 1, {-.5, 0, -.5}, {.5, 0, .5}},
        {"shape='plane'\nsize=[4,2]\ncolumns=3\nrows=5", 15, {-2, 0, -1}, {2, 0, 1}},
        {"shape='sphere'", 64 * 32, {-.5, -.5, -.5}, {.5, .5, .5}},
        {"shape='sphere'\nradius=2\nsegments=8\nrings=4", 32, {-2, -2, -2}, {2, 2, 2}},
        {"shape='cylinder'", 66, {-.5, -.5, -.5}, {.5, .5, .5}},
        {"shape='cylinder'\nradius=2\nheight=6\nsegments=4", 6, {-2, -3, -2}, {2, 3, 2}},
        {"shape='cylinder'\nradius=1\ntop_radius=3\nsegments=4", 6, {-3, -.5, -3}, {3, .5, 3}},
        {"shape='cone'", 65, {-.5, -.5, -.5}, {.5, .5, .5}},
        {"shape='cone'\nradius=3\nheight=2\nsegments=4", 5, {-3, -1, -3}, {3, 1, 3}},
        {"shape='torus'", 64 * 32, {-.7, -.2, -.7}, {.7, .2, .7}},
        {"shape='torus'\nradius=2\ntube_radius=1\nsegments=8\ntube_segments=4", 32, {-3, -1, -3}, {3, 1, 3}},
    };
    for (const Shape& shape : shapes) {
        SCOPED_TRACE(shape.keys);
        const Scene scene = loaded("[[object]]\n" + std::string(shape.keys));
        EXPECT_EQ(scene.meshes[0].polygon_count, shape.polygons);
        expect_near(bounds_of(scene).low, shape.low);
        expect_near(bounds_of(scene).high, shape.high);
    }
    const auto teapot = [](const std::string& keys) { return loaded("[[object]]\nshape='teapot'\n" + keys); };
    EXPECT_EQ(teapot("tessellation=2").meshes[0].repairs.input_polygons, 32u * 4);
    EXPECT_EQ(teapot("").meshes[0].repairs.input_polygons, 32u * 100);
}

TEST(SceneKeys, NameAndSubdivision) {
    EXPECT_EQ(loaded("[[object]]\nshape='box'\nname='die'").objects[0].name, "die");
    EXPECT_EQ(loaded("[[object]]\nshape='cone'").objects[0].name, "cone");
    EXPECT_EQ(loaded("[[object]]\nshape='box'\nsubdivide=2").meshes[0].polygon_count, 6u * 16);
    EXPECT_EQ(described("[[object]]\nshape='box'\nscheme='loop'").objects[0].scheme, SubdivisionScheme::loop);
    EXPECT_EQ(described("[[object]]\nshape='box'\nscheme='catmull-clark'").objects[0].scheme,
              SubdivisionScheme::catmull_clark);
    EXPECT_EQ(described("[[object]]\nshape='box'\nscheme='automatic'").objects[0].scheme, SubdivisionScheme::automatic);
    EXPECT_THROW(loaded("[[object]]\nshape='box'\nscheme='loop'\nsubdivide=1"), InputError);
}

glm::dvec3 image_of(const std::string& keys, const glm::dvec3& p) {
    const SceneDescription scene = described("[[object]]\nshape='box'\n" + keys);
    return glm::dvec3(scene.objects[0].to_world * scene.objects[0].instances.back() * glm::dvec4(p, 1));
}

TEST(SceneKeys, Transforms) {
    expect_near(image_of("translate=[1,2,3]", {10, 20, 30}), {11, 22, 33});
    expect_near(image_of("scale=2", {1, 2, 3}), {2, 4, 6});
    expect_near(image_of("scale=[1,-2,0.5]", {1, 2, 4}), {1, -4, 2});
    expect_near(image_of("rotate=[90,0,0]", {0, 1, 0}), {0, 0, 1});
    expect_near(image_of("rotate=[0,90,0]", {0, 0, 1}), {1, 0, 0});
    expect_near(image_of("rotate=[0,0,90]", {1, 0, 0}), {0, 1, 0});
    // About X first, then Y, then Z.
    expect_near(image_of("rotate=[90,90,0]", {0, 1, 0}), {1, 0, 0});
    expect_near(image_of("rotate=[90,0,90]", {0, 1, 0}), {0, 0, 1});
    expect_near(image_of("rotate=[0,90,90]", {0, 0, 1}), {0, 1, 0});
    // Scale first, translation last.
    expect_near(image_of("translate=[5,0,0]\nrotate=[0,0,90]\nscale=[2,1,1]", {1, 0, 0}), {5, 2, 0});
    expect_near(image_of("rotate=[0,0,360]", {1, 2, 3}), {1, 2, 3}, 1e-12);
}

TEST(SceneKeys, AMatrixIsWrittenRowByRow) {
    const std::string matrix = "matrix=[2,2,3,4, 5,6,7,8, 9,10,11,12, 0,0,0,1]";
    expect_near(image_of(matrix, {0, 0, 0}), {4, 8, 12});
    expect_near(image_of(matrix, {1, 0, 0}), {6, 13, 21});
    expect_near(image_of(matrix, {0, 1, 0}), {6, 14, 22});
    expect_near(image_of(matrix, {0, 0, 1}), {7, 15, 23});
}

TEST(SceneKeys, Instances) {
    const Scene scene = loaded(R"(
[[object]]
shape = 'box'
name = 'die'
translate = [100, 0, 0]
rotate = [0, 0, 90]
[[object.instance]]
translate = [10, 0, 0]
[[object.instance]]
scale = 3
[[object.instance]]
matrix = [1,0,0,0, 0,1,0,0, 0,0,1,7, 0,0,0,1]
)");
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.objects.size(), 3u);
    EXPECT_EQ(scene.objects[0].name, "die#1");
    EXPECT_EQ(scene.objects[2].name, "die#3");
    const auto origin = [&](std::size_t i) { return glm::dvec3(scene.objects[i].to_world[3]); };
    expect_near(origin(0), {100, 10, 0});  // the instance lies within the object's transform
    expect_near(origin(1), {100, 0, 0});
    expect_near(origin(2), {100, 0, 7});
    EXPECT_NEAR(glm::length(glm::dvec3(scene.objects[1].to_world[0])), 3, 1e-12);
}

TEST(SceneKeys, Materials) {
    const Scene scene = loaded(R"(
[[material]]
name = 'clay'
color = '#804020'
[[material]]
name = 'glass'
color = [0.1, 0.2, 3]
opacity = 0.25
[[object]]
shape = 'box'
material = 'glass'
[[object]]
shape = 'box'
)");
    ASSERT_EQ(scene.materials.size(), 4u);  // two of the file and one per shape
    EXPECT_EQ(scene.materials[0].name, "clay");
    expect_near(glm::dvec3(scene.materials[0].color), linear(0x80, 0x40, 0x20));
    EXPECT_EQ(scene.materials[0].opacity, 1.0f);
    expect_near(glm::dvec3(scene.materials[1].color), {0.1, 0.2, 3});
    EXPECT_EQ(scene.materials[1].opacity, 0.25f);
    EXPECT_EQ(scene.objects[0].materials, std::vector<std::uint32_t>{1});
    EXPECT_EQ(scene.objects[1].materials, std::vector<std::uint32_t>{3});
    EXPECT_EQ(scene.materials[3].color, Material{}.color);
}

TEST(SceneKeys, HiddenLines) {
    const std::string box = "[[object]]\nshape = 'box'\n";
    const HiddenLineStyle none = loaded(box).lines.style.hidden;
    EXPECT_EQ(none.style, HiddenStyle::none);
    const LineStyle style = loaded(box + R"([lines]
width = 2
[lines.hidden]
style = 'dashed'
color = '#804020'
)")
                                .lines.style;
    EXPECT_EQ(style.hidden.style, HiddenStyle::dashed);
    EXPECT_EQ(style.hidden_width_px(), 2) << "as visible lines";
    EXPECT_EQ(style.hidden_dash_px(), (std::array<double, 2>{8, 6}));
    expect_near(glm::dvec3(style.hidden.color), linear(0x80, 0x40, 0x20));
    const LineStyle own = loaded(box + "[lines.hidden]\nwidth = 0.5\ndash = [5, 1.5]\n").lines.style;
    EXPECT_EQ(own.hidden_width_px(), 0.5);
    EXPECT_EQ(own.hidden_dash_px(), (std::array<double, 2>{5, 1.5}));
}

TEST(SceneKeys, Cameras) {
    const SceneDescription scene = described(std::string(kBox) + R"(
[[camera]]
name = 'front'
eye = [1, 2, 3]
target = [4, 5, 6]
up = [0, 0, 1]
fov = 50
[[camera]]
name = 'plan'
projection = 'orthographic'
direction = [0, 0, 1]
fit = 0.5
[[camera]]
name = 'section'
height = 12.5
[[camera]]
projection = 'perspective'
)");
    ASSERT_EQ(scene.cameras.size(), 4u);
    const CameraSettings& front = scene.cameras[0];
    EXPECT_EQ(front.name, "front");
    EXPECT_FALSE(front.orthographic);
    EXPECT_EQ(front.eye, glm::dvec3(1, 2, 3));
    EXPECT_EQ(front.target, glm::dvec3(4, 5, 6));
    EXPECT_EQ(front.up, glm::dvec3(0, 0, 1));
    EXPECT_EQ(front.fov_deg, 50);
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_EQ(scene.cameras[1].direction, glm::dvec3(0, 0, 1));
    EXPECT_EQ(scene.cameras[1].fit, 0.5);
    EXPECT_FALSE(scene.cameras[1].height);
    EXPECT_TRUE(scene.cameras[2].orthographic);  // a height says so
    EXPECT_EQ(scene.cameras[2].height, 12.5);
    EXPECT_FALSE(scene.cameras[3].orthographic);
    EXPECT_EQ(scene.cameras[3].name, "");
}

TEST(SceneKeys, Lines) {
    const auto lines = [](const std::string& keys) { return described(kBox + ("[lines]\n" + keys)).lines; };
    EXPECT_EQ(lines("draw=['crease','mark']").classes, LineClass::crease | LineClass::mark);
    EXPECT_EQ(lines("draw=['all']").classes, LineClassSet::all());
    EXPECT_EQ(lines("draw='all'").classes, LineClassSet::all());
    EXPECT_TRUE(lines("draw=['none']").classes.empty());
    EXPECT_TRUE(lines("draw=[]").classes.empty());
    for (int c = 0; c < kLineClassCount; ++c) {
        const auto line_class = static_cast<LineClass>(c);
        EXPECT_EQ(lines("draw=['" + std::string(name_of(line_class)) + "']").classes, LineClassSet(line_class));
    }
    EXPECT_EQ(lines("width=2.5").style.width_px, 2.5);
    EXPECT_EQ(lines("width=1024").style.width_px, 1024);
    EXPECT_EQ(lines("crease_angle=0").crease_angle_deg, 0);
    EXPECT_EQ(lines("crease_angle=180").crease_angle_deg, 180);
    EXPECT_EQ(lines("crease_angle=180").crease_fade_deg, 0);
    EXPECT_EQ(lines("crease_angle=[35,45]").crease_angle_deg, 40);
    EXPECT_EQ(lines("").contours, Contours::mesh);
    EXPECT_EQ(lines("contours='smooth'").contours, Contours::smooth);
    EXPECT_FALSE(lines("").style.dash_px.has_value());
    EXPECT_EQ(*lines("dash=[6,2.5]").style.dash_px, (std::array<double, 2>{6, 2.5}));
    EXPECT_EQ(lines("crease_angle=[35,45]").crease_fade().from_deg, 35);
    EXPECT_EQ(lines("crease_angle=[35,45]").crease_fade().to_deg, 45);
    EXPECT_EQ(lines("side='both'").style.side, StrokeSide::both);
    EXPECT_EQ(lines("side='inside'").style.side, StrokeSide::inside);
    EXPECT_EQ(lines("side='outside'").style.side, StrokeSide::outside);
    EXPECT_EQ(lines("").style.filter, PixelFilter::box);
    EXPECT_EQ(lines("filter='box'").style.filter, PixelFilter::box);
    EXPECT_EQ(lines("filter='gaussian'").style.filter, PixelFilter::gaussian);
    EXPECT_EQ(lines("filter='mitchell'").style.filter, PixelFilter::mitchell);
    for (const glm::vec3& color : lines("color='#ff0000'").style.colors) EXPECT_EQ(color, glm::vec3(1, 0, 0));
}

TEST(SceneKeys, ColorsPerLineClass) {
    const LineStyle style = described(std::string(kBox) + R"(
[lines]
color = '#0f0'
[lines.colors]
crease = [0.5, 0.25, 0]
mark = '#0000ff'
)")
                                .lines.style;
    EXPECT_EQ(style.color_of(LineClass::silhouette), glm::vec3(0, 1, 0));
    EXPECT_EQ(style.color_of(LineClass::crease), glm::vec3(0.5f, 0.25f, 0));
    EXPECT_EQ(style.color_of(LineClass::mark), glm::vec3(0, 0, 1));
    for (int c = 0; c < kLineClassCount; ++c) {
        const std::string name(kLineClassNames[static_cast<std::size_t>(c)]);
        EXPECT_EQ(
            described(kBox + ("[lines.colors]\n" + name + "='#f00'")).lines.style.colors[static_cast<std::size_t>(c)],
            glm::vec3(1, 0, 0));
    }
}

TEST(SceneKeys, SurfacesPictureAndPatel) {
    const auto scene = [](const std::string& text) { return described(kBox + text); };
    EXPECT_EQ(scene("[surfaces]\nshading='paper'").surfaces.shading, SurfaceShading::paper);
    EXPECT_EQ(scene("[surfaces]\nshading='lambert'").surfaces.shading, SurfaceShading::lambert);
    EXPECT_EQ(scene("[surfaces]\nshading='none'").surfaces.shading, SurfaceShading::none);
    EXPECT_EQ(scene("[surfaces]\npaper='#00f'").surfaces.paper_color, glm::vec3(0, 0, 1));

    EXPECT_EQ(scene("[picture]\nsize=[1,65535]").picture.height, 65535);
    EXPECT_EQ(scene("[picture]\nsize=[320,200]").picture.width, 320);
    EXPECT_EQ(scene("[picture]\nbackground='#fff'").picture.background, glm::vec3(1.0f));
    EXPECT_EQ(scene("[picture]\nbackground=[0,0.5,0]").picture.background, glm::vec3(0, 0.5f, 0));
    EXPECT_TRUE(scene("[picture]\nbackground='transparent'").picture.transparent);
    EXPECT_FALSE(scene("[picture]\nbackground='#fff'").picture.transparent);

    for (const int bits : {16, 64, 256}) {
        EXPECT_EQ(scene("[patel]\nmask=" + std::to_string(bits)).patel.mask_bits, bits);
    }
    EXPECT_EQ(scene("[reference]\nsamples=64").reference.samples, 64);
    EXPECT_EQ(scene("[patel]\nhalo='four'").patel.halo, HaloShape::four);
    EXPECT_EQ(scene("[patel]\nhalo='eight'").patel.halo, HaloShape::eight);
    EXPECT_EQ(scene("[patel]\nhalo='octagon'").patel.halo, HaloShape::octagon);
}

TEST(SceneKeys, ZBuffer) {
    const auto settings = [](const std::string& keys) { return described(kBox + ("[zbuffer]\n" + keys)).zbuffer; };
    EXPECT_EQ(settings("").depth_bits, 24);
    EXPECT_EQ(settings("").eps, 1e-3);
    EXPECT_EQ(settings("").factor, 1);
    EXPECT_EQ(settings("").units, 1);
    EXPECT_FALSE(settings("").clamp || settings("").adjust || settings("").depth_range);
    EXPECT_TRUE(settings("").canonical_edges);
    for (const int bits : {16, 24, 32, 64}) {
        EXPECT_EQ(settings("depth_bits=" + std::to_string(bits)).depth_bits, bits);
    }
    EXPECT_EQ((*settings("depth_range=[2,30]").depth_range)[1], 30);
    EXPECT_EQ(settings("eps=0.25").eps, 0.25);
    EXPECT_EQ(settings("factor=0").factor, 0);
    EXPECT_EQ(settings("units=4").units, 4);
    EXPECT_EQ(settings("clamp=0.01").clamp, 0.01);
    EXPECT_EQ(settings("adjust='edges'").adjust, DepthAdjust::edges);
    EXPECT_EQ(settings("adjust='fills'").adjust, DepthAdjust::fills);
    EXPECT_FALSE(settings("canonical_edges=false").canonical_edges);
    EXPECT_EQ(settings("highlight='crease'").highlight_classes, LineClass::crease);
    const ZBufferSettings several = settings("highlight=['crease','mark','box']\nhighlight_color='#00f'");
    EXPECT_EQ(several.highlight_classes, LineClass::crease | LineClass::mark);
    EXPECT_EQ(several.highlight_objects, std::vector<std::string>{"box"});
    EXPECT_EQ(several.highlight_color, glm::vec3(0, 0, 1));
    EXPECT_NO_THROW(loaded(kBox + std::string("[zbuffer]\nhighlight=['box','crease']")));
    EXPECT_THROW(loaded(kBox + std::string("[zbuffer]\nhighlight=['creases']")), InputError);
}

TEST(SceneKeys, ASingleTableCountsAsAListOfOne) {
    const SceneDescription scene = described("[object]\nshape='box'\n[camera]\nname='a'\n[material]\nname='m'\n");
    EXPECT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(SceneKeys, ByteOrderMarksAndLineEndingsOfWindows) {
    EXPECT_EQ(described("\xEF\xBB\xBF[[object]]\r\nshape='box'\r\n[lines]\r\nwidth=3\r\n").lines.style.width_px, 3);
}

}  // namespace
}  // namespace burin
