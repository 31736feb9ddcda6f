#include "scene/animation/table_hash.h"

#include <array>
#include <string_view>

#include "base/content_hash.h"

namespace burin {
namespace {

bool is_of_frames(std::string_view key) { return key == "camera" || key == "frames" || key == "turntable"; }
bool is_of_place(std::string_view key) {
    static constexpr std::array<std::string_view, 6> kKeys = {"translate", "rotate",        "scale",
                                                              "matrix",    "interpolation", "key"};
    for (const std::string_view place : kKeys) {
        if (key == place) return true;
    }
    return false;
}

/// `depth`: of the node in the scene. The keys of objects are at depth 2.
void add(const toml::node& node, std::string_view table_name, int depth, ContentHash& hash) {
    hash.add(static_cast<std::uint64_t>(node.type()));
    if (const toml::table* const table = node.as_table()) {
        for (const auto& [key, value] : *table) {  // sorted by key
            if (depth == 0 && is_of_frames(key.str())) continue;
            if (table_name == "object" && is_of_place(key.str())) continue;
            hash.add(key.str());
            add(value, depth == 0 ? key.str() : table_name, depth + 1, hash);
        }
        hash.add(std::uint64_t{0});
    } else if (const toml::array* const array = node.as_array()) {
        for (const toml::node& element : *array) add(element, table_name, depth + 1, hash);
        hash.add(std::uint64_t{array->size()});
    } else if (const auto text = node.value_exact<std::string_view>()) {
        hash.add(*text);
    } else if (const auto whole = node.value_exact<std::int64_t>()) {
        hash.add(static_cast<std::uint64_t>(*whole));
    } else if (const auto number = node.value_exact<double>()) {
        hash.add(*number);
    } else if (const auto truth = node.value_exact<bool>()) {
        hash.add(std::uint64_t{*truth});
    }
}

}  // namespace

std::uint64_t hash_of_scene_tables(const toml::table& tables) {
    ContentHash hash;
    add(tables, "", 0, hash);
    return hash.value();
}

}  // namespace burin
