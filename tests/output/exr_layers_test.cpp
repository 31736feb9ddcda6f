// Layers that tell whose pixels are, and where they go: Cryptomatte, line, motion; and how channels form parts.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/murmur_hash.h"
#include "image/half.h"
#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "output/exr_attributes.h"
#include "output/film_files.h"
#include "render/matte_names.h"
#include "render/mattes.h"
#include "render/motion.h"
#include "scene/sheet_toml.h"
#include "shading/sheet/style_sheet.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::exr_layers_test {
namespace {

using namespace test;

LayerSet all_layers() {
    LayerSet layers;
    layers.crypto.add_all();
    layers.crypto_ranks = 16;
    layers.coverage = layers.surface = layers.lines_hidden = layers.line = layers.motion = true;
    return layers;
}

/// A picture with all channels of a file.
Image picture_of(const Scene& scene, const Camera& camera, int width, int height, PixelRect crop, int threads,
                 LayerSet layers = all_layers(), const SurfaceSet* next = nullptr) {
    const PreparedScene prepared = prepare_for_abuffer(scene, threads);
    Frame frame = make_frame(scene, camera, width, height, crop, &prepared);
    frame.next = next;
    if (!scene.sheet) {
        layers.crypto.remove(CryptoLayer::line_set);
        frame.needs.tells_invisibility = frame.needs.behind();
    }
    Film film({0, 0, width, height}, crop, layers, frame.criteria.classes);
    RunOptions options;
    options.threads = threads;
    render_abuffer(frame, options, film);
    return FilmChannels(frame, film).rows(strip_of(film.image()), crop.y0, crop.y1);
}

/// The names' numbers and shares of a layer, pixel by pixel.
class LayerShares {
  public:
    LayerShares(const Image& image, const std::string& layer) {
        for (int rank = 0; rank < 16; ++rank) {
            const std::string pair = layer + "0" + std::to_string(rank / 2) + ".";
            const Channel* const id = image.find(pair + (rank % 2 == 0 ? "R" : "B"));
            if (id == nullptr) break;
            ranks_.emplace_back(id->as<float>(), image.find(pair + (rank % 2 == 0 ? "G" : "A"))->as<float>());
        }
        EXPECT_FALSE(ranks_.empty()) << layer;
    }
    std::map<std::uint32_t, double> at(std::size_t pixel) const {
        std::map<std::uint32_t, double> shares;
        float last = 2;
        for (const auto& [ids, values] : ranks_) {
            const float value = values[pixel];
            const auto number = std::bit_cast<std::uint32_t>(ids[pixel]);
            EXPECT_EQ(number == 0, value == 0);
            EXPECT_LE(value, last) << "the largest comes first";
            last = value;
            if (value > 0) {
                EXPECT_TRUE(shares.emplace(number, value).second) << "a name has two ranks";
            }
        }
        return shares;
    }

  private:
    std::vector<std::pair<std::span<const float>, std::span<const float>>> ranks_;
};

double sum_of(const std::map<std::uint32_t, double>& shares) {
    double sum = 0;
    for (const auto& [id, share] : shares) sum += share;
    return sum;
}

/// Numbers of a channel of half precision.
class Halves {
  public:
    Halves(const Image& image, const std::string& name) {
        if (const Channel* const channel = image.find(name)) values_ = channel->as<std::uint16_t>();
    }
    bool are_there() const { return !values_.empty(); }
    double at(std::size_t pixel) const { return static_cast<double>(float_from_half(values_[pixel])); }

