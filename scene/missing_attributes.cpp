#include "scene/missing_attributes.h"

#include <algorithm>
#include <cstddef>

#include "mesh/text_scan.h"

namespace burin {
namespace {

constexpr std::size_t kMostNames = 5;  // that a note lists

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size() && i < kMostNames; ++i)
        text += (i == 0 ? "'" : ", '") + printable(names[i], 200) + "'";
    if (names.size() > kMostNames) text += " and " + std::to_string(names.size() - kMostNames) + " more";
    return text;
}

}  // namespace

std::vector<std::string> notes_on_missing_attributes(const Scene& scene, const AttributeReaders& readers,
                                                     const std::vector<std::string>& known) {
    std::vector<std::string> notes;
    const auto look_for = [&](AttributeKind kind, const std::string& name, bool by_sheet, bool by_surfaces,
                              const std::string& what, const std::string& hint) {
        if (!by_sheet && !by_surfaces) return;
        std::vector<std::string> without;
        for (const SceneObject& object : scene.objects) {
            const Mesh& mesh = scene.meshes[object.mesh];
            if (!mesh.triangles.empty() && find_layer(mesh.attributes, kind, name) == nullptr)
                without.push_back(object.name);
        }
        if (without.empty()) return;
        const std::string reader = !by_surfaces ? "the style sheet reads "
                                   : !by_sheet  ? "[surfaces] reads "
                                                : "the style sheet and [surfaces] read ";
        notes.push_back(reader + what + ", which " + listed(without) + (without.size() == 1 ? " has" : " have") +
                        " not: 0 there" + hint);
    };
    const AttributeWish &sheet = readers.sheet, &surfaces = readers.surfaces;
    look_for(AttributeKind::uv, {}, sheet.uv, surfaces.uv, "texture coordinates (u, v)", {});
    look_for(AttributeKind::color, {}, sheet.color, surfaces.color, "colours of vertices (Cv)", {});
    const auto asks = [](const AttributeWish& wish, const std::string& name) {
        return std::find(wish.named.begin(), wish.named.end(), name) != wish.named.end();
    };
    std::vector<std::string> names = sheet.named;
    for (const std::string& name : surfaces.named) {
        if (!asks(sheet, name)) names.push_back(name);
    }
    for (const std::string& name : names) {
        look_for(AttributeKind::named, name, asks(sheet, name), asks(surfaces, name),
                 "the vertex attribute '" + printable(name, 200) + "'",
                 known.empty() ? "; the models have none with a name" : "; the models have " + listed(known));
    }
    return notes;
}

}  // namespace burin
