#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/huge_pages.h"

namespace burin {

/// Names that hold for the polygons behind them, until the next name: in the order of their first use.
class NameUses {
  public:
    /// Name 0 is what stands before the first name.
    NameUses() { number_of(""); }

    /// From polygon number `polygon` on the name is `name`.
    void use(std::string_view name, std::size_t polygon) { use(number_of(name), polygon); }

    /// Uses of a text behind this one, whose polygon 0 is number `first_polygon` here.
    void append(const NameUses& later, std::size_t first_polygon) {
        std::vector<std::uint32_t> numbers;
        for (const std::string& name : later.names_) numbers.push_back(number_of(name));
        for (const Use& u : later.uses_) use(numbers[u.name], first_polygon + u.first_polygon);
    }

    const std::vector<std::string>& names() const { return names_; }

    /// The number of the name of each of `count` polygons.
    std::vector<std::uint32_t> per_polygon(std::size_t count) const {
        std::vector<std::uint32_t> numbers;
        reserve_large(numbers, count);
        std::uint32_t name = 0;
        for (const Use& u : uses_) {
            numbers.resize(u.first_polygon, name);
            name = u.name;
        }
        numbers.resize(count, name);
        return numbers;
    }

  private:
    struct Use {
        std::size_t first_polygon;
        std::uint32_t name;
    };

    std::uint32_t number_of(std::string_view name) {
        const auto [it, is_new] =
            numbers_.try_emplace(std::string(name), static_cast<std::uint32_t>(names_.size()));
        if (is_new) names_.push_back(it->first);
        return it->second;
    }
    void use(std::uint32_t name, std::size_t polygon) {
        if (!uses_.empty() && uses_.back().first_polygon == polygon) uses_.pop_back();
        uses_.push_back({polygon, name});
    }

    std::vector<std::string> names_;
    std::map<std::string, std::uint32_t, std::less<>> numbers_;
    std::vector<Use> uses_;
};

}  // namespace burin