  private:
    std::span<const std::uint16_t> values_;
};

/// A few bodies of two materials that pass through each other.
Scene some_scene(Random& random) {
    const auto moved = [&](PolygonSoup soup) {
        const glm::dvec3 by = random.in_box(1);
        return transformed(std::move(soup), [by](glm::dvec3 p) { return p + by; });
    };
    Scene scene = scene_of({moved(make_torus(0.9, 0.4, 24, 12)), moved(make_box({1, 1, 1})),
                            moved(make_sphere(0.7, 16, 8)), moved(make_box({0.3, 2, 0.3}))});
    scene.materials.resize(2);
    scene.materials[1].name = "second";
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        scene.objects[i].name = "object " + std::to_string(i);
        scene.objects[i].materials = MaterialList(std::vector<std::uint32_t>{static_cast<std::uint32_t>(i % 2)});
    }
    scene.lines.classes = LineClassSet::all();
    return scene;
}

const Camera kCamera = perspective_camera({2, 1.5, 4}, {0, 0, 0});
constexpr PixelRect kWhole{0, 0, 100, 80};

/// That shares add up to what the beauty and the lines have.
void expect_sums(const Image& image, const std::string& what, double tolerance = 1e-3) {
    std::array<std::uint32_t, kLineClassCount> visible{};
    std::vector<Halves> coverages;
    for (std::size_t c = 0; c < visible.size(); ++c) {
        visible[c] = crypto_id(kLineClassNames[c]);
        coverages.emplace_back(image, "coverage." + std::string(kLineClassNames[c]));
    }
    const LayerShares objects(image, "CryptoObject"), materials(image, "CryptoMaterial"), classes(image, "CryptoLine"),
        line_objects(image, "CryptoLineObject");
    const Halves alphas(image, "A"), line_alphas(image, "lines.A");
    double lines = 0, all = 0;
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        const double alpha = alphas.at(i);
        ASSERT_NEAR(sum_of(objects.at(i)), alpha, tolerance) << what << " pixel " << i;
        ASSERT_NEAR(sum_of(materials.at(i)), alpha, tolerance) << what << " pixel " << i;
        const auto by_class = classes.at(i);
        double seen = 0;
        for (std::size_t c = 0; c < visible.size(); ++c) {
            const auto own = by_class.find(visible[c]);
            const double share = own == by_class.end() ? 0 : own->second;
            seen += share;
            if (!coverages[c].are_there()) continue;
            ASSERT_NEAR(share, coverages[c].at(i), tolerance) << what << " class " << c << " pixel " << i;
        }
        ASSERT_NEAR(seen, line_alphas.at(i), tolerance) << what << " pixel " << i;
        ASSERT_NEAR(sum_of(line_objects.at(i)), sum_of(by_class), tolerance);
        lines += seen;
        all += alpha;
    }
    EXPECT_GT(lines, 50) << what;
    EXPECT_GE(all, lines) << what;
}

TEST(CryptoNames, HaveKnownNumbers) {
    EXPECT_EQ(crypto_id("torus"), 4053562365u);
    EXPECT_EQ(crypto_id("bunny"), 0x13851a76u);
    EXPECT_EQ(crypto_id("crease"), 0x40e53276u);
    EXPECT_EQ(murmur_hash("CryptoObject") >> 4, 0x3ae39a5u);
    EXPECT_EQ(murmur_hash("CryptoLine") >> 4, 0x0bb32efu);
    EXPECT_EQ(murmur_hash(""), 0u);
    EXPECT_EQ(murmur_hash("hello"), 0x248bfa47u);
    EXPECT_EQ(murmur_hash("hello, world"), 0x149bbb7fu);
}

TEST(CryptoNames, AreOrdinaryFloats) {
    int mended = 0;
    for (int i = 0; i < 4000; ++i) {
        const std::string name = "part" + std::to_string(i);
        const std::uint32_t hash = murmur_hash(name), id = crypto_id(name);
        ASSERT_TRUE(std::isnormal(std::bit_cast<float>(id))) << name;
        const std::uint32_t exponent = hash >> 23 & 0xFF;
        ASSERT_EQ(id, exponent == 0 || exponent == 255 ? hash ^ 0x800000u : hash) << name;
        mended += id != hash;
    }
    EXPECT_GT(mended, 10);
}

