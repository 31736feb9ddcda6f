#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace burin::test {

/// What stands in the header of an EXR: the attributes of each part, as bytes. Read by code that is not the writer's.
class ExrHeader {
  public:
    struct Attribute {
        std::string type, bytes;
    };
    using Part = std::map<std::string, Attribute>;

    explicit ExrHeader(const std::string& file) {
        std::uint32_t version = 0;
        std::memcpy(&version, file.data() + 4, sizeof version);
        is_multi_part = (version & 0x1000u) != 0;
        std::size_t at = 8;
        const auto text = [&] {
            const std::string t(file.c_str() + at);
            at += t.size() + 1;
            return t;
        };
        while (at < file.size()) {
            Part& part = parts.emplace_back();
            for (std::string name = text(); !name.empty(); name = text()) {
                const std::string type = text();
                std::int32_t size = 0;
                std::memcpy(&size, file.data() + at, sizeof size);
                part[name] = {type, file.substr(at + 4, static_cast<std::size_t>(size))};
                order.push_back(name);
                at += 4 + static_cast<std::size_t>(size);
            }
            if (!is_multi_part || file[at] == 0) break;
        }
    }

    std::string text(const std::string& name, std::size_t part = 0) const { return parts[part].at(name).bytes; }
    /// Numbers of an attribute.
    template <typename T>
    std::vector<T> numbers(const std::string& name, std::size_t part = 0) const {
        const std::string& bytes = parts[part].at(name).bytes;
        std::vector<T> values(bytes.size() / sizeof(T));
        std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
        return values;
    }
    bool has(const std::string& name, std::size_t part = 0) const { return parts[part].count(name) != 0; }

    bool is_multi_part = false;
    std::vector<Part> parts;
    std::vector<std::string> order;
};

}  // namespace burin::test
