#include "abuffer/masks/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random.h"

namespace burin::visibility_test {
namespace {

using test::Random;
using Mask = std::uint64_t;
const ExtendedGrid kGrid{8, 2};

struct Pixel {
    std::vector<Fragment<Mask>> fragments;
    std::vector<DepthPlane> planes;
    std::vector<int> family;  // surfaces of one family lie in one plane
    std::vector<int> behind;  // or else, those with a larger number behind the others
    SurfaceOrder order(std::uint32_t a, std::uint32_t b) const {
        SurfaceOrder order;
        if (family[a] != family[b]) return order;
        order.have_common_place = order.has_level = true;
        order.is_apart = behind[a] != behind[b];
        order.has_front = behind[a] < behind[b];
        order.has_behind = behind[a] > behind[b];
        return order;
    }
    VisibleSamples<Mask> resolve() const {
        VisibleSamples<Mask> visible;
        resolve_visibility<Mask>(
            fragments, kGrid, 10, 20,
            [this](const Fragment<Mask>& f) -> const DepthPlane& { return planes[f.surface]; },
            [this](const Fragment<Mask>& a, const Fragment<Mask>& b) { return order(a.surface, b.surface); }, visible);
        return visible;
    }
    void add(Mask mask, DepthPlane plane, int in_family = -1, int is_behind = 0) {
        behind.push_back(is_behind);
        family.push_back(in_family >= 0 ? in_family : 1000 + static_cast<int>(family.size()));
        fragments.push_back({mask, static_cast<std::uint32_t>(planes.size())});
        planes.push_back(plane);
    }
};

DepthPlane flat(double nearness) {
    DepthPlane plane;
    plane.at_origin = plane.lowest = plane.highest = nearness;
    return plane;
}

DepthPlane slanted(Random& random) {
    DepthPlane plane;
    plane.per_x = random.real(-1, 1);
    plane.per_y = random.real(-1, 1);
    plane.at_origin = random.real(-0.3, 0.3) - plane.per_x * 10.5 - plane.per_y * 20.5;
    plane.lowest = -100;
    plane.highest = 100;
    return plane;
}

TEST(Visibility, TheNearestPlaneWinsAtEverySample) {
    for (int trial = 0; trial < 500; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        Pixel pixel;
        const int count = random.integer(0, 7);
        for (int i = 0; i < count; ++i) pixel.add(random.bits64() | random.bits64(), slanted(random));
        const auto visible = pixel.resolve();
        Mask all = 0;
        for (std::size_t i = 0; i < visible.masks.size(); ++i) {
            ASSERT_EQ(all & visible.masks[i], 0u) << "visible masks are disjoint";
            all |= visible.masks[i];
        }
        ASSERT_EQ(all, ~Mask{0}) << "each sample belongs to a fragment or the background";
        for (int sample = 0; sample < 64; ++sample) {
            const glm::dvec2 at = kGrid.position(10, 20, sample / 8, sample % 8);
            double best = -1e300;
            std::uint32_t owner = static_cast<std::uint32_t>(count);
            for (std::uint32_t i = 0; i < pixel.fragments.size(); ++i) {
                const double nearness = pixel.planes[i].extended_to(at);
                if ((pixel.fragments[i].mask >> sample & 1) != 0 && nearness > best) {
                    best = nearness;
                    owner = i;
                }
            }
            ASSERT_EQ(visible.owner[static_cast<std::size_t>(sample)], owner) << trial << ", sample " << sample;
        }
    }
}

TEST(Visibility, CrossingPlanesShareThePixel) {
    Pixel pixel;
    DepthPlane rising = flat(0), falling = flat(0);
    rising.per_x = 1;
    rising.at_origin = -10.5;
    falling.per_x = -1;
    falling.at_origin = 10.5;
    rising.lowest = falling.lowest = -10;
    rising.highest = falling.highest = 10;
    pixel.add(~Mask{0}, rising);
    pixel.add(~Mask{0}, falling);
    const auto visible = pixel.resolve();
    EXPECT_EQ(visible.masks[0], 0xF0F0F0F0F0F0F0F0u);  // the right half
    EXPECT_EQ(visible.masks[1], 0x0F0F0F0F0F0F0F0Fu);
}

TEST(Visibility, CoincidentSurfacesGoToTheFirstWhateverRoundingDoes) {
    for (int trial = 0; trial < 300; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        Pixel pixel;
        const DepthPlane plane = slanted(random);
        for (int i = 0; i < 4; ++i) {
            DepthPlane noisy = plane;
            noisy.at_origin += random.real(-1e-9, 1e-9);
            pixel.add(~Mask{0}, noisy, 1);
        }
        EXPECT_EQ(pixel.resolve().masks[0], ~Mask{0}) << trial;
    }
}

TEST(Visibility, OnAnEdgeTheSurfaceInFrontWinsWhateverRoundingDoes) {
    for (int trial = 0; trial < 300; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        Pixel pixel;
        const int front = random.integer(0, 3), sample = random.integer(0, 63);
        const glm::dvec2 at = kGrid.position(10, 20, sample / 8, sample % 8);
        for (int i = 0; i < 4; ++i) {
            DepthPlane plane = slanted(random);
            plane.at_origin += random.real(-1e-9, 1e-9) - plane.extended_to(at);
            pixel.add(Mask{1} << sample, plane, 1, i == front ? 0 : random.integer(1, 3));
        }
        EXPECT_EQ(pixel.resolve().owner[static_cast<std::size_t>(sample)], static_cast<std::uint32_t>(front)) << trial;
    }
}

TEST(Visibility, TheOrderOfTheListDoesNotMatterWhereDepthsDiffer) {
    for (int trial = 0; trial < 200; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        Pixel pixel;
        for (int i = 0; i < 5; ++i) pixel.add(random.bits64(), slanted(random));
        Pixel turned = pixel;
        std::reverse(turned.fragments.begin(), turned.fragments.end());
        const auto a = pixel.resolve(), b = turned.resolve();
        for (std::size_t i = 0; i < 5; ++i) ASSERT_EQ(a.masks[i], b.masks[4 - i]) << trial;
    }
}

}  // namespace
}  // namespace burin::visibility_test
