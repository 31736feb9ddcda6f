#include "tests/support/drawing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/build_meshes.h"
#include "render/film.h"
#include "render/frame.h"

namespace burin::test {

Scene scene_of(std::vector<PolygonSoup> objects) {
    Scene scene;
    for (PolygonSoup& soup : objects) {
        if (soup.object_names.empty()) soup.object_names = {"object"};
        if (soup.materials.empty()) soup.materials = {Material{}};
        std::vector<std::uint32_t> materials(soup.materials.size());
        std::iota(materials.begin(), materials.end(), static_cast<std::uint32_t>(scene.materials.size()));
        for (const Material& m : soup.materials) scene.materials.push_back(m);
        for (Mesh& mesh : build_meshes(soup, {})) {
            SceneObject object;
            object.name = mesh.name;
            object.mesh = static_cast<std::uint32_t>(scene.meshes.size());
            object.materials = materials;
            scene.meshes.push_back(std::move(mesh));
            scene.objects.push_back(std::move(object));
        }
    }
    scene.cameras.emplace_back();
    return scene;
}

PolygonSoup soup_of(std::vector<glm::dvec3> positions, std::vector<std::vector<std::uint32_t>> polygons) {
    PolygonSoup soup;
    soup.positions = std::move(positions);
    for (const auto& polygon : polygons) soup.add_polygon(polygon);
    return soup;
}

PolygonSoup transformed(PolygonSoup soup, const std::function<glm::dvec3(glm::dvec3)>& f) {
    for (glm::dvec3& p : soup.positions) p = f(p);
    return soup;
}

Camera pixel_camera(int width, int height, double eye_z) {
    Camera camera;
    camera.orthographic = true;
    camera.height = height;
    camera.to_world[3] = glm::dvec4(0.5 * width, 0.5 * height, eye_z, 1);
    return camera;
}

Camera perspective_camera(glm::dvec3 eye, glm::dvec3 target, double fov_deg) {
    CameraSettings settings;
    settings.eye = eye;
    settings.target = target;
    settings.fov_deg = fov_deg;
    return resolve_camera(
        settings, [](const auto&) {}, 1);
}

Drawing::Drawing(const Scene& scene, const Camera& camera, int width, int height, int threads)
    : Drawing(scene, camera, width, height, {0, 0, width, height}, threads) {}

Drawing::Drawing(const Scene& scene, const Camera& camera, int width, int height, PixelRect crop, int threads,
                 RenderFunction render) {
    const Frame frame = make_frame(scene, camera, width, height, crop);
    LayerSet all{true, true, true, true, true, true, true};
    all.lines_hidden = scene.lines.style.hidden.style != HiddenStyle::none;
    Film film({0, 0, width, height}, crop, all, frame.criteria.classes);
    RunOptions options;
    options.threads = threads;
    render(frame, options, film);
    image_ = film.image();
}

double Drawing::at(const std::string& channel, int x, int y) const {
    const Channel* const c = image_.find(channel);
    if (c == nullptr) ADD_FAILURE() << "no channel " << channel;
    return c == nullptr ? std::nan("") : image_.value(*c, x, y);
}

double Drawing::line(LineClass c, int x, int y) const {
    const Channel* const channel = image_.find("coverage." + std::string(name_of(c)));
    return channel == nullptr ? 0 : image_.value(*channel, x, y);
}

double Drawing::sum(const std::string& channel) const {
    double sum = 0;
    for (int y = 0; y < height(); ++y) {
        for (int x = 0; x < width(); ++x) sum += at(channel, x, y);
    }
    return sum;
}

double Drawing::sum(LineClass c) const {
    const std::string name = "coverage." + std::string(name_of(c));
    return image_.find(name) == nullptr ? 0 : sum(name);
}

std::vector<double> Drawing::coverage() const {
    std::vector<double> values;
    for (int y = 0; y < height(); ++y) {
        for (int x = 0; x < width(); ++x) values.push_back(line(x, y));
    }
    return values;
}

double Drawing::drawn_share(glm::dvec2 a, glm::dvec2 b, double trim_px, double reach_px) const {
    const double length = glm::distance(a, b);
    int points = 0, drawn = 0;
    for (double s = trim_px; s <= length - trim_px; s += 0.25) {
        const glm::dvec2 p = glm::mix(a, b, s / length);
        bool found = false;
        for (int y = static_cast<int>(std::floor(p.y)) - 1; y <= p.y + 1; ++y) {
            for (int x = static_cast<int>(std::floor(p.x)) - 1; x <= p.x + 1; ++x) {
                if (x < 0 || y < 0 || x >= width() || y >= height()) continue;
                const glm::dvec2 d =
                    glm::max(glm::max(glm::dvec2(x, y) - p, p - glm::dvec2(x + 1, y + 1)), glm::dvec2(0.0));
                found = found || (glm::length(d) <= reach_px && line(x, y) > 0);
            }
        }
        ++points;
        drawn += found;
    }
    return points == 0 ? std::nan("") : static_cast<double>(drawn) / points;
}

::testing::AssertionResult same_bits(const Image& a, const Image& b) {
    if (a.data() != b.data() || a.channels().size() != b.channels().size()) {
        return ::testing::AssertionFailure() << "the images have different sizes or channels";
    }
    for (std::size_t c = 0; c < a.channels().size(); ++c) {
        const Channel &x = a.channels()[c], &y = b.channels()[c];
        if (x.name != y.name) return ::testing::AssertionFailure() << x.name << " is not " << y.name;
        if (x.bytes == y.bytes) continue;
        const auto at = std::mismatch(x.bytes.begin(), x.bytes.end(), y.bytes.begin()).first - x.bytes.begin();
        const int pixel = static_cast<int>(static_cast<std::size_t>(at) / size_of(x.type));
        const int px = pixel % a.width(), py = pixel / a.width();
        return ::testing::AssertionFailure() << "channel " << x.name << " differs at pixel " << px << "," << py << ": "
                                             << a.value(x, px, py) << " and " << b.value(y, px, py);
    }
    return ::testing::AssertionSuccess();
}

}  // namespace burin::test
