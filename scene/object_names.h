#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

// Objects are meant by names, on the command line and in scene files.

namespace burin {

/// Names by which users mean objects. A name means the object that has it, its parts ("engine"
/// means "engine/piston") and its instances ("tree" means "tree#2").
class ObjectNames {
  public:
    explicit ObjectNames(const std::vector<std::string>& names) {
        for (const std::string& name : names) by_hash_.emplace(hash_of(name), name);
    }

    /// Calls use(name) for each of the names that means the object. The time does not depend on how
    /// many names there are.
    template <typename Use>
    void for_each_of(std::string_view object, const Use& use) const {
        std::uint64_t hash = kStart;
        for (std::size_t i = 0; i <= object.size(); ++i) {
            if (i == object.size() || object[i] == '/' || object[i] == '#') {
                const auto [begin, end] = by_hash_.equal_range(hash);
                for (auto it = begin; it != end; ++it) {
                    if (it->second == object.substr(0, i)) use(it->second);
                }
            }
            if (i < object.size()) hash = next(hash, object[i]);
        }
    }
    bool mean(std::string_view object) const {
        bool is_meant = false;
        if (!by_hash_.empty()) for_each_of(object, [&](const std::string&) { is_meant = true; });
        return is_meant;
    }

  private:
    // FNV-1a: the hash of a name is made of that of the name without its last letter.
    static constexpr std::uint64_t kStart = 0xCBF29CE484222325u;
    static std::uint64_t next(std::uint64_t hash, char c) {
        return (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
    }
    static std::uint64_t hash_of(std::string_view name) {
        std::uint64_t hash = kStart;
        for (const char c : name) hash = next(hash, c);
        return hash;
    }

    std::unordered_multimap<std::uint64_t, std::string> by_hash_;
};

}  // namespace burin
