// Samples of deep pixels, and the names behind their numbers.

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "base/murmur_hash.h"
#include "image/half.h"
#include "mesh/shapes.h"
#include "output/deep_samples.h"
#include "render/film.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::deep_samples_test {
namespace {

using namespace test;

/// A frame whose names are `near`, `far` and `glass`, objects and materials.
class NamedFrame {
  public:
    explicit NamedFrame(bool is_float = false) : scene_(scene_of({box(), box(), box()})) {
        const char* const names[] = {"near", "far", "glass"};
        scene_.materials.resize(3);
        for (std::size_t i = 0; i < 3; ++i) scene_.objects[i].name = scene_.materials[i].name = names[i];
        scene_.deep.is_float = is_float;
        frame_ = make_frame(scene_, perspective_camera({0, 0, 9}, {0, 0, 0}), 8, 8, {0, 0, 8, 8}, nullptr);
    }
    const Frame& frame() const { return frame_; }

  private:
    static PolygonSoup box() { return make_box({1, 1, 1}); }

    Scene scene_;
    Frame frame_;
};

DeepSurface surface(std::uint32_t number, float share, float distance, float brightness, bool is_glass = false) {
    DeepSurface s;
    s.owner = {number, number};
    s.share = share;
    s.distance = distance;
    s.color = glm::vec3(brightness * share);
    s.is_opaque = !is_glass;
    return s;
}

DeepLine line(LineClass drawn_as, std::uint32_t number, float share, float distance, float brightness = 0) {
    DeepLine l;
    l.line.drawn_as = drawn_as;
    l.line.owner = {number, number};
    l.line.share = share;
    l.distance = distance;
    l.color = glm::vec3(brightness);
    return l;
}

/// What is seen of samples that are chosen, red and alpha.
template <typename Choose>
glm::dvec2 flattened(std::span<const DeepSample> samples, const Choose& choose) {
    glm::dvec2 sum(0.0);
    double left = 1;
    for (const DeepSample& s : samples) {
        if (!choose(s)) continue;
        sum += left * glm::dvec2(static_cast<double>(s.color.r), static_cast<double>(s.alpha));
        left *= 1.0 - static_cast<double>(s.alpha);
    }
    return sum;
}
constexpr auto all = [](const DeepSample&) { return true; };
constexpr auto surfaces_only = [](const DeepSample& s) { return s.line == 0; };

void expect_tidy(std::span<const DeepSample> samples) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
        EXPECT_TRUE(std::isfinite(samples[i].z) && samples[i].z > 0);
        EXPECT_TRUE(samples[i].alpha >= 0 && samples[i].alpha <= 1);
        if (i > 0) {
            EXPECT_GT(samples[i].z, samples[i - 1].z);
        }
    }
}

TEST(DeepSamples, HalvesThatAbutDoNotBleed) {
    const NamedFrame named;
    DeepSampler sampler(named.frame());
    const std::vector<DeepSurface> surfaces = {surface(1, 0.5f, 4, 0.25f), surface(2, 0.5f, 4, 0.75f)};
    const auto samples = sampler.samples_of({0, 0, surfaces, {}, false});
    ASSERT_EQ(samples.size(), 2u);
    EXPECT_EQ(samples[0].alpha, 0.5f);
    EXPECT_EQ(samples[1].alpha, 1.0f);
    EXPECT_EQ(samples[1].z, std::nextafter(4.0f, 5.0f));
    EXPECT_EQ(flattened(samples, all), glm::dvec2(0.5, 1));
    EXPECT_EQ(samples[0].object, murmur_hash("near"));
    EXPECT_EQ(samples[1].material, murmur_hash("far"));
    EXPECT_EQ(samples[0].line, 0u);
}

TEST(DeepSamples, LinesLieInFrontAndCanBeTakenAway) {
    const NamedFrame named;
    DeepSampler sampler(named.frame());
    // The line of the far surface is drawn over the near one, too.
    const std::vector<DeepSurface> surfaces = {surface(1, 0.5f, 4, 1), surface(2, 0.25f, 7, 0.5f)};
    const std::vector<DeepLine> lines = {line(LineClass::crease, 2, 0.25f, 7)};
    const auto samples = sampler.samples_of({0, 0, surfaces, lines, false});
    ASSERT_EQ(samples.size(), 3u);
    EXPECT_EQ(samples[0].line, murmur_hash("crease"));
    EXPECT_EQ(samples[0].object, murmur_hash("far"));
    EXPECT_EQ(samples[0].z, 4.0f);
    EXPECT_EQ(samples[0].alpha, 0.25f);
    EXPECT_EQ(flattened(samples, surfaces_only), glm::dvec2(0.5 + 0.125, 0.75));
    const glm::dvec2 whole = flattened(samples, all);
    EXPECT_NEAR(whole.x, 0.75 * (0.5 + 0.125), 1e-12);
    EXPECT_NEAR(whole.y, 0.25 + 0.75 * 0.75, 1e-12);
    expect_tidy(samples);
}