TEST(CryptoNames, ManifestsAreSortedAndEscaped) {
    MatteNames names;
    for (const char* const raw :
         {"b \"quoted\"", "back\\slash", "a\tb\x7f", "\xC3\xA4", "bad \xFF\xC3", "b \"quoted\""}) {
        names.names.push_back(matte_name(raw));
        names.ids.push_back(0x00000abcu);
    }
    EXPECT_EQ(names.manifest(),
              "{\"a_b_\":\"00000abc\",\"b \\\"quoted\\\"\":\"00000abc\",\"back\\\\slash\":\"00000abc\","
              "\"bad __\":\"00000abc\",\"\xC3\xA4\":\"00000abc\"}");
    EXPECT_EQ(MatteNames().manifest(), "{}");
    EXPECT_EQ(matte_name(""), "default") << "nobody can pick an empty name";
}

TEST(CryptoNames, WarnWhereTheyAreHardToUse) {
    EXPECT_TRUE(warnings_on_names({"a", "b", "a"}).empty()) << "equal names are one, on purpose";
    EXPECT_EQ(warnings_on_names({"a, b", "<0x12>", "x<y"}).size(), 2u);
    // Two names of one number, found by trying.
    std::map<std::uint32_t, std::string> known;
    for (int i = 0;; ++i) {
        const std::string name = "n" + std::to_string(i);
        const auto [other, is_new] = known.emplace(crypto_id(name), name);
        if (is_new) continue;
        ASSERT_EQ(warnings_on_names({other->second, name}).size(), 1u);
        break;
    }
}

TEST(Cryptomatte, SharesAddUp) {
    for (std::uint64_t trial = 0; trial < 8; ++trial) {
        Random random(trial);
        Scene scene = some_scene(random);
        LineStyle& style = scene.lines.style;
        style.width_px = random.real(0.4, 5);
        std::string what = "trial " + std::to_string(trial);
        if (trial % 2 == 1) style.hidden.style = trial % 4 == 1 ? HiddenStyle::solid : HiddenStyle::dashed;
        if (trial % 5 == 2) style.side = StrokeSide::outside;
        if (trial % 5 == 3) style.dash_px = {4, 3};
        if (trial % 3 == 2) scene.materials[1].opacity = 0.4f;
        if (trial % 5 == 4) scene.surfaces.shading = SurfaceShading::none;
        expect_sums(picture_of(scene, kCamera, 100, 80, kWhole, 2), what);
    }
}

TEST(Cryptomatte, SharesAddUpThroughFilters) {
    for (const PixelFilter filter : {PixelFilter::gaussian, PixelFilter::mitchell}) {
        for (const bool has_hidden : {false, true}) {
            Random random(77);
            Scene scene = some_scene(random);
            scene.lines.style.filter = filter;
            if (has_hidden) scene.lines.style.hidden.style = HiddenStyle::solid;
            // Where a negative lobe takes ink away, kinds of lines are cut off one by one in the picture, and together
            // here.
            expect_sums(picture_of(scene, kCamera, 100, 80, kWhole, 2), "filter",
                        filter == PixelFilter::gaussian && !has_hidden ? 1e-3 : 0.03);
        }
    }
}

constexpr const char* kSheet = R"toml(
[style.thick]
width = 3
[style.thin]
width = "= mix(0.5, 2.5, t)"
opacity = 0.6
[style.behind]
width = 1
color = "#ff0000"
[[set]]
name = "outline"
classes = ["silhouette", "border"]
style = "thick"
[[set]]
name = "inner"
classes = ["crease", "intersection", "object", "polygon", "silhouette"]
style = "thin"
[[set]]
name = "covered"
classes = ["crease", "intersection", "object", "polygon", "silhouette"]
qi = [1, 9]
style = "behind"
)toml";

