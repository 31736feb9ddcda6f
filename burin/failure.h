#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "base/error.h"
#include "burin/burin.h"
#include "burin/struct_fields.h"

namespace burin {

/// Notes the exception that is being handled as this thread's failure. Returns its burin_result.
int note_failure() noexcept;

/// Runs what a function of the interface does: what it throws becomes a burin_result.
template <typename Work>
int guarded(const Work& work) noexcept {
    try {
        return work();
    } catch (...) {
        return note_failure();
    }
}
/// The same where a pointer is returned.
template <typename Work>
auto guarded_pointer(const Work& work) noexcept -> decltype(work()) {
    try {
        return work();
    } catch (...) {
        note_failure();
        return nullptr;
    }
}

/// Note `index` as the interface returns it: NULL where there is none.
inline const char* note_at(const std::vector<std::string>& notes, int index) {
    return index >= 0 && static_cast<std::size_t>(index) < notes.size() ? notes[static_cast<std::size_t>(index)].c_str()
                                                                        : nullptr;
}

/// Throws UsageError for a pointer that is NULL.
template <typename T>
T& required(T* pointer, const char* name) {
    if (pointer == nullptr) throw UsageError(std::string(name) + " is NULL");
    return *pointer;
}

/// A struct as its caller knows it: fields that came later are 0. Fields that are not known here must be 0.
template <typename Struct>
Struct read_struct(const Struct* given, const char* name) {
    constexpr std::uint32_t kLargest = 4096;
    const std::uint32_t size = required(given, name).size;
    if (size < sizeof(std::uint32_t) || size > kLargest || !ends_between_fields<Struct>(size)) {
        throw UsageError(std::string(name) + ".size is " + std::to_string(size) + "; set it to sizeof(burin_" + name +
                         ")");
    }
    Struct known{};
    std::memcpy(&known, given, std::min<std::size_t>(size, sizeof known));
    const auto* const bytes = reinterpret_cast<const unsigned char*>(given);
    if (size > sizeof known &&
        std::any_of(bytes + sizeof known, bytes + size, [](unsigned char b) { return b != 0; })) {
        throw UsageError(std::string(name) + " has fields that burin " + burin_version() +
                         " does not know; use a newer one");
    }
    return known;
}
/// NULL: all as usual.
template <typename Struct>
Struct read_struct_or_default(const Struct* given, const char* name) {
    return given == nullptr ? Struct{} : read_struct(given, name);
}

}  // namespace burin
