// What must not change the pictures of the z-buffer methods, and which of them are equal.

#include "mesh/shapes.h"
#include "scene/scene_description.h"
#include "tests/methods/zbuffer_support.h"
#include "tests/support/oracle.h"

namespace burin::zbuffer_invariance_test {
namespace {

using namespace test;

struct LoadedScene {
    Scene scene;
    Camera camera;
};

LoadedScene loaded(const std::string& name, int width, int height) {
    LoadedScene result;
    result.scene = load_scene(read_scene_file(BURIN_SOURCE_FOLDER "/scenes/" + name + ".toml", {}));
    result.camera =
        resolve_camera(result.scene.cameras[0], scene_points(result.scene), static_cast<double>(width) / height);
    return result;
}

TEST(ZBufferMethods, StencilIsTheEdgingPlane) {
    for (const char* const name : {"cage", "cube", "crossing", "flange", "star", "still_life", "teapot", "wireframe"}) {
        const LoadedScene s = loaded(name, 200, 140);
        const MethodDrawing a("edging-plane", s.scene, s.camera, 200, 140), b("stencil", s.scene, s.camera, 200, 140);
        EXPECT_TRUE(same_bits(a.image(), b.image())) << name;
        EXPECT_GT(a.sum("lines.A"), 50) << name;
    }
}

TEST(ZBufferMethods, ThreadsTilesAndCropsChangeNothing) {
    const LoadedScene s = loaded("teapot", 300, 200);
    const PixelRect crop{37, 29, 211, 168};
    for (const std::string_view method : kZBufferMethods) {
        const MethodDrawing one(method, s.scene, s.camera, 300, 200, 1), four(method, s.scene, s.camera, 300, 200, 4);
        EXPECT_TRUE(same_bits(one.image(), four.image())) << method;
        const MethodDrawing part(method, s.scene, s.camera, 300, 200, crop, 3);
        for (const char* const channel : {"R", "lines.A", "surface.G", "Z", "N.X", "id.polygon"}) {
            for (int y = crop.y0; y < crop.y1; ++y) {
                for (int x = crop.x0; x < crop.x1; ++x) {
                    ASSERT_EQ(part.at(channel, x - crop.x0, y - crop.y0), one.at(channel, x, y))
                        << method << channel << x << "," << y;
                }
            }
        }
    }
}

TEST(ZBufferMethods, MovesByWholePixelsMoveThePicture) {
    const MinimalScene s = scene_hilite();
    for (const std::string_view method : kZBufferMethods) {
        Camera moved = s.camera;
        moved.to_world[3] += glm::dvec4(-16, 8, 0, 0);
        const MethodDrawing a(method, s), b(method, s.scene, moved, s.size_px, s.size_px);
        for (int y = 20; y < 230; ++y) {
            for (int x = 20; x < 230; ++x) {
                ASSERT_EQ(a.at("lines.A", x, y), b.at("lines.A", x + 16, y + 8)) << method;
            }
        }
    }
}

TEST(ZBufferMethods, AgreeOnWhatSurfacesAre) {
    // Distance, normals and numbers do not depend on the method, whatever it does to z.
    const LoadedScene s = loaded("teapot", 160, 120);
    const MethodDrawing first("simple", s.scene, s.camera, 160, 120);
    for (const std::string_view method : kZBufferMethods) {
        const MethodDrawing d(method, s.scene, s.camera, 160, 120);
        for (int y = 0; y < 120; ++y) {
            for (int x = 0; x < 160; ++x) {
                for (const char* const channel : {"Z", "N.X", "N.Y", "N.Z", "id.object", "id.polygon", "surface.R"}) {
                    ASSERT_EQ(d.at(channel, x, y), first.at(channel, x, y)) << method;
                }
            }
        }
    }
    const Oracle oracle(s.scene, s.camera, 160, 120);
    int different = 0, hits = 0;
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 160; ++x) {
            const Oracle::Hit hit = oracle.cast({x + 0.5, y + 0.5});
            const double z = first.at("Z", x, y);
            hits += hit.triangle != Oracle::Hit::kNone;
            if ((hit.triangle == Oracle::Hit::kNone) != std::isinf(z)) ++different;
            if (hit.triangle != Oracle::Hit::kNone && !(std::abs(z / hit.distance - 1) < 1e-5)) ++different;
        }
    }
    EXPECT_GT(hits, 2000);
    EXPECT_LE(different, 2) << "rays through edges may find the one or the other triangle";
}

TEST(ZBufferMethods, DrawNothingWhenNothingIsAskedFor) {
    LoadedScene s = loaded("cube", 100, 80);
    s.scene.lines.classes = LineClassSet();
    for (const std::string_view method : kZBufferMethods) {
        const MethodDrawing d(method, s.scene, s.camera, 100, 80);
        EXPECT_EQ(d.sum("lines.A"), 0);
        EXPECT_GT(d.sum("A"), 1000) << "but surfaces";
    }
    s.scene = scene_of({});
    s.scene.lines.classes = LineClassSet::all();
    for (const std::string_view method : kZBufferMethods) {
        EXPECT_EQ(MethodDrawing(method, s.scene, s.camera, 60, 50).sum("A"), 0) << "an empty scene";
    }
}

TEST(ZBufferMethods, FarEyesCloseEyesAndEyesWithinTheModel) {
    Scene scene = scene_of({make_box({1, 1, 1}), make_sphere(0.3, 12, 6)});
    scene.lines.classes = LineClassSet::all();
    struct View {
        glm::dvec3 eye;
        double fov_deg;
        bool sees_edges;
    };
    // Within the sphere; before the middle of a face, so near that only the face is seen; far away.
    for (const View& view :
         {View{{0.1, 0.2, 0.05}, 60, true}, View{{0.501, 0.1, 0.1}, 60, false}, View{{3e4, 2e4, 1e4}, 0.004, true}}) {
        for (const std::string_view method : kZBufferMethods) {
            const MethodDrawing d(method, scene, perspective_camera(view.eye, {0, 0, 0}, view.fov_deg), 80, 60);
            EXPECT_EQ(d.sum("lines.A") > 20, view.sees_edges) << method << view.eye.x;
            EXPECT_GT(d.sum("A"), 80 * 60 / 8) << method << view.eye.x;
        }
    }
}

}  // namespace
}  // namespace burin::zbuffer_invariance_test