TEST(DeepSamples, LinesThatCoverAllLeaveSurfacesAsTheyAre) {
    const NamedFrame named;
    DeepSampler sampler(named.frame());
    const std::vector<DeepSurface> surfaces = {surface(1, 0.5f, 4, 1), surface(2, 0.5f, 7, 0.5f)};
    const std::vector<DeepLine> lines = {line(LineClass::crease, 1, 1, 3)};
    const auto samples = sampler.samples_of({0, 0, surfaces, lines, false});
    ASSERT_EQ(samples.size(), 3u);
    EXPECT_EQ(samples[0].alpha, 1.0f);
    EXPECT_EQ(samples[1].alpha, 0.5f);
    EXPECT_EQ(flattened(samples, surfaces_only), glm::dvec2(0.75, 1));
}

TEST(DeepSamples, LinesBehindGlassStayThere) {
    const NamedFrame named;
    DeepSampler sampler(named.frame());
    const std::vector<DeepSurface> surfaces = {surface(3, 0.5f, 3, 0.25f, true), surface(2, 0.5f, 7, 1)};
    DeepLine behind = line(LineClass::crease, 2, 0.25f, 6.5f);
    behind.is_behind = behind.line.is_below = true;
    const std::vector<DeepLine> lines = {behind};
    const auto samples = sampler.samples_of({0, 0, surfaces, lines, false});
    ASSERT_EQ(samples.size(), 3u);
    EXPECT_EQ(samples[0].object, murmur_hash("glass"));
    EXPECT_EQ(samples[1].line, murmur_hash("crease"));
    EXPECT_EQ(samples[1].z, 6.5f);
    EXPECT_EQ(samples[2].alpha, 1.0f);
    const glm::dvec2 whole = flattened(samples, all);
    EXPECT_NEAR(whole.x, 0.75 * (0.125 + 0.5), 1.0 / 4096);
    EXPECT_EQ(whole.y, 1.0);
    EXPECT_NEAR(flattened(samples, all).y - flattened(samples, surfaces_only).y, 0, 1e-12);
}

TEST(DeepSamples, HiddenLinesLieBehindWhatCoversThePixel) {
    const NamedFrame named;
    DeepSampler sampler(named.frame());
    DeepLine hidden = line(LineClass::border, 2, 0.375f, 9);
    hidden.line.is_hidden = hidden.line.is_below = true;
    hidden.invisibility = 2;
    const std::vector<DeepLine> lines = {line(LineClass::crease, 1, 0.5f, 4), hidden};
    const std::vector<DeepSurface> covers = {surface(1, 1, 4, 0.5f)}, partly = {surface(1, 0.75f, 4, 0.5f)},
                                   deeper = {surface(1, 0.5f, 4, 0.5f), surface(2, 0.5f, 10, 0.5f)};
    const auto samples = sampler.samples_of({0, 0, covers, lines, false});
    ASSERT_EQ(samples.size(), 3u);
    EXPECT_EQ(samples[2].line, murmur_hash("border"));
    EXPECT_EQ(samples[2].z, 9.0f);
    EXPECT_EQ(samples[2].alpha, 0.375f);
    EXPECT_EQ(samples[2].invisibility, 2u);
    EXPECT_EQ(samples[1].alpha, 1.0f) << "nothing of hidden lines is seen";
    EXPECT_EQ(sampler.samples_of({0, 0, partly, lines, false}).size(), 2u);
    EXPECT_EQ(sampler.samples_of({0, 0, deeper, lines, false}).size(), 3u);
}

