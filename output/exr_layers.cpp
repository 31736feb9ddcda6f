#include "output/exr_layers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>

namespace burin {

std::string channel_name(std::string_view name, ChannelNames names) {
    const std::size_t dot = name.rfind('.');
    if (names == ChannelNames::plain || dot == std::string_view::npos || name.size() - dot == 2)
        return std::string(name);
    std::string shown(name);
    std::replace(shown.begin(), shown.end(), '.', '_');
    return shown + ".V";
}

std::string part_of(std::string_view channel) {
    const std::size_t dot = channel.find('.');
    if (dot == std::string_view::npos) return channel == "Z" ? "depth" : "rgba";
    std::string_view layer = channel.substr(0, dot);
    if (layer == "forward") return "motion";
    if (layer.starts_with("Crypto")) {
        while (std::isdigit(static_cast<unsigned char>(layer.back())) != 0) layer.remove_suffix(1);
    }
    return std::string(layer);
}

std::vector<ExrPart> parts_of(const std::vector<ChannelFormat>& channels, const std::vector<CryptoAttributes>& crypto) {
    constexpr std::array<std::string_view, 10> kOrder = {"rgba",  "lines", "lines_hidden", "coverage", "surface",
                                                         "depth", "N",     "id",           "line",     "motion"};
    std::vector<ExrPart> parts;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        if (channels[c].name.empty()) continue;
        const std::string name = part_of(channels[c].name);
        auto part = std::find_if(parts.begin(), parts.end(), [&](const ExrPart& p) { return p.name == name; });
        if (part == parts.end()) part = parts.insert(parts.end(), ExrPart{name, {}, {}});
        part->channels.push_back(c);
    }
    // Lines of sets stand behind lines_hidden, layers of Cryptomatte at the end, each in the order of their channels.
    const auto place = [&](const ExrPart& part) {
        if (part.name.starts_with("Crypto")) return kOrder.size() * 2;
        const auto* const known = std::find(kOrder.begin(), kOrder.end(), part.name);
        constexpr std::size_t kBehindHidden = 2;
        return known == kOrder.end() ? 2 * kBehindHidden + 1 : 2 * static_cast<std::size_t>(known - kOrder.begin());
    };
    std::stable_sort(parts.begin(), parts.end(),
                     [&](const ExrPart& a, const ExrPart& b) { return place(a) < place(b); });
    for (const CryptoAttributes& layer : crypto) {
        for (ExrPart& part : parts) {
            if (part.name == layer.layer || &part == &parts.front())
                part.attributes.insert(part.attributes.end(), layer.attributes.begin(), layer.attributes.end());
        }
    }
    return parts;
}

}  // namespace burin