TEST(Cryptomatte, SharesOfAStyleSheetAddUp) {
    for (const PixelFilter filter : {PixelFilter::box, PixelFilter::gaussian}) {
        Random random(5);
        Scene scene = some_scene(random);
        scene.sheet = std::make_shared<const StyleSheet>(read_sheet_text(kSheet, "sheet.toml"));
        scene.lines.style.filter = filter;
        const Image image = picture_of(scene, kCamera, 100, 80, kWhole, 2);
        double of_sets[3] = {};
        const LayerShares objects(image, "CryptoObject"), of_set(image, "CryptoLineSet"), classes(image, "CryptoLine");
        const Halves alphas(image, "A");
        for (std::size_t i = 0; i < image.pixel_count(); ++i) {
            ASSERT_NEAR(sum_of(objects.at(i)), alphas.at(i), 2e-3) << i;
            const auto sets = of_set.at(i);
            ASSERT_NEAR(sum_of(sets), sum_of(classes.at(i)), 1e-3) << i;
            int number = 0;
            for (const char* const name : {"outline", "inner", "covered"}) {
                const auto own = sets.find(crypto_id(name));
                of_sets[number++] += own == sets.end() ? 0 : own->second;
            }
        }
        for (const double sum : of_sets) EXPECT_GT(sum, 20);
    }
}

TEST(Cryptomatte, BytesDependOnNeitherThreadsNorCrop) {
    for (const bool has_sheet : {false, true}) {
        Random random(9);
        Scene scene = some_scene(random);
        scene.materials[1].opacity = 0.5f;
        scene.lines.style.hidden.style = HiddenStyle::solid;
        if (has_sheet) scene.sheet = std::make_shared<const StyleSheet>(read_sheet_text(kSheet, "sheet.toml"));
        const Image whole = picture_of(scene, kCamera, 100, 80, kWhole, 1);
        for (const int threads : {2, 7}) {
            EXPECT_TRUE(same_bits(whole, picture_of(scene, kCamera, 100, 80, kWhole, threads))) << threads << has_sheet;
        }
        const PixelRect crop{13, 21, 77, 64};
        const Image part = picture_of(scene, kCamera, 100, 80, crop, 2);
        for (const Channel& channel : part.channels()) {
            for (int y = 0; y < part.height(); ++y) {
                for (int x = 0; x < part.width(); ++x) {
                    const std::size_t size = size_of(channel.type);
                    const std::byte* const a =
                        channel.bytes.data() + static_cast<std::size_t>(y * part.width() + x) * size;
                    const std::byte* const b =
                        whole.find(channel.name)->bytes.data() +
                        static_cast<std::size_t>((y + crop.y0) * whole.width() + x + crop.x0) * size;
                    ASSERT_TRUE(std::equal(a, a + size, b))
                        << has_sheet << " " << channel.name << " " << x << "," << y << ": " << part.value(channel, x, y)
                        << ", not " << whole.value(*whole.find(channel.name), x + crop.x0, y + crop.y0);
                }
            }
        }
    }
}

TEST(Cryptomatte, SevenNamesInAPixel) {
    // Seven strips, each a seventh of a pixel... of which samples see as many as they are fine.
    std::vector<PolygonSoup> strips;
    for (int i = 0; i < 8; ++i) {
        const double x = 4 + i * 0.125;
        strips.push_back(soup_of({{x, 2, 0}, {x + 0.125, 2, 0}, {x + 0.125, 8, 0}, {x, 8, 0}}, {{0, 1, 2, 3}}));
    }
    Scene scene = scene_of(std::move(strips));
    for (std::size_t i = 0; i < scene.objects.size(); ++i) scene.objects[i].name = "strip" + std::to_string(i);
    scene.lines.classes = {};
    scene.abuffer.samples = 8;
    LayerSet layers;
    layers.crypto.add(CryptoLayer::object);
    const PixelRect rect{0, 0, 10, 10};
    const Frame frame = make_frame(scene, pixel_camera(10, 10), 10, 10, rect);
    Film film(rect, rect, layers, frame.criteria.classes);
    render_abuffer(frame, {}, film);
    const FilmChannels channels(frame, film);
    const Image image = channels.rows(strip_of(film.image()), 0, 10);
    const auto shares = LayerShares(image, "CryptoObject").at(5 * 10 + 4);
    ASSERT_EQ(shares.size(), 6u);
    for (const auto& [id, share] : shares) EXPECT_EQ(share, 0.125);
    EXPECT_EQ(channels.dropped(), 2u * 6u);
    // Of equal shares the lower numbers have the first ranks.
    std::vector<std::uint32_t> ids;
    for (const auto& object : scene.objects) ids.push_back(crypto_id(object.name));
    std::sort(ids.begin(), ids.end());
    EXPECT_EQ(shares.rbegin()->first, ids[5]);
}