TEST(DeepSamples, RoundingDoesNotAddUp) {
    for (const bool is_float : {false, true}) {
        const NamedFrame named(is_float);
        DeepSampler sampler(named.frame());
        for (unsigned trial = 0; trial < 2000; ++trial) {
            Random random(trial);
            std::vector<DeepSurface> surfaces;
            std::vector<DeepLine> lines;
            float left = 1, line_left = 1;
            for (std::uint32_t i = 1; i <= 3; ++i) {
                const auto part = static_cast<float>(random.real(0, 1));
                const float share = i == 3 && trial % 2 == 0 ? left : left * part;
                left -= share;
                surfaces.push_back(
                    surface(i, share, static_cast<float>(random.real(3, 5)), static_cast<float>(random.real(0, 1))));
                const float line_share = line_left * static_cast<float>(random.real(0, 1));
                line_left -= line_share;
                lines.push_back(line(static_cast<LineClass>(i), i, line_share, static_cast<float>(random.real(3, 5)),
                                     static_cast<float>(random.real(0, 1))));
            }
            double color = 0, alpha = 0, covered = 0;
            for (const DeepSurface& s : surfaces) {
                color += static_cast<double>(s.color.r);
                alpha += static_cast<double>(s.share);
            }
            glm::dvec2 beauty(0.0);
            for (const DeepLine& l : lines) {
                beauty += static_cast<double>(l.line.share) * glm::dvec2(static_cast<double>(l.color.r), 1);
                covered += static_cast<double>(l.line.share);
            }
            beauty += (1 - covered) * glm::dvec2(color, alpha);
            const auto samples = sampler.samples_of({0, 0, surfaces, lines, false});
            expect_tidy(samples);
            const double bound = 1.0 / 2048;  // with the film's rounding of surfaces
            const glm::dvec2 off = glm::abs(flattened(samples, all) - beauty);
            EXPECT_LE(std::max(off.x, off.y), bound) << trial << " " << is_float;
            const glm::dvec2 off_surface = glm::abs(flattened(samples, surfaces_only) - glm::dvec2(color, alpha));
            EXPECT_LE(std::max(off_surface.x, off_surface.y), bound) << trial << " " << is_float;
            if (HasFailure()) return;
        }
    }
}

double on_film(double value) { return static_cast<double>(float_from_half(Film::to_half(static_cast<float>(value)))); }

/// What a pixel has on the film, which rounds surfaces before it lays lines over them, and each class.
struct OnFilm {
    glm::dvec2 surfaces{0.0}, beauty{0.0};  // red and alpha
    std::map<std::uint32_t, double> coverage;

    OnFilm(const std::vector<DeepSurface>& all_surfaces, const std::vector<DeepLine>& lines) {
        for (const DeepSurface& s : all_surfaces) surfaces += glm::dvec2(s.color.r, s.share);
        surfaces = {on_film(surfaces.x), on_film(surfaces.y)};
        glm::dvec2 ink(0.0);
        for (const DeepLine& l : lines) {
            const auto share = static_cast<double>(l.line.share);
            ink += share * glm::dvec2(l.color.r, 1);
            coverage[murmur_hash(kLineClassNames[static_cast<std::size_t>(l.line.drawn_as)])] += share;
        }
        beauty = ink + surfaces * (1 - ink.y);
        beauty = {on_film(beauty.x), on_film(beauty.y)};
        for (auto& [name, share] : coverage) share = on_film(share);
    }
};

double matte(std::span<const DeepSample> samples, std::uint32_t name) {
    double sum = 0, left = 1;
    for (const DeepSample& s : samples) {
        if (s.line == name) sum += left * static_cast<double>(s.alpha);
        left *= 1.0 - static_cast<double>(s.alpha);
    }
    return sum;
}

/// One to three lines of one or more classes, of a few colours, over none to three surfaces.
TEST(DeepSamples, AreWhatTheFilmHas) {
    for (const bool is_float : {false, true}) {
        const NamedFrame named(is_float);
        DeepSampler sampler(named.frame());
        for (unsigned trial = 0; trial < 50000; ++trial) {
            Random random(trial);
            const unsigned surface_count = trial % 4, line_count = 1 + trial / 4 % 3;
            const bool is_plain = trial % 5 == 0;  // black lines of one class
            std::vector<DeepSurface> surfaces;
            std::vector<DeepLine> lines;
            float left = 1, line_left = 1;
            for (std::uint32_t i = 1; i <= surface_count; ++i) {
                const auto part = static_cast<float>(random.real(0, 1));
                const float share = i == surface_count && trial % 2 == 0 ? left : left * part;
                left -= share;
                surfaces.push_back(
                    surface(i, share, static_cast<float>(random.real(3, 5)), static_cast<float>(random.real(0, 1))));
            }
            for (std::uint32_t i = 1; i <= line_count; ++i) {
                const float share = line_left * static_cast<float>(random.real(0, 1));
                line_left -= share;
                const auto drawn_as = static_cast<LineClass>(is_plain ? 1 : random.integer(0, 3));
                const auto brightness = static_cast<float>(is_plain ? 0.0 : random.real(0, 1));
                lines.push_back(line(drawn_as, i, share, static_cast<float>(random.real(3, 5)), brightness));
            }
            const OnFilm film(surfaces, lines);
            const auto samples = sampler.samples_of({0, 0, surfaces, lines, false});
            expect_tidy(samples);
            const glm::dvec2 off = glm::abs(flattened(samples, all) - film.beauty);
            // Roundings of classes on the film may differ from the one of all together: a bit of each is left.
            EXPECT_LE(std::max(off.x, off.y), is_plain ? 1.0 / 2048 : 3.0 / 4096) << trial << " " << is_float;
            const glm::dvec2 off_surface = glm::abs(flattened(samples, surfaces_only) - film.surfaces);
            EXPECT_LE(std::max(off_surface.x, off_surface.y), 1.0 / 2048) << trial << " " << is_float;
            for (const auto& [name, share] : film.coverage)
                EXPECT_NEAR(matte(samples, name), share, is_plain ? 1.0 / 4096 : 1.0 / 2048)
                    << trial << " " << is_float;
        }
    }
}

