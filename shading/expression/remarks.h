#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

// What is right in an expression, and yet probably a mistake.

namespace burin {

struct ExpressionRemarks {
    static constexpr std::size_t kMost = 16;  ///< of each kind

    struct Name {
        std::string kind, pattern;
        bool operator==(const Name&) const = default;
    };
    std::vector<Name> names;                   ///< patterns that no name of a scene fits
    std::vector<std::array<float, 3>> colors;  ///< constant ones with a component above 1

    void add(Name name) { add_new(names, std::move(name)); }
    void add(const std::array<float, 3>& color) { add_new(colors, color); }
    void add(const ExpressionRemarks& more) {
        for (const Name& name : more.names) add(name);
        for (const auto& color : more.colors) add(color);
    }

  private:
    template <typename T>
    static void add_new(std::vector<T>& list, T thing) {
        if (list.size() < kMost && std::find(list.begin(), list.end(), thing) == list.end())
            list.push_back(std::move(thing));
    }
};

}  // namespace burin
