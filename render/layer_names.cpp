#include "render/layer_names.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "mesh/text_scan.h"
#include "shading/sheet/style_sheet.h"

namespace burin {

namespace {

constexpr std::string_view kOfSet = "lines_";

/// The layers that line sets of a scene's style sheet have of their own.
std::vector<std::string> layers_of_sets(const Scene& scene) {
    std::vector<std::string> layers;
    if (!scene.sheet) return layers;
    for (const LineSet& set : scene.sheet->sets) {
        if (set.is_enabled && !set.layer.empty()) layers.push_back(set.layer);
    }
    return layers;
}

}  // namespace

LayerSet layers_named(std::string_view list) {
    LayerSet layers{false, false, false, false, false, false, false, false};
    const std::pair<std::string_view, bool*> names[] = {
        {"beauty", &layers.beauty},   {"lines", &layers.lines},
        {"Z", &layers.depth},         {"N", &layers.normal},
        {"ids", &layers.ids},         {"coverage", &layers.coverage},
        {"surface", &layers.surface}, {"lines_hidden", &layers.lines_hidden},
        {"line", &layers.line},       {"motion", &layers.motion}};
    for (std::size_t end = 0; end != std::string_view::npos;) {
        end = list.find(',');
        const std::string_view name = list.substr(0, end);
        const auto it =
            std::find_if(std::begin(names), std::end(names), [&](const auto& n) { return n.first == name; });
        const auto* const crypto = std::find(kCryptoLayerNames.begin(), kCryptoLayerNames.end(), name);
        if (it != std::end(names)) {
            *it->second = true;
        } else if (crypto != kCryptoLayerNames.end()) {
            layers.crypto.add(static_cast<CryptoLayer>(crypto - kCryptoLayerNames.begin()));
        } else if (name == "crypto") {
            layers.crypto.add_all();
        } else if (name.starts_with(kOfSet) && name.size() > kOfSet.size()) {
            const std::string set(name.substr(kOfSet.size()));
            if (std::find(layers.line_sets.begin(), layers.line_sets.end(), set) == layers.line_sets.end())
                layers.line_sets.push_back(set);
        } else {
            throw UsageError(
                "unknown layer '" + printable(name) +
                "'; known are beauty,lines,Z,N,ids,coverage,surface,lines_hidden,line,motion,crypto and the layers "
                "of crypto, CryptoObject,CryptoMaterial,CryptoLine,CryptoLineObject,CryptoLineSet");
        }
        if (end != std::string_view::npos) list.remove_prefix(end + 1);
    }
    return layers;
}

LayerSet layers_of(const Scene& scene, const std::optional<LayerSet>& named) {
    std::vector<std::string> of_sets = layers_of_sets(scene);
    if (!named) {
        LayerSet layers;
        layers.lines_hidden = draws_hidden_lines(scene);
        layers.line_sets = std::move(of_sets);
        return layers;
    }
    for (const std::string& set : named->line_sets) {
        if (std::find(of_sets.begin(), of_sets.end(), set) != of_sets.end()) continue;
        std::string known;
        for (const std::string& layer : of_sets) known += (known.empty() ? "" : ",") + std::string(kOfSet) + layer;
        throw UsageError("unknown layer 'lines_" + printable(set) + "'; " +
                         (scene.sheet ? "sets of the style sheet have " + (known.empty() ? "none" : known)
                                      : "only sets of a style sheet have such layers"));
    }
    LayerSet layers = *named;
    layers.crypto_ranks = scene.crypto.ranks;
    if (!scene.sheet && layers.crypto.has(CryptoLayer::line_set)) {
        if (!layers.crypto.is_all)
            throw UsageError("CryptoLineSet has the line sets of a style sheet; give one with --style");
        layers.crypto.remove(CryptoLayer::line_set);
    }
    return layers;
}

}  // namespace burin
