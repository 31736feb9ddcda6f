#include "cli/exr_options.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "cli/option_values.h"

namespace burin {

using namespace option_values;

void fill_exr_options(const ExrTexts& t, Arguments& a) {
    a.exr.has_parts = t.parts;
    if (t.parts) a.exr_options.emplace_back("--parts");
    if (!t.channel_names.empty()) {
        if (t.channel_names != "plain" && t.channel_names != "blender")
            fail("--channel-names", "must be plain or blender");
        if (t.channel_names == "blender") a.exr.names = ChannelNames::blender;
        a.exr_options.emplace_back("--channel-names");
    }
    if (!t.compression.empty()) {
        const std::pair<std::string_view, ExrCompression> kinds[] = {{"zip", ExrCompression::zip},
                                                                     {"zips", ExrCompression::zips},
                                                                     {"rle", ExrCompression::rle},
                                                                     {"none", ExrCompression::none}};
        const auto* const kind =
            std::find_if(std::begin(kinds), std::end(kinds), [&](const auto& k) { return k.first == t.compression; });
        if (kind == std::end(kinds))
            fail("--compression", "must be zip, zips, rle or none; others lose what ids and mattes need");
        a.exr.compression = kind->second;
        a.exr_options.emplace_back("--compression");
    }
    if (t.overscan.empty()) return;
    constexpr int kMostPx = 16384;
    a.overscan_px = integer("--overscan", t.overscan, 0, kMostPx);
    a.exr_options.emplace_back("--overscan");
    const auto refuse = [](bool is_given, const char* option) {
        if (is_given) fail("--overscan", std::string("cannot stand beside ") + option + "; remove one");
    };
    refuse(a.crop.has_value(), "--crop");
    refuse(!a.views.empty(), "--views");
    refuse(a.saves_surface, "--save-surface");
}

void refuse_exr_options(const Arguments& a, OutputFormat format) {
    if (format != OutputFormat::exr && !a.exr_options.empty()) fail(a.exr_options.front(), "EXR only");
}

}  // namespace burin
