// Rates as fractions, and names of channels and parts.

#include <gtest/gtest.h>

#include "output/exr_attributes.h"
#include "output/exr_layers.h"

namespace burin::exr_names_test {
namespace {

TEST(ExrAttributes, RatesAreFractions) {
    EXPECT_EQ(rational_of(24), (ExrRational{24, 1}));
    EXPECT_EQ(rational_of(24000.0 / 1001), (ExrRational{24000, 1001}));
    EXPECT_EQ(rational_of(23.976), (ExrRational{24000, 1001}));
    EXPECT_EQ(rational_of(29.97), (ExrRational{30000, 1001}));
    EXPECT_EQ(rational_of(12.5), (ExrRational{25, 2}));
}

TEST(ChannelNames, BlenderSeesAll) {
    EXPECT_EQ(channel_name("coverage.crease", ChannelNames::blender), "coverage_crease.V");
    EXPECT_EQ(channel_name("id.object", ChannelNames::blender), "id_object.V");
    EXPECT_EQ(channel_name("line.class", ChannelNames::blender), "line_class.V");
    for (const char* const kept : {"R", "lines.A", "N.X", "Z", "line.Z", "CryptoObject00.R", "forward.u"})
        EXPECT_EQ(channel_name(kept, ChannelNames::blender), kept);
    EXPECT_EQ(channel_name("coverage.crease", ChannelNames::plain), "coverage.crease");
}

TEST(Parts, StandInOrder) {
    std::vector<ChannelFormat> channels;
    for (const char* const name :
         {"CryptoLine00.R", "CryptoObject00.R", "CryptoObject01.R", "forward.u", "line.Z", "id.object", "N.X", "Z",
          "surface.R", "coverage.crease", "lines_top.R", "lines_hidden.R", "lines.R", "R", "A"})
        channels.push_back({name, PixelType::float32});
    const std::vector<ExrPart> parts = parts_of(channels, {{"CryptoObject", {{"cryptomatte/3ae39a5/name", "x"}}}});
    std::string order;
    for (const ExrPart& part : parts) order += part.name + " ";
    EXPECT_EQ(order,
              "rgba lines lines_hidden lines_top coverage surface depth N id line motion CryptoLine CryptoObject ");
    EXPECT_EQ(parts[0].channels.size(), 2u);
    EXPECT_EQ(parts[0].attributes.size(), 1u);
    EXPECT_EQ(parts.back().channels.size(), 2u);
    EXPECT_EQ(parts.back().attributes.size(), 1u);
    EXPECT_TRUE(parts[1].attributes.empty());
}

}  // namespace
}  // namespace burin::exr_names_test