TEST(LineLayer, HasTheLineThatCoversMost) {
    // A box before a farther one, from the front: its outline belongs to it, at its depth.
    Scene scene =
        scene_of({transformed(make_box({6, 6, 2}), [](glm::dvec3 p) { return p + glm::dvec3(20, 20, 0); }),
                  transformed(make_box({30, 30, 2}), [](glm::dvec3 p) { return p + glm::dvec3(20, 20, -9); })});
    scene.lines.style.width_px = 2;
    scene.lines.style.hidden.style = HiddenStyle::solid;
    const PixelRect rect{0, 0, 40, 40};
    const Image image = picture_of(scene, pixel_camera(40, 40, 100), 40, 40, rect, 2);
    const auto number = [&](const char* name, int x, int y) { return image.value(*image.find(name), x, y); };
    EXPECT_EQ(number("line.object", 17, 20), 1);
    EXPECT_EQ(number("line.material", 17, 20), 1);
    EXPECT_EQ(number("line.class", 17, 20), 1 + static_cast<int>(LineClass::silhouette));
    EXPECT_EQ(number("line.qi", 17, 20), 0);
    EXPECT_NEAR(number("line.Z", 17, 20), 99, 1.5);
    EXPECT_EQ(number("line.width", 17, 20), 2);
    EXPECT_EQ(number("line.object", 5, 20), 2);
    EXPECT_NEAR(number("line.Z", 5, 20), 108, 1.5);
    EXPECT_EQ(number("line.object", 10, 20), 0);
    EXPECT_EQ(number("line.class", 10, 20), 0);
    EXPECT_TRUE(std::isinf(number("line.Z", 10, 20)));
    EXPECT_EQ(number("line.width", 10, 20), 0);
}

