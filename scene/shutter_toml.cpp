#include "scene/shutter_toml.h"

namespace burin {
namespace {

constexpr TomlReader::Range kFrames{-1e6, 1e6};

void read_curve(TomlReader& t, ShutterSettings& shutter) {
    if (t.is_text("curve")) {
        const std::size_t curve = *t.choice("curve", {"box", "triangle"});
        shutter.rise = shutter.fall = curve == 0 ? 0 : 0.5;
    } else if (const auto parts = t.numbers("curve", 2)) {
        shutter.rise = (*parts)[0];
        shutter.fall = (*parts)[1];
        if (!(shutter.rise >= 0 && shutter.fall >= 0 && shutter.rise + shutter.fall <= 1)) {
            t.fail("curve",
                   "must be \"box\", \"triangle\", or two parts of the time, 0 or more, that add up to at most 1");
        }
    }
}

}  // namespace

ShutterSettings read_shutter(TomlReader& t) {
    ShutterSettings shutter;
    shutter.open = t.number("open", kFrames).value_or(shutter.open);
    shutter.close = t.number("close", kFrames).value_or(shutter.close);
    if (!(shutter.open < shutter.close)) t.fail(t.has("close") ? "close" : "open", "must open before it closes");
    read_curve(t, shutter);
    if (t.is_text("samples")) {
        t.choice("samples", {"auto"});
    } else {
        shutter.samples = t.integer("samples", 1, ShutterSettings::kMostSamples);
    }
    t.finish();
    return shutter;
}

}  // namespace burin
