#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace burin {

/// The names that the numbers in one channel of an EXR stand for.
struct NamedIds {
    std::string channel;
    std::string component;  ///< what is named: `object`
    std::map<std::uint32_t, std::string> names;
};

/// The value of an attribute of type `idmanifest`: the size of the names' serial form, and that as a zlib stream. Ids
/// are MurmurHash3 of the names, in every file the same.
std::vector<std::uint8_t> id_manifest(const std::vector<NamedIds>& groups);

}  // namespace burin
