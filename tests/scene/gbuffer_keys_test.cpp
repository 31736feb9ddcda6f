#include <gtest/gtest.h>

#include "tests/scene/scene_text.h"

namespace burin {
namespace {

using namespace test;

GBufferSettings read(const std::string& keys) {
    return described("[[object]]\nshape='box'\n[gbuffer]\n" + keys).gbuffer;
}

TEST(GBufferKeys, EveryValueIsRead) {
    const GBufferSettings empty = read("");
    EXPECT_EQ(empty.operators,
              GBufferOperatorSet::of({GBufferOperator::profile, GBufferOperator::internal, GBufferOperator::id}));
    EXPECT_EQ(empty.supersample, 1);
    for (int o = 0; o < kGBufferOperatorCount; ++o) {
        const std::string name(kGBufferOperatorNames[static_cast<std::size_t>(o)]);
        EXPECT_EQ(read("operators=['" + name + "']").operators,
                  GBufferOperatorSet::of({static_cast<GBufferOperator>(o)}));
    }
    for (const int s : {1, 2, 4, 8}) EXPECT_EQ(read("supersample=" + std::to_string(s)).supersample, s);
    for (const int bits : {0, 8, 16, 24}) EXPECT_EQ(read("depth_bits=" + std::to_string(bits)).depth_bits, bits);
    const GBufferSettings s = read(
        "dilate=false\nsmooth=true\ncomposition='maximum'\ndepth_scale=2\nreference_distance="
        "3\njump_limit=5\n"
        "profile_limit=6\nprofile_power=1.5\ngate=false\ncrease_limit=0.25\nrelative_jump=0.5\n"
        "relative_jump_slope=0\nid_comparison='less'\nid_neighbours=4\ncontours='y'\ncontour_step="
        "7\n"
        "contour_width=8\nhatching=true\ncross_hatching='distance'\ncross_darkness=0.75");
    EXPECT_FALSE(s.dilate);
    EXPECT_TRUE(s.smooth);
    EXPECT_EQ(s.composition, LineComposition::maximum);
    EXPECT_EQ(s.depth_scale, 2);
    EXPECT_EQ(s.reference_distance, 3);
    EXPECT_EQ(s.jump_limit, 5);
    EXPECT_EQ(s.profile_limit, 6);
    EXPECT_EQ(s.profile_power, 1.5);
    EXPECT_FALSE(s.gate);
    EXPECT_EQ(s.crease_limit, 0.25);
    EXPECT_EQ(s.relative_jump, 0.5);
    EXPECT_EQ(s.relative_jump_slope, 0);
    EXPECT_EQ(s.id_comparison, IdComparison::less);
    EXPECT_EQ(s.id_neighbours, 4);
    EXPECT_EQ(s.contours, ContourField::y);
    EXPECT_EQ(s.contour_step, 7);
    EXPECT_EQ(s.contour_width_px, 8);
    EXPECT_TRUE(s.hatching);
    EXPECT_EQ(s.cross_hatching, ContourField::distance);
    EXPECT_EQ(s.cross_darkness, 0.75);
    EXPECT_EQ(read("id_comparison='greater'").id_comparison, IdComparison::greater);
    EXPECT_EQ(read("contours='x'").contours, ContourField::x);
    EXPECT_EQ(read("contours='z'").contours, ContourField::z);
}

TEST(GBufferKeys, MistakesAreNamed) {
    const std::pair<const char*, const char*> mistakes[] = {
        {"operator=['id']", "did you mean 'operators'?"},
        {"operators=['edges']", "unknown operator 'edges'; known are first second"},
        {"supersample=3", "must be 1, 2, 4 or 8"},
        {"supersample=16", "at most 8"},
        {"depth_bits=12", "must be 8, 16, 24, or 0"},
        {"id_neighbours=6", "must be 4 or 8"},
        {"profile_limit=0", "greater than 0"},
        {"contour_step=0", "greater than 0"},
        {"contours='height'", "distance"},
        {"cross_darkness=2", "at most 1"},
        {"gate=1", "true or false"},
    };
    for (const auto& [keys, words] : mistakes) {
        try {
            read(keys);
            ADD_FAILURE() << keys;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace burin
