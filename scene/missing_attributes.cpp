#include "scene/missing_attributes.h"

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

std::vector<std::string> notes_on_missing_attributes(const Scene& scene, const AttributeWish& wish,
                                                     const std::vector<std::string>& known) {
    std::vector<std::string> notes;
    const auto look_for = [&](AttributeKind kind, const std::string& name, const std::string& what,
                              const std::string& hint) {
        std::vector<std::string> without;
        for (const SceneObject& object : scene.objects) {
            const Mesh& mesh = scene.meshes[object.mesh];
            if (!mesh.triangles.empty() && find_layer(mesh.attributes, kind, name) == nullptr)
                without.push_back(object.name);
        }
        if (without.empty()) return;
        notes.push_back("the style sheet reads " + what + ", which " + listed(without) +
                        (without.size() == 1 ? " has" : " have") + " not: 0 there" + hint);
    };
    if (wish.uv) look_for(AttributeKind::uv, {}, "texture coordinates (u, v)", {});
    if (wish.color) look_for(AttributeKind::color, {}, "colours of vertices (Cv)", {});
    for (const std::string& name : wish.named) {
        look_for(AttributeKind::named, name, "the vertex attribute '" + printable(name, 200) + "'",
                 known.empty() ? "; the models have none with a name" : "; the models have " + listed(known));
    }
    return notes;
}

}  // namespace burin
