#include "cli/doubled_settings.h"

#include <algorithm>
#include <string_view>

#include "mesh/text_scan.h"

namespace burin {
namespace {

/// An option, and the key of scenes or style sheets that it sets, without numbers of elements.
struct Setting {
    std::string_view option, key;
};
constexpr Setting kSettings[] = {
    {"--line-width", "lines.width"},
    {"--line-width", "style.width"},
    {"--color", "lines.color"},
    {"--color", "style.color"},
    {"--lines", "lines.draw"},
    {"--crease-angle", "lines.crease_angle"},
    {"--hidden", "lines.hidden.style"},
    {"--style", "style"},
    {"--size", "picture.size"},
    {"--background", "picture.background"},
    {"--dpi", "picture.dpi"},
    {"--paper", "picture.paper"},
    {"--margin", "picture.margin"},
    {"--scale", "picture.scale"},
    {"--unit", "picture.unit"},
    {"--fps", "frames.fps"},
    {"--turntable", "turntable.frames"},
    {"--shutter", "shutter.open"},
    {"--shutter", "shutter.close"},
    {"--blur-samples", "shutter.samples"},
    {"--eye", "camera.eye"},
    {"--target", "camera.target"},
    {"--up", "camera.up"},
    {"--fov", "camera.fov"},
    {"--ortho", "camera.height"},
    {"--lens", "camera.lens_radius"},
    {"--focus", "camera.focus"},
    {"--samples", "abuffer.samples"},
    {"--mask", "patel.mask"},
    {"--operator", "gbuffer.operators"},
    {"--supersample", "gbuffer.supersample"},
};

/// "camera.0.eye" is "camera.eye".
std::string without_numbers(std::string_view key) {
    std::string plain;
    while (true) {
        const std::size_t dot = key.find('.');
        const std::string_view part = key.substr(0, dot);
        if (part.find_first_not_of("0123456789") != std::string_view::npos)
            plain.append(plain.empty() ? "" : ".").append(part);
        if (dot == std::string_view::npos) return plain;
        key.remove_prefix(dot + 1);
    }
}

}  // namespace

std::vector<std::string> notes_of_doubled_settings(const std::vector<std::string>& options,
                                                   std::span<const Override> overrides) {
    std::vector<std::string> notes;
    for (const Setting& setting : kSettings) {
        if (std::find(options.begin(), options.end(), setting.option) == options.end()) continue;
        for (const Override& o : overrides) {
            if (without_numbers(o.key) != setting.key) continue;
            notes.push_back("--set " + printable(o.key) + " is left out: " + std::string(setting.option) +
                            " says the same, and is stronger");
        }
    }
    return notes;
}

}  // namespace burin
