#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/huge_pages.h"

// Names of objects and materials stand in front of what they hold for, in a text or in a piece of one.

namespace burin {

/// Names that hold for the polygons and lines behind them, until the next name: in the order of
/// their first use.
class NameUses {
  public:
    /// Name 0 is what stands before the first name.
    NameUses() { number_of(""); }

    /// Numbers of the polygon and the line that come next.
    struct Place {
        std::size_t polygon = 0, line = 0;
        bool operator==(const Place&) const = default;
    };

    /// Says that from a place on the name is `name`.
    void use(std::string_view name, Place place) { use(number_of(name), place); }

    /// Uses of a text behind this one, whose first polygon and line have the numbers of `first`
    /// here.
    void append(const NameUses& later, Place first) {
        std::vector<std::uint32_t> numbers;
        for (const std::string& name : later.names_) numbers.push_back(number_of(name));
        for (const Use& u : later.uses_)
            use(numbers[u.name], {first.polygon + u.first.polygon, first.line + u.first.line});
    }

    const std::vector<std::string>& names() const { return names_; }

    /// The number of the name of each of `count` polygons.
    std::vector<std::uint32_t> per_polygon(std::size_t count) const { return per_item(count, &Place::polygon); }
    /// The number of the name of each of `count` lines.
    std::vector<std::uint32_t> per_line(std::size_t count) const { return per_item(count, &Place::line); }

  private:
    struct Use {
        Place first;
        std::uint32_t name;
    };

    std::vector<std::uint32_t> per_item(std::size_t count, std::size_t Place::*item) const {
        std::vector<std::uint32_t> numbers;
        reserve_large(numbers, count);
        std::uint32_t name = 0;
        for (const Use& u : uses_) {
            numbers.resize(u.first.*item, name);
            name = u.name;
        }
        numbers.resize(count, name);
        return numbers;
    }

    std::uint32_t number_of(std::string_view name) {
        const auto [it, is_new] = numbers_.try_emplace(std::string(name), static_cast<std::uint32_t>(names_.size()));
        if (is_new) names_.push_back(it->first);
        return it->second;
    }
    void use(std::uint32_t name, Place place) {
        if (!uses_.empty() && uses_.back().first == place) uses_.pop_back();
        uses_.push_back({place, name});
    }

    std::vector<std::string> names_;
    std::map<std::string, std::uint32_t, std::less<>> numbers_;
    std::vector<Use> uses_;
};

}  // namespace burin
