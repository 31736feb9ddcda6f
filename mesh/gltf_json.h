#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "base/error.h"
#include "mesh/text_scan.h"

// JSON of a glTF file is read with every access checked, and named as glTF writes it.

namespace burin {

/// A JSON value together with its place in the file, for messages. Every access is checked.
class JsonPlace {
  public:
    using Json = nlohmann::json;
    JsonPlace(const std::string& file, const Json& value, std::string place)
        : file_(&file), value_(&value), place_(std::move(place)) {}

    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(*file_ + ": " + (place_.empty() ? "the JSON text" : place_) + ": " + message +
                         "; repair or re-export the file");
    }

    const Json& json() const { return *value_; }
    bool has(const char* key) const { return value_->is_object() && value_->contains(key); }

    /// A member that must be there.
    JsonPlace at(const char* key) const {
        if (!has(key)) fail("'" + std::string(key) + "' is missing");
        return {*file_, (*value_)[key], place_.empty() ? key : place_ + "." + key};
    }
    /// Element `index` of an array.
    JsonPlace element(std::size_t index) const {
        if (!value_->is_array() || index >= value_->size()) {
            fail("element " + std::to_string(index) + " does not exist");
        }
        return {*file_, (*value_)[index], place_ + "[" + std::to_string(index) + "]"};
    }
    /// Length of an array.
    std::size_t size() const {
        if (!value_->is_array()) fail("must be an array");
        return value_->size();
    }
    /// Length of the array `key`, 0 when it is not there.
    std::size_t size_of(const char* key) const { return has(key) ? at(key).size() : 0; }

    double number() const {
        if (!value_->is_number()) fail("must be a number");
        const double number = value_->get<double>();
        if (!(std::abs(number) <= kLargestCoordinate)) fail("the number is not finite or beyond 1e30");
        return number;
    }
    double number_or(const char* key, double fallback) const { return has(key) ? at(key).number() : fallback; }
    std::uint64_t integer() const {
        if (value_->is_number_unsigned()) return value_->get<std::uint64_t>();
        if (value_->is_number_float()) {  // some writers put 3.0
            const double number = value_->get<double>();
            if (number >= 0 && number <= 9e15 && number == std::floor(number)) {
                return static_cast<std::uint64_t>(number);
            }
        }
        fail("must be an integer of 0 or more");
    }
    std::uint64_t integer_or(const char* key, std::uint64_t fallback) const {
        return has(key) ? at(key).integer() : fallback;
    }
    /// An integer that counts into an array of `size` elements.
    std::uint32_t index_below(std::size_t size, const char* what) const {
        const std::uint64_t index = integer();
        if (index >= size) {
            fail(std::string(what) + " " + std::to_string(index) + " does not exist (there are " +
                 std::to_string(size) + ")");
        }
        return static_cast<std::uint32_t>(index);
    }
    std::string text() const {
        if (!value_->is_string()) fail("must be a text");
        return value_->get<std::string>();
    }
    /// A text, or a number as it is written.
    std::string text_or_number() const { return value_->is_number() ? value_->dump() : text(); }
    std::string text_or(const char* key, const std::string& fallback) const {
        return has(key) ? at(key).text() : fallback;
    }
    bool boolean() const {
        if (!value_->is_boolean()) fail("must be true or false");
        return value_->get<bool>();
    }
    bool has_extension(const char* name) const { return has("extensions") && at("extensions").has(name); }
    JsonPlace extension(const char* name) const { return at("extensions").at(name); }

  private:
    const std::string* file_;
    const Json* value_;
    std::string place_;
};

/// Throws InputError with the line where the text breaks off, and when it is nested more than 256 deep.
/// `path` is for messages.
nlohmann::json parse_gltf_json(const std::string& path, std::string_view text);

}  // namespace burin