TEST(Motion, IsWhereTheSurfaceGoes) {
    Random random(3);
    for (const bool is_orthographic : {false, true}) {
        // Tilted squares, each of which moves and turns as a whole.
        std::vector<PolygonSoup> squares;
        std::vector<glm::dvec3> normals, places;
        for (int i = 0; i < 4; ++i) {
            const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 0.2, 1) + 0.5 * random.direction());
            const glm::dvec3 a = glm::normalize(glm::cross(normal, {0, 1, 0})), b = glm::cross(normal, a);
            const glm::dvec3 place = random.in_box(1);
            squares.push_back(soup_of({place - a - b, place + a - b, place + a + b, place - a + b}, {{0, 1, 2, 3}}));
            normals.push_back(normal);
            places.push_back(place);
        }
        const Scene scene = scene_of(std::move(squares));
        Scene later = scene;
        for (SceneObject& object : later.objects)
            object.to_world =
                glm::translate(glm::rotate(glm::dmat4(1.0), 0.05, random.direction()), 0.1 * random.in_box(1));
        Camera camera = kCamera, camera_later = perspective_camera({2.1, 1.4, 3.9}, {0.05, 0, 0});
        for (Camera* c : {&camera, &camera_later}) {
            c->orthographic = is_orthographic;
            c->height = 5;
        }
        const Frame next = make_frame(later, camera_later, 100, 80, kWhole);
        const Image image = picture_of(scene, camera, 100, 80, kWhole, 2, all_layers(), &next.surfaces);
        const Projection before = camera.projection(100, 80, 0), after = camera_later.projection(100, 80, 0);
        int exact = 0, moved = 0;
        for (int y = 0; y < 80; ++y) {
            for (int x = 0; x < 100; ++x) {
                const glm::dvec2 way(image.value(*image.find("forward.u"), x, y),
                                     -image.value(*image.find("forward.v"), x, y));  // which points up
                const auto object = static_cast<std::size_t>(image.value(*image.find("id.object"), x, y));
                if (object == 0) {
                    ASSERT_EQ(way, glm::dvec2(0.0));
                    continue;
                }
                glm::dvec3 origin, ray;
                before.view_ray({x + 0.5, y + 0.5}, origin, ray);
                const glm::dvec3 from(camera.to_world * glm::dvec4(origin, 1.0)),
                    along(camera.to_world * glm::dvec4(ray, 0.0)), normal = normals[object - 1];
                const glm::dvec3 point =
                    from + along * (glm::dot(normal, places[object - 1] - from) / glm::dot(normal, along));
                const glm::dvec4 there = later.objects[object - 1].to_world * glm::dvec4(point, 1.0);
                const glm::dvec2 pixel = after.to_pixel(glm::dvec3(camera_later.to_view() * there));
                const double error = glm::distance(way, pixel - glm::dvec2(x + 0.5, y + 0.5));
                ASSERT_LT(error, 0.5) << x << "," << y;  // beside a border, where the centre is beyond it
                exact += error < 1e-3;
                ++moved;
            }
        }
        EXPECT_GT(moved, 500);
        EXPECT_GT(exact, 0.97 * moved);
    }
}

TEST(Motion, IsNothingInAStill) {
    Random random(3);
    const Image image = picture_of(some_scene(random), kCamera, 100, 80, kWhole, 2);
    for (const float u : image.find("forward.u")->as<float>()) ASSERT_EQ(u, 0);
}

TEST(ExrAttributes, MatricesLeadToPixels) {
    for (const bool is_orthographic : {false, true}) {
        Random random(is_orthographic);
        const Scene scene = some_scene(random);
        Camera camera = kCamera;
        camera.orthographic = is_orthographic;
        camera.height = 4.5;
        camera.area = {{0.1, 0.2}, {0.8, 0.9}};
        const Frame frame = make_frame(scene, camera, 120, 90, {10, 5, 90, 80});
        const ExrOptions exr = exr_options_of(frame, 7, true);
        ExrMatrix to_camera{}, to_ndc{};
        for (const ExrAttribute& a : exr.attributes) {
            if (a.name == "worldToCamera") to_camera = std::get<ExrMatrix>(a.value);
            if (a.name == "worldToNDC") to_ndc = std::get<ExrMatrix>(a.value);
        }
        const auto times = [](const glm::dvec4& row, const ExrMatrix& m) {
            glm::dvec4 result(0.0);
            for (int r = 0; r < 4; ++r) {
                for (int c = 0; c < 4; ++c)
                    result[c] += row[r] * static_cast<double>(m[static_cast<std::size_t>(4 * r + c)]);
            }
            return result;
        };
        for (int i = 0; i < 100; ++i) {
            const glm::dvec4 point(random.in_box(1), 1.0);
            const glm::dvec3 view(camera.to_view() * point);
            const glm::dvec4 seen = times(point, to_camera);
            ASSERT_NEAR(seen.z, -view.z, 1e-5) << "left-handed: farther is more";
            ASSERT_NEAR(seen.x, view.x, 1e-5);
            const glm::dvec4 ndc = times(point, to_ndc);
            const glm::dvec2 pixel = frame.surfaces.projection.to_pixel(view);
            ASSERT_NEAR(ndc.x / ndc.w * 120, pixel.x, 1e-3);
            ASSERT_NEAR(ndc.y / ndc.w * 90, pixel.y, 1e-3);
        }
    }
}

}  // namespace
}  // namespace burin::exr_layers_test