/// Reads what id_manifest() makes, after the documentation of OpenEXR's IDManifest.
class ManifestReader {
  public:
    explicit ManifestReader(const std::vector<std::uint8_t>& value) {
        std::uint64_t size = 0;
        std::memcpy(&size, value.data(), sizeof size);
        raw_.resize(size);
        uLongf length = size;
        EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(raw_.data()), &length, value.data() + 8, value.size() - 8), Z_OK);
        EXPECT_EQ(length, size);
        EXPECT_EQ(number(), 0u);
        std::vector<std::size_t> lengths(number());
        for (std::size_t& l : lengths) l = varint();
        std::vector<std::string> names;
        for (const std::size_t l : lengths) {
            std::string text = take(l);
            if (!names.empty()) {
                const bool is_wide = names.back().size() > 255;
                const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
                const std::size_t common = is_wide ? byte(0) * 256u + byte(1) : byte(0);
                text = names.back().substr(0, common) + text.substr(is_wide ? 2 : 1);
            }
            names.push_back(text);
        }
        if (number() != 0) {
            EXPECT_EQ(number(), 0u);
            EXPECT_EQ(number(), names.size() - 1);
        }
        for (std::uint32_t groups = number(); groups > 0; --groups) {
            EXPECT_EQ(number(), 1u);
            const std::string channel = take(varint());
            EXPECT_EQ(number(), 1u);
            components[channel] = take(varint());
            EXPECT_EQ(take(1), "\2");
            EXPECT_EQ(take(number()), "MurmurHash3_32");
            EXPECT_EQ(take(number()), "id");
            EXPECT_EQ(take(1), "\2");
            std::uint32_t last = 0;
            for (std::uint32_t count = number(); count > 0; --count) {
                last += static_cast<std::uint32_t>(varint());
                found[channel][last] = names.at(varint());
            }
        }
        EXPECT_EQ(at_, raw_.size());
    }
    std::map<std::string, std::string> components;
    std::map<std::string, std::map<std::uint32_t, std::string>> found;

  private:
    std::string take(std::size_t count) {
        at_ += count;
        return raw_.substr(at_ - count, count);
    }
    std::uint32_t number() {
        std::uint32_t value = 0;
        std::memcpy(&value, take(4).data(), 4);
        return value;
    }
    std::size_t varint() {
        std::size_t value = 0;
        for (int shift = 0;; shift += 7) {
            const auto byte = static_cast<unsigned char>(take(1)[0]);
            value |= std::size_t{byte & 127u} << shift;
            if (byte < 128) return value;
        }
    }

    std::string raw_;
    std::size_t at_ = 0;
};

TEST(IdManifest, HasAllNames) {
    std::vector<NamedIds> groups = {{"lineid", "line class", {}}, {"objectid", "object", {}}, {"none", "empty", {}}};
    for (int i = 0; i < 3000; ++i) {
        std::string name = "assembly/part " + std::to_string(i * 7919 % 3000);
        if (i % 200 == 3) name += std::string(240 + static_cast<std::size_t>(i % 40), 'x') + std::to_string(i);
        if (i % 500 == 7) name = std::string(70000, 'y') + std::to_string(i);
        groups[1].names.emplace(murmur_hash(name), name);
        if (i < 8) groups[0].names.emplace(murmur_hash(name), name);
    }
    const ManifestReader manifest(id_manifest(groups));
    for (const NamedIds& group : groups) {
        EXPECT_EQ(manifest.components.at(group.channel), group.component);
        const auto found = manifest.found.find(group.channel);
        EXPECT_TRUE(found == manifest.found.end() ? group.names.empty() : found->second == group.names)
            << group.channel;
    }
    const ManifestReader empty(id_manifest({}));
    EXPECT_TRUE(empty.found.empty());
}

TEST(IdManifest, OfAFrameHasObjectsMaterialsAndClasses) {
    const NamedFrame named;
    const ManifestReader manifest(id_manifest(DeepSampler(named.frame()).names()));
    EXPECT_EQ(manifest.found.at("lineid").size(), static_cast<std::size_t>(kLineClassCount));
    EXPECT_EQ(manifest.found.at("objectid").at(murmur_hash("glass")), "glass");
    EXPECT_EQ(manifest.found.at("materialid").at(murmur_hash("far")), "far");
}

}  // namespace
}  // namespace burin::deep_samples_test
