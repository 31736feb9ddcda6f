#include "render/layer_names.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/error.h"
#include "mesh/text_scan.h"

namespace burin {

LayerSet layers_named(std::string_view list) {
    LayerSet layers{false, false, false, false, false, false, false, false};
    const std::pair<std::string_view, bool*> names[] = {
        {"beauty", &layers.beauty},   {"lines", &layers.lines},
        {"Z", &layers.depth},         {"N", &layers.normal},
        {"ids", &layers.ids},         {"coverage", &layers.coverage},
        {"surface", &layers.surface}, {"lines_hidden", &layers.lines_hidden}};
    for (std::size_t end = 0; end != std::string_view::npos;) {
        end = list.find(',');
        const std::string_view name = list.substr(0, end);
        const auto it =
            std::find_if(std::begin(names), std::end(names), [&](const auto& n) { return n.first == name; });
        if (it == std::end(names)) {
            throw UsageError("unknown layer '" + printable(name) +
                             "'; known are beauty,lines,Z,N,ids,coverage,surface,lines_hidden");
        }
        *it->second = true;
        if (end != std::string_view::npos) list.remove_prefix(end + 1);
    }
    return layers;
}

}  // namespace burin
